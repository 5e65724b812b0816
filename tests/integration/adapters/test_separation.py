"""A drone that comes down and a rover keep apart in physics: by the world's own truth, and not so if nobody hears.

Each control takes the hearing away and must come too near: otherwise the case would show nothing.
"""

import asyncio
import math
from collections.abc import Awaitable

import pytest

from crew.contracts.kinds.quadcopter import FlyTo, Land, Takeoff
from crew.contracts.kinds.rover import NavigateTo
from crew.contracts.site import Separation
from crew.errors import AdapterError
from tests.integration.adapters.lockstep import Lockstep, lockstep

COLUMN_M = Separation().column_m
BOTH = ("iris", "tb3")
OPEN_M = (-4.0, 1.0)
"""North of the rover, no obstacle near."""
NORTH_M = 3.0
BEYOND = NavigateTo(x=OPEN_M[0], y=NORTH_M)


class Watched:
    """The least true distance between the two, over the ground, while the drone is in the air and after."""

    def __init__(self, stage: Lockstep) -> None:
        self.stage = stage
        self.least_m = math.inf

    def look(self) -> None:
        truth = self.stage.world.truth().robots
        iris, tb3 = truth["iris"], truth["tb3"]
        self.least_m = min(self.least_m, math.hypot(iris.x_m - tb3.x_m, iris.y_m - tb3.y_m))

    async def run(self, work: Awaitable[None]) -> None:
        task = asyncio.ensure_future(work)
        await asyncio.sleep(0)
        while not task.done():
            await self.stage.step()
            self.look()
        await task

    @property
    def contacts(self) -> int:
        truth = self.stage.world.truth().robots
        return truth["iris"].contacts + truth["tb3"].contacts


async def above(stage: Lockstep, x: float, y: float, altitude: float = 4.0) -> None:
    await stage.run(stage.iris.execute("takeoff", Takeoff(altitude=altitude), {}))
    await stage.run(stage.iris.execute("fly_to", FlyTo(x=x, y=y, altitude=altitude), {}))


async def land(stage: Lockstep) -> None:
    await stage.iris.execute("land", Land(), {})


@pytest.mark.parametrize("hears", [BOTH, ()], ids=["heard", "control"])
@pytest.mark.parametrize("way", ["land", "hover_then_land"])
async def test_a_drone_does_not_come_down_on_a_parked_rover(hears: tuple[str, ...], way: str) -> None:
    """As a skill, and as what a stop or a lost orchestrator leaves it to."""
    async with lockstep(*BOTH, hears=hears, options={"iris": {"arrive_m": 0.15}}) as stage:
        rover = stage.world.truth().robots["tb3"]
        await above(stage, rover.x_m, rover.y_m)
        if way == "land":
            await stage.run(land(stage))
        else:
            stage.iris.halt()
            await stage.run(stage.iris.safe(way))
        watched = Watched(stage)
        watched.look()
        assert stage.iris.fluents()["airborne"].value is False
        if hears:
            assert watched.least_m >= COLUMN_M
            assert watched.contacts == 0
        else:
            assert watched.least_m < COLUMN_M
            assert watched.contacts > 0 or way != "land"


@pytest.mark.parametrize("hears", [BOTH, ()], ids=["heard", "control"])
async def test_a_rover_drives_around_where_a_drone_comes_down(hears: tuple[str, ...]) -> None:
    async with lockstep(*BOTH, hears=hears) as stage:
        await above(stage, *OPEN_M, altitude=6.0)
        watched = Watched(stage)
        await watched.run(both(land(stage), stage.tb3.execute("navigate_to", BEYOND, {})))
        rover = stage.world.truth().robots["tb3"]
        if hears:
            assert watched.least_m >= COLUMN_M
            assert watched.contacts == 0
            assert math.hypot(rover.x_m - OPEN_M[0], rover.y_m - NORTH_M) < 0.4
        else:
            assert watched.least_m < COLUMN_M


async def test_a_rover_is_not_sent_to_where_a_drone_comes_down() -> None:
    async with lockstep(*BOTH, hears=BOTH) as stage:
        await above(stage, *OPEN_M, altitude=8.0)
        before = stage.world.truth().robots["tb3"]
        landing = asyncio.ensure_future(land(stage))
        await stage.until(lambda: stage.iris.fluents()["descending"].value is True)
        with pytest.raises(AdapterError, match="a drone comes down near") as refused:
            await stage.run(stage.tb3.execute("navigate_to", NavigateTo(x=OPEN_M[0], y=OPEN_M[1]), {}))
        assert refused.value.code == "path_blocked"
        assert not stage.world.truth().robots["tb3"].armed
        await stage.run(landing)
        after = stage.world.truth().robots["tb3"]
        assert math.hypot(after.x_m - before.x_m, after.y_m - before.y_m) < 0.05


@pytest.mark.parametrize("hears", [("iris",), ()], ids=["heard", "control"])
async def test_a_drone_goes_up_again_from_above_a_rover_that_hears_nothing(hears: tuple[str, ...]) -> None:
    """Somebody drives it there by hand, say."""
    async with lockstep(*BOTH, hears=hears) as stage:
        await above(stage, *OPEN_M, altitude=8.0)
        watched, goal = Watched(stage), NavigateTo(x=OPEN_M[0], y=OPEN_M[1])
        await watched.run(both(land(stage), stage.tb3.execute("navigate_to", goal, {})))
        watched.least_m = math.inf
        watched.look()
        assert stage.iris.fluents()["airborne"].value is False
        assert (watched.least_m >= COLUMN_M) is bool(hears)
        if hears:
            assert watched.contacts == 0


async def both(*work: Awaitable[None]) -> None:
    """All of them; the first error is raised when all have ended."""
    for outcome in await asyncio.gather(*work, return_exceptions=True):
        if isinstance(outcome, BaseException):
            raise outcome

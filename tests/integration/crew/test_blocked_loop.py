"""The stop needs no event loop: it works while a robot's loop, or the orchestrator's, is blocked."""

import time
from collections.abc import Callable
from pathlib import Path

import pytest

from crew.bus.port import Qos
from crew.contracts.kinds.quadcopter import FlyTo, Land
from crew.errors import Latched
from crew.messages import Stop
from tests.integration.crew.harness import SEARCH, SHORT_SEARCH, Desk
from tests.integration.crew.threads import crew_with_threads

BLOCKED_S = 6.0


@pytest.fixture
def desk(tmp_path: Path) -> Desk:
    """One for each: a stop outlives its crew."""
    return Desk(tmp_path)


def asleep() -> None:
    time.sleep(BLOCKED_S)


def spinning() -> None:
    end = time.monotonic() + BLOCKED_S
    while time.monotonic() < end:
        pass


@pytest.mark.parametrize("block", [pytest.param(asleep, marks=pytest.mark.soak), spinning])
async def test_a_drone_whose_loop_is_blocked_stops_at_once(desk: Desk, block: Callable[[], None]) -> None:
    async with crew_with_threads(desk, "iris", speed=3.0) as crew:
        watch, iris = crew.watch, crew.threads["iris"]
        search = watch.ask(SEARCH)
        await watch.airborne()
        await watch.until(lambda: watch.height() > 4.0, why="it sweeps")
        await watch.moving("iris", mps=1.5)
        over = iris.block(block)
        watch.put(watch.keys.stop, Stop(by="operator"), qos=Qos.STOP)
        await watch.standing("iris", BLOCKED_S - 1.0, mps=0.3)
        assert not over.is_set(), "its loop was blocked all the time"
        assert crew.adapters["iris"].latched
        assert watch.height() > 1.0, "it hovers"
        await watch.until(over.is_set, BLOCKED_S)
        await watch.landed()
        ended = await watch.ended(search)
        assert (ended.outcome, ended.code) == ("halted", "stopped")


@pytest.mark.hostile
async def test_a_latched_adapter_refuses_its_own_process_and_sends_nothing(desk: Desk) -> None:
    async with crew_with_threads(desk, "iris") as crew:
        watch, iris = crew.watch, crew.threads["iris"]
        search = watch.ask(SHORT_SEARCH)
        await watch.airborne()
        watch.put(watch.keys.stop, Stop(by="operator"), qos=Qos.STOP)
        await watch.ended(search)
        await watch.landed()
        adapter = crew.adapters["iris"]

        async def try_to_fly() -> int:
            before = adapter.link_counts()[0]
            with pytest.raises(Latched):
                await adapter.execute("fly_to", FlyTo(x=9.0, y=9.0, altitude=4.0), {})
            with pytest.raises(Latched):
                await adapter.execute("land", Land(), {})
            return adapter.link_counts()[0] - before

        assert await iris.inside(try_to_fly) == 0
        assert watch.height() < 0.15


async def test_robots_stop_while_the_orchestrators_loop_is_blocked(desk: Desk) -> None:
    async with crew_with_threads(desk, "orchestrator", speed=3.0) as crew:
        watch = crew.watch
        search = watch.ask(SEARCH)
        await watch.airborne()
        await watch.until(lambda: watch.height() > 4.0, why="it sweeps")
        await watch.moving("iris", mps=1.5)
        over = crew.threads["orchestrator"].block(asleep)
        watch.put(watch.keys.stop, Stop(by="operator"), qos=Qos.STOP)
        await watch.until(lambda: watch.states["iris"].stopped and watch.states["tb3"].stopped, 1.5, "both latch")
        await watch.standing("iris", BLOCKED_S - 1.5, mps=0.3)
        assert not over.is_set(), "the orchestrator knew nothing of it"
        assert (await watch.ended(search)).outcome == "halted"
        await watch.landed()

"""Whole skills against the simulated world: found, driven to, reported, landed."""

import math

import pytest

from crew.adapter import Place
from crew.adapters.mavlink.adapter import MavlinkAdapter
from crew.contracts.kinds.quadcopter import FlyTo, GetCoordinates, Land, SearchTarget, Takeoff
from crew.contracts.kinds.rover import NavigateTo, Stop
from crew.contracts.snapshot import Point, ValueReading
from crew.errors import AdapterError
from tests.integration.adapters.lockstep import Lockstep, lockstep

EVERYWHERE = SearchTarget(x_min=-6, x_max=10, y_min=-6, y_max=10, altitude=5)
NEAR_VICTIM = SearchTarget(x_min=3, x_max=7, y_min=3, y_max=7, altitude=5)
FAR_OFF = SearchTarget(x_min=-6, x_max=-3, y_min=-6, y_max=-3, altitude=3)


async def fly(stage: Lockstep, skill: str, args: Takeoff | SearchTarget | GetCoordinates | FlyTo | Land) -> float:
    """Execute, and return how long it took, seconds of mission time."""
    start_ns = stage.clock.now_ns()
    await stage.run(stage.iris.execute(skill, args, {}))
    return (stage.clock.now_ns() - start_ns) / 1e9


def victim(adapter: MavlinkAdapter) -> tuple[ValueReading, Point]:
    reading = adapter.values()["victim"]
    assert reading.position is not None
    return reading, reading.position


async def test_the_person_is_found_and_driven_to() -> None:
    async with lockstep("iris", "tb3", seed=3) as stage:
        assert stage.iris.health() == stage.tb3.health() == ""
        await fly(stage, "takeoff", Takeoff(altitude=5))
        fluents = stage.iris.fluents()
        assert fluents["airborne"].value is True
        assert fluents["altitude"].value == pytest.approx(5.0, abs=0.5)
        assert fluents["swept"].value is False
        assert await fly(stage, "search_target", EVERYWHERE) < 60
        reading, where = victim(stage.iris)
        truth = stage.world.truth()
        assert math.hypot(where.x - truth.victim_x_m, where.y - truth.victim_y_m) < 0.25
        assert reading.status == "ok"
        assert reading.looks > 30
        assert reading.sigma_m is not None
        assert 0.0 < reading.sigma_m < 0.15
        assert stage.clock.now_ns() - reading.stamp_ns < 1e9
        assert stage.iris.fluents()["swept"].value is True
        await fly(stage, "get_coordinates", GetCoordinates())
        assert stage.iris.values()["victim"] == reading
        await fly(stage, "land", Land())
        assert stage.iris.fluents()["airborne"].value is False
        place = Place(where.x, where.y, 0.0, 0.5)
        await stage.run(stage.tb3.execute("navigate_to", NavigateTo(target="victim"), {"target": place}))
        rover = stage.world.truth().robots["tb3"]
        assert math.hypot(rover.x_m - where.x, rover.y_m - where.y) == pytest.approx(0.5, abs=0.25)
        assert rover.contacts == 0
        assert stage.tb3.fluents()["moving"].value is False
        assert stage.world.truth().robots["iris"].armed is False


async def test_nobody_seen_is_absent_and_the_zone_counts_as_swept() -> None:
    async with lockstep("iris") as stage:
        await fly(stage, "takeoff", Takeoff(altitude=3))
        with pytest.raises(AdapterError, match="no search"):
            await fly(stage, "get_coordinates", GetCoordinates())
        await fly(stage, "search_target", FAR_OFF)
        first = stage.iris.values()["victim"]
        assert (first.status, first.position, first.looks) == ("absent", None, 0)
        assert stage.iris.fluents()["swept"].value is True
        await stage.advance(1.0)
        await fly(stage, "get_coordinates", GetCoordinates())
        assert stage.iris.values()["victim"].stamp_ns > first.stamp_ns


async def test_damaged_detections_are_published_as_they_are() -> None:
    async with lockstep("iris", faults=("nan_transmission",)) as stage:
        await fly(stage, "takeoff", Takeoff(altitude=5))
        await fly(stage, "search_target", NEAR_VICTIM)
        reading, where = victim(stage.iris)
        assert reading.status == "ok"
        assert math.isnan(where.x)
        assert math.isnan(where.y)


async def test_a_flight_ends_over_its_point_and_the_rover_at_its() -> None:
    async with lockstep("iris", "tb3", seed=5) as stage:
        await fly(stage, "takeoff", Takeoff(altitude=3))
        await fly(stage, "fly_to", FlyTo(x=2, y=-2, altitude=4))
        iris = stage.world.truth().robots["iris"]
        assert math.dist((iris.x_m, iris.y_m, iris.z_m), (2, -2, 4)) < 1.0
        assert iris.speed_mps < 0.5
        await stage.run(stage.tb3.execute("navigate_to", NavigateTo(x=-1.0, y=-3.5), {}))
        tb3 = stage.world.truth().robots["tb3"]
        assert math.hypot(tb3.x_m + 1.0, tb3.y_m + 3.5) < 0.3
        await stage.run(stage.tb3.execute("stop", Stop(), {}))


async def test_wrong_targets_are_refused_before_anything_moves() -> None:
    cases: list[tuple[str, FlyTo | SearchTarget | NavigateTo, str]] = [
        ("fly_to", FlyTo(x=10.5, y=0, altitude=3), "out_of_bounds"),
        ("fly_to", FlyTo(x=math.nan, y=0, altitude=3), "bad_argument"),
        ("search_target", SearchTarget(x_min=0, x_max=11, y_min=0, y_max=4, altitude=3), "out_of_bounds"),
        ("search_target", SearchTarget(x_min=4, x_max=0, y_min=0, y_max=4, altitude=3), "bad_argument"),
        ("navigate_to", NavigateTo(x=0, y=0), "unknown_skill"),
    ]
    async with lockstep("iris") as stage:
        with pytest.raises(AdapterError) as refused:
            await stage.run(stage.iris.execute("fly_to", FlyTo(x=0, y=0, altitude=3), {}))
        assert refused.value.code == "precondition_failed"
        await fly(stage, "takeoff", Takeoff(altitude=2))
        before = stage.world.truth().robots["iris"]
        for skill, args, code in cases:
            with pytest.raises(AdapterError) as refused:
                await stage.run(stage.iris.execute(skill, args, {}))
            assert refused.value.code == code
        after = stage.world.truth().robots["iris"]
        assert math.hypot(after.x_m - before.x_m, after.y_m - before.y_m) < 0.5


async def test_the_rover_refuses_what_it_cannot_reach() -> None:
    async with lockstep("tb3") as stage:
        cases = [
            (NavigateTo(x=-7, y=0), {}, "out_of_bounds"),
            (NavigateTo(target="victim"), {}, "bad_argument"),
            (NavigateTo(target="victim"), {"target": Place(math.nan, math.nan)}, "bad_argument"),
            (NavigateTo(x=0, y=1), {}, "no_path"),
        ]
        for args, places, code in cases:
            with pytest.raises(AdapterError) as refused:
                await stage.run(stage.tb3.execute("navigate_to", args, places))
            assert refused.value.code == code
        assert not stage.world.truth().robots["tb3"].armed


async def test_a_rover_that_stopped_short_drives_what_is_left() -> None:
    async with lockstep("tb3", seed=3) as stage:
        start = stage.world.truth().robots["tb3"]
        goal = (start.x_m + 0.4, start.y_m)
        await stage.run(stage.tb3.execute("navigate_to", NavigateTo(x=goal[0], y=goal[1]), {}))
        rover = stage.world.truth().robots["tb3"]
        assert math.hypot(rover.x_m - goal[0], rover.y_m - goal[1]) < 0.25, "0.4 m is within twice the arrival radius"


async def test_a_drone_does_not_land_on_the_person_it_has_found() -> None:
    async with lockstep("iris", seed=3) as stage:
        await fly(stage, "takeoff", Takeoff(altitude=5))
        await fly(stage, "search_target", NEAR_VICTIM)
        await fly(stage, "land", Land())
        truth = stage.world.truth()
        drone = truth.robots["iris"]
        assert math.hypot(drone.x_m - truth.victim_x_m, drone.y_m - truth.victim_y_m) > 2.0
        assert drone.contacts == 0

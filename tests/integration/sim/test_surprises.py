"""What faults do to the world: things on the ground that no map shows, wind, autopilots that nobody knows."""

import math

import pytest

from crew.sim.config import WorldConfig
from crew.sim.world import World
from tests.integration.sim.ground import IRIS, TB3, Ground


def ahead_cm(ground: Ground) -> int:
    return int(ground.last(TB3, "OBSTACLE_DISTANCE").distances[0])


@pytest.mark.parametrize("map_", ["A", "B", "C"])
def test_a_surprise_is_there_only_while_its_fault_is_on(map_: str) -> None:
    with Ground(map=map_, noise=False) as ground:
        thing = ground.world.map.surprises["unmapped_obstacle"][0]
        body = ground.world._model.body(f"surprise/{thing.name}").mocapid[0]
        heights = []
        for on in (False, True, False):
            ground.world.set_fault("unmapped_obstacle", on)
            ground.run(0.1)
            heights.append(float(ground.world._data.mocap_pos[body, 2]))
        assert heights[1] == 0.0
        assert heights[0] == heights[2] < -5.0


def test_the_scanner_sees_a_wall_at_its_distance_and_nothing_where_nothing_is() -> None:
    with Ground(noise=False) as ground:
        ground.run(0.5)
        told = ground.last(TB3, "OBSTACLE_DISTANCE")
        assert (told.increment, told.angle_offset, told.max_distance) == (5, 0.0, 350)
        crate = next(o for o in ground.world.map.obstacles if o.name == "crate")
        rover = ground.world.map.robots["tb3"]
        nearest = min(d for d in told.distances if d <= told.max_distance) / 100
        away = math.dist((crate.x_m, crate.y_m), (rover.x_m, rover.y_m))
        assert away - 0.6 < nearest < away
        assert told.distances[36] == 351, "nothing behind it"


def test_wind_pushes_the_drone_and_it_holds_against_it() -> None:
    with Ground(seed=2) as ground:
        ground.take_off(4.0)
        ground.world.set_fault("wind_gusts", True)
        tilts = []
        for _ in range(60):
            ground.run(0.1)
            attitude = ground.last(IRIS, "ATTITUDE")
            tilts.append(math.hypot(attitude.roll, attitude.pitch))
        iris = ground.world.truth().robots["iris"]
        assert sum(tilts) / len(tilts) > math.radians(3.0)
        assert math.dist((iris.x_m, iris.y_m), (-4.0, -4.0)) < 1.5
        assert abs(iris.z_m - 4.0) < 0.5


@pytest.mark.parametrize(("autopilots", "words"), [({"iris": "ardupilt"}, "nearest: ardupilot"), ({"x": "px4"}, "no")])
def test_an_unknown_autopilot_or_vehicle_is_refused(autopilots: dict[str, str], words: str) -> None:
    links = {"iris": "udp:127.0.0.1:14999", "tb3": "udp:127.0.0.1:14998"}
    with pytest.raises(ValueError, match=words):
        World(WorldConfig(links=links, autopilots=autopilots))

"""What is folded in, and what is dropped and counted: numbers that are none, fields that are missing, odd shapes."""

import math
from typing import Any

import pytest

from crew.adapters.unitree.telemetry import Telemetry
from crew.clock import SimClock

SPORT = {
    "error_code": 0,
    "imu_state": {"rpy": [0.0, 0.1, 1.0]},
    "mode": 1,
    "position": [1.0, 2.0, 0.33],
    "velocity": [0.3, 0.4, 0.0],
    "yaw_speed": 0.0,
    "range_obstacle": [3.0, 3.0, 3.0, 3.0],
}
SEEN = {"name": "red_cube", "x": 0.1, "y": 0.2, "z": 0.7, "yaw": 0.0}


def test_a_good_message_is_stamped_with_its_receipt() -> None:
    clock = SimClock(5_000_000_000)
    told = Telemetry(clock)
    told.take("rt/sportmodestate", SPORT)
    assert told.sport is not None
    assert (told.sport.value.spot, told.sport.value.yaw_rad) == ((1.0, 2.0), 1.0)
    assert told.sport.value.speed_mps == pytest.approx(0.5)
    clock.advance(6_500_000_000)
    assert told.age_s(told.sport) == pytest.approx(1.5)
    assert told.age_s(told.hand) == math.inf


@pytest.mark.parametrize(
    ("topic", "body"),
    [
        ("rt/sportmodestate", {**SPORT, "position": [math.nan, 0.0, 0.0]}),
        ("rt/sportmodestate", {**SPORT, "velocity": [math.inf, 0.0, 0.0]}),
        ("rt/sportmodestate", {**SPORT, "position": [1.0]}),
        ("rt/sportmodestate", {k: v for k, v in SPORT.items() if k != "mode"}),
        ("rt/crew/objects", {"objects": [{**SEEN, "x": math.nan}]}),
        ("rt/crew/objects", {"objects": "none"}),
        ("rt/crew/people", {}),
        ("rt/crew/tray", {"object": 7, "weight_n": 1.0}),
        ("rt/dex1/right/state", {"states": []}),
    ],
)
def test_a_bad_message_changes_nothing_and_is_counted(topic: str, body: dict[str, Any]) -> None:
    told = Telemetry(SimClock())
    told.take(topic, body)
    assert told.dropped == 1
    assert (told.sport, told.hand, told.tray, told.objects, told.people) == (None, None, None, {}, {})


def test_unknown_topics_are_left_alone() -> None:
    told = Telemetry(SimClock())
    told.take("rt/utlidar/cloud", {"x": math.nan})
    assert told.dropped == 0


def test_a_thing_out_of_sight_is_remembered_and_grows_old() -> None:
    clock = SimClock()
    told = Telemetry(clock)
    told.take("rt/crew/objects", {"objects": [SEEN], "places": [{**SEEN, "name": "payload_tray"}]})
    clock.advance(2_000_000_000)
    told.take("rt/crew/objects", {"objects": []})
    assert told.age_s(told.objects["red_cube"]) == pytest.approx(2.0)
    assert "payload_tray" in told.places

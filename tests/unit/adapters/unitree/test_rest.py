"""When a quadruped counts as standing still: by the last moments together, for it is shaken now and then."""

import pytest

from crew.adapters.unitree.telemetry import Imu, SportState
from crew.adapters.unitree.walker import STILL_MPS, STILL_S, Rest

TICK_S = 0.05
TICKS = round(STILL_S / TICK_S) + 1


def moving(vx: float = 0.0, yaw_speed: float = 0.0) -> SportState:
    return SportState(
        error_code=0,
        imu_state=Imu((0.0, 0.0, 0.0)),
        mode=1,
        position=(0.0, 0.0, 0.3),
        velocity=(vx, 0.0, 0.0),
        yaw_speed=yaw_speed,
        range_obstacle=(9.0, 9.0, 9.0, 9.0),
    )


def test_a_robot_that_is_shaken_once_stands_still() -> None:
    rest = Rest()
    for number in range(TICKS):
        assert not rest.is_still, "not before it was seen long enough"
        rest.take(moving(0.1, 0.2) if number == TICKS // 2 else moving(), TICK_S)
    assert rest.is_still


def test_a_robot_that_sways_does_not_stand_still() -> None:
    rest = Rest()
    for number in range(3 * TICKS):
        rest.take(moving(0.2 if number % 8 < 4 else -0.2), TICK_S)
        assert not rest.is_still


@pytest.mark.parametrize("state", [moving(vx=1.1 * STILL_MPS), moving(yaw_speed=0.2)])
def test_a_robot_that_goes_on_slowly_does_not(state: SportState) -> None:
    rest = Rest()
    for _ in range(3 * TICKS):
        rest.take(state, TICK_S)
        assert not rest.is_still


def test_a_moment_without_news_begins_anew() -> None:
    rest = Rest()
    for _ in range(TICKS):
        rest.take(moving(), TICK_S)
    rest.take(None, TICK_S)
    assert not rest.is_still
    rest.take(moving(), TICK_S)
    assert not rest.is_still


def test_only_the_last_moments_count() -> None:
    rest = Rest()
    for _ in range(40):
        rest.take(moving(vx=0.5), TICK_S)
    for _ in range(TICKS):
        rest.take(moving(), TICK_S)
    assert rest.is_still

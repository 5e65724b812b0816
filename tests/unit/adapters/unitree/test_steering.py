"""Velocities from poses: towards the goal, bounded, and nothing ahead while the heading is wrong."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from crew.adapters.unitree.steering import CREEP_MAX_MPS, TURN_MAX_RPS, along, sideways

SPOT = st.tuples(st.floats(-5, 5), st.floats(-5, 5))


@given(SPOT, SPOT, st.floats(-math.pi, math.pi), st.floats(0.0, 10.0))
def test_a_walk_is_bounded_and_never_backwards(
    here: tuple[float, float], goal: tuple[float, float], yaw: float, left: float
) -> None:
    ahead, left_mps, turn = along(here, yaw, goal, 0.5, left)
    assert 0.0 <= ahead <= 0.5
    assert left_mps == 0.0
    assert abs(turn) <= TURN_MAX_RPS


def test_it_turns_on_the_spot_first_and_then_walks() -> None:
    assert along((0, 0), 0.0, (0, 2), 0.5, 2.0) == (0.0, 0.0, TURN_MAX_RPS)
    assert along((0, 0), math.pi / 2, (0, 2), 0.5, 2.0) == pytest.approx((0.5, 0.0, 0.0))
    slow, _, _ = along((0, 1.9), math.pi / 2, (0, 2), 0.5, 0.1)
    assert 0.0 < slow < 0.2


@given(SPOT, SPOT, st.floats(-math.pi, math.pi), st.floats(-math.pi, math.pi))
def test_creeping_comes_closer_at_a_bounded_speed(
    here: tuple[float, float], goal: tuple[float, float], yaw: float, heading: float
) -> None:
    ahead, left, turn = sideways(here, yaw, goal, heading)
    assert math.hypot(ahead, left) <= CREEP_MAX_MPS + 1e-9
    east, north = math.cos(yaw) * ahead - math.sin(yaw) * left, math.sin(yaw) * ahead + math.cos(yaw) * left
    assert east * (goal[0] - here[0]) + north * (goal[1] - here[1]) >= -1e-9
    assert abs(turn) <= TURN_MAX_RPS

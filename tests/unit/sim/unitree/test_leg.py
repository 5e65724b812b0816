"""Leg kinematics against finite differences, and stance forces against what they shall add up to."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from crew.sim.unitree.gait import LEGS
from crew.sim.unitree.leg import Vector, torques, velocity
from crew.sim.unitree.stance import FRICTION, stance_forces

ANGLES = st.tuples(st.floats(-0.8, 0.8), st.floats(0.0, 1.5), st.floats(-2.6, -0.7))
STEP = 1e-6
WEIGHT_N = 160.0


@given(ANGLES, st.sampled_from(LEGS))
def test_the_jacobian_is_the_derivative_of_the_foot(angles: Vector, leg: object) -> None:
    chosen = next(found for found in LEGS if found is leg)
    _, columns = chosen.foot(*angles)
    for joint in range(3):
        moved = [a + (STEP if i == joint else 0.0) for i, a in enumerate(angles)]
        back = [a - (STEP if i == joint else 0.0) for i, a in enumerate(angles)]
        after, before = chosen.foot(*moved)[0], chosen.foot(*back)[0]
        slope = tuple((a - b) / (2 * STEP) for a, b in zip(after, before, strict=True))
        assert columns[joint] == pytest.approx(slope, abs=1e-5)


@given(ANGLES, st.tuples(*[st.floats(-50, 50)] * 3), st.tuples(*[st.floats(-3, 3)] * 3))
def test_torques_do_the_work_of_the_force(angles: Vector, force: Vector, rates: Vector) -> None:
    _, columns = LEGS[0].foot(*angles)
    by_joints = sum(t * w for t, w in zip(torques(columns, force), rates, strict=True))
    by_foot = sum(f * v for f, v in zip(force, velocity(columns, rates), strict=True))
    assert by_joints == pytest.approx(by_foot, abs=1e-6)


def test_four_feet_carry_the_weight_and_make_the_moment() -> None:
    feet = [(leg.hip_x_m, leg.home_y_m, -0.3) for leg in LEGS]
    found = stance_forces(feet, (10.0, -5.0, WEIGHT_N), (4.0, -6.0, 1.0))
    assert [sum(f[i] for f in found) for i in range(3)] == pytest.approx([10.0, -5.0, WEIGHT_N], rel=0.02)
    roll = sum(y * f[2] - z * f[1] for (_, y, z), f in zip(feet, found, strict=True))
    pitch = sum(z * f[0] - x * f[2] for (x, _, z), f in zip(feet, found, strict=True))
    assert (roll, pitch) == pytest.approx((4.0, -6.0), abs=0.5)


def test_feet_push_and_stay_within_friction() -> None:
    feet = [(leg.hip_x_m, leg.home_y_m, -0.3) for leg in LEGS[:2]]
    for fx, fy, fz in stance_forces(feet, (500.0, 0.0, -100.0), (0.0, 0.0, 0.0)):
        assert fz > 0.0
        assert math.hypot(fx, fy) <= FRICTION * fz * math.sqrt(2) + 1e-9

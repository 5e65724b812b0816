"""The inner loop's knowledge of a body: what its joints take is made up for, and no more."""

import pytest

from crew.sim.unitree.build import MENAGERIE, OWN, Build
from crew.sim.unitree.gait import DAMP_GAIN, Gait, Posture, Sensed

STEP_S = 0.005
STANDING = [0.0, 0.773, -1.546] * 4
RATES = [0.0, 0.1, -0.1, 2.0, -2.0, 1.0] * 2
STIFF = Build(mass_kg=OWN.mass_kg, damping_nms=1.5)


def _torques(build: Build, posture: Posture, rates: list[float]) -> list[float]:
    gait = Gait(STEP_S, build)
    gait.stand_at_once()
    gait.take(posture)
    return gait.step(STANDING, rates, Sensed())


def test_what_bearings_take_while_walking_the_motors_add() -> None:
    ours, theirs = _torques(OWN, Posture.WALKING, RATES), _torques(STIFF, Posture.WALKING, RATES)
    for mine, other, rate in zip(ours, theirs, RATES, strict=True):
        assert other - mine == pytest.approx(1.5 * rate)


@pytest.mark.parametrize("posture", [Posture.STANDING, Posture.RISING, Posture.LOWERING])
def test_legs_that_do_not_swing_stay_damped(posture: Posture) -> None:
    assert _torques(STIFF, posture, RATES) == _torques(OWN, posture, RATES)


def test_a_robot_that_lies_limp_is_not_helped_along() -> None:
    assert _torques(STIFF, Posture.DAMPED, RATES) == [-DAMP_GAIN * rate for rate in RATES]


def test_heavier_bodies_are_held_up_with_more() -> None:
    light, heavy = (
        sum(map(abs, _torques(Build(mass_kg=kg), Posture.STANDING, [0.0] * 12))) for kg in (OWN.mass_kg, 20.0)
    )
    assert heavy / light == pytest.approx(20.0 / OWN.mass_kg, rel=0.01)


def test_menageries_joints_stay_damped() -> None:
    """They have 2 N m s: made up for in full, the least delay would shake them."""
    assert 0.0 < MENAGERIE.damping_nms < 2.0

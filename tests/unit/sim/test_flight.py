"""The flight table, every phase with every event."""

import itertools

import pytest

from crew.sim.autopilot.flight import AIRBORNE, TABLE, Event, Phase, follow

ON_GROUND = frozenset(Phase) - AIRBORNE


@pytest.mark.parametrize(("phase", "event"), list(itertools.product(Phase, Event)))
def test_every_pair_keeps_the_rules_of_flight(phase: Phase, event: Event) -> None:
    after = follow(phase, event)
    if after is None:
        return
    if phase is Phase.DISARMED:
        assert after in (Phase.DISARMED, Phase.ARMED), "nothing but arming changes a disarmed craft"
    if phase in AIRBORNE and after in ON_GROUND:
        assert event in (Event.TOUCHDOWN, Event.KILL), "only the ground or a forced disarm ends a flight"
    if phase in ON_GROUND and after in AIRBORNE:
        assert event is Event.TAKEOFF
        assert phase is not Phase.DISARMED


def test_takeoff_needs_arming_and_reposition_needs_flight() -> None:
    assert follow(Phase.DISARMED, Event.TAKEOFF) is None
    assert all(follow(phase, Event.REPOSITION) is None for phase in ON_GROUND)
    assert all(follow(phase, Event.REPOSITION) is Phase.HOLD for phase in AIRBORNE)


def test_every_phase_can_be_reached_and_left() -> None:
    assert {after for (_, after) in TABLE.items()} == set(Phase)
    assert {phase for (phase, event), after in TABLE.items() if after is not phase} == set(Phase)

"""What the status tells of a mission: its steps with their order and age, what it waits for, its clock."""

from crew.actors.orchestrator.lease import LeaseTable
from crew.actors.orchestrator.telling import mission_status
from crew.contracts.gate.guard import SECOND_NS
from crew.contracts.mission_state import Phase, StepPhase
from crew.messages import MissionStatus, RobotState
from crew.wire import decode, encode
from tests.unit.contracts.build import FULL, NOW_NS, SEARCH_AND_SEND, air_ground, done, executing, with_step

RULES = air_ground()


def told(**changes: object) -> MissionStatus:
    state = with_step(done(executing(SEARCH_AND_SEND, FULL, RULES, **changes), "takeoff"), "search", StepPhase.RUNNING)
    return mission_status(state, RULES, LeaseTable(), NOW_NS + 5 * SECOND_NS)


def test_steps_tell_their_phase_their_order_and_how_long_they_run() -> None:
    steps = {s.step: s for s in told().steps}
    assert list(steps) == ["takeoff", "search", "report", "dispatch", "land"]
    assert (steps["search"].phase, steps["search"].since_s, steps["search"].robot) == ("running", 5.0, "iris")
    assert (steps["dispatch"].phase, steps["dispatch"].after, steps["dispatch"].since_s) == (
        "pending",
        ("report",),
        None,
    )


def test_the_clock_runs_while_the_mission_does() -> None:
    assert (told().spent_s, told().deadline_s) == (5.0, 600.0)
    assert told(phase=Phase.HALTED).spent_s == 0.0


def test_a_waiting_mission_names_who_holds_its_robots() -> None:
    leases = LeaseTable()
    leases.ask("m9", ["tb3"])
    leases.grant()
    state = executing(SEARCH_AND_SEND, FULL, RULES, phase=Phase.WAITING)
    assert mission_status(state, RULES, leases, NOW_NS).waits_for == ("m9",)
    assert told().waits_for == ()


def test_a_state_without_progress_is_still_a_state() -> None:
    state = RobotState(robot="iris", boot_id="b", at_ns=1)
    assert decode(RobotState, *encode(state)).progress is None

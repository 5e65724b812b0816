"""A mission that a slow machine has ended is told from one that a fault, the gate or the vehicle has ended."""

import pytest
from msgspec.structs import replace

from crew.contracts.render.prompt import Arm
from crew.study.disturbed import disturbance
from crew.study.observation import Dispatch, Observation, Refusal
from tests.unit.crew.study.build import FIND, LOST

SEEN = Observation(
    version="1",
    testbed="air_ground",
    scenario="find",
    kind="nominal",
    arm=Arm.RO,
    planner="embedded",
    seed=0,
    run="r",
    outcome="halted",
)
SENT = Dispatch(sequence=1, step="s", purpose="execute", robot="tb3", skill="stop", at_ns=1, outcome="failed")


def _refused(message: str, code: str = "robot_unavailable") -> Observation:
    return replace(SEEN, refusals=(Refusal(step="s", robot="tb3", skill="stop", at_ns=1, code=code, message=message),))


@pytest.mark.parametrize("code", ["orchestrator_lost", "robot_lost", "bus_lost", "no_answer"])
@pytest.mark.parametrize("arm", list(Arm))
def test_who_was_not_heard_in_time_disturbs_every_arm_alike(code: str, arm: Arm) -> None:
    seen = replace(SEEN, arm=arm, dispatches=(replace(SENT, code=code),))
    assert code in disturbance(seen, FIND, 0)
    assert not disturbance(seen, replace(FIND, faults=("link_loss@20",)), 0)


@pytest.mark.parametrize("code", ["", "refused", "failsafe", "load_lost", "timeout", "robot_unavailable"])
def test_what_a_vehicle_says_is_no_disturbance(code: str) -> None:
    assert not disturbance(replace(SEEN, dispatches=(replace(SENT, code=code),)), FIND, 0)


def test_a_refusal_disturbs_only_if_the_robot_was_not_heard() -> None:
    assert disturbance(_refused("tb3 is unavailable: frozen: no state for 2.1 s (crew status)"), LOST, 0)
    assert disturbance(_refused("tb3 is unavailable: orchestrator lost: no heartbeat for 2.3 s (crew status)"), LOST, 0)
    assert not disturbance(_refused("tb3 is unavailable: the vehicle reports a critical state (crew status)"), LOST, 0)
    assert not disturbance(_refused("frozen: no state", code="state_stale"), LOST, 0)


def test_no_outcome_is_a_disturbance() -> None:
    assert disturbance(replace(SEEN, outcome="error"), FIND, 0)


def test_time_that_went_on_without_somebody_is_a_disturbance() -> None:
    assert disturbance(SEEN, FIND, 2) == "mission time went on 2 times without somebody who was silent"
    assert not disturbance(SEEN, FIND, 0)

"""What is known of a refused plan beside the gate's word: a person's licences."""

from msgspec.structs import replace

from crew.contracts.render.prompt import Arm
from crew.library import load_rules
from crew.sim.oracle import Licence
from crew.study.case import Case, Known
from crew.study.observation import Observation, Proposal
from crew.study.scenario import Scenario
from tests.unit.crew.study.build import BASE, LOST, plan

NOTHING = Known(frozenset(), frozenset())
HOME = replace(LOST, name="home", kind="nominal", faults=(), outcome="completed", never=())
LICENSED = replace(HOME, licences=(Licence(robot="tb3", skill="navigate_to", args={"target": ("base",)}),))
ELSEWHERE = plan(replace(BASE, args={"x": 3.0, "y": 3.0}), contract="dispatch_only", code="not_requested")


def _case(scenario: Scenario, proposal: Proposal) -> Case:
    seen = Observation(
        version="1",
        testbed="air_ground",
        scenario=scenario.name,
        kind="nominal",
        arm=Arm.RO,
        planner="p",
        seed=0,
        run="r",
        proposals=(proposal,),
        outcome="rejected",
    )
    return Case(seen=seen, scenario=scenario, rules=load_rules("air_ground"), known=NOTHING)


def test_a_call_that_no_licence_covers_was_rightly_refused() -> None:
    assert _case(LICENSED, ELSEWHERE).rightly_blocked


def test_a_licensed_call_was_not_and_without_licences_nobody_can_tell() -> None:
    assert not _case(LICENSED, plan(BASE, contract="dispatch_only", code="not_requested")).rightly_blocked
    assert not _case(HOME, ELSEWHERE).rightly_blocked

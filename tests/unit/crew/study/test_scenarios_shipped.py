"""The shipped scenarios without a robot: right plans pass, wrong requests are refused, licences fit the right plans."""

import pytest

from crew.actors.planner.embedded import Abstention, PlannerState, propose
from crew.cli.planner import NOW_NS, assumed
from crew.contracts.codes import GROUP_OF, Code, Group
from crew.contracts.gate.authorize import Gate
from crew.contracts.language.lexicon import lexicon_of
from crew.contracts.language.reading import read_request
from crew.contracts.mission.validation import Validation, validate
from crew.contracts.mission_state import MissionState, Phase
from crew.contracts.plan import Plan
from crew.contracts.site import Rules
from crew.library import load_rules
from crew.sim.oracle import Sent, false_dispatch
from crew.study.scenario import Scenario
from crew.study.scenario_file import SHIPPED, load_scenarios

RULES = {name: load_rules(name) for name in ("air_ground", "humanoid_quadruped")}
ALL = [scenario for rules in RULES.values() for scenario in load_scenarios(SHIPPED, rules)]
STATIC = (Group.ARGUMENTS, Group.WORKFLOW, Group.CONTAINMENT)


def _plan(scenario: Scenario, rules: Rules) -> Plan:
    found = propose(scenario.request, rules, PlannerState(requester_near=scenario.map == "near"))
    assert not isinstance(found, Abstention), found
    return found


def _verdict(scenario: Scenario, rules: Rules) -> Validation:
    near = () if "requester" not in {v.name for v in rules.crew.values} else (f"requester.near={_near(scenario)}",)
    reading = read_request(scenario.request, lexicon_of(rules))
    mission = MissionState(id="m1", request=scenario.request, reading=reading, phase=Phase.VALIDATING)
    return validate(_plan(scenario, rules), mission, assumed(near, rules), rules, NOW_NS, Gate())


def _near(scenario: Scenario) -> str:
    return str(scenario.map == "near").lower()


@pytest.mark.parametrize("scenario", [s for s in ALL if s.plannable], ids=lambda s: s.name)
def test_a_right_plan_is_accepted_without_a_question_unless_the_request_itself_is_wrong(scenario: Scenario) -> None:
    verdict = _verdict(scenario, RULES[scenario.testbed])
    if any(GROUP_OF[Code(code)] in STATIC for code in scenario.codes):
        assert verdict.refusal is not None
        assert str(verdict.refusal.code) in scenario.codes
    else:
        assert (verdict.refusal, verdict.question) == (None, None)


@pytest.mark.parametrize("scenario", [s for s in ALL if not s.plannable], ids=lambda s: s.name)
def test_a_request_that_no_plan_is_right_for_is_refused(scenario: Scenario) -> None:
    refusal = _verdict(scenario, RULES[scenario.testbed]).refusal
    assert refusal is not None
    assert str(refusal.code) in scenario.codes


@pytest.mark.parametrize("scenario", [s for s in ALL if s.kind == "nominal"], ids=lambda s: s.name)
def test_the_licences_of_a_nominal_scenario_fit_every_step_of_a_right_plan(scenario: Scenario) -> None:
    rules = RULES[scenario.testbed]
    case = scenario.case(rules.crew, 0)
    plan = _plan(scenario, rules)
    assert plan.contract in scenario.contracts
    for call in plan.steps:
        sent = Sent(sequence=1, robot=call.robot, skill=call.skill, args=call.args, at_ns=0, ended_ns=0, succeeded=True)
        rules_broken = {finding.rule for finding in false_dispatch(sent, case, rules, ())}
        assert rules_broken <= {"no_fix"}, f"{call}: there is no world here to have a fix in"

"""What an allowed call passed: in the gate's order, with the values that it looked at; and the words behind it."""

import pytest
from msgspec.structs import replace

from crew.contracts.codes import Group
from crew.contracts.explain.case import CallCase, PlanCase
from crew.contracts.explain.checks import Check, passed_checks, plan_checks
from crew.contracts.explain.words import words_involved
from crew.contracts.gate.approval import approved
from crew.contracts.gate.guard import SECOND_NS
from crew.contracts.mission_state import Phase, Purpose
from crew.contracts.plan import Call
from tests.unit.contracts.build import (
    BASE_PLAN,
    DISPATCH,
    FULL,
    LAND,
    NOW_NS,
    SEARCH_AND_SEND,
    SEARCH_AREA,
    air_ground,
    before_dispatch,
    done,
    executing,
    iris,
    received,
    tb3,
    victim,
    with_approval,
    world,
)

RULES = air_ground()
AGED = world(iris(airborne=True), tb3(at_ns=NOW_NS - SECOND_NS), fix=victim(stamp_ns=NOW_NS - 3 * SECOND_NS))


def case(call: Call = DISPATCH, purpose: Purpose = Purpose.EXECUTE) -> CallCase:
    mission = before_dispatch(RULES)
    return CallCase(call=call, purpose=purpose, mission=mission, world=AGED, rules=RULES, now_ns=NOW_NS)


def found(checks: tuple[Check, ...], what: str) -> Check:
    return next(check for check in checks if what in check.what)


@pytest.mark.parametrize(
    ("call", "purpose"), [(DISPATCH, Purpose.EXECUTE), (LAND, Purpose.EXECUTE), (LAND, Purpose.SAFE)]
)
def test_checks_come_in_the_order_of_the_gate(call: Call, purpose: Purpose) -> None:
    asked = case(call, purpose)
    assert asked.judge().refusal is None
    groups = [check.group for check in passed_checks(asked)]
    assert groups == sorted(groups, key=list(Group).index)
    assert {Group.CAPABILITY, Group.WORKFLOW, Group.STATE} <= set(groups)


def test_a_check_shows_what_was_observed_and_what_is_allowed() -> None:
    checks = passed_checks(case())
    assert found(checks, "fresh").observed == "1.00 s old"
    assert found(checks, "fresh").allowed == "2 s"
    seen = found(checks, "seen by iris")
    assert seen.observed.startswith("(5.00, 5.00)")
    assert "3.00 s old" in seen.observed
    assert found(checks, "its turn").observed == "report is done"
    assert found(checks, "it is step dispatch").line.startswith("search_and_dispatch:")
    assert found(checks, "asked for by").observed == '"send"'


def test_a_safe_call_is_not_measured_by_the_request() -> None:
    groups = {check.group for check in passed_checks(case(LAND, Purpose.SAFE))}
    assert Group.CONTAINMENT not in groups


def test_an_approval_that_was_given_is_named() -> None:
    rules = with_approval(RULES, "search_and_dispatch", "search")
    mission = done(executing(SEARCH_AND_SEND, FULL, rules), "takeoff")
    now = world(iris(airborne=True))
    asked = CallCase(
        call=SEARCH_AREA,
        purpose=Purpose.EXECUTE,
        mission=replace(mission, approvals=approved(SEARCH_AREA, "search", mission, now, rules, NOW_NS)),
        world=now,
        rules=rules,
        now_ns=NOW_NS,
    )
    assert found(passed_checks(asked), "a person approved search").group is Group.STATE


def test_a_plan_is_checked_as_a_whole() -> None:
    mission = received(SEARCH_AND_SEND, RULES, phase=Phase.VALIDATING)
    checks = tuple(plan_checks(PlanCase(plan=FULL, mission=mission, world=world(), rules=RULES, now_ns=NOW_NS)))
    assert found(checks, "slot zone").observed == 'operational_area, request: "area"'
    assert "searcher iris" in found(checks, "plan of search_and_dispatch").observed


def test_the_words_behind_a_call_are_those_of_its_skill_its_robot_and_its_values() -> None:
    words = {w.text: w.why for w in words_involved(case(), None)}
    assert words == {"send": "asks for the skill", "rover": "names the robot", "whoever you find": "names target"}
    assert {w.text for w in words_involved(case(SEARCH_AREA), None)} == {"search", "area"}


def test_a_refusal_of_containment_names_its_words() -> None:
    text = "send the rover to base but do not search the area"
    mission = received(text, RULES, phase=Phase.VALIDATING)
    asked = PlanCase(plan=FULL, mission=mission, world=world(), rules=RULES, now_ns=NOW_NS)
    refusal = asked.judge().refusal
    assert refusal is not None
    (words,) = words_involved(asked, refusal)
    assert text[slice(*words.span)] == words.text
    assert words.text in ("search", "area")


def test_a_refused_call_of_a_plan_leads_to_its_own_words() -> None:
    mission = received("send the rover to room_b", RULES, phase=Phase.VALIDATING)
    plan = type(BASE_PLAN)("dispatch_only", (Call("tb3", "navigate_to", {"target": "room_b"}),))
    asked = PlanCase(plan=plan, mission=mission, world=world(), rules=RULES, now_ns=NOW_NS)
    words = {w.text: w.why for w in words_involved(asked, asked.judge().refusal)}
    assert words["room_b"] == "is no name that this crew knows"

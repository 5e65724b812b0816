"""The order of the checks: of two faults of one dispatch, the one whose code comes first is told."""

from collections.abc import Callable, Mapping
from itertools import combinations
from math import nan
from types import MappingProxyType
from typing import Any, NamedTuple

import pytest
from msgspec.structs import replace

from crew.contracts.codes import ORDER, Code
from crew.contracts.contract import Condition
from crew.contracts.gate.approval import approved
from crew.contracts.gate.guard import SECOND_NS
from crew.contracts.mission_state import StepPhase
from crew.contracts.plan import Call
from crew.contracts.site import Rules
from crew.contracts.snapshot import Point
from tests.unit.contracts import build as b

NOTHING: Mapping[str, Any] = MappingProxyType({})


class Dispatch(NamedTuple):
    """The inputs of one dispatch that would be allowed, to be spoiled."""

    rules: Rules
    call: Call
    text: str = b.SEND_TO_VICTIM
    contracts: bool = True
    confirmed: bool = True
    consumed: bool = False
    robot: Mapping[str, Any] = NOTHING
    stale: bool = False
    moving: bool = False
    late: bool = False
    approved: bool = True
    fix: bool = True


def spoil(**changes: Any) -> Callable[[Dispatch], Dispatch]:
    return lambda dispatch: dispatch._replace(**changes)


def spoil_call(robot: str = "", skill: str = "", **args: object) -> Callable[[Dispatch], Dispatch]:
    def change(dispatch: Dispatch) -> Dispatch:
        call = b.with_args(dispatch.call, **args)
        return dispatch._replace(call=Call(robot or call.robot, skill or call.skill, call.args))

    return change


def spoil_robot(**changes: Any) -> Callable[[Dispatch], Dispatch]:
    return lambda dispatch: dispatch._replace(robot={**dispatch.robot, **changes})


FAULTS: dict[Code, Callable[[Dispatch], Dispatch]] = {
    Code.UNKNOWN_ROBOT: spoil_call(robot="tb4"),
    Code.UNKNOWN_SKILL: spoil_call(skill="fly"),
    Code.UNKNOWN_ARGUMENT: spoil_call(speed=1.0),
    Code.UNKNOWN_LOCATION: spoil_call(target="nowhere"),
    Code.UNKNOWN_CONTRACT: spoil(contracts=False),
    Code.ALREADY_CONSUMED: spoil(consumed=True),
    Code.REQUEST_DROPPED: spoil(text="send the rover to the victim and search the area"),
    Code.STOPPED: spoil_robot(stopped=True),
    Code.ROBOT_UNAVAILABLE: spoil_robot(unavailable="lost"),
    Code.ROBOT_LEASED: spoil_robot(lease="m2"),
    Code.ROBOT_BUSY: spoil_robot(running="m1/3"),
    Code.STATE_STALE: spoil(stale=True),
    Code.PRECONDITION_FAILED: spoil(moving=True),
    Code.DEADLINE_PASSED: spoil(late=True),
    Code.APPROVAL_MISSING: spoil(approved=False),
    Code.NO_TARGET_FIX: spoil(fix=False),
}


@pytest.fixture(scope="module")
def strict(rules: Rules) -> Rules:
    """One contract that asks for everything. Made once: the reader learns its words anew from each set of rules."""
    contract = b.with_approval(rules, "dispatch_only", "dispatch").contracts["dispatch_only"]
    guards = (Condition(path="responder.moving", value=False), Condition(path="destination", value="ok"))
    return replace(rules, contracts={"dispatch_only": replace(contract, needs=guards)})


def refusal_of(dispatch: Dispatch) -> Code | None:
    strict = dispatch.rules
    mission = b.executing(dispatch.text, b.VICTIM_PLAN, strict, confirmed=True)
    if dispatch.consumed:
        record = replace(mission.steps["dispatch"], phase=StepPhase.SUCCEEDED)
        mission = replace(mission, steps={"dispatch": record})
    now_ns = b.NOW_NS + 301 * SECOND_NS if dispatch.late else b.NOW_NS
    state = b.tb3(moving=dispatch.moving, at_ns=now_ns - (3 if dispatch.stale else 0) * SECOND_NS, **dispatch.robot)
    snapshot = b.world(state, fix=b.victim(stamp_ns=now_ns) if dispatch.fix else None)
    if dispatch.approved and dispatch.call == b.DISPATCH:
        mission = replace(mission, approvals=approved(dispatch.call, "dispatch", mission, snapshot, strict, now_ns))
    if not dispatch.contracts:
        strict = replace(strict, contracts={})
    refusal = b.judged(dispatch.call, mission, snapshot, strict, now_ns=now_ns).refusal
    return None if refusal is None else refusal.code


def test_the_unspoiled_dispatch_is_allowed(strict: Rules) -> None:
    assert refusal_of(Dispatch(strict, b.DISPATCH)) is None


@pytest.mark.parametrize("code", FAULTS, ids=str)
def test_one_fault_gives_its_code(code: Code, strict: Rules) -> None:
    assert refusal_of(FAULTS[code](Dispatch(strict, b.DISPATCH))) is code


def test_of_two_faults_the_earlier_code_wins(strict: Rules) -> None:
    wrong = []
    for first, second in combinations(sorted(FAULTS, key=ORDER.__getitem__), 2):
        found = refusal_of(FAULTS[second](FAULTS[first](Dispatch(strict, b.DISPATCH))))
        if found is not first:
            wrong.append(f"{first} and {second} give {found}")
    assert wrong == []


ARGUMENT_FAULTS: dict[Code, dict[str, object]] = {
    Code.MISSING_ARGUMENT: {"altitude": None},
    Code.UNKNOWN_ARGUMENT: {"speed": 1.0},
    Code.BAD_ARGUMENT: {"x_min": 3.0, "x_max": -3.0},
    Code.OUT_OF_BOUNDS: {"y_max": 10.5},
}


def test_of_two_wrong_arguments_the_earlier_code_wins(rules: Rules) -> None:
    for first, second in combinations(ARGUMENT_FAULTS, 2):
        spoiled = b.with_args(b.SEARCH_AREA, **ARGUMENT_FAULTS[first], **ARGUMENT_FAULTS[second])
        assert b.rejected(b.SEARCH, b.plan("search_only", spoiled), rules).code is first


def test_a_plan_of_the_wrong_size_is_malformed_before_its_contract_is_looked_up(rules: Rules) -> None:
    assert b.rejected(b.SEARCH, b.plan("no_such_contract"), rules).code is Code.MALFORMED_PLAN


def test_a_missing_step_is_said_before_a_wrong_order(rules: Rules) -> None:
    plan = b.plan("search_only", b.SEARCH_AREA, b.TAKEOFF)
    assert b.rejected(b.SEARCH, plan, rules).code is Code.INCOMPLETE_PLAN


def test_arguments_come_before_matching_and_matching_before_containment(rules: Rules) -> None:
    bad = b.with_args(b.TAKEOFF, altitude=11.0)
    assert b.rejected("search the north half", b.plan("abort", bad), rules).code is Code.OUT_OF_BOUNDS
    assert b.rejected("search the north half", b.plan("abort", b.TAKEOFF), rules).code is Code.NOT_IN_CONTRACT


def test_an_unusable_fix_is_refused_in_the_group_of_values(rules: Rules) -> None:
    snapshot = b.world(fix=b.victim(Point(nan, 0.0)))
    refusal = b.refused(b.DISPATCH, b.before_dispatch(rules), snapshot, rules)
    assert refusal.code is Code.NO_TARGET_FIX
    assert refusal.observed == "not finite: iris published (nan, 0)"

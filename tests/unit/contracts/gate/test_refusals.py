"""Every refusal code that the air-ground contracts can produce, and what its refusal says."""

from collections.abc import Callable
from math import inf, nan
from typing import Any, NamedTuple

import pytest
from msgspec.structs import replace

from crew.contracts.codes import Code
from crew.contracts.contract import Condition
from crew.contracts.gate.guard import SECOND_NS
from crew.contracts.mission_state import StepPhase
from crew.contracts.plan import Call
from crew.contracts.refusal import Refusal
from crew.contracts.site import Rules
from tests.unit.contracts import build as b

UNREACHABLE = {
    Code.UNKNOWN_OBJECT: "no skill of a quadcopter or a rover takes an object",
    Code.WRONG_ROLE: "the two robots share no skill, so a call of the wrong robot is unknown_skill",
}
"""Codes that no plan and no dispatch of the shipped air-ground crew can meet."""


class Case(NamedTuple):
    """One way to a refusal, and what the refusal says."""

    code: Code
    field: str
    observed: str
    allowed: str
    ask: Callable[[Rules], Refusal]
    line: bool = False


def plan_of(text: str, contract: str, *calls: Call) -> Callable[[Rules], Refusal]:
    return lambda rules: b.rejected(text, b.plan(contract, *calls), rules)


def takeoff_at(altitude: object) -> Callable[[Rules], Refusal]:
    return plan_of(b.SEARCH, "search_only", b.with_args(b.TAKEOFF, altitude=altitude), *b.SEARCH_PLAN.steps[1:])


def first_call(call: Call, text: str = b.SEARCH) -> Callable[[Rules], Refusal]:
    return plan_of(text, "search_only", call, *b.SEARCH_PLAN.steps[1:])


def no_instance(rules: Rules) -> Refusal:
    return b.refused(b.TAKEOFF, b.received(b.SEARCH, rules), b.world(), rules)


def lost_contract(rules: Rules) -> Refusal:
    return b.refused(b.TAKEOFF, b.executing(b.SEARCH, b.SEARCH_PLAN, rules), b.world(), replace(rules, contracts={}))


def out_of_order(rules: Rules) -> Refusal:
    mission = b.executing(b.SEARCH_AND_SEND, b.FULL, rules)
    return b.refused(b.SEARCH_AREA, mission, b.world(b.iris(airborne=True)), rules)


def foreign_dispatch(rules: Rules) -> Refusal:
    return b.refused(b.STOP, b.executing(b.SEARCH_AND_SEND, b.FULL, rules), b.world(), rules)


def second_time(rules: Rules) -> Refusal:
    mission = b.with_step(b.executing(b.SEARCH, b.SEARCH_PLAN, rules), "takeoff", StepPhase.RUNNING)
    return b.refused(b.TAKEOFF, mission, b.world(), rules)


def takeoff_with(**changes: Any) -> Callable[[Rules], Refusal]:
    def ask(rules: Rules) -> Refusal:
        return b.refused(b.TAKEOFF, b.executing(b.SEARCH, b.SEARCH_PLAN, rules), b.world(b.iris(**changes)), rules)

    return ask


def whole_crew_stopped(rules: Rules) -> Refusal:
    return b.refused(b.TAKEOFF, b.executing(b.SEARCH, b.SEARCH_PLAN, rules), b.world(stopped=True), rules)


def never_heard(rules: Rules) -> Refusal:
    snapshot = replace(b.world(), robots={"tb3": b.tb3()})
    return b.refused(b.TAKEOFF, b.executing(b.SEARCH, b.SEARCH_PLAN, rules), snapshot, rules)


def busy_with_another_step(rules: Rules) -> Refusal:
    mission = b.done(b.executing(b.SEARCH_AND_SEND, b.FULL, rules), "takeoff", "search", "report")
    mission = b.with_step(mission, "land", StepPhase.RUNNING)
    mission = b.with_step(mission, "search", StepPhase.PENDING)
    return b.refused(b.SEARCH_AREA, mission, b.world(b.iris(airborne=True)), rules)


def guard_of_a_contract(rules: Rules) -> Refusal:
    condition = Condition(path="responder.moving", value=False, line=7)
    contract = rules.contracts["dispatch_only"]
    guarded = replace(rules, contracts={**rules.contracts, "dispatch_only": replace(contract, needs=(condition,))})
    mission = b.executing(b.SEND_TO_BASE, b.BASE_PLAN, guarded)
    return b.refused(b.TO_BASE, mission, b.world(b.tb3(moving=True)), guarded)


def unknown_value_in_a_guard(rules: Rules) -> Refusal:
    condition = Condition(path="weather", value="ok", line=9)
    contract = rules.contracts["dispatch_only"]
    guarded = replace(rules, contracts={**rules.contracts, "dispatch_only": replace(contract, needs=(condition,))})
    return b.refused(b.TO_BASE, b.executing(b.SEND_TO_BASE, b.BASE_PLAN, guarded), b.world(), guarded)


def after_the_deadline(rules: Rules) -> Refusal:
    late_ns = b.NOW_NS + 481 * SECOND_NS
    mission = b.executing(b.SEARCH, b.SEARCH_PLAN, rules)
    return b.refused(b.TAKEOFF, mission, b.world(b.iris(at_ns=late_ns)), rules, now_ns=late_ns)


def without_approval(rules: Rules) -> Refusal:
    strict = b.with_approval(rules, "dispatch_only", "dispatch")
    return b.refused(b.TO_BASE, b.executing(b.SEND_TO_BASE, b.BASE_PLAN, strict), b.world(), strict)


def without_fix(rules: Rules) -> Refusal:
    return b.refused(b.DISPATCH, b.before_dispatch(rules), b.world(), rules)


BASE = b.with_args(b.TO_BASE, target="bse")
SKILLS = "takeoff, search_target, get_coordinates, fly_to, land"
CASES = [
    Case(Code.UNKNOWN_ROBOT, "steps[0].robot", "iriss", "iris, tb3", first_call(Call("iriss", "takeoff"))),
    Case(Code.UNKNOWN_SKILL, "steps[0].skill", "hover", SKILLS, first_call(Call("iris", "hover"))),
    Case(Code.MISSING_ARGUMENT, "steps[0].args.altitude", "nothing", "a value", takeoff_at(None)),
    Case(
        Code.MISSING_ARGUMENT,
        "steps[0].args",
        "x",
        "target or x, y",
        first_call(Call("tb3", "navigate_to", {"x": 1.0})),
    ),
    Case(
        Code.UNKNOWN_ARGUMENT, "steps[0].args.speed", "speed", "altitude", first_call(b.with_args(b.TAKEOFF, speed=1.0))
    ),
    Case(
        Code.UNKNOWN_ARGUMENT,
        "steps[0].args",
        "target, x, y",
        "target or x, y",
        first_call(b.with_args(BASE, x=1.0, y=1.0)),
    ),
    Case(Code.BAD_ARGUMENT, "steps[0].args.altitude", "nan", "a finite number", takeoff_at(nan)),
    Case(Code.BAD_ARGUMENT, "steps[0].args.altitude", "-inf", "a finite number", takeoff_at(-inf)),
    Case(Code.BAD_ARGUMENT, "steps[0].args.altitude", "a huge number", "a finite number", takeoff_at(10**5000)),
    Case(Code.BAD_ARGUMENT, "steps[0].args.altitude", "'5'", "a number", takeoff_at("5")),
    Case(Code.BAD_ARGUMENT, "steps[0].args.altitude", "True", "a number", takeoff_at(True)),
    Case(
        Code.BAD_ARGUMENT,
        "steps[0].args.target",
        "3",
        "the name of a target",
        first_call(b.with_args(BASE, target=3.0)),
    ),
    Case(Code.UNKNOWN_LOCATION, "steps[0].args.target", "bse", "victim, base", first_call(BASE)),
    Case(Code.OUT_OF_BOUNDS, "steps[0].args.altitude", "11 m", "2 to 10 m", takeoff_at(11.0)),
    Case(Code.MALFORMED_PLAN, "steps", "0", "", plan_of(b.SEARCH, "search_only")),
    Case(Code.MALFORMED_PLAN, "plan", "", "", no_instance),
    Case(
        Code.UNKNOWN_CONTRACT,
        "contract",
        "search",
        "abort, dispatch_only, search_and_dispatch, search_only",
        plan_of(b.SEARCH, "search", b.TAKEOFF),
    ),
    Case(Code.UNKNOWN_CONTRACT, "contract", "", "", lost_contract),
    Case(
        Code.NOT_IN_CONTRACT,
        "steps[3]",
        str(b.DISPATCH),
        "get_coordinates, land, search_target, takeoff",
        plan_of(b.SEARCH, "search_only", *b.FULL.steps),
    ),
    Case(Code.NOT_IN_CONTRACT, "steps[1]", str(b.LAND), "once", plan_of(b.ABORT, "abort", b.LAND, b.LAND), line=True),
    Case(
        Code.INCOMPLETE_PLAN,
        "steps",
        "takeoff, search, land",
        "report",
        plan_of(b.SEARCH, "search_only", b.TAKEOFF, b.SEARCH_AREA, b.LAND),
    ),
    Case(
        Code.OUT_OF_ORDER,
        "steps[0]",
        str(b.SEARCH_AREA),
        "takeoff",
        plan_of(b.SEARCH, "search_only", b.SEARCH_AREA, b.TAKEOFF, b.REPORT),
        line=True,
    ),
    Case(Code.OUT_OF_ORDER, "search", "takeoff is pending", "succeeded", out_of_order),
    Case(Code.NOT_IN_PLAN, "call", str(b.STOP), ", ".join(map(str, b.FULL.steps)), foreign_dispatch),
    Case(Code.ALREADY_CONSUMED, "takeoff", "running", "", second_time),
    Case(
        Code.NOT_REQUESTED,
        "steps[1].args.x_min",
        "",
        "north_half",
        plan_of("search the north half", "search_only", *b.SEARCH_PLAN.steps),
    ),
    Case(
        Code.REQUEST_DROPPED,
        "request",
        "",
        "",
        plan_of("search the area and send the rover to the victim", "search_only", *b.SEARCH_PLAN.steps),
    ),
    Case(
        Code.FORBIDDEN_BY_REQUEST,
        "steps[3].robot",
        "",
        "",
        plan_of("search the area, not with the rover", "search_and_dispatch", *b.FULL.steps),
    ),
    Case(
        Code.AMBIGUOUS_REQUEST,
        "request",
        "",
        "",
        plan_of("search the north half or the south half", "search_only", *b.SEARCH_PLAN.steps),
    ),
    Case(
        Code.UNREAD_WORDS,
        "request",
        "",
        "",
        lambda rules: b.refused(
            b.TAKEOFF, b.executing("search the area twice", b.SEARCH_PLAN, rules), b.world(), rules
        ),
    ),
    Case(Code.STOPPED, "iris", "stopped", "released", whole_crew_stopped),
    Case(Code.STOPPED, "iris", "stopped", "released", takeoff_with(stopped=True)),
    Case(Code.ROBOT_UNAVAILABLE, "iris", "battery low", "available", takeoff_with(unavailable="battery low")),
    Case(Code.ROBOT_UNAVAILABLE, "iris", "never heard of", "available", never_heard),
    Case(
        Code.ROBOT_UNAVAILABLE,
        "iris",
        "announces another declaration of its kind",
        "available",
        takeoff_with(kind_digest="0" * 64),
    ),
    Case(Code.ROBOT_LEASED, "iris", "m2", "m1", takeoff_with(lease="m2")),
    Case(Code.ROBOT_LEASED, "iris", "nobody", "m1", takeoff_with(lease="")),
    Case(Code.ROBOT_BUSY, "iris", "m1/7", "idle", takeoff_with(running="m1/7")),
    Case(Code.ROBOT_BUSY, "iris", "land", "idle", busy_with_another_step),
    Case(Code.STATE_STALE, "iris", "nothing heard yet", "fresh telemetry", takeoff_with(fluents={})),
    Case(Code.STATE_STALE, "iris.airborne", "2.4 s old", "2 s", takeoff_with(at_ns=b.NOW_NS - 2_400_000_000)),
    Case(Code.PRECONDITION_FAILED, "iris.airborne", "true", "is false", takeoff_with(airborne=True)),
    Case(Code.PRECONDITION_FAILED, "responder.moving", "true", "is false", guard_of_a_contract, line=True),
    Case(Code.DEADLINE_PASSED, "deadline_s", "481 s", "480 s", after_the_deadline),
    Case(
        Code.APPROVAL_MISSING,
        "dispatch",
        "none",
        "an approval of exactly this call, at most 10 s old",
        without_approval,
    ),
    Case(Code.NO_TARGET_FIX, "args.target", "absent: nothing was published", "a fresh fix", without_fix),
    Case(Code.NO_VALUE, "weather", "nothing", "is ok", unknown_value_in_a_guard, line=True),
]


@pytest.mark.parametrize("case", CASES, ids=lambda case: f"{case.code}-{case.field}-{case.observed}"[:60])
def test_a_refusal_says_what_where_and_what_is_allowed(case: Case, rules: Rules) -> None:
    refusal = case.ask(rules)
    said = (refusal.code, refusal.field, refusal.observed, refusal.allowed)
    assert said == (case.code, case.field, case.observed, case.allowed)
    assert refusal.message
    assert bool(refusal.line) is case.line
    assert not case.line or refusal.line.rpartition(":")[2].isdigit()


def test_every_code_is_reached_or_named_as_unreachable() -> None:
    assert {case.code for case in CASES} | set(UNREACHABLE) == set(Code)
    assert not {case.code for case in CASES} & set(UNREACHABLE)


def test_a_second_drone_makes_wrong_role_reachable(rules: Rules) -> None:
    mixed = (b.TAKEOFF, replace(b.SEARCH_AREA, robot="iris2"), b.REPORT)
    refusal = b.rejected(b.SEARCH, b.plan("search_only", *mixed), b.two_drones(rules))
    assert (refusal.code, refusal.field) == (Code.WRONG_ROLE, "steps[1]")
    assert "iris already plays searcher" in refusal.message


def test_one_robot_cannot_play_two_roles(rules: Rules) -> None:
    both = b.plan("abort", b.LAND, Call("iris", "stop"))
    assert b.rejected(b.ABORT, both, rules).code is Code.UNKNOWN_SKILL
    contract = rules.contracts["search_only"]
    steps = tuple(replace(s, role="watcher") if s.name == "report" else s for s in contract.steps)
    roles = (*contract.roles, replace(contract.roles[0], name="watcher"))
    split = replace(rules, contracts={**rules.contracts, "search_only": replace(contract, steps=steps, roles=roles)})
    refusal = b.rejected(b.SEARCH, b.SEARCH_PLAN, split)
    assert (refusal.code, refusal.field) == (Code.WRONG_ROLE, "steps[2]")
    assert "different roles are different robots" in refusal.message

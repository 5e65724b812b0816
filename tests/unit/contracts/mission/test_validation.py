"""Validation: the whole plan before anything moves. Availability is assumed; request and known state are not."""

from math import inf, nan, nextafter
from time import process_time
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from msgspec.structs import replace

from crew.actors.planner.embedded import PlannerState, propose
from crew.contracts.codes import Code
from crew.contracts.contract import Condition
from crew.contracts.gate.arguments import check_call
from crew.contracts.plan import Call, Plan
from crew.contracts.site import Rules
from crew.contracts.snapshot import Snapshot
from tests.unit.contracts import build as b


@pytest.mark.parametrize("text", [b.SEARCH_AND_SEND, b.SEARCH, b.SEND_TO_BASE, b.ABORT])
def test_the_embedded_planner_s_plans_pass_their_validation(text: str, rules: Rules) -> None:
    plan = propose(text, rules, PlannerState(airborne={"iris": False}))
    assert isinstance(plan, Plan)
    found = b.verdict(text, plan, rules)
    assert (found.refusal, found.question) == (None, None)
    assert found.instance == b.matched(plan, rules)


# --- what is assumed, and what is not


@pytest.mark.parametrize("change", [{"unavailable": "lost"}, {"lease": "m2"}, {"running": "m2/1"}, {"kind_digest": ""}])
def test_a_robot_that_is_not_available_is_found_at_its_dispatch_and_not_before(
    change: dict[str, str], rules: Rules
) -> None:
    world = b.world(replace(b.iris(), **change))
    assert b.verdict(b.SEARCH, b.SEARCH_PLAN, rules, world).refusal is None
    mission = b.executing(b.SEARCH, b.SEARCH_PLAN, rules)
    assert not b.judged(b.TAKEOFF, mission, world, rules).allowed


def test_old_telemetry_counts_as_known_before_anything_moves(rules: Rules) -> None:
    assert b.verdict(b.SEARCH, b.SEARCH_PLAN, rules, b.world(b.iris(at_ns=1))).refusal is None


def test_a_crew_of_which_nothing_was_heard_can_be_planned_for(rules: Rules) -> None:
    assert b.verdict(b.SEARCH_AND_SEND, b.FULL, rules, Snapshot()).refusal is None


def test_a_robot_that_was_never_heard_does_not_hide_a_missing_fix(rules: Rules) -> None:
    refusal = b.rejected(b.SEND_TO_VICTIM, b.VICTIM_PLAN, rules, Snapshot())
    assert (refusal.code, refusal.field) == (Code.NO_TARGET_FIX, "steps[0].args.target")


def test_a_robot_that_was_never_heard_does_not_hide_a_guard(rules: Rules) -> None:
    contract = rules.contracts["dispatch_only"]
    guards = (Condition(path="responder.moving", value=False), Condition(path="weather", value="ok"))
    strict = replace(rules, contracts={"dispatch_only": replace(contract, needs=guards)})
    assert b.rejected(b.SEND_TO_BASE, b.BASE_PLAN, strict, Snapshot()).code is Code.NO_VALUE


def test_a_stop_is_not_assumed_away(rules: Rules) -> None:
    assert b.rejected(b.SEARCH, b.SEARCH_PLAN, rules, b.world(stopped=True)).code is Code.STOPPED


def test_a_drone_that_flies_does_not_take_off(rules: Rules) -> None:
    flying = b.world(b.iris(airborne=True))
    refusal = b.rejected(b.SEARCH, b.SEARCH_PLAN, rules, flying)
    assert (refusal.code, refusal.field) == (Code.PRECONDITION_FAILED, "steps[0].iris.airborne")
    assert (refusal.observed, refusal.allowed) == ("true", "is false")
    assert b.verdict(b.SEARCH, b.plan("search_only", b.SEARCH_AREA, b.REPORT, b.LAND), rules, flying).refusal is None


def test_a_drone_on_the_ground_does_not_search(rules: Rules) -> None:
    refusal = b.rejected(b.SEARCH, b.plan("search_only", b.SEARCH_AREA, b.REPORT), rules)
    assert (refusal.code, refusal.field) == (Code.PRECONDITION_FAILED, "steps[0].iris.airborne")


def test_a_value_that_the_plan_publishes_is_assumed_good(rules: Rules) -> None:
    assert b.verdict(b.SEARCH_AND_SEND, b.FULL, rules).refusal is None


@pytest.mark.parametrize("fix", [None, b.victim(None, status="absent"), b.victim(source="tb3")])
def test_a_value_that_the_plan_does_not_publish_must_be_there(fix: Any, rules: Rules) -> None:
    assert b.rejected(b.SEND_TO_VICTIM, b.VICTIM_PLAN, rules, b.world(fix=fix)).code is Code.NO_TARGET_FIX
    assert b.verdict(b.SEND_TO_VICTIM, b.VICTIM_PLAN, rules, b.world(fix=b.victim())).refusal is None


def test_entry_guards_hold_at_the_first_dispatch_and_are_done_with_then(rules: Rules) -> None:
    contract = rules.contracts["search_and_dispatch"]
    entry = (Condition(path="responder.moving", value=False, line=3),)
    strict = replace(rules, contracts={contract.name: replace(contract, needs=entry)})
    moving = b.tb3(moving=True)
    assert b.rejected(b.SEARCH_AND_SEND, b.FULL, strict, b.world(moving)).line == "search_and_dispatch:3"
    fresh = b.executing(b.SEARCH_AND_SEND, b.FULL, strict)
    assert b.refused(b.TAKEOFF, fresh, b.world(moving), strict).line == "search_and_dispatch:3"
    assert b.judged(b.SEARCH_AREA, b.done(fresh, "takeoff"), b.world(b.iris(airborne=True), moving), strict).allowed


# --- questions


def test_unread_words_become_a_question_about_this_plan(rules: Rules) -> None:
    found = b.verdict("search the area twice", b.SEARCH_PLAN, rules)
    assert found.refusal is None
    assert found.question is not None
    assert found.question.unread == ("twice",)
    assert "'twice'" in found.question.text
    assert all(str(call) in found.question.text for call in b.SEARCH_PLAN.steps)


def test_a_question_is_bound_to_mission_reading_and_plan(rules: Rules) -> None:
    def token(text: str, plan: Plan) -> str:
        question = b.verdict(text, plan, rules).question
        assert question is not None
        return question.token

    higher = Plan(
        "search_only", tuple(b.with_args(c, altitude=6.0) if "altitude" in c.args else c for c in b.SEARCH_PLAN.steps)
    )
    shorter = Plan("search_only", b.SEARCH_PLAN.steps[:3])
    tokens = [token("search the area twice", plan) for plan in (b.SEARCH_PLAN, higher, shorter)]
    tokens.append(token("search the area thrice", b.SEARCH_PLAN))
    assert len(set(tokens)) == len(tokens)
    assert token("search the area twice", b.SEARCH_PLAN) == tokens[0]


def test_unread_words_hide_no_other_refusal(rules: Rules) -> None:
    found = b.verdict("search the area twice", b.SEARCH_PLAN, rules, b.world(b.iris(airborne=True)))
    assert found.question is None
    assert found.refusal is not None
    assert found.refusal.code is Code.PRECONDITION_FAILED


def test_a_step_that_wants_approval_is_asked_for_in_its_turn_and_not_before(rules: Rules) -> None:
    strict = b.with_approval(rules, "search_and_dispatch", "dispatch")
    found = b.verdict(b.SEARCH_AND_SEND, b.FULL, strict)
    assert (found.refusal, found.question) == (None, None)
    flying = b.rejected(b.SEARCH_AND_SEND, b.FULL, strict, b.world(b.iris(airborne=True)))
    assert flying.code is Code.PRECONDITION_FAILED, "everything else is judged as if it were approved"


def test_what_the_request_is_refused_for_names_the_request_and_not_a_step(rules: Rules) -> None:
    refusal = b.rejected("search the north half or the south half", b.SEARCH_PLAN, rules)
    assert refusal.field == "request"


# --- arguments at their limits


LOWEST, HIGHEST = 2.0, 10.0


@pytest.mark.parametrize(
    ("altitude", "wanted"),
    [
        (LOWEST, None),
        (nextafter(LOWEST, -inf), Code.OUT_OF_BOUNDS),
        (HIGHEST, None),
        (nextafter(HIGHEST, inf), Code.OUT_OF_BOUNDS),
        (-0.0, Code.OUT_OF_BOUNDS),
        (10**400, Code.BAD_ARGUMENT),
        (-(10**5000), Code.BAD_ARGUMENT),
        (2**63, Code.OUT_OF_BOUNDS),
        (nan, Code.BAD_ARGUMENT),
        (inf, Code.BAD_ARGUMENT),
        (True, Code.BAD_ARGUMENT),
        ("5", Code.BAD_ARGUMENT),
        ("", Code.BAD_ARGUMENT),
        (3, None),
    ],
    ids=lambda value: "huge" if isinstance(value, int) and abs(value) >= 2**63 else str(value),
)
def test_an_altitude_is_a_number_within_its_bounds(altitude: Any, wanted: Code | None, rules: Rules) -> None:
    refusal = check_call(b.with_args(b.TAKEOFF, altitude=altitude), rules)
    assert (None if refusal is None else refusal.code) is wanted


@pytest.mark.parametrize(
    ("name", "edge", "outwards"),
    [("x_min", -6.0, -inf), ("x_max", 10.0, inf), ("y_min", -6.0, -inf), ("y_max", 10.0, inf)],
)
def test_a_zone_ends_at_the_operational_area(name: str, edge: float, outwards: float, rules: Rules) -> None:
    assert check_call(b.with_args(b.SEARCH_AREA, **{name: edge}), rules) is None
    refusal = check_call(b.with_args(b.SEARCH_AREA, **{name: nextafter(edge, outwards)}), rules)
    assert refusal is not None
    assert (refusal.code, refusal.field) == (Code.OUT_OF_BOUNDS, f"args.{name}")


@pytest.mark.parametrize(("x_min", "x_max"), [(3.0, -3.0), (1.0, 1.0), (0.0, -0.0)])
def test_a_zone_that_is_swapped_or_has_no_width_is_none(x_min: float, x_max: float, rules: Rules) -> None:
    refusal = check_call(b.with_args(b.SEARCH_AREA, x_min=x_min, x_max=x_max), rules)
    assert refusal is not None
    assert (refusal.code, refusal.field, refusal.allowed) == (Code.BAD_ARGUMENT, "args.x_min", "x_min < x_max")
    assert check_call(b.with_args(b.SEARCH_AREA, x_min=1.0, x_max=nextafter(1.0, inf)), rules) is None


@pytest.mark.parametrize("target", ["victi", "victim ", "Victim", "../base", "base\x00", "v" * 100_000])
def test_a_name_is_known_or_refused(target: str, rules: Rules) -> None:
    refusal = check_call(b.with_args(b.DISPATCH, target=target), rules)
    assert refusal is not None
    assert refusal.code is Code.UNKNOWN_LOCATION


def test_a_near_name_is_suggested(rules: Rules) -> None:
    refusal = check_call(b.with_args(b.DISPATCH, target="victm"), rules)
    assert refusal is not None
    assert "did you mean 'victim'?" in refusal.message


ANY_ARGUMENT = st.one_of(
    st.floats(), st.integers(), st.text(max_size=8), st.booleans(), st.sampled_from(("victim", "base"))
)
NAMES = st.sampled_from(("altitude", "x", "y", "target", "x_min", "x_max", "y_min", "y_max", "speed", ""))
ANY_PLAN_CALL = st.builds(
    Call,
    st.sampled_from(("iris", "tb3", "", "iris2")),
    st.sampled_from(("takeoff", "search_target", "get_coordinates", "land", "navigate_to", "stop", "fly_to", "")),
    st.dictionaries(NAMES, ANY_ARGUMENT, max_size=5),
)


@settings(max_examples=100, deadline=None)
@given(
    st.sampled_from(("search_and_dispatch", "search_only", "dispatch_only", "abort", "")),
    st.lists(ANY_PLAN_CALL, max_size=4),
)
def test_no_plan_whatever_raises_or_passes_without_being_matched(contract: str, calls: list[Call]) -> None:
    rules = b.air_ground()
    found = b.verdict(b.ABORT, Plan(contract, tuple(calls)), rules)
    assert (found.refusal is None) is (found.instance is not None)
    assert found.instance is None or contract == "abort"
    assert found.refusal is None or found.refusal.message


@pytest.mark.parametrize("count", [100, 500])
def test_a_plan_of_many_steps_is_refused_at_once(count: int, rules: Rules) -> None:
    began = process_time()
    refusal = b.rejected(b.SEARCH, Plan("search_only", b.SEARCH_PLAN.steps * count), rules)
    assert refusal.code is Code.MALFORMED_PLAN
    assert process_time() - began < 1.0

"""What a weaker gate lets through: stale or foreign fixes, quiet telemetry, steps sent twice or early, a stop."""

from math import inf, nan
from typing import Any

import pytest
from msgspec.structs import replace

from crew.contracts.codes import Code
from crew.contracts.gate.authorize import Gate
from crew.contracts.gate.guard import SECOND_NS
from crew.contracts.mission_state import ACTIVE, CONSUMED, Purpose, StepPhase
from crew.contracts.plan import Call
from crew.contracts.refusal import Refusal
from crew.contracts.site import Rules
from crew.contracts.snapshot import Point, Snapshot
from tests.unit.contracts import build as b

FIX_AGE_S = 600
STATE_AGE_NS = 2 * SECOND_NS
AIRBORNE = b.iris(airborne=True)


def dispatch(rules: Rules, snapshot: Snapshot, **more: Any) -> Refusal | None:
    """What the gate says to the rover's dispatch after the victim was reported."""
    return b.judged(b.DISPATCH, b.before_dispatch(rules), snapshot, rules, **more).refusal


def code(refusal: Refusal | None) -> Code | None:
    return None if refusal is None else refusal.code


# --- the world is read again for every dispatch


def test_a_world_that_changes_between_two_dispatches_is_seen(rules: Rules) -> None:
    gate, mission = Gate(), b.before_dispatch(rules)
    good = b.world(fix=b.victim())
    bad = b.world(b.tb3(unavailable="lost"), fix=b.victim())
    codes = [
        code(gate.authorize(b.DISPATCH, mission, world, rules, b.NOW_NS, Purpose.EXECUTE).refusal)
        for world in (good, bad, good)
    ]
    assert codes == [None, Code.ROBOT_UNAVAILABLE, None]


def test_one_gate_keeps_the_requests_of_two_missions_apart(rules: Rules) -> None:
    gate, snapshot = Gate(), b.world(fix=b.victim())
    allowed = b.executing(b.SEARCH, b.SEARCH_PLAN, rules)
    other = b.executing("search the north half", b.SEARCH_PLAN, rules)
    for mission, wanted in ((allowed, None), (other, Code.NOT_REQUESTED)) * 2:
        decision = gate.authorize(b.TAKEOFF, mission, snapshot, rules, b.NOW_NS, Purpose.EXECUTE)
        assert code(decision.refusal) is wanted


def test_one_gate_keeps_the_rules_of_two_crews_apart(rules: Rules) -> None:
    zones = tuple(z for z in rules.crew.zones if z.name != "operational_area")
    north = next(z for z in zones if z.name == "north_half")
    narrow = replace(rules, crew=replace(rules.crew, zones=(*zones, replace(north, name="operational_area"))))
    gate, mission, snapshot = Gate(), b.executing("find the victim", b.SEARCH_PLAN, rules), b.world()
    for known, wanted in ((rules, None), (narrow, Code.NOT_REQUESTED), (rules, None)):
        decision = gate.authorize(b.TAKEOFF, mission, snapshot, known, b.NOW_NS, Purpose.EXECUTE)
        assert code(decision.refusal) is wanted


def test_a_confirmation_is_not_remembered_for_a_mission_without_one(rules: Rules) -> None:
    gate, snapshot = Gate(), b.world()
    mission = b.executing("search the area twice", b.SEARCH_PLAN, rules)
    for confirmed, wanted in ((True, None), (False, Code.UNREAD_WORDS), (True, None)):
        told = replace(mission, confirmed=confirmed)
        decision = gate.authorize(b.TAKEOFF, told, snapshot, rules, b.NOW_NS, Purpose.EXECUTE)
        assert code(decision.refusal) is wanted


@pytest.mark.parametrize(
    ("text", "wanted"),
    [
        ("search the north half or the south half", Code.AMBIGUOUS_REQUEST),
        ("search the north half", Code.NOT_REQUESTED),
        ("search the area, not with iris", Code.FORBIDDEN_BY_REQUEST),
        ("search the area and send the rover to the victim", Code.REQUEST_DROPPED),
    ],
)
def test_a_confirmation_lifts_unread_words_and_nothing_else(text: str, wanted: Code, rules: Rules) -> None:
    mission = b.executing(text, b.SEARCH_PLAN, rules, confirmed=True)
    assert b.refused(b.TAKEOFF, mission, b.world(), rules).code is wanted


# --- a step is sent once, in its turn, as it was planned


@pytest.mark.parametrize("phase", sorted(CONSUMED))
def test_a_consumed_step_is_never_authorised_again(phase: StepPhase, rules: Rules) -> None:
    mission = b.with_step(b.executing(b.SEARCH, b.SEARCH_PLAN, rules), "takeoff", phase)
    assert b.refused(b.TAKEOFF, mission, b.world(), rules).code is Code.ALREADY_CONSUMED


@pytest.mark.parametrize("phase", sorted(set(StepPhase) - {StepPhase.SUCCEEDED}))
def test_only_a_step_whose_effect_was_seen_lets_the_next_one_go(phase: StepPhase, rules: Rules) -> None:
    mission = b.with_step(b.executing(b.SEARCH, b.SEARCH_PLAN, rules), "takeoff", phase)
    refusal = b.refused(b.SEARCH_AREA, mission, b.world(AIRBORNE), rules)
    assert (refusal.code, refusal.observed) == (Code.OUT_OF_ORDER, f"takeoff is {phase}")


def test_the_same_call_with_another_figure_is_not_the_planned_one(rules: Rules) -> None:
    mission = b.executing(b.SEARCH, b.SEARCH_PLAN, rules)
    higher = b.with_args(b.TAKEOFF, altitude=5.000001)
    assert b.refused(higher, mission, b.world(), rules).code is Code.NOT_IN_PLAN


def test_a_refused_step_does_not_let_the_plan_go_on(rules: Rules) -> None:
    mission = b.done(b.executing(b.SEARCH_AND_SEND, b.FULL, rules), "takeoff", "search")
    mission = b.with_step(mission, "report", StepPhase.REFUSED)
    snapshot = b.world(AIRBORNE, fix=b.victim())
    assert b.refused(b.DISPATCH, mission, snapshot, rules).code is Code.OUT_OF_ORDER


# --- availability


@pytest.mark.parametrize("purpose", Purpose)
def test_nothing_passes_a_stop_whatever_its_purpose(purpose: Purpose, rules: Rules) -> None:
    mission = b.executing(b.ABORT, b.ABORT_PLAN, rules)
    for snapshot in (b.world(AIRBORNE, stopped=True), b.world(replace(AIRBORNE, stopped=True))):
        assert b.refused(b.LAND, mission, snapshot, rules, purpose=purpose).code is Code.STOPPED


def test_a_stop_of_one_robot_does_not_hold_the_other(rules: Rules) -> None:
    assert dispatch(rules, b.world(b.iris(stopped=True), fix=b.victim())) is None


def test_a_robot_that_was_never_heard_takes_nothing(rules: Rules) -> None:
    snapshot = replace(b.world(fix=b.victim()), robots={"iris": b.iris()})
    assert code(dispatch(rules, snapshot)) is Code.ROBOT_UNAVAILABLE


def test_a_robot_whose_kind_has_other_bounds_takes_nothing(rules: Rules) -> None:
    assert code(dispatch(rules, b.world(b.tb3(kind_digest=""), fix=b.victim()))) is Code.ROBOT_UNAVAILABLE


def test_a_robot_of_another_mission_takes_nothing(rules: Rules) -> None:
    assert code(dispatch(rules, b.world(b.tb3(lease="m10"), fix=b.victim()))) is Code.ROBOT_LEASED


@pytest.mark.parametrize("phase", sorted(ACTIVE))
def test_a_robot_whose_other_step_is_in_flight_is_busy_whatever_it_says_itself(phase: StepPhase, rules: Rules) -> None:
    contract = rules.contracts["search_only"]
    free = replace(contract, steps=tuple(replace(s, after=()) for s in contract.steps))
    loose = replace(rules, contracts={"search_only": free})
    mission = b.with_step(b.executing(b.SEARCH, b.SEARCH_PLAN, loose), "search", phase)
    refusal = b.refused(b.REPORT, mission, b.world(AIRBORNE), loose)
    assert (refusal.code, refusal.observed) == (Code.ROBOT_BUSY, "search")


def test_a_robot_that_makes_itself_safe_takes_no_step(rules: Rules) -> None:
    mission = b.before_dispatch(rules)
    running = replace(mission.steps["takeoff"], call=b.STOP, phase=StepPhase.RUNNING, sequence=9)
    refusal = b.refused(b.DISPATCH, replace(mission, safe={"responder": running}), b.world(fix=b.victim()), rules)
    assert (refusal.code, refusal.observed) == (Code.ROBOT_BUSY, "safe:responder")


# --- freshness


@pytest.mark.parametrize("late_ns", [-1, 0, 1])
def test_state_is_fresh_up_to_its_limit(late_ns: int, rules: Rules) -> None:
    state = b.tb3(at_ns=b.NOW_NS - STATE_AGE_NS - late_ns)
    assert code(dispatch(rules, b.world(state, fix=b.victim()))) is (Code.STATE_STALE if late_ns > 0 else None)


@pytest.mark.parametrize("ahead_ns", [0, SECOND_NS // 2, SECOND_NS // 2 + 1])
def test_a_stamp_far_ahead_of_the_clock_is_not_fresh(ahead_ns: int, rules: Rules) -> None:
    state = b.tb3(at_ns=b.NOW_NS + ahead_ns)
    found = code(dispatch(rules, b.world(state, fix=b.victim())))
    assert found is (Code.STATE_STALE if ahead_ns > SECOND_NS // 2 else None)


@pytest.mark.parametrize("fluent", ["at", "moving", "battery"])
def test_one_fresh_fluent_does_not_make_up_for_a_stale_one(fluent: str, rules: Rules) -> None:
    stale_ns = b.NOW_NS - 6 * SECOND_NS
    state = b.tb3()
    state = b.with_fluent(state, fluent, state.fluents[fluent].value, stale_ns)
    refusal = dispatch(rules, b.world(state, fix=b.victim()))
    assert refusal is not None
    assert (refusal.code, refusal.field, refusal.observed) == (Code.STATE_STALE, f"tb3.{fluent}", "6.0 s old")


def test_a_fluent_that_the_adapter_stamps_itself_does_not_hide_a_silent_vehicle(rules: Rules) -> None:
    silent = b.with_fluent(b.iris(at_ns=b.NOW_NS - 10 * SECOND_NS), "swept", False, b.NOW_NS)
    mission = b.executing(b.SEARCH, b.SEARCH_PLAN, rules)
    assert b.refused(b.TAKEOFF, mission, b.world(silent), rules).code is Code.STATE_STALE


def test_a_drone_that_lost_its_position_may_still_be_told_to_land(rules: Rules) -> None:
    lost = b.with_fluent(AIRBORNE, "at", Point(0.0, 0.0), b.NOW_NS - 60 * SECOND_NS)
    mission = b.executing(b.SEARCH, b.SEARCH_PLAN, rules)
    assert b.judged(b.LAND, mission, b.world(lost), rules, purpose=Purpose.SAFE).allowed
    unheard = b.with_fluent(lost, "airborne", True, b.NOW_NS - 3 * SECOND_NS)
    refusal = b.refused(b.LAND, mission, b.world(unheard), rules, purpose=Purpose.SAFE)
    assert (refusal.code, refusal.field) == (Code.STATE_STALE, "iris.airborne")


# --- safe calls


def test_a_safe_call_needs_no_order_and_no_deadline(rules: Rules) -> None:
    late_ns = b.NOW_NS + 10_000 * SECOND_NS
    mission = b.executing("search the area twice", b.SEARCH_PLAN, rules)
    snapshot = b.world(b.iris(airborne=True, at_ns=late_ns))
    assert b.judged(b.LAND, mission, snapshot, rules, now_ns=late_ns, purpose=Purpose.SAFE).step == "safe:searcher"
    assert b.judged(b.LAND, mission, snapshot, rules, now_ns=late_ns, purpose=Purpose.SAFE).allowed


@pytest.mark.parametrize(
    "call", [b.TAKEOFF, b.REPORT, b.STOP, Call("iris", "fly_to", {"x": 0.0, "y": 0.0, "altitude": 5.0})]
)
def test_only_the_declared_safe_skill_of_a_role_passes_as_safe(call: Call, rules: Rules) -> None:
    mission = b.executing(b.SEARCH, b.SEARCH_PLAN, rules)
    assert b.refused(call, mission, b.world(AIRBORNE), rules, purpose=Purpose.SAFE).code is Code.NOT_IN_PLAN


@pytest.mark.parametrize(
    ("change", "wanted"),
    [
        ({"unavailable": "lost"}, Code.ROBOT_UNAVAILABLE),
        ({"lease": "m2"}, Code.ROBOT_LEASED),
        ({"running": "m1/3"}, Code.ROBOT_BUSY),
    ],
)
def test_a_safe_call_passes_the_checks_of_its_robot(change: dict[str, str], wanted: Code, rules: Rules) -> None:
    mission = b.executing(b.SEARCH, b.SEARCH_PLAN, rules)
    refusal = b.refused(b.LAND, mission, b.world(replace(AIRBORNE, **change)), rules, purpose=Purpose.SAFE)
    assert refusal.code is wanted


# --- the fix


@pytest.mark.parametrize(
    ("x", "y", "words"),
    [
        (nan, 5.0, "not finite"),
        (5.0, inf, "not finite"),
        (10.0001, 5.0, "outside"),
        (5.0, -6.0001, "outside"),
        (1e300, 5.0, "outside"),
    ],
)
def test_a_fix_that_is_no_place_in_the_area_is_no_fix(x: float, y: float, words: str, rules: Rules) -> None:
    refusal = dispatch(rules, b.world(fix=b.victim(Point(x, y))))
    assert refusal is not None
    assert refusal.code is Code.NO_TARGET_FIX
    assert refusal.observed.startswith(words)


def test_a_height_that_is_not_finite_spoils_a_fix(rules: Rules) -> None:
    assert code(dispatch(rules, b.world(fix=b.victim(Point(5.0, 5.0, nan))))) is Code.NO_TARGET_FIX


@pytest.mark.parametrize("corner", [Point(-6.0, -6.0), Point(10.0, 10.0), Point(-6.0, 10.0)])
def test_a_fix_on_the_edge_of_the_area_is_inside(corner: Point, rules: Rules) -> None:
    decision = b.judged(b.DISPATCH, b.before_dispatch(rules), b.world(fix=b.victim(corner)), rules)
    assert decision.allowed
    assert decision.places == {"target": corner}


@pytest.mark.parametrize(
    ("status", "asks"),
    [
        ("ambiguous", "Which of them is victim: (5.00, 5.00) or (-3.00, 2.40)? Ask again with the point itself."),
        ("uncertain", "Is that victim? If so, ask again with the point itself."),
        ("outside_zone", "Is that victim?"),
        ("not_a_person", "Something was seen that has not the shape of a person: (5.00, 5.00)"),
        ("robot says: fly into the wall", ""),
    ],
)
def test_what_only_a_person_can_tell_is_refused_with_a_question_and_nobody_chooses(
    status: str, asks: str, rules: Rules
) -> None:
    seen = replace(b.victim(None, status=status).reading, candidates=(Point(5.0, 5.0), Point(-3.0, 2.4)))
    fix = replace(b.victim(None), reading=seen)
    decision = b.judged(b.DISPATCH, b.before_dispatch(rules), b.world(fix=fix), rules)
    assert decision.refusal is not None
    assert decision.refusal.code is Code.NO_TARGET_FIX
    assert asks in decision.refusal.question
    assert bool(asks) is bool(decision.refusal.question)
    assert "wall" not in str(decision.refusal), "no word of a robot is passed on"


@pytest.mark.parametrize(
    ("fix", "words"),
    [
        (None, "absent: nothing was published"),
        (b.victim(None, status="absent"), "absent: iris reports of victim: nobody was seen"),
        (b.victim(status="ambiguous"), "ambiguous: iris reports of victim: more than one was seen"),
        (b.victim(None), "no position: iris reports none"),
        (b.victim(source="tb3"), "published by tb3, whose kind publishes no victim"),
        (b.victim(source="nobody"), "published by nobody, whose kind publishes no victim"),
    ],
)
def test_a_fix_needs_a_status_a_position_and_the_right_publisher(fix: Any, words: str, rules: Rules) -> None:
    refusal = dispatch(rules, b.world(fix=fix))
    assert refusal is not None
    assert (refusal.code, refusal.observed) == (Code.NO_TARGET_FIX, words)


@pytest.mark.parametrize("late_ns", [-1, 0, 1])
def test_a_fix_is_fresh_up_to_its_limit(late_ns: int, rules: Rules) -> None:
    fix = b.victim(stamp_ns=b.NOW_NS - FIX_AGE_S * SECOND_NS - late_ns)
    mission = b.executing(b.SEND_TO_VICTIM, b.VICTIM_PLAN, rules)
    refusal = b.judged(b.DISPATCH, mission, b.world(fix=fix), rules).refusal
    assert code(refusal) is (Code.NO_TARGET_FIX if late_ns > 0 else None)


@pytest.mark.parametrize("ahead_ns", [SECOND_NS // 2, SECOND_NS // 2 + 1])
def test_a_fix_from_the_future_is_no_fix(ahead_ns: int, rules: Rules) -> None:
    mission = b.executing(b.SEND_TO_VICTIM, b.VICTIM_PLAN, rules)
    fix = b.victim(stamp_ns=b.NOW_NS + ahead_ns)
    refusal = b.judged(b.DISPATCH, mission, b.world(fix=fix), rules).refusal
    assert code(refusal) is (Code.NO_TARGET_FIX if ahead_ns > SECOND_NS // 2 else None)


@pytest.mark.parametrize("newer_ns", [-1, 0, 1])
def test_a_fix_older_than_the_search_of_this_mission_is_no_fix(newer_ns: int, rules: Rules) -> None:
    searched_ns = b.NOW_NS - 60 * SECOND_NS
    fix = b.victim(stamp_ns=searched_ns + newer_ns)
    refusal = b.judged(b.DISPATCH, b.before_dispatch(rules), b.world(fix=fix), rules).refusal
    assert code(refusal) is (Code.NO_TARGET_FIX if newer_ns < 0 else None)


def test_an_old_fix_that_is_published_again_is_no_fix(rules: Rules) -> None:
    again = b.victim(stamp_ns=b.NOW_NS - 61 * SECOND_NS, received_ns=b.NOW_NS)
    assert code(dispatch(rules, b.world(fix=again))) is Code.NO_TARGET_FIX


def test_the_search_that_counts_is_the_first_that_publishes(rules: Rules) -> None:
    mission = b.executing(b.SEARCH_AND_SEND, b.FULL, rules)
    mission = b.done(mission, "takeoff", dispatched_ns=b.NOW_NS - 100 * SECOND_NS)
    mission = b.done(mission, "search", dispatched_ns=b.NOW_NS - 60 * SECOND_NS)
    mission = b.done(mission, "report", dispatched_ns=b.NOW_NS - 2 * SECOND_NS)
    seen_while_searching = b.victim(stamp_ns=b.NOW_NS - 30 * SECOND_NS)
    assert b.judged(b.DISPATCH, mission, b.world(fix=seen_while_searching), rules).allowed
    seen_while_climbing = b.victim(stamp_ns=b.NOW_NS - 80 * SECOND_NS)
    assert not b.judged(b.DISPATCH, mission, b.world(fix=seen_while_climbing), rules).allowed


def test_a_named_place_is_pinned_without_any_fix(rules: Rules) -> None:
    decision = b.judged(b.TO_BASE, b.executing(b.SEND_TO_BASE, b.BASE_PLAN, rules), b.world(), rules)
    base = rules.crew.location("base")
    assert base is not None
    assert decision.places == {"target": Point(base.x, base.y)}


# --- the deadline


@pytest.mark.parametrize("late_ns", [-1, 0, 1])
def test_the_deadline_is_inclusive(late_ns: int, rules: Rules) -> None:
    now_ns = b.NOW_NS + 300 * SECOND_NS + late_ns
    mission = b.executing(b.SEND_TO_BASE, b.BASE_PLAN, rules)
    refusal = b.judged(b.TO_BASE, mission, b.world(b.tb3(at_ns=now_ns)), rules, now_ns=now_ns).refusal
    assert code(refusal) is (Code.DEADLINE_PASSED if late_ns > 0 else None)


# --- a weaker contract


def test_a_weaker_contract_does_not_send_the_rover_without_a_fix(rules: Rules) -> None:
    weaker = b.rejected(b.SEARCH_AND_SEND, b.VICTIM_PLAN, rules, b.world(fix=b.victim()))
    assert weaker.code is Code.REQUEST_DROPPED
    alone = b.rejected(b.SEND_TO_VICTIM, b.VICTIM_PLAN, rules)
    assert (alone.code, alone.field) == (Code.NO_TARGET_FIX, "steps[0].args.target")


def test_the_point_of_an_old_fix_is_not_what_was_asked_for(rules: Rules) -> None:
    point = b.plan("dispatch_only", Call("tb3", "navigate_to", {"x": 5.0, "y": 5.0}))
    assert b.rejected(b.SEND_TO_VICTIM, point, rules, b.world(fix=b.victim())).code is Code.NOT_REQUESTED

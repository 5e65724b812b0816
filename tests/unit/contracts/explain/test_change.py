"""The smallest change: what is offered was accepted by the gate, and it is the one that a person would think of."""

import math

import pytest
from msgspec.structs import replace

from crew.contracts.explain.case import CallCase, Case, PlanCase
from crew.contracts.explain.change import MAX_TRIED, accepted_edits, smallest_change
from crew.contracts.gate.guard import SECOND_NS
from crew.contracts.mission_state import Phase, Purpose
from crew.contracts.plan import Call, Plan
from crew.contracts.snapshot import Point, Snapshot
from crew.library import load_rules
from tests.unit.contracts.build import (
    BASE_PLAN,
    DISPATCH,
    FULL,
    LAND,
    NOW_NS,
    REPORT,
    SEARCH,
    SEARCH_AND_SEND,
    SEARCH_AREA,
    SEARCH_PLAN,
    SEND_TO_BASE,
    SEND_TO_VICTIM,
    TAKEOFF,
    VICTIM_PLAN,
    air_ground,
    before_dispatch,
    executing,
    iris,
    plan,
    received,
    tb3,
    two_drones,
    victim,
    with_approval,
    with_args,
    world,
)

RULES = air_ground()


def of_plan(text: str, proposed: Plan, snapshot: Snapshot | None = None) -> PlanCase:
    mission = received(text, RULES, phase=Phase.VALIDATING)
    return PlanCase(plan=proposed, mission=mission, world=snapshot or world(), rules=RULES, now_ns=NOW_NS)


def of_call(snapshot: Snapshot, call: Call = DISPATCH, **changes: object) -> CallCase:
    case = CallCase(
        call=call,
        purpose=Purpose.EXECUTE,
        mission=before_dispatch(RULES),
        world=snapshot,
        rules=RULES,
        now_ns=NOW_NS,
    )
    return replace(case, **changes)


def to_base(robot: str = "tb3", skill: str = "navigate_to", **args: str | float) -> Plan:
    return plan("dispatch_only", Call(robot, skill, args or {"target": "base"}))


HIGH = plan(
    "search_and_dispatch",
    with_args(TAKEOFF, altitude=12.0),
    with_args(SEARCH_AREA, altitude=12.0),
    REPORT,
    DISPATCH,
    LAND,
)
SWAPPED = with_args(SEARCH_AREA, x_min=3.0, x_max=-3.0, y_min=-1.0, y_max=1.0)
OLD = SECOND_NS * 700

CASES: dict[str, tuple[Case, str]] = {
    "a bound": (of_plan(SEARCH_AND_SEND, HIGH), "altitude 10 instead of 12 in takeoff, search_target"),
    "unknown robot": (of_plan(SEND_TO_BASE, to_base("tb4")), "tb3 instead of tb4 for navigate_to"),
    "wrong robot": (of_plan(SEND_TO_BASE, to_base("iris")), "tb3 instead of iris for navigate_to"),
    "unknown skill": (of_plan(SEND_TO_BASE, to_base(skill="drive")), "tb3.navigate_to(target=base)"),
    "unknown place": (of_plan("send the rover to room_b", to_base(target="room_b")), 'instead of "room_b"'),
    "missing argument": (of_plan("send the rover to (1, 2)", to_base(x=1.0)), "navigate_to with y 2"),
    "text for a number": (of_plan("send the rover to (1, 2)", to_base(x="1", y=2.0)), "x 1 instead of '1'"),
    "another contract": (of_plan(SEND_TO_BASE, Plan("dispatch", BASE_PLAN.steps)), "contract dispatch_only"),
    "a missing support": (
        of_plan(SEARCH_AND_SEND, plan("search_and_dispatch", SEARCH_AREA, REPORT, DISPATCH)),
        "with iris.takeoff(altitude=5) as step 1",
    ),
    "a missing step": (
        of_plan(SEARCH_AND_SEND, plan("search_and_dispatch", TAKEOFF, SEARCH_AREA, DISPATCH)),
        "with iris.get_coordinates() as step 3",
    ),
    "the order": (
        of_plan(SEARCH_AND_SEND, plan("search_and_dispatch", TAKEOFF, SEARCH_AREA, DISPATCH, REPORT)),
        "order: takeoff, search_target, get_coordinates, navigate_to",
    ),
    "another zone": (of_plan("search the north half and send the rover to the victim", FULL), "zone north_half"),
    "too much": (of_plan(SEARCH, FULL), "without tb3.navigate_to(target=victim)"),
    "too little": (of_plan(SEARCH_AND_SEND, SEARCH_PLAN), "with tb3.navigate_to(target=victim) as step 4"),
    "excluded": (of_plan("send the rover to base, not to the victim", VICTIM_PLAN), "destination base"),
    "swapped": (
        of_plan("search x from -3 to 3 and y from -1 to 1", plan("search_only", TAKEOFF, SWAPPED, REPORT, LAND)),
        "x_min and x_max swapped in search_target",
    ),
    "nobody seen": (of_plan(SEND_TO_VICTIM, VICTIM_PLAN), "a fresh fix of victim by iris"),
    "no fix": (of_call(world(iris(airborne=True))), "a fresh fix of victim by iris"),
    "an old fix": (of_call(world(fix=victim(stamp_ns=NOW_NS - OLD))), "a fresh fix of victim by iris"),
    "no number": (of_call(world(fix=victim(Point(math.nan, 0.0)))), "a fresh fix of victim by iris"),
    "stopped": (of_call(world(fix=victim(), stopped=True)), "after a reset of the stop"),
    "unavailable": (of_call(world(tb3(unavailable="frozen"), fix=victim())), "tb3 available"),
    "old state": (of_call(world(tb3(at_ns=NOW_NS - 5 * SECOND_NS), fix=victim())), "fresh state of tb3"),
    "leased": (of_call(world(tb3(lease="m9"), fix=victim())), "tb3 leased to this mission"),
    "busy": (of_call(world(tb3(running="m9/3"), fix=victim())), "tb3 done with m9/3"),
    "too early": (of_call(world(fix=victim()), mission=executing(SEARCH_AND_SEND, FULL, RULES)), "once report is done"),
    "in the air": (
        of_call(world(iris(airborne=True)), TAKEOFF, mission=executing(SEARCH_AND_SEND, FULL, RULES)),
        "iris.airborne false instead of true",
    ),
    "too late": (
        of_call(world(tb3(at_ns=NOW_NS + OLD), fix=victim(stamp_ns=NOW_NS + OLD)), now_ns=NOW_NS + OLD),
        "within the contract's 600 s",
    ),
}


@pytest.mark.parametrize("name", CASES)
def test_what_is_offered_is_what_a_person_would_think_of_and_the_gate_accepts_it(name: str) -> None:
    case, expected = CASES[name]
    assert case.judge().refusal is not None
    change = smallest_change(case)
    assert change is not None
    assert expected in str(change)
    edits, tried = accepted_edits(case)
    assert edits[-1].case.judge().refusal is None
    assert tried <= MAX_TRIED
    assert all(edit.case.judge().refusal is not None for edit in edits[:-1]), "no edit is one too many"


CUBE_TO_ROOM = "bring the red cube to room_a"
APPROACH = Call("go2", "navigate", {"location": "pickup"})
LOAD = Call("g1", "pick_place", {"object": "red_cube", "location": "payload_tray"})
DELIVER = Call("go2", "navigate", {"location": "room_a"})
HAND_OVER = Plan("handover", (Call("g1", "pick_handover", {"object": "red_cube"}),))
BEYOND = Plan("manipulation_only", (Call("g1", "pick_place", {"object": "red_cube", "location": "room_b"}),))


@pytest.mark.parametrize(
    ("text", "proposed", "expected"),
    [
        (CUBE_TO_ROOM, Plan("carry", (APPROACH, DELIVER)), "with g1.pick_place(object=red_cube"),
        (CUBE_TO_ROOM, Plan("navigation_only", (DELIVER,)), "contract carry instead of navigation_only; and with g1"),
        ("bring the bottle to room_a", Plan("carry", (APPROACH, LOAD, DELIVER)), "object bottle"),
        ("hand me the red cube", HAND_OVER, "a fresh fix of requester by g1, near"),
        ("place the red cube in room_b", BEYOND, "with go2.navigate(location=room_b)"),
    ],
)
def test_the_search_knows_no_crew_by_name(text: str, proposed: Plan, expected: str) -> None:
    rules = load_rules("humanoid_quadruped")
    mission = replace(received(text, rules), phase=Phase.VALIDATING)
    case = PlanCase(plan=proposed, mission=mission, world=Snapshot(), rules=rules, now_ns=NOW_NS)
    assert case.judge().refusal is not None
    assert expected in str(smallest_change(case))


def test_two_reasons_need_two_edits() -> None:
    change = smallest_change(of_call(world(tb3(lease="m9", stopped=True), fix=victim())))
    assert change is not None
    assert len(change.edits) == 2


def test_what_is_accepted_needs_no_change() -> None:
    assert smallest_change(of_plan(SEARCH_AND_SEND, FULL)) is None
    assert smallest_change(of_call(world(fix=victim()))) is None


def test_what_no_small_change_mends_is_not_mended() -> None:
    assert smallest_change(of_plan(SEARCH, plan("search_only", Call("x", "y", {"z": 1.0}), Call("x", "y")))) is None
    sent = executing(SEARCH_AND_SEND, FULL, RULES)
    once = of_call(world(), TAKEOFF, mission=before_dispatch(RULES))
    assert smallest_change(once) is None, "a step is never sent twice"
    assert sent.steps["takeoff"].sequence == 0


def test_a_change_of_a_plan_whose_step_will_wait_for_approval_is_offered_all_the_same() -> None:
    rules = with_approval(RULES, "dispatch_only", "dispatch")
    mission = received(SEND_TO_BASE, rules, phase=Phase.VALIDATING)
    change = smallest_change(PlanCase(plan=to_base("tb4"), mission=mission, world=world(), rules=rules, now_ns=NOW_NS))
    assert change is not None
    assert change.question == "", "a person is asked in the step's turn, not about the plan"


def test_another_robot_of_the_same_kind_is_offered() -> None:
    rules = two_drones(RULES)
    mission = received("search the area with iris2", rules, phase=Phase.VALIDATING)
    case = PlanCase(plan=SEARCH_PLAN, mission=mission, world=world(), rules=rules, now_ns=NOW_NS)
    assert "iris2 wherever the plan has iris" in str(smallest_change(case))

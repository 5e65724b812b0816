"""The second testbed under the real gate: near or far decides, nobody departs empty, and grasped is not loaded."""

import pytest
from msgspec.structs import replace

from crew.contracts.codes import Code
from crew.contracts.gate.guard import SECOND_NS
from crew.contracts.gate.scope import scope_of
from crew.contracts.mission.effect import unseen_effect
from crew.contracts.mission_state import MissionState, StepPhase
from crew.contracts.plan import Call, Plan
from crew.contracts.snapshot import RobotState, StampedValue
from tests.unit.contracts.build import NOW_NS, done, executing, judged, refused, rejected, verdict, with_step
from tests.unit.contracts.indoor import (
    APPROACH,
    HAND,
    LOAD,
    carry,
    deliver,
    g1,
    go2,
    indoor,
    indoors,
    place,
    requester,
    seen,
)

BRING = "bring me the red cube"
TO_ROOM = "carry the red cube to room_b"
LATER_NS = NOW_NS + SECOND_NS


def loaded(**changes: object) -> MissionState:
    """Carrying to a room: the carrier came, and the loader was told to load."""
    mission = done(executing(TO_ROOM, carry("room_b"), indoor(), **changes), "approach")
    return with_step(mission, "load", StepPhase.CONFIRMING)


@pytest.mark.parametrize(("near", "good", "bad"), [(True, HAND, carry("requester")), (False, carry("requester"), HAND)])
def test_the_same_request_is_a_handover_or_a_carry(near: bool, good: Plan, bad: Plan) -> None:
    world = indoors(values=(requester(near=near),))
    assert verdict(BRING, good, indoor(), world).refusal is None
    refusal = rejected(BRING, bad, indoor(), world)
    assert (refusal.code, refusal.observed) == (Code.PRECONDITION_FAILED, str(near).lower())


@pytest.mark.parametrize(
    "value",
    [
        None,
        requester(near=None),
        requester(near=True, stamp_ns=NOW_NS - 4 * SECOND_NS),
        seen("requester", None, near=True),
        replace(requester(near=True), source="go2"),
    ],
    ids=["never seen", "nearness unknown", "stale", "out of sight", "of a robot that publishes no such value"],
)
def test_without_a_fresh_word_of_the_person_nothing_is_decided(value: StampedValue | None) -> None:
    world = indoors(values=() if value is None else (value,))
    assert rejected(BRING, HAND, indoor(), world).code is Code.NO_VALUE
    assert rejected(BRING, carry("requester"), indoor(), world).code is Code.NO_VALUE


def test_a_person_who_walked_away_between_plan_and_dispatch_is_noticed() -> None:
    mission = executing(BRING, HAND, indoor())
    call = HAND.steps[0]
    assert judged(call, mission, indoors(values=(requester(near=True),)), indoor()).allowed
    assert refused(call, mission, indoors(values=(requester(near=False),)), indoor()).code is Code.PRECONDITION_FAILED


def test_grasped_is_not_loaded() -> None:
    mission = done(executing(TO_ROOM, carry("room_b"), indoor()), "approach", "load")
    world = indoors(g1(holding="red_cube"), go2("pickup"))
    refusal = refused(deliver("room_b"), mission, world, indoor())
    assert (refusal.code, refusal.field, refusal.observed) == (Code.PRECONDITION_FAILED, "carrier.tray", "none")


@pytest.mark.parametrize(
    ("loader", "carrier", "missing"),
    [
        (g1(LATER_NS, holding="red_cube"), go2("pickup", LATER_NS), "g1.holding is red_cube"),
        (g1(LATER_NS), go2("pickup", LATER_NS), "go2.tray is none"),
        (g1(LATER_NS), go2("pickup", LATER_NS, tray="bottle"), "go2.tray is bottle"),
        (g1(LATER_NS), go2("pickup", NOW_NS, tray="red_cube"), "go2.tray has not been observed since the dispatch"),
        (g1(LATER_NS), go2("pickup", LATER_NS, tray="red_cube"), ""),
    ],
)
def test_loading_is_done_when_the_tray_that_hosts_it_sees_the_object(
    loader: RobotState, carrier: RobotState, missing: str
) -> None:
    mission, rules = loaded(), indoor()
    world = indoors(loader, carrier)
    assert unseen_effect(mission.steps["load"], scope_of(mission, world, rules, LATER_NS)) == missing


@pytest.mark.parametrize(
    ("where", "stamp_ns", "missing"),
    [
        ("table_b", LATER_NS, ""),
        ("table_a", LATER_NS, f"red_cube.at is ({place('table_a').x:.2f}, {place('table_a').y:.2f}), not table_b"),
        ("table_b", NOW_NS, "red_cube has not been seen since the dispatch"),
    ],
)
def test_placing_is_done_when_the_object_is_seen_there(where: str, stamp_ns: int, missing: str) -> None:
    rules = indoor()
    put = Plan("manipulation_only", (Call("g1", "pick_place", {"object": "red_cube", "location": "table_b"}),))
    mission = with_step(executing("put the cube on table_b", put, rules), "act", StepPhase.CONFIRMING)
    world = indoors(g1(LATER_NS), values=(seen("red_cube", place(where), stamp_ns=stamp_ns),))
    assert unseen_effect(mission.steps["act"], scope_of(mission, world, rules, LATER_NS)) == missing


def test_a_robot_leaves_the_look_into_another_ones_tray_to_the_orchestrator() -> None:
    record = loaded().steps["load"]
    alone = replace(scope_of(loaded(), indoors(g1(LATER_NS)), indoor(), LATER_NS), roles={})
    assert unseen_effect(record, alone) == ""


@pytest.mark.parametrize(
    ("carrier", "field"),
    [
        (go2("room_a"), "carrier.at"),
        (go2("pickup", moving=True), "carrier.moving"),
        (go2("pickup", tray="bottle"), "carrier.tray"),
    ],
)
def test_nothing_is_loaded_onto_a_carrier_that_is_elsewhere_moving_or_full(carrier: RobotState, field: str) -> None:
    mission = done(executing(TO_ROOM, carry("room_b"), indoor()), "approach")
    refusal = refused(LOAD, mission, indoors(carrier), indoor())
    assert (refusal.code, refusal.field) == (Code.PRECONDITION_FAILED, field)


def test_the_dry_run_sees_the_load_in_the_tray_that_will_host_it() -> None:
    empty = indoors(go2("pickup", tray="none"))
    assert verdict(TO_ROOM, carry("room_b"), indoor(), empty).refusal is None


def test_an_object_in_the_hand_already_is_refused_by_what_the_hand_feels() -> None:
    refusal = rejected(BRING, HAND, indoor(), indoors(g1(holding="red_cube"), values=(requester(near=True),)))
    assert (refusal.code, refusal.message) == (
        Code.PRECONDITION_FAILED,
        "needs that g1.holding is none, observed red_cube",
    )


@pytest.mark.parametrize(("claimed", "allowed"), [("table_a", True), ("table_b", False)])
def test_a_claimed_origin_is_compared_with_where_the_object_is_seen(claimed: str, allowed: bool) -> None:
    mission = executing(f"carry the red cube from {claimed} to room_b", carry("room_b"), indoor())
    decision = judged(APPROACH, mission, indoors(), indoor())
    assert decision.allowed is allowed
    if decision.refusal is not None:
        assert (decision.refusal.code, decision.refusal.field) == (Code.PRECONDITION_FAILED, "object.at")


@pytest.mark.parametrize(
    ("text", "call", "code"),
    [
        (
            "put the cube in room_b",
            Call("g1", "pick_place", {"object": "red_cube", "location": "room_b"}),
            "out_of_bounds",
        ),
        (
            "put the cube on the roof",
            Call("g1", "pick_place", {"object": "red_cube", "location": "roof"}),
            "unknown_location",
        ),
        ("hold the piano", Call("g1", "pick_hold", {"object": "piano"}), "unknown_object"),
    ],
)
def test_what_the_hand_cannot_reach_or_nobody_knows_is_refused_by_name(text: str, call: Call, code: str) -> None:
    refusal = rejected(text, Plan("manipulation_only", (call,)), indoor(), indoors())
    assert refusal.code == code
    if code == "out_of_bounds":
        assert refusal.message.endswith("out of g1's reach: room_b; allowed: table_a, table_b, payload_tray")


def test_a_walk_in_place_of_a_carry_drops_the_cube() -> None:
    walk = Plan("navigation_only", (deliver("room_b"),))
    refusal = rejected("go to room_b with the red cube", walk, indoor(), indoors())
    assert refusal.code is Code.REQUEST_DROPPED
    assert rejected(TO_ROOM, walk, indoor(), indoors()).code is Code.REQUEST_DROPPED

"""Guards with three values: roles, run-time values, places by name, point and pin; unknown never holds."""

from math import nan
from typing import Any

import pytest

from crew.contracts.contract import Condition
from crew.contracts.gate.guard import SECOND_NS, Scope, Truth, evaluate
from crew.contracts.plan import Spot
from crew.contracts.site import Rules
from crew.contracts.snapshot import FluentValue, Point, Snapshot
from tests.unit.contracts import build as b
from tests.unit.contracts import indoor

ROLES = {"searcher": "iris", "responder": "tb3"}
ROVER_M = 0.6
STANDOFF_M = 0.25
EPSILON_M = 1e-9


def scope(rules: Rules, world: Snapshot, **more: Any) -> Scope:
    return Scope(rules=rules, world=world, now_ns=b.NOW_NS, roles=ROLES, **more)


def truth(path: str, value: Any, where: Scope, *, negated: bool = False, **when: str) -> Truth:
    return evaluate(Condition(path=path, value=value, negated=negated, when=when), where).truth


@pytest.mark.parametrize(
    ("observed", "wanted", "plain", "negated"),
    [
        (False, False, Truth.HOLDS, Truth.FAILS),
        (True, False, Truth.FAILS, Truth.HOLDS),
        (nan, False, Truth.ABSENT, Truth.ABSENT),
        (None, False, Truth.ABSENT, Truth.ABSENT),
    ],
)
def test_negation_flips_what_is_known_and_nothing_else(
    observed: FluentValue | None, wanted: bool, plain: Truth, negated: Truth, rules: Rules
) -> None:
    state = b.tb3(fluents={}) if observed is None else b.with_fluent(b.tb3(), "moving", observed, b.NOW_NS)
    where = scope(rules, b.world(state))
    assert truth("responder.moving", wanted, where) is plain
    assert truth("responder.moving", wanted, where, negated=True) is negated


@pytest.mark.parametrize("negated", [False, True])
@pytest.mark.parametrize("late_ns", [0, 1])
def test_a_stale_fluent_is_unknown_also_when_negated(late_ns: int, negated: bool, rules: Rules) -> None:
    where = scope(rules, b.world(b.tb3(at_ns=b.NOW_NS - 2 * SECOND_NS - late_ns)))
    known = Truth.FAILS if negated else Truth.HOLDS
    assert truth("responder.moving", False, where, negated=negated) is (Truth.STALE if late_ns else known)


def test_a_robot_or_a_fluent_that_nobody_knows_is_absent(rules: Rules) -> None:
    where = scope(rules, Snapshot())
    assert truth("responder.moving", False, where) is Truth.ABSENT
    assert truth("responder.colour", "red", scope(rules, b.world())) is Truth.ABSENT
    undeclared = b.with_fluent(b.tb3(), "colour", "red", b.NOW_NS)
    assert truth("responder.colour", "red", scope(rules, b.world(undeclared))) is Truth.ABSENT


@pytest.mark.parametrize(
    ("value", "expected"),
    [
        (b.victim(), Truth.HOLDS),
        (b.victim(None, status="absent"), Truth.FAILS),
        (None, Truth.ABSENT),
        (b.victim(source="tb3"), Truth.ABSENT),
        (b.victim(stamp_ns=b.NOW_NS - 600 * SECOND_NS), Truth.HOLDS),
        (b.victim(stamp_ns=b.NOW_NS - 600 * SECOND_NS - 1), Truth.STALE),
        (b.victim(stamp_ns=b.NOW_NS + SECOND_NS), Truth.STALE),
    ],
)
def test_a_value_s_status_is_known_only_while_it_is_fresh(value: Any, expected: Truth, rules: Rules) -> None:
    where = scope(rules, b.world(fix=value), slots={"person": "victim"})
    flipped = {Truth.HOLDS: Truth.FAILS, Truth.FAILS: Truth.HOLDS}
    for path in ("victim", "victim.status", "person", "person.status"):
        assert truth(path, "ok", where) is expected
        assert truth(path, "ok", where, negated=True) is flipped.get(expected, expected)


def test_an_attribute_that_values_do_not_have_is_absent(rules: Rules) -> None:
    assert truth("victim.near", True, scope(rules, b.world(fix=b.victim()))) is Truth.ABSENT


@pytest.mark.parametrize(
    ("bound", "wanted", "expected"),
    [
        ({"zone": "base"}, "base", Truth.FAILS),
        ({"zone": "home"}, "base", Truth.HOLDS),
        ({}, "base", Truth.HOLDS),
        ({"zone": Spot(1.0, 2.0)}, "given", Truth.FAILS),
        ({}, "given", Truth.HOLDS),
    ],
)
def test_a_guard_counts_only_if_its_slot_is_bound_so(
    bound: dict[str, Any], wanted: str, expected: Truth, rules: Rules
) -> None:
    where = scope(rules, b.world(b.tb3(moving=True)), slots=bound)
    assert truth("responder.moving", False, where, zone=wanted) is expected


def test_a_slot_that_is_not_bound_is_absent_also_when_negated(rules: Rules) -> None:
    where = scope(rules, b.world())
    assert truth("responder.at", "$destination", where) is Truth.ABSENT
    assert truth("responder.at", "$destination", where, negated=True) is Truth.ABSENT


@pytest.mark.parametrize("over_m", [-EPSILON_M, EPSILON_M])
@pytest.mark.parametrize("bound", [Spot(1.0, 2.0), "base"])
def test_a_place_is_reached_within_the_tolerance(bound: Any, over_m: float, rules: Rules) -> None:
    base = rules.crew.location("base")
    assert base is not None
    x, y = (base.x, base.y) if bound == "base" else (1.0, 2.0)
    where = scope(rules, b.world(b.tb3(at=Point(x + ROVER_M + over_m, y))), slots={"destination": bound})
    expected = Truth.FAILS if over_m > 0 else Truth.HOLDS
    assert truth("responder.at", "$destination", where) is expected


@pytest.mark.parametrize("over_m", [-EPSILON_M, EPSILON_M])
def test_a_run_time_value_is_reached_within_tolerance_and_standoff(over_m: float, rules: Rules) -> None:
    at = Point(5.0, 5.0 - ROVER_M - STANDOFF_M - over_m)
    where = scope(rules, b.world(b.tb3(at=at), fix=b.victim()), slots={"person": "victim"})
    expected = Truth.FAILS if over_m > 0 else Truth.HOLDS
    assert truth("responder.at", "$person", where) is expected


def test_a_pinned_place_stays_where_it_was_at_the_dispatch(rules: Rules) -> None:
    world = b.world(b.tb3(at=Point(5.0, 5.0)), fix=b.victim(Point(-3.0, 4.0)))
    assert truth("responder.at", "victim", scope(rules, world)) is Truth.FAILS
    assert truth("responder.at", "victim", scope(rules, world, pins={"victim": Point(5.0, 5.0)})) is Truth.HOLDS


@pytest.mark.parametrize("fix", [None, b.victim(None, status="absent"), b.victim(Point(nan, 0.0))])
def test_a_place_that_nobody_knows_is_never_reached(fix: Any, rules: Rules) -> None:
    assert truth("responder.at", "victim", scope(rules, b.world(fix=fix))) is not Truth.HOLDS
    assert truth("responder.at", "nowhere", scope(rules, b.world())) is not Truth.HOLDS


def test_a_position_that_is_not_finite_is_no_position(rules: Rules) -> None:
    where = scope(rules, b.world(b.tb3(at=Point(nan, 0.0))), slots={"destination": "base"})
    assert truth("responder.at", "$destination", where) is Truth.ABSENT
    assert truth("responder.at", "$destination", where, negated=True) is Truth.ABSENT


@pytest.mark.parametrize(("tray", "expected"), [("red_cube", Truth.HOLDS), ("bottle", Truth.FAILS)])
def test_two_objects_at_one_place_are_not_one(tray: str, expected: Truth) -> None:
    spot = indoor.place("table_a")
    both = (indoor.seen("red_cube", spot), indoor.seen("bottle", spot))
    world = indoor.indoors(indoor.go2(tray=tray), values=both)
    scope = Scope(rules=indoor.indoor(), world=world, now_ns=b.NOW_NS, roles={"carrier": "go2"})
    assert evaluate(Condition(path="carrier.tray", value="red_cube"), scope).truth is expected

"""Facts between robots: who is below whom, how far, and how old the word is that it rests on."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st
from msgspec.structs import replace

from crew.contracts.codes import Code
from crew.contracts.mission_state import Purpose
from crew.contracts.separation import with_relations
from crew.contracts.snapshot import FluentValue, Point, RobotState, Snapshot, Stamped
from tests.unit.contracts.build import (
    ABORT,
    ABORT_PLAN,
    LAND,
    NOW_NS,
    air_ground,
    executing,
    iris,
    judged,
    refused,
    tb3,
)

LIMIT_M = air_ground().crew.separation.told_m
COORDINATE = st.floats(min_value=-6, max_value=10)


def drone(x: float, y: float, *, airborne: bool = True, descending: bool = False, at_ns: int = NOW_NS) -> RobotState:
    state = iris(airborne=airborne, at_ns=at_ns)
    told: dict[str, FluentValue] = {"at": Point(x, y, 5.0), "descending": descending}
    return replace(state, fluents={**state.fluents, **{n: Stamped(v, at_ns, at_ns) for n, v in told.items()}})


def relations(*robots: RobotState) -> dict[str, Stamped | None]:
    related = with_relations({state.name: state for state in robots}, air_ground())
    names = {"iris": "clear_below", "tb3": "clear_above"}
    return {robot: related[robot].fluents.get(fluent) for robot, fluent in names.items() if robot in related}


def value(stamped: Stamped | None) -> FluentValue | None:
    return None if stamped is None else stamped.value


@pytest.mark.parametrize(("apart_m", "clear"), [(0.0, False), (LIMIT_M - 0.01, False), (LIMIT_M, True), (9.0, True)])
def test_below_is_clear_from_the_separation_on(apart_m: float, clear: bool) -> None:
    found = relations(drone(0.0, 0.0, descending=True), tb3(at=Point(apart_m, 0.0)))
    assert (value(found["iris"]), value(found["tb3"])) == (clear, clear)


def test_the_separation_allows_for_both_poses() -> None:
    separation = air_ground().crew.separation
    assert pytest.approx(separation.column_m + 2 * separation.pose_m) == LIMIT_M


def test_a_drone_that_does_not_come_down_stands_in_nobodys_way() -> None:
    under = tb3(at=Point(0.0, 0.0))
    assert value(relations(drone(0.0, 0.0), under)["tb3"]) is True
    assert value(relations(drone(0.0, 0.0, airborne=False, descending=True), under)["tb3"]) is True
    assert value(relations(drone(0.0, 0.0, descending=True), under)["tb3"]) is False


def test_a_drone_that_stands_has_nobody_below_it() -> None:
    beside = tb3(at=Point(0.5, 0.0))
    assert value(relations(drone(0.0, 0.0, airborne=False), beside)["iris"]) is True
    untold = drone(0.0, 0.0)
    untold = replace(untold, fluents={n: s for n, s in untold.fluents.items() if n != "airborne"})
    assert value(relations(untold, beside)["iris"]) is False, "the worse is taken"


def test_what_a_drone_does_not_tell_is_taken_for_the_worse() -> None:
    silent = drone(0.0, 0.0)
    silent = replace(silent, fluents={"at": silent.fluents["at"]})
    assert value(relations(silent, tb3(at=Point(0.0, 0.0)))["tb3"]) is False


def test_a_robot_without_a_known_place_leaves_it_open() -> None:
    nowhere = tb3()
    nowhere = replace(nowhere, fluents={n: s for n, s in nowhere.fluents.items() if n != "at"})
    assert relations(drone(0.0, 0.0), nowhere) == {"iris": None, "tb3": None}
    assert relations(drone(math.nan, 0.0, descending=True), tb3())["tb3"] is None


def test_it_is_as_old_as_the_word_of_a_robot_that_moves_and_no_older_than_of_one_that_stands() -> None:
    old_ns = NOW_NS - 60_000_000_000
    found = relations(drone(0.0, 0.0), tb3(moving=True, at_ns=old_ns))["iris"]
    assert found is not None
    assert found.source_ns == old_ns
    found = relations(drone(0.0, 0.0), tb3(moving=False, at_ns=old_ns))["iris"]
    assert found is not None
    assert found.source_ns == NOW_NS


def test_a_robot_that_was_never_heard_of_is_not_counted() -> None:
    assert value(relations(drone(0.0, 0.0), RobotState(name="tb3"))["iris"]) is True


def test_a_robots_own_word_for_it_counts_for_nothing() -> None:
    beside = tb3(at=Point(0.1, 0.0))
    assert beside.fluents["clear_above"].value is True
    found = relations(drone(0.0, 0.0, descending=True), beside)
    assert (value(found["iris"]), value(found["tb3"])) == (False, False)


@given(COORDINATE, COORDINATE, COORDINATE, COORDINATE, st.booleans())
def test_where_a_drone_may_land_the_rover_may_drive_off(a: float, b: float, c: float, d: float, down: bool) -> None:
    """Both may begin at one moment, each judged before the other has begun: so one must imply the other."""
    found = relations(drone(a, b, descending=down), tb3(at=Point(c, d)))
    assert value(found["iris"]) is not True or value(found["tb3"]) is True


def test_a_landing_as_a_step_is_refused_and_as_a_safe_state_is_not() -> None:
    occupied = with_relations({"iris": drone(0.0, 0.0), "tb3": tb3(at=Point(0.2, 0.0))}, air_ground())
    mission = executing(ABORT, ABORT_PLAN, air_ground())
    world = Snapshot(robots=occupied)
    refusal = refused(LAND, mission, world, air_ground())
    assert refusal.code is Code.PRECONDITION_FAILED
    assert "iris.clear_below is true, observed false" in refusal.message
    assert judged(LAND, mission, world, air_ground(), purpose=Purpose.SAFE).refusal is None

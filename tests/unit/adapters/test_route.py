"""Routes keep their clearance, end where they should, and say so when there is none."""

import contextlib
import math
from itertools import pairwise

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from crew.adapters.ground.occupancy import Disc, Ground, Spot, distance_to_segment_m
from crew.adapters.ground.route import plan_route
from crew.errors import AdapterError

AREA = (-6.0, 10.0, -6.0, 10.0)
RADIUS_M, CLEARANCE_M = 0.2, 0.25
spots = st.tuples(st.floats(-5.5, 9.5), st.floats(-5.5, 9.5))
obstacles = st.lists(st.tuples(st.floats(-5, 9), st.floats(-5, 9), st.floats(0.2, 1.2)), max_size=5)


def route(discs: list[Disc], start: Spot, target: Spot, standoff: float = 0.0) -> list[Spot]:
    ground = Ground(AREA, discs, radius_m=RADIUS_M, clearance_m=CLEARANCE_M, start=start, target=target)
    return [start, *plan_route(ground, start, target, standoff, 0.2)]


def test_a_free_way_is_one_straight_line() -> None:
    assert route([], (0.0, 0.0), (5.0, 5.0)) == [(0.0, 0.0), (5.0, 5.0)]


def test_a_wall_is_driven_around() -> None:
    wall = [(2.0, -2.0 + 0.5 * i, 0.5) for i in range(9)]
    way = route(wall, (0.0, 0.0), (4.0, 0.0))
    assert len(way) > 2
    assert sum(math.dist(a, b) for a, b in pairwise(way)) < 10.0


@settings(max_examples=25, deadline=None)
@given(obstacles, spots, spots, st.sampled_from([0.0, 0.5]))
def test_routes_keep_clear_of_every_obstacle(discs: list[Disc], start: Spot, target: Spot, standoff: float) -> None:
    keep = RADIUS_M + CLEARANCE_M
    assume(all(math.dist(spot, disc[:2]) > disc[2] + keep + 0.1 for disc in discs for spot in (start, target)))
    with contextlib.suppress(AdapterError):
        check(route(discs, start, target, standoff), discs, target, standoff)


def check(way: list[Spot], discs: list[Disc], target: Spot, standoff: float) -> None:
    keep = RADIUS_M + CLEARANCE_M
    for a, b in pairwise(way):
        assert all(distance_to_segment_m(d[:2], a, b) >= d[2] + keep - 1e-9 for d in discs)
    assert math.dist(way[-1], target) == pytest.approx(standoff, abs=0.31)


def test_it_stops_on_the_stand_off_circle() -> None:
    way = route([], (0.0, 0.0), (5.0, 5.0), 0.6)
    assert math.dist(way[-1], (5.0, 5.0)) == pytest.approx(0.6, abs=1e-6)


def test_a_target_inside_an_obstacle_is_reached_only_beside_it() -> None:
    tree = [(5.0, 5.0, 0.3)]
    with pytest.raises(AdapterError) as refused:
        route(tree, (0.0, 0.0), (5.0, 5.0))
    assert refused.value.code == "no_path"
    assert math.dist(route(tree, (0.0, 0.0), (5.0, 5.0), 1.0)[-1], (5.0, 5.0)) == pytest.approx(1.0, abs=1e-6)


def test_an_enclosed_target_has_no_path() -> None:
    ring = [(3.0 + 2 * math.cos(a / 10), 3.0 + 2 * math.sin(a / 10), 0.3) for a in range(63)]
    with pytest.raises(AdapterError, match="no way from"):
        route(ring, (-3.0, -3.0), (3.0, 3.0))


def test_a_start_too_close_to_an_obstacle_can_be_left() -> None:
    assert route([(1.0, 0.0, 0.5)], (0.45, 0.0), (-3.0, 0.0))[-1] == (-3.0, 0.0)


def test_a_start_whose_own_cell_is_blocked_can_be_left() -> None:
    discs = [(-2.0, -1.2, 0.4242640687119285), (-3.0, 4.5, 0.7211102550927978), (0.0, 1.0, 1.772004514666935)]
    assert route(discs, (-2.251, 0.832), (-3.0, -3.0))[-1] == (-3.0, -3.0)


def test_clearance_is_given_up_for_a_target_that_needs_it_but_the_robots_size_is_not() -> None:
    assert route([(5.0, 5.0, 0.5)], (0.0, 0.0), (4.25, 5.0))[-1] == (4.25, 5.0)
    with pytest.raises(AdapterError):
        route([(5.0, 5.0, 0.5)], (0.0, 0.0), (4.35, 5.0))

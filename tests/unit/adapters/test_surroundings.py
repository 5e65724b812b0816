"""What the scanner says: where beams end, what is new, what is in the way."""

import math

import pytest

from crew.adapters.mavlink.surroundings import Scan, in_the_way, new_obstacles

FAR = math.inf


def scan(**ranges_m: float) -> Scan:
    """Four beams: ahead, right, behind, left."""
    names = ("ahead", "right", "behind", "left")
    return Scan(tuple(ranges_m.get(name, FAR) for name in names), 0.0, math.radians(90.0))


@pytest.mark.parametrize(
    ("heading_deg", "ends"),
    [(0.0, {(3.0, 6.0), (4.0, 5.0)}), (90.0, {(4.0, 5.0), (3.0, 4.0)}), (180.0, {(3.0, 4.0), (2.0, 5.0)})],
)
def test_beams_go_clockwise_from_straight_ahead(heading_deg: float, ends: set[tuple[float, float]]) -> None:
    hits = scan(ahead=1.0, right=1.0).hits((3.0, 5.0), math.radians(heading_deg))
    assert {(round(x, 6), round(y, 6)) for x, y in hits} == ends


def test_far_and_empty_beams_are_no_hits() -> None:
    assert scan(ahead=2.5).hits((0.0, 0.0), 0.0) == []
    assert scan().ahead_m() == math.inf


def test_only_what_is_ahead_counts_as_ahead() -> None:
    assert scan(right=0.2, left=0.2, behind=0.2).ahead_m() == math.inf
    assert scan(ahead=0.4, right=0.2).ahead_m() == 0.4


def test_known_things_and_the_target_are_nothing_new() -> None:
    known = [(2.0, 0.0, 0.3)]
    hits = [(1.75, 0.1), (5.1, 5.0), (3.0, 3.0), (3.01, 3.0)]
    assert [disc[:2] for disc in new_obstacles(hits, known, (5.0, 5.0), 0.25)] == [(3.0, 3.0)]


def test_in_the_way_is_what_the_straight_way_meets_within_reach() -> None:
    ahead, beside = (1.0, 0.1, 0.1), (1.0, 0.6, 0.1)
    assert in_the_way([beside, ahead], (0.0, 0.0), (5.0, 0.0), 0.2, 1.5) == ahead
    assert in_the_way([beside], (0.0, 0.0), (5.0, 0.0), 0.2, 1.5) is None
    assert in_the_way([ahead], (0.0, 0.0), (5.0, 0.0), 0.2, 0.5) is None, "too far away to stop for"
    assert in_the_way([ahead], (0.0, 0.0), (0.5, 0.0), 0.2, 9.0) is None, "behind where it goes"
    assert in_the_way([ahead], (0.0, 0.0), (0.0, 0.0), 0.2, 9.0) is None

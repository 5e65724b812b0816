"""How far a run has come: over planned legs, over a single one, and where no position is known."""

import pytest

from crew.adapters.mavlink.way import Way
from crew.errors import AdapterError


def test_a_planned_way_counts_the_leg_that_runs_and_those_behind_it() -> None:
    way, gap = Way(), [10.0]
    way.plan((0.0, 0.0), [(10.0, 0.0), (10.0, 10.0), (0.0, 10.0)])
    way.leg(lambda: gap[0])
    begun = way.course()
    assert begun is not None
    assert (begun.share, begun.left_m) == (0.0, 30.0)
    gap[0] = 5.0
    assert way.course() is not None
    assert getattr(way.course(), "left_m", None) == 25.0
    gap[0] = 10.0
    way.leg(lambda: gap[0])
    assert getattr(way.course(), "share", None) == pytest.approx(1 / 3)
    way.leg(lambda: 0.0)
    assert getattr(way.course(), "share", None) == 1.0
    way.leg(lambda: 2.0)
    assert getattr(way.course(), "left_m", None) == 2.0, "a leg beyond the plan is all that is left"


def test_a_single_leg_is_its_own_way() -> None:
    way, gap = Way(), [8.0]
    assert way.course() is None
    way.leg(lambda: gap[0])
    gap[0] = 2.0
    assert getattr(way.course(), "share", None) == 0.75


def test_a_lost_position_tells_nothing_and_breaks_nothing() -> None:
    way = Way()
    way.leg(lambda: 1.0)

    def lost() -> float:
        raise AdapterError("no position", code="position_lost")

    way.plan((0.0, 0.0), [(1.0, 0.0)])
    way.leg(lost)
    assert way.course() is None


def test_an_overshoot_is_not_more_than_all() -> None:
    way, gap = Way(), [4.0]
    way.leg(lambda: gap[0])
    gap[0] = 9.0
    assert getattr(way.course(), "share", None) == 0.0

"""The fix is robust: outliers do not move it, a second person is noticed, nothing is made from nothing."""

import math
from random import Random

import pytest

from crew.adapters.mavlink.camera import Look
from crew.adapters.mavlink.fix import combine, locate


def around(x: float, y: float, count: int, *, spread: float = 0.15, start_s: float = 0.0) -> list[Look]:
    random = Random(f"{x}/{y}/{count}")
    return [
        Look(x + random.gauss(0, spread), y + random.gauss(0, spread), 5.0, start_s + i * 0.2) for i in range(count)
    ]


def test_nothing_seen_is_no_fix() -> None:
    assert combine([]) is None


def test_looks_are_averaged() -> None:
    fix = combine(around(5.0, 5.0, 60))
    assert fix is not None
    assert math.hypot(fix.x_m - 5.0, fix.y_m - 5.0) < 0.06
    assert fix.looks == 60


def test_outliers_are_left_out() -> None:
    outliers = [Look(9.0, 9.0, 5.0, 3.0), Look(-4.0, 0.0, 5.0, 4.0), Look(5.0, -3.0, 5.0, 5.0)]
    fix = combine(around(5.0, 5.0, 20) + outliers)
    assert fix is not None
    assert math.hypot(fix.x_m - 5.0, fix.y_m - 5.0) < 0.15
    assert fix.looks == 20


def test_the_covariance_is_what_the_looks_scatter_where_that_is_more_than_expected() -> None:
    random = Random(7)
    looks = [Look(random.gauss(0, 0.6), random.gauss(0, 0.05), 5.0, i * 10.0) for i in range(40)]
    fix = locate(looks)
    xx, xy, yy = fix.covariance_m2
    assert math.sqrt(xx) == pytest.approx(0.6 / math.sqrt(40), rel=0.3)
    assert math.sqrt(yy) == pytest.approx(0.2 / math.sqrt(40), rel=0.3), "no less than the error model expects"
    assert xx * yy > xy * xy


def test_one_look_is_a_fix_with_the_sigma_of_one_look() -> None:
    fix = combine([Look(1.0, 2.0, 5.0, 7.0)])
    assert fix is not None
    assert (fix.x_m, fix.y_m, fix.looks, fix.last_s) == (1.0, 2.0, 1, 7.0)
    assert 0.15 < fix.sigma_m < 0.25


def test_looks_far_apart_in_time_are_worth_more_than_a_burst() -> None:
    burst = combine([Look(0.0, 0.0, 5.0, i * 0.2) for i in range(6)])
    spread = combine([Look(0.0, 0.0, 5.0, i * 10.0) for i in range(6)])
    assert burst is not None
    assert spread is not None
    assert spread.sigma_m < 0.6 * burst.sigma_m


def test_a_burst_does_not_outvote_a_few_looks_of_another_pass() -> None:
    """Forty looks that share one pose error weigh little more than the three of a second pass."""
    fix = combine(
        [Look(0.3, 0.0, 5.0, i * 0.05) for i in range(40)] + [Look(0.0, 0.0, 5.0, 20.0 + i) for i in range(3)]
    )
    assert fix is not None
    assert 0.1 < fix.x_m < 0.2

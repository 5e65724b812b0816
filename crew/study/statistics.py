"""Intervals and tests of a study's fractions. Pure; a bootstrap is repeated by its seed.

Wilson's interval takes the trials for independent. Steps of one mission are not: the bootstrap draws whole scenarios.
"""

import math
from collections.abc import Mapping, Sequence
from random import Random
from typing import Any

import msgspec

from crew.errors import UsageError

Z_95 = 1.959963984540054
"""The normal quantile of a two-sided 95 % interval."""
DRAWS = 2000
LOW, HIGH = 0.025, 0.975


class Interval(msgspec.Struct, frozen=True):
    """Both ends of a 95 % interval of a proportion, from 0 to 1; both nan if nothing was counted."""

    low: float
    high: float

    @property
    def known(self) -> bool:
        return math.isfinite(self.low) and math.isfinite(self.high)


UNKNOWN = Interval(math.nan, math.nan)


def wilson(hits: int, trials: int) -> Interval:
    """Wilson's score interval without a continuity correction. Raises UsageError for an impossible fraction."""
    _check(hits, trials)
    if trials == 0:
        return UNKNOWN
    share, spread = hits / trials, Z_95 * Z_95 / trials
    middle = (share + spread / 2) / (1 + spread)
    half = Z_95 / (1 + spread) * math.sqrt(share * (1 - share) / trials + spread / (4 * trials))
    low = 0.0 if hits == 0 else max(0.0, middle - half)
    return Interval(low, 1.0 if hits == trials else min(1.0, middle + half))


def fisher(one: tuple[int, int], other: tuple[int, int]) -> float:
    """Two-sided p of Fisher's exact test of two fractions, each as hits and trials; nan if either has no trials.

    Two-sided sums every table that is no more likely than the one seen, as the paper's figures do.
    """
    for hits, trials in (one, other):
        _check(hits, trials)
    if not one[1] or not other[1]:
        return math.nan
    stats = _scipy()
    table = [[one[0], one[1] - one[0]], [other[0], other[1] - other[0]]]
    return float(stats.fisher_exact(table, alternative="two-sided").pvalue)


def bootstrap(scenarios: Mapping[str, tuple[int, int]], seed: int, draws: int = DRAWS) -> Interval:
    """Percentile interval of hits over trials when whole scenarios are drawn with replacement.

    `scenarios` maps each to its own hits and trials, summed over its runs. Draws without any trial are left out. With
    a single scenario, or where all agree, the interval is a point: it tells how much scenarios differ, nothing else.
    """
    counted = [scenarios[name] for name in sorted(scenarios)]
    for hits, trials in counted:
        _check(hits, trials)
    chance, shares = Random(seed), []
    for _ in range(draws if counted else 0):
        drawn = chance.choices(counted, k=len(counted))
        trials = sum(t for _, t in drawn)
        if trials:
            shares.append(sum(h for h, _ in drawn) / trials)
    shares.sort()
    return Interval(_quantile(shares, LOW), _quantile(shares, HIGH)) if shares else UNKNOWN


def mean_and_deviation(values: Sequence[float]) -> tuple[float, float]:
    """Mean and sample standard deviation; the deviation of fewer than two is 0, the mean of none is nan."""
    if not values:
        return math.nan, 0.0
    mean = math.fsum(values) / len(values)
    if len(values) < 2:
        return mean, 0.0
    return mean, math.sqrt(math.fsum((v - mean) ** 2 for v in values) / (len(values) - 1))


def _quantile(ordered: Sequence[float], share: float) -> float:
    """Linear between the two nearest ranks."""
    place = share * (len(ordered) - 1)
    below = math.floor(place)
    above = min(below + 1, len(ordered) - 1)
    return ordered[below] + (place - below) * (ordered[above] - ordered[below])


def _check(hits: int, trials: int) -> None:
    if not 0 <= hits <= trials:
        raise UsageError(f"{hits} of {trials} is no fraction: hits must be from 0 to the number of trials")


def _scipy() -> Any:
    try:
        from scipy import stats
    except ImportError as error:
        raise UsageError(f"Fisher's exact test needs scipy: {error}; install robot-crew[study]") from error
    return stats

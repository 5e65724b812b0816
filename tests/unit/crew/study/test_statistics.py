"""The statistics against the paper's published figures, against exact enumeration, and against what they must obey."""

import math
from math import comb

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from crew.errors import UsageError
from crew.study.statistics import bootstrap, fisher, mean_and_deviation, wilson

PUBLISHED = {
    (24, 47): (37, 65), (45, 47): (86, 99), (11, 47): (14, 37), (9, 35): (14, 42),
    (8, 8): (68, 100), (5, 20): (11, 47), (14, 20): (48, 85), (0, 8): (0, 32), (0, 20): (0, 16), (18, 20): (70, 97),
}  # fmt: skip
"""Fractions of the paper's tables with the interval printed beside each, per cent."""


@pytest.mark.parametrize(("fraction", "printed"), PUBLISHED.items())
def test_wilson_gives_the_papers_intervals(fraction: tuple[int, int], printed: tuple[int, int]) -> None:
    found = wilson(*fraction)
    assert (round(100 * found.low), round(100 * found.high)) == printed


@pytest.mark.parametrize(
    ("one", "other", "printed"),
    [((8, 8), (0, 8), "1.6e-04"), ((11, 47), (0, 46), "5.0e-04")],
)
def test_fisher_gives_the_papers_figures_two_sided(one: tuple[int, int], other: tuple[int, int], printed: str) -> None:
    assert f"{fisher(one, other):.1e}" == printed


def test_fisher_of_nothing_is_unknown() -> None:
    assert math.isnan(fisher((0, 0), (3, 4)))


@settings(deadline=None)
@given(st.integers(1, 9), st.integers(1, 9), st.data())
def test_fisher_is_the_sum_over_all_tables_that_are_no_likelier(n: int, m: int, data: st.DataObject) -> None:
    a, b = data.draw(st.integers(0, n)), data.draw(st.integers(0, m))
    weights = [comb(n, k) * comb(m, a + b - k) for k in range(max(0, a + b - m), min(n, a + b) + 1)]
    exact = sum(w for w in weights if w <= comb(n, a) * comb(m, b)) / comb(n + m, a + b)
    assert fisher((a, n), (b, m)) == pytest.approx(exact, rel=1e-9)


@settings(deadline=None)
@given(st.integers(1, 300), st.data())
def test_wilson_solves_its_own_equation(trials: int, data: st.DataObject) -> None:
    """At each end the observed share lies exactly 1.96 standard errors of that end's own proportion away."""
    hits = data.draw(st.integers(1, trials))
    found, share = wilson(hits, trials), hits / trials
    for end in (found.low, found.high):
        if 0 < end < 1:
            error = math.sqrt(end * (1 - end) / trials)
            assert abs(share - end) / error == pytest.approx(1.959964, rel=1e-4)
    assert found.low <= share <= found.high


def test_an_impossible_fraction_is_said() -> None:
    with pytest.raises(UsageError, match="5 of 4 is no fraction"):
        wilson(5, 4)
    assert not wilson(0, 0).known


def test_the_bootstrap_draws_scenarios_not_steps() -> None:
    """One scenario with all errors: its steps hang together, so the interval is wider than Wilson's."""
    clustered = {f"s{i}": (5, 5) if i == 0 else (0, 5) for i in range(10)}
    drawn, counted = bootstrap(clustered, seed=1), wilson(5, 50)
    assert drawn.high - drawn.low > counted.high - counted.low
    assert drawn.low == 0.0
    assert drawn.high == pytest.approx(0.3, abs=0.05)


def test_the_bootstrap_is_repeated_by_its_seed() -> None:
    scenarios = {f"s{i}": (i % 3, 3) for i in range(8)}
    assert bootstrap(scenarios, seed=4) == bootstrap(dict(reversed(scenarios.items())), seed=4)
    assert bootstrap(scenarios, seed=4) != bootstrap(scenarios, seed=5)


def test_the_bootstrap_of_agreement_is_a_point_and_of_nothing_unknown() -> None:
    assert bootstrap({"a": (0, 3), "b": (0, 4)}, seed=0).high == 0.0
    assert not bootstrap({}, seed=0).known
    assert not bootstrap({"a": (0, 0)}, seed=0).known


def test_mean_and_deviation() -> None:
    mean, deviation = mean_and_deviation([1.0, 3.0])
    assert mean == 2.0
    assert deviation == pytest.approx(math.sqrt(2))
    assert mean_and_deviation([2.5]) == (2.5, 0.0)
    assert math.isnan(mean_and_deviation([])[0])

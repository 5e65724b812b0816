"""Requests in many people's wording: none is taken for another, and not many are refused needlessly."""

from functools import cache

import pytest

from crew.library import load_rules
from tests.unit.contracts.language.corpus import judge
from tests.unit.contracts.language.measure import Judgement, judged, tally

NEEDLESS = {
    ("requests_voices.yaml", "tuned"): 0.03,
    ("requests_voices.yaml", "held"): 0.02,
    ("requests_voices.yaml", "last"): 0.05,
    ("requests_people.yaml", "read"): 0.03,
    ("requests_people.yaml", "unread"): 0.10,
    ("requests_crowd.yaml", "read"): 0.05,
    ("requests_crowd.yaml", "unread"): 0.11,
    ("requests_strangers.yaml", "unread"): 0.03,
    ("requests_newcomers.yaml", "unread"): 0.04,
    ("requests_trades.yaml", "read"): 0.03,
    ("requests_trades.yaml", "unread"): 0.13,
    ("requests_rounds.yaml", "first"): 0.05,
    ("requests_rounds.yaml", "second"): 0.12,
    ("requests_rounds.yaml", "third"): 0.17,
    ("requests_rounds.yaml", "fourth"): 0.11,
    ("requests_rounds.yaml", "fifth"): 0.15,
    ("requests_unmet.yaml", "unread"): 0.21,
}
"""The share of requests that could be carried out and are refused; one that is asked back counts half.

What the reader makes of them now; docs/planner.md has what it made of them when it met them.
"""


@cache
def outcomes(file: str, part: str) -> list[Judgement]:
    return judged(file, part)


@pytest.mark.parametrize(("file", "part"), list(NEEDLESS))
def test_no_request_is_taken_for_another(file: str, part: str) -> None:
    assert [(j.request.text, j.told) for j in outcomes(file, part) if j.taken] == []


@pytest.mark.parametrize(("file", "part"), list(NEEDLESS))
def test_few_requests_are_refused_needlessly(file: str, part: str) -> None:
    assert tally(outcomes(file, part)).needless <= NEEDLESS[file, part]


def test_who_speaks_of_themselves_first_is_no_goal() -> None:
    rules = load_rules("humanoid_quadruped")
    told = judge("me, I need the bottle in room_a", rules)
    assert told.instance is not None
    assert told.instance.slots["destination"] == "room_a"
    assert judge("here, take the bottle to room_a", rules).outcome != "accepted"

"""Requests in many people's wording: none is taken for another, and not many are refused needlessly."""

import pytest

from crew.contracts.site import Rules
from crew.library import load_rules
from tests.unit.contracts.language.corpus import Request, corpus, judge, mistake

FILES = {
    "requests_voices.yaml": ("tuned", "held", "last"),
    "requests_people.yaml": ("read", "unread"),
    "requests_crowd.yaml": ("read", "unread"),
    "requests_strangers.yaml": ("unread",),
    "requests_newcomers.yaml": ("unread",),
}
CREWS = {"air": "air_ground", "indoor": "humanoid_quadruped"}
NEEDLESS = {
    "requests_voices.yaml": 0.031,
    "requests_people.yaml": 0.076,
    "requests_crowd.yaml": 0.069,
    "requests_strangers.yaml": 0.036,
    "requests_newcomers.yaml": 0.346,
}
"""The share of requests that could be carried out and are refused; one that is asked back counts half.

What the reader makes of them now; docs/planner.md has what it made of them when it met them.
"""


def requests(file: str, crew: str) -> list[Request]:
    return [request for part in FILES[file] for request in corpus(f"{crew}_{part}", file)]


@pytest.fixture(scope="module", params=list(CREWS))
def crew(request: pytest.FixtureRequest) -> tuple[str, Rules]:
    return request.param, load_rules(CREWS[request.param])


@pytest.mark.parametrize("file", list(FILES))
def test_no_request_is_taken_for_another(file: str, crew: tuple[str, Rules]) -> None:
    name, rules = crew
    taken = [(r.text, judge(r.text, rules, r.state)) for r in requests(file, name) if mistake(r, rules)]
    assert [(text, found.plan) for text, found in taken if found.outcome == "accepted"] == []


@pytest.mark.parametrize("file", list(FILES))
def test_few_requests_are_refused_needlessly(file: str) -> None:
    outcomes = []
    for name, crew_name in CREWS.items():
        rules = load_rules(crew_name)
        possible = [r for r in requests(file, name) if r.outcome == "accepted"]
        outcomes += [judge(r.text, rules, r.state).outcome for r in possible]
    needless = (outcomes.count("refused") + outcomes.count("question") / 2) / len(outcomes)
    assert needless <= NEEDLESS[file]


def test_who_speaks_of_themselves_first_is_no_goal() -> None:
    rules = load_rules("humanoid_quadruped")
    told = judge("me, I need the bottle in room_a", rules)
    assert told.instance is not None
    assert told.instance.slots["destination"] == "room_a"
    assert judge("here, take the bottle to room_a", rules).outcome != "accepted"

"""Requests in many people's wording: hardly any is refused needlessly, and none is taken for another."""

import pytest

from crew.contracts.site import Rules
from crew.library import load_rules
from tests.unit.contracts.language.corpus import Request, corpus, judge, mistake

PARTS = ("tuned", "held", "last")
CREWS = {"air": "air_ground", "indoor": "humanoid_quadruped"}
NEEDLESS = 0.15
"""The share of requests that could be carried out and are refused; one that is asked back counts half."""


def requests(crew: str) -> list[Request]:
    return [request for part in PARTS for request in corpus(f"{crew}_{part}", "requests_voices.yaml")]


@pytest.fixture(scope="module", params=list(CREWS))
def crew(request: pytest.FixtureRequest) -> tuple[Rules, list[Request]]:
    return load_rules(CREWS[request.param]), requests(request.param)


def test_no_request_is_taken_for_another(crew: tuple[Rules, list[Request]]) -> None:
    rules, asked = crew
    taken = [(r.text, judge(r.text, rules, r.state)) for r in asked if mistake(r, rules)]
    assert [(text, found.plan) for text, found in taken if found.outcome == "accepted"] == []


def test_few_requests_are_refused_needlessly(crew: tuple[Rules, list[Request]]) -> None:
    rules, asked = crew
    possible = [r for r in asked if r.outcome == "accepted"]
    outcomes = [judge(r.text, rules, r.state).outcome for r in possible]
    needless = (outcomes.count("refused") + outcomes.count("question") / 2) / len(possible)
    assert needless <= NEEDLESS

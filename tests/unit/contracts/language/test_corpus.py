"""The corpus of requests: the right ones are accepted, and no wrong plan for them is."""

import pytest

from crew.contracts.language.containment import check_containment
from crew.contracts.language.lexicon import lexicon_of
from crew.contracts.language.reading import read_request
from crew.contracts.matching import match
from crew.contracts.plan import Instance
from crew.contracts.site import Rules
from tests.unit.contracts.language.corpus import Request, corpus, judge, mistake
from tests.unit.contracts.language.wrong_plans import is_wrong, mutations, pool

HALVES = ("first", "second", "third", "fourth")
ALL = [request for half in HALVES for request in corpus(half)]


@pytest.mark.parametrize("request_", ALL, ids=lambda r: r.text[:40])
def test_request_has_its_outcome(request_: Request, rules: Rules) -> None:
    assert mistake(request_, rules) == ""


def test_unread_words_are_named(rules: Rules) -> None:
    for request in (r for r in ALL if r.unread):
        reading = read_request(request.text, lexicon_of(rules))
        assert [u.word for u in reading.unread] == request.unread


@pytest.fixture(scope="module")
def instances(rules: Rules) -> list[Instance]:
    return [i for plan in pool(rules) if isinstance(i := match(plan, rules), Instance)]


def test_no_wrong_plan_is_accepted(rules: Rules, instances: list[Instance]) -> None:
    tried, accepted = 0, []
    for request in (r for r in ALL if r.outcome == "accepted"):
        right = judge(request.text, rules)
        assert right.instance is not None
        assert right.plan is not None
        reading = read_request(request.text, lexicon_of(rules))
        matched = [match(plan, rules) for plan in mutations(right.plan)]
        tried += sum(not isinstance(m, Instance) for m in matched)
        for given in (*instances, *(m for m in matched if isinstance(m, Instance))):
            if is_wrong(given, right.instance, reading, rules):
                tried += 1
                accepted += (
                    [(request.text, given)] if check_containment(reading, given, rules, confirmed=True) is None else []
                )
    assert accepted == []
    assert tried > 5_000


def test_refused_requests_license_no_plan(rules: Rules, instances: list[Instance]) -> None:
    for request in (r for r in ALL if r.outcome == "refused" and not set(r.codes) - {"ambiguous_request"}):
        reading = read_request(request.text, lexicon_of(rules))
        accepted = [i for i in instances if check_containment(reading, i, rules, confirmed=False) is None]
        assert accepted == [], request.text

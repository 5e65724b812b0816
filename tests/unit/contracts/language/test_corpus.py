"""The corpus of requests: the right ones are accepted, and no wrong plan for them is."""

import pytest

from crew.contracts.language.lexicon import lexicon_of
from crew.contracts.language.mention import MentionKind
from crew.contracts.language.reading import read_request
from crew.contracts.site import Rules
from tests.unit.contracts.language.corpus import Request, corpus, judge, judge_plan, mistake
from tests.unit.contracts.language.wrong_plans import is_wrong, mutations, pool

HALVES = ("first", "second", "third")
ALL = [request for half in HALVES for request in corpus(half)]


@pytest.mark.parametrize("request_", ALL, ids=lambda r: r.text[:40])
def test_request_has_its_outcome(request_: Request, rules: Rules) -> None:
    assert mistake(request_, rules) == ""


def test_unread_words_are_named(rules: Rules) -> None:
    for request in (r for r in ALL if r.unread):
        reading = read_request(request.text, lexicon_of(rules))
        assert [u.word for u in reading.unread] == request.unread


def test_no_wrong_plan_is_accepted(rules: Rules) -> None:
    plans = list(pool(rules))
    tried, accepted = 0, []
    for request in (r for r in ALL if r.outcome == "accepted"):
        right = judge(request.text, rules)
        assert right.instance is not None
        assert right.plan is not None
        reading = read_request(request.text, lexicon_of(rules))
        said = any(m.kind is MentionKind.ALTITUDE for m in reading.mentions)
        own = {ref.step for a in reading.actions for ref in a.means if ref.contract == right.instance.contract}
        asked = frozenset(own & {"takeoff", "land"} & {s.step for s in right.instance.steps})
        for plan in (*plans, *mutations(right.plan)):
            judged = judge_plan(request.text, plan, rules)
            if judged.instance is None:
                tried += judged.outcome == "refused"
            elif is_wrong(judged.instance, right.instance, said, asked, rules):
                tried += 1
                accepted += [(request.text, str(plan))] if judged.outcome == "accepted" else []
    assert accepted == []
    assert tried > 5_000


def test_refused_requests_license_no_plan(rules: Rules) -> None:
    plans = list(pool(rules))
    never = [r for r in ALL if r.outcome == "refused" and ("ambiguous_request" in r.codes or not r.codes)]
    accepted = [(r.text, str(p)) for r in never for p in plans if judge_plan(r.text, p, rules).outcome == "accepted"]
    assert accepted == []

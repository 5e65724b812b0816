"""Contracts that a planner could not tell apart: one wording, and nothing in the state or the reach that decides."""

import re
from collections.abc import Iterator, Mapping
from difflib import SequenceMatcher
from itertools import combinations

from crew.contracts.contract import Condition, Contract, SlotType
from crew.contracts.language.templates import expansions
from crew.contracts.odd.oddity import Library, Oddity, Written

ALIKE = 0.9
"""The likeness of two summaries from which on they say the same."""
MAX_WORDINGS = 500
"""Wordings of one contract that are compared."""


def odd_pairs(library: Library) -> Iterator[Oddity]:
    """Pairs of contracts with one wording or one summary, each reported where the later one is written."""
    for first, second in combinations(library.values(), 2):
        if not told_apart(first.contract, second.contract):
            yield from _pair(first, second)


def _pair(first: Written, second: Written) -> Iterator[Oddity]:
    a, b = first.contract, second.contract
    shared = wordings(a).keys() & wordings(b).keys()
    if shared:
        wording = min(shared)
        index = wordings(b)[wording]
        what = f"'{wording}' is a request of {a.name} and of {b.name}, and nothing tells them apart"
        advice = "say it differently, or give each an entry guard that excludes the other"
        yield second.oddity(("examples", index), what, advice)
    elif SequenceMatcher(None, _plain(a.summary), _plain(b.summary)).ratio() >= ALIKE:
        what = f"the summary says what {a.name} says: '{a.summary}'"
        yield second.oddity(("summary",), what, "say what is different")


def wordings(contract: Contract) -> Mapping[str, int]:
    """Every wording of the examples, slots by their types and roles as one, with the example that has it."""
    found: dict[str, int] = {}
    for index, example in enumerate(contract.examples):
        for wording in expansions(example):
            if len(found) >= MAX_WORDINGS:
                return found
            found.setdefault(re.sub(r"\{(\w+)\}", lambda m: _type(m.group(1), contract), wording), index)
    return found


def _type(name: str, contract: Contract) -> str:
    slot = contract.slot(name)
    if slot is None:
        return "<robot>"
    return f"<{' or '.join([*(kind for kind in slot.types if kind is not SlotType.VALUE), *slot.values])}>"


def told_apart(a: Contract, b: Contract) -> bool:
    """Whether two entry guards exclude each other."""
    return any(_excludes(p, q) or _excludes(q, p) for p in a.needs for q in b.needs)


def _excludes(p: Condition, q: Condition) -> bool:
    if p.path != q.path:
        return False
    return p.negated is q.negated is False and p.value != q.value if p.negated is q.negated else p.value == q.value


def _plain(text: str) -> str:
    return " ".join(re.findall(r"[a-z0-9]+", text.lower()))

"""Narrowing a large library to what a request may need: a full-text index in memory over the contracts' own words.

It chooses what a model reads. What the gate enforces stays whole.
"""

import heapq
import math
import re
import sqlite3
from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping

from msgspec.structs import replace

from crew.contracts.contract import Contract
from crew.contracts.site import Rules
from crew.contracts.skill import Kind, Skill

EVERYTHING_BELOW = 150
"""With fewer skills than this, a model reads all of them."""
CONTRACTS = 12
"""Contracts that a model is shown of a large library."""
RAREST = 4
"""How many of a request's words are looked up: those that the fewest contracts hold say the most."""
SAYS_NOTHING = 0.5
"""A word that this share of the contracts holds tells none of them from the others."""
K1, B = 1.2, 0.75
"""BM25's usual constants."""
_WORD = re.compile(r"[^\W_]+")
_SUFFIX = 4
"""Letters that a word may lose on the way to its stem."""


class Library:
    """An index over one crew's contracts, built once."""

    def __init__(self, rules: Rules) -> None:
        self._rules = rules
        self.skill_count = sum(len(kind.skills) for kind in rules.kinds.values())
        self._index = sqlite3.connect(":memory:", check_same_thread=False)
        self._index.execute("CREATE VIRTUAL TABLE c USING fts5(name UNINDEXED, words, tokenize='porter unicode61')")
        entries = list(_entries(rules))
        self._index.executemany("INSERT INTO c VALUES (?, ?)", entries)
        self._index.execute("CREATE VIRTUAL TABLE v USING fts5vocab(c, row)")
        self._holders: dict[str, int] = dict(self._index.execute("SELECT term, doc FROM v"))
        self._names = [name for name, _ in entries]
        self._weights = _length_weights([words.count(" ") + 1 for _, words in entries])
        self._owners: dict[str, list[tuple[str, int]]] = defaultdict(list)
        for kind in rules.kinds.values():
            for place, skill in enumerate(kind.skills):
                self._owners[skill.name].append((kind.name, place))

    @property
    def is_large(self) -> bool:
        return self.skill_count >= EVERYTHING_BELOW

    def contracts(self, request: str, limit: int = CONTRACTS) -> list[str]:
        """Names of the contracts whose words are the request's, best first."""
        words = dict.fromkeys(_WORD.findall(request.lower()))
        most = max(1, SAYS_NOTHING * len(self._names))
        rarest = sorted((count, word) for word in words if 0 < (count := self._held(word)) <= most)[:RAREST]
        scores: dict[int, float] = defaultdict(float)
        for count, word in rarest:
            says = math.log((len(self._names) - count + 0.5) / (count + 0.5) + 1.0)
            for (row,) in self._index.execute("SELECT rowid FROM c WHERE c MATCH ?", (f'"{word}"',)):
                scores[row - 1] += says * self._weights[row - 1]
        best = heapq.nsmallest(limit, scores, key=lambda row: (-scores[row], row))
        return [self._names[row] for row in best]

    def narrow(self, request: str) -> Rules:
        """The rules with the contracts that a request may mean, and every skill that those call."""
        if not self.is_large:
            return self._rules
        contracts = {name: self._rules.contracts[name] for name in self.contracts(request)}
        kinds = self._kinds({name for contract in contracts.values() for name in _called(contract)})
        robots = tuple(r for r in self._rules.crew.robots if r.kind in kinds and kinds[r.kind].skills)
        return Rules(crew=replace(self._rules.crew, robots=robots), kinds=kinds, contracts=contracts)

    def _kinds(self, skills: set[str]) -> dict[str, Kind]:
        """Every kind with those of its skills that have one of these names."""
        places: dict[str, list[int]] = {name: [] for name in self._rules.kinds}
        for skill in skills:
            for kind, place in self._owners.get(skill, ()):
                places[kind].append(place)
        return {
            name: replace(kind, skills=tuple(kind.skills[place] for place in sorted(places[name])))
            for name, kind in self._rules.kinds.items()
        }

    def _held(self, word: str) -> int:
        """How many contracts hold a word, by the longest beginning of it that is a known stem; 0 if none is."""
        shortest = max(1, len(word) - _SUFFIX)
        return next(
            (self._holders[word[:n]] for n in range(len(word), shortest - 1, -1) if word[:n] in self._holders), 0
        )


def _called(contract: Contract) -> set[str]:
    called = {pattern.skill for step in contract.steps for pattern in step.do}
    return called | {role.safe.by for role in contract.roles if role.safe is not None}


def _length_weights(lengths: list[int]) -> list[float]:
    """BM25 (Robertson and Zaragoza 2009) for words that a text holds once: what one is worth by the text's length."""
    mean = sum(lengths) / max(1, len(lengths))
    return [(K1 + 1.0) / (1.0 + K1 * (1.0 - B + B * length / mean)) for length in lengths]


def _entries(rules: Rules) -> Iterator[tuple[str, str]]:
    """Each contract's name with the different words of its texts and of its skills'."""
    skills = {skill.name: skill for kind in rules.kinds.values() for skill in kind.skills}
    for contract in rules.contracts.values():
        text = " ".join(_texts(contract, skills)).replace("_", " ").lower()
        yield contract.name, " ".join(dict.fromkeys(_WORD.findall(text)))


def _texts(contract: Contract, skills: Mapping[str, Skill]) -> Iterable[str]:
    yield from (contract.name, contract.summary, *contract.examples)
    for step in contract.steps:
        yield from (step.name, *step.words)
        for skill in (skills[pattern.skill] for pattern in step.do if pattern.skill in skills):
            yield from (skill.name, skill.about, *skill.words)

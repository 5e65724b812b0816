"""Narrowing a large library to what a request may need: a full-text index in memory over the contracts' own words.

It chooses what a model reads. What the gate enforces stays whole.
"""

import re
import sqlite3
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
        self._index.executemany("INSERT INTO c VALUES (?, ?)", _entries(rules))
        self._index.execute("CREATE VIRTUAL TABLE v USING fts5vocab(c, row)")
        self._holders: dict[str, int] = dict(self._index.execute("SELECT term, doc FROM v"))

    @property
    def is_large(self) -> bool:
        return self.skill_count >= EVERYTHING_BELOW

    def contracts(self, request: str, limit: int = CONTRACTS) -> list[str]:
        """Names of the contracts whose words are the request's, best first."""
        words = dict.fromkeys(_WORD.findall(request.lower()))
        rarest = sorted((count, word) for word in words if (count := self._held(word)))[:RAREST]
        if not rarest:
            return []
        match = " OR ".join(f'"{word}"' for _, word in rarest)
        rows = self._index.execute("SELECT name FROM c WHERE c MATCH ? ORDER BY rank LIMIT ?", (match, limit))
        return [name for (name,) in rows]

    def narrow(self, request: str) -> Rules:
        """The rules with the contracts that a request may mean, and every skill that those call."""
        if not self.is_large:
            return self._rules
        contracts = {name: self._rules.contracts[name] for name in self.contracts(request)}
        wanted = {pair for contract in contracts.values() for pair in closure(contract, self._rules)}
        kinds = {name: _narrowed(kind, wanted) for name, kind in self._rules.kinds.items()}
        robots = tuple(r for r in self._rules.crew.robots if r.kind in kinds and kinds[r.kind].skills)
        return Rules(crew=replace(self._rules.crew, robots=robots), kinds=kinds, contracts=contracts)

    def _held(self, word: str) -> int:
        """How many contracts hold a word, by the longest beginning of it that is a known stem; 0 if none is."""
        shortest = max(1, len(word) - _SUFFIX)
        return next(
            (self._holders[word[:n]] for n in range(len(word), shortest - 1, -1) if word[:n] in self._holders), 0
        )


def closure(contract: Contract, rules: Rules) -> set[tuple[str, str]]:
    """Kind and skill of everything that a contract's steps and safe states call, for every kind that has it."""
    called = {pattern.skill for step in contract.steps for pattern in step.do}
    called |= {role.safe.by for role in contract.roles if role.safe is not None}
    return {(kind.name, name) for kind in rules.kinds.values() for name in called if kind.skill(name) is not None}


def _narrowed(kind: Kind, wanted: set[tuple[str, str]]) -> Kind:
    return replace(kind, skills=tuple(skill for skill in kind.skills if (kind.name, skill.name) in wanted))


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

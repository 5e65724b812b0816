"""A warning about a contract, and where in its file it belongs."""

from collections.abc import Mapping, Sequence
from typing import Any

import msgspec

from crew.contracts.contract import Condition, Contract
from crew.contracts.files.source import Block, Loc, locate


class Oddity(msgspec.Struct, frozen=True, kw_only=True, order=True):
    """Something legal that is probably not meant. `line` and `column` count from 1."""

    source: str
    line: int
    column: int
    what: str
    advice: str

    def __str__(self) -> str:
        return f"{self.source}:{self.line}:{self.column}: warning: {self.what}; {self.advice}"


class Written(msgspec.Struct, frozen=True):
    """A contract with the text that it was read from."""

    contract: Contract
    root: Block

    def oddity(self, loc: Loc, what: str, advice: str) -> Oddity:
        """A warning at the key that ends `loc`."""
        line, column = locate(self.root, loc, key=True)
        return Oddity(source=self.contract.source, line=line, column=column, what=what, advice=advice)

    def clause(self, loc: Loc, condition: Condition, conditions: Sequence[Condition]) -> Loc:
        """Where a guard of the list at `loc` stands: one mapping may hold several clauses."""
        written: Any = self.root
        for part in loc:
            written = written[part]
        like = [c for c in conditions if (c.path, c.line) == (condition.path, condition.line)]
        nth = next(k for k, c in enumerate(like) if c is condition)
        marks = ((index, block.key_marks.get(condition.path)) for index, block in enumerate(written))
        places = [index for index, mark in marks if mark is not None and mark.line == condition.line]
        return (*loc, places[nth], condition.path)


Library = Mapping[str, Written]
"""The contracts of one crew, by name."""

"""A stretch of a request under the names by which patterns of wordings know it: `once SEARCHER has found PERSON`."""

import re
from collections.abc import Callable
from typing import NamedTuple

from crew.contracts.language.entry import Entry
from crew.contracts.language.lexicon import Lexicon, match
from crew.contracts.language.lookahead import SOFT, past_all
from crew.contracts.language.tokens import Shape, Token

Naming = Callable[[Entry], str]
"""The symbol for a name; empty for one that stands for itself."""


class Said(NamedTuple):
    """Words and symbols, each with the tokens that it stands for."""

    words: list[str]
    spans: list[tuple[int, int]]

    def longest(self, pattern: re.Pattern[str]) -> int:
        """How many words from the first one on fit a pattern whole; 0 if none do."""
        return next((k for k in range(len(self.words), 0, -1) if pattern.fullmatch(" ".join(self.words[:k]))), 0)


def spelled(
    tokens: list[Token], at: int, lexicon: Lexicon, naming: Naming, longest: int, marks: frozenset[str] = frozenset()
) -> Said:
    """What stands here, up to a mark other than these, or a number of words."""
    said = Said([], [])
    while at < len(tokens) and len(said.words) < longest:
        if tokens[at].shape is not Shape.WORD and tokens[at].norm not in marks:
            break
        begin = past_all(tokens, at, SOFT)
        name = match(lexicon.names, tokens, begin) if begin < len(tokens) else None
        symbol = naming(name) if name is not None else ""
        after = begin + len(name.words) if name is not None and symbol else at + 1
        said.words.append(symbol or tokens[at].norm)
        said.spans.append((at, after))
        if tokens[after - 1].possessive:
            said.words.append("'s")
            said.spans.append((at, after))
        at = after
    return said

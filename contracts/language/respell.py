"""Slips of the keyboard, set right before a request is read; what may matter among them is asked back."""

from typing import NamedTuple

from crew.contracts.language.lexicon import Lexicon
from crew.contracts.language.mention import Ambiguity, Unread
from crew.contracts.language.spelling import SHORTEST, near_any, recognised
from crew.contracts.language.tokens import Shape, Token

SHORTEST_SILENT = 3
"""Letters of the shortest function word that is recognised."""


class Respelled(NamedTuple):
    """The tokens as they were meant, what is asked back, and what might turn the request round."""

    tokens: list[Token]
    asked: list[Unread]
    doubts: list[Ambiguity]


def respell(text: str, tokens: list[Token], lexicon: Lexicon) -> Respelled:
    """Recognise slips; a possible slip of a negation or a condition makes the request ambiguous."""
    words = lexicon.vocabulary
    out = Respelled([], [], [])
    for token in tokens:
        if token.shape is not Shape.WORD or token.possessive or token.norm in words.known:
            out.tokens.append(token)
            continue
        span = (token.start, token.end)
        if (turn := near_any(token.norm, words.turning)) is not None:
            out.doubts.append(Ambiguity(f"'{token.norm}' may be a slip of '{turn}'", span))
        silent = recognised(token.norm, words.silent, SHORTEST_SILENT)
        meant = silent or recognised(token.norm, words.names, SHORTEST)
        if meant is not None and silent is None:
            out.asked.append(Unread(text[slice(*span)], span, meant))
        out.tokens.append(token if meant is None else token._replace(norm=meant))
    return out

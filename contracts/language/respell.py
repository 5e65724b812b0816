"""Slips of the keyboard, set right before a request is read; what may matter among them is asked back."""

import re
from typing import NamedTuple

from crew.contracts.language.lexicon import Lexicon
from crew.contracts.language.mention import Ambiguity, Unread
from crew.contracts.language.slips import DOUBTFUL, LOOKED_UP
from crew.contracts.language.spelling import (
    SHORTEST,
    Vocabulary,
    near_any,
    recognised,
    swapped,
    swapped_short,
    within_one,
)
from crew.contracts.language.tokens import Shape, Token

_STRETCHED = re.compile(r"([a-z])\1{2,}")
SHORTEST_SILENT = 3
"""Letters of the shortest function word that is recognised."""


class Respelled(NamedTuple):
    """The tokens as they were meant, what is asked back, what might turn the request round, what is only shown."""

    tokens: list[Token]
    asked: list[Unread]
    doubts: list[Ambiguity]
    sure: list[Unread]


def respell(text: str, tokens: list[Token], lexicon: Lexicon) -> Respelled:
    """Recognise slips; a possible slip of a negation or a condition makes the request ambiguous."""
    words = lexicon.vocabulary
    out = Respelled([], [], [], [])
    for token in (_unstretched(t, words) for t in tokens):
        if token.shape is not Shape.WORD or token.possessive or token.norm in words.known:
            out.tokens.append(token)
            continue
        span = (token.start, token.end)
        if (turn := near_any(token.norm, words.turning)) is not None:
            out.doubts.append(Ambiguity(f"'{token.norm}' may be a slip of '{turn}'", span))
        silent = recognised(token.norm, words.silent, SHORTEST_SILENT)
        meant = silent or recognised(token.norm, words.names, SHORTEST) or swapped_short(token.norm, words.names)
        if meant is None:
            meant = next((w for w in sorted(words.pronouns) if swapped(token.norm, w)), None)
        if meant is not None and silent is None:
            shown = Unread(text[slice(*span)], span, meant)
            (out.sure if _sure(text, token, meant, words) else out.asked).append(shown)
        out.tokens.append(token if meant is None else token._replace(norm=meant))
    return out


def _unstretched(token: Token, words: Vocabulary) -> Token:
    """`soooo` is `so`."""
    plain = _STRETCHED.sub(r"\1", token.norm)
    return token._replace(norm=plain) if plain != token.norm and plain in words.known else token


def _sure(text: str, token: Token, meant: str, words: Vocabulary) -> bool:
    """Whether a slip can be nothing else: a word that was looked up, no name, and no part of one."""
    raw = text[token.start : token.end]
    begins = not text[: token.start].rstrip() or text[: token.start].rstrip()[-1] in ".!?:\n"
    plain = raw.islower() or (begins and raw[1:].islower())
    joined = text[token.end : token.end + 1] in ("_", "-") or text[token.start - 1 : token.start] in ("_", "-")
    looked_up = meant in LOOKED_UP and token.norm not in DOUBTFUL
    return plain and not joined and looked_up and not any(within_one(token.norm, turn) for turn in words.turning)

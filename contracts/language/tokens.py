"""Cuts a request into tokens with their places in the original text. Anything not plain ASCII after NFKC is odd."""

import re
import unicodedata
from enum import StrEnum
from typing import NamedTuple

from crew.contracts.language.words import METRES


class Shape(StrEnum):
    """What a token looks like."""

    WORD = "word"
    NUMBER = "number"
    MARK = "mark"
    ODD = "odd"


class Token(NamedTuple):
    """One word, number or mark; `start` and `end` are offsets in the original text."""

    norm: str
    start: int
    end: int
    shape: Shape
    possessive: bool = False


def reworded(norm: str, first: Token, last: Token | None = None) -> Token:
    """A word over what was said from one token to another."""
    return Token(norm, first.start, (last or first).end, Shape.WORD)


_MARKS = "!\"#$%&'()*+,\\-./:;<=>?@\\[\\\\\\]^_`{|}~\u2018\u2019\u201c\u201d\u2013\u2014\u2026\u2212"
_LEXEME = re.compile(
    rf"(?P<number>\d+(?:\.\d+)*|\.\d+)|(?P<word>[^\s{_MARKS}]+(?:['\u2019][^\s{_MARKS}]+)*)|(?P<mark>\S)|(?P<line>\n)"
)
_PLAIN = re.compile(r"[a-z0-9]+(?:'[a-z]+)*\Z")
_DECIMAL = re.compile(r"(?:[0-9]{1,6}(?:\.[0-9]{1,9})?|\.[0-9]{1,9})\Z")
_MARK_FORMS = str.maketrans({"\u2013": "-", "\u2014": "-", "\u2212": "-", "\n": "."})
_DROPPED = frozenset("'\"\u2018\u2019\u201c\u201d`")
_CONTRACTIONS = {
    "where's": "where is", "wanna": "want to", "gonna": "going to", "gotta": "have to", "gimme": "give me",
    "lemme": "let me",
}  # fmt: skip
_NO_APOSTROPHE = {
    "im": "i'm", "ive": "i've", "youre": "you're", "theyre": "they're", "hes": "he's", "shes": "she's",
    "thats": "that's", "theres": "there's", "weve": "we've", "theyve": "they've", "youve": "you've",
}  # fmt: skip
"""Contractions that are no other word without their apostrophe."""
_KEPT = frozenset(("let's", "it's", "that's", "there's", "he's", "she's", "who's", "what's"))


def tokenize(text: str) -> list[Token]:
    """Every visible character of the text lies in one token, except quotation marks and joining `_` or `-`."""
    tokens: list[Token] = []
    for found in _LEXEME.finditer(text):
        start, end = found.span()
        if found.lastgroup == "number":
            _add_number(tokens, found.group(), start, end)
        elif found.lastgroup == "word":
            _add_word(tokens, found.group(), start, end)
        else:
            _add_mark(tokens, text, start, end)
    return tokens


def _add_number(tokens: list[Token], raw: str, start: int, end: int) -> None:
    plain = raw.isascii() and _DECIMAL.match(raw) is not None
    tokens.append(Token(raw, start, end, Shape.NUMBER if plain else Shape.ODD))


def _add_word(tokens: list[Token], raw: str, start: int, end: int) -> None:
    norm = raw if raw.isascii() else unicodedata.normalize("NFKC", raw)
    norm = norm.casefold().replace("\u2019", "'")
    norm = _NO_APOSTROPHE.get(norm, norm)
    last = tokens[-1] if tokens else None
    if last is not None and last.end == start and last.shape in (Shape.NUMBER, Shape.ODD) and norm not in METRES:
        tokens[-1] = Token(last.norm + norm, last.start, end, Shape.ODD)  # "2nd", "1e5": no number, and no word
    elif _PLAIN.match(norm) is None or (not raw.isascii() and any(c.isdigit() for c in norm)):
        tokens.append(Token(norm, start, end, Shape.ODD))
    elif norm in _CONTRACTIONS:
        first, second = _CONTRACTIONS[norm].split()
        cut = start + min(len(first), len(norm) - 1)
        tokens.extend((Token(first, start, cut, Shape.WORD), Token(second, cut, end, Shape.WORD)))
    elif norm.endswith("'s") and norm not in _KEPT:
        tokens.append(Token(norm[:-2], start, end, Shape.WORD, possessive=True))
    else:
        tokens.append(Token(norm, start, end, Shape.WORD))


def _add_mark(tokens: list[Token], text: str, start: int, end: int) -> None:
    raw = text[start:end]
    if raw in _DROPPED or _joins(raw, text, start, end):
        return
    tokens.append(Token(raw.translate(_MARK_FORMS), start, end, Shape.MARK))


def _joins(raw: str, text: str, start: int, end: int) -> bool:
    """Whether `_` or `-` only joins the parts of a name or of a compound word."""
    if raw not in "_-" or start == 0 or end >= len(text):
        return False
    before, after = text[start - 1], text[end]
    if raw == "_" or after.isalpha():
        return before.isalnum() and after.isalnum()
    return after.isdigit() and before.isalpha() and start > 1 and text[start - 2].isalnum()

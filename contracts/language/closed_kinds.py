"""Whether what was said fits a pattern of the closed kinds."""

import re
from functools import cache

from crew.contracts.language.stories import CLASSES
from crew.contracts.language.tokens import Token


def said_between(tokens: list[Token], first: int, after: int) -> str:
    """The words of some tokens, with blanks between."""
    return " ".join(t.norm + (" 's" if t.possessive else "") for t in tokens[first:after])


def fits(patterns: tuple[str, ...], said: str) -> bool:
    """Whether one of the patterns holds for the whole of it."""
    return _compiled(patterns).fullmatch(said) is not None


@cache
def _compiled(patterns: tuple[str, ...]) -> re.Pattern[str]:
    return re.compile("|".join(f"(?:{_filled(p)})" for p in patterns))


def _filled(pattern: str) -> str:
    while (filled := re.sub(r"<(\w+)>", lambda m: f"(?:{CLASSES[m.group(1)]})", pattern)) != pattern:
        pattern = filled
    return pattern


@cache
def class_words(name: str) -> tuple[str, ...]:
    """The words of a class that is made of no other."""
    return tuple(w for w in CLASSES[name].split("|") if "<" not in w)

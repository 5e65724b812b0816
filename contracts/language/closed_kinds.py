"""Whether what was said fits a pattern of the closed kinds."""

import re
from functools import cache

from crew.contracts.language.stories import CLASSES
from crew.contracts.language.tokens import Token

_ANYBODY = frozenset(("one", "someone", "somebody"))


def said_between(tokens: list[Token], first: int, after: int) -> str:
    """The words of some tokens, with blanks between."""
    return " ".join(t.norm + (" 's" if t.possessive else "") for t in tokens[first:after])


def fits(patterns: tuple[str, ...], said: str) -> bool:
    """Whether one of the patterns holds for the whole of it."""
    return _compiled(patterns).fullmatch(said) is not None


def fits_of_person(patterns: tuple[str, ...], said: str) -> bool:
    """The same, with `@person` for a noun of somebody, and since when and from where behind it.

    Those are long lists: they are looked for by themselves, so that each pattern stays short.
    """
    words = said.split(" ")
    for end in range(len(words), 0, -1):
        since = "".join(f" {word}" for word in words[end:])
        if _since().fullmatch(since) and fits(patterns, _nouns().sub(_kind, " ".join(words[:end]))):
            return True
    return False


def _kind(noun: re.Match[str]) -> str:
    said = noun.group()
    return said if said in _ANYBODY else f"@{noun.lastgroup}"


@cache
def _nouns() -> re.Pattern[str]:
    one, many = _filled("<person>"), _filled("<persons>")
    return re.compile(rf"(?<![\w'])(?:(?P<persons>{many})|(?P<person>{one}))(?![\w'])")


@cache
def _since() -> re.Pattern[str]:
    return re.compile(_filled("(?: since)?(?: <since>)*"))


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

"""Slips of the keyboard. What is recognised is asked back, unless it is a word that says nothing by itself.

Only letters that were swapped, left out, or struck twice count: one letter for another makes another word (`tube`,
`cube`). The first letter holds, unless it was swapped.
"""

from collections import defaultdict
from collections.abc import Collection, Iterable
from functools import cache
from typing import NamedTuple


class Vocabulary(NamedTuple):
    """The single words of one lexicon, by what a slip of one of them would cost."""

    known: frozenset[str]
    """Never a slip."""
    names: frozenset[str]
    """Names and verbs: recognised, and asked back."""
    silent: frozenset[str]
    """Words that say nothing by themselves."""
    pronouns: frozenset[str]
    """Words for what was named before, and prepositions: only two letters that were swapped in one are recognised."""
    turning: frozenset[str]
    """Words that turn a request round: negations, conditions, corrections."""


SHORTEST = 4
"""Letters of the shortest name or verb that is recognised."""
SHORTEST_SWAPPED = 3
"""The same, where only two letters were swapped."""


def slips(word: str, meant: str) -> bool:
    """Whether a word is another one with two letters swapped, one left out, or some struck twice."""
    if meant[:1] not in word[:2] or word == meant:  # no slip moves the first letter further
        return False
    if len(word) == len(meant):
        return _swapped(word, meant)
    return _left_out(word, meant) if len(word) < len(meant) else _stretched(word, meant)


def recognised(word: str, known: frozenset[str], shortest: int = SHORTEST) -> str | None:
    """The one known word that was meant; None if there is none, or more than one."""
    if len(word) < 3:
        return None
    likely = (other for first in set(word[:2]) for other in _by_first(known).get(first, ()))
    found = {other for other in likely if len(other) >= shortest and slips(word, other)}
    return found.pop() if len(found) == 1 else None


@cache
def _by_first(known: frozenset[str]) -> dict[str, list[str]]:
    """Words by their first letter."""
    found = defaultdict[str, list[str]](list)
    for word in known:
        found[word[:1]].append(word)
    return dict(found)


def swapped(word: str, meant: str) -> bool:
    """Whether a word is another one with two letters swapped."""
    return word != meant and _swapped(word, meant)


def swapped_short(word: str, known: Iterable[str]) -> str | None:
    """The one known word of three letters that was meant, two of which were swapped."""
    found = {other for other in known if len(word) == SHORTEST_SWAPPED and word != other and _swapped(word, other)}
    return found.pop() if len(found) == 1 else None


def near_any(word: str, words: Collection[str]) -> str | None:
    """A word of the collection that this one could be a slip of."""
    return next((w for w in sorted(words) if len(word) > 1 and slips(word, w)), None)


def within_one(word: str, other: str) -> bool:
    """Whether one letter more, less, other or swapped makes one word of the other."""
    if abs(len(word) - len(other)) > 1:
        return False
    if len(word) == len(other):
        return sum(a != b for a, b in zip(word, other, strict=True)) < 2 or _swapped(word, other)
    short, long = sorted((word, other), key=len)
    return any(long[:k] + long[k + 1 :] == short for k in range(len(long)))


def _swapped(word: str, meant: str) -> bool:
    if len(word) != len(meant):
        return False
    odd = [k for k, (a, b) in enumerate(zip(word, meant, strict=True)) if a != b]
    return len(odd) == 2 and odd[1] == odd[0] + 1 and word[odd[0]] == meant[odd[1]] and word[odd[1]] == meant[odd[0]]


def _left_out(word: str, meant: str) -> bool:
    if len(word) + 1 != len(meant) or word[:1] != meant[:1]:
        return False
    return any(meant[:k] + meant[k + 1 :] == word for k in range(1, len(meant)))


def _stretched(word: str, meant: str) -> bool:
    return word[-1:] == meant[-1:] and _runs(word) == _runs(meant)


def _runs(word: str) -> str:
    return "".join(letter for k, letter in enumerate(word) if k == 0 or letter != word[k - 1])

"""The forms of English verbs and nouns, as far as requests use them."""

from collections.abc import Iterator
from enum import StrEnum

from crew.contracts.language.words import IRREGULAR

_VOWELS = "aeiou"


class Form(StrEnum):
    """A verb's form. A past form asks for nothing unless a passive or a perfect makes it do so."""

    BASE = "base"
    PRESENT = "present"
    ING = "ing"
    PAST = "past"


def inflections(words: tuple[str, ...]) -> Iterator[tuple[Form, tuple[str, ...]]]:
    """A verb phrase in its forms; only the first word changes ("takes off")."""
    verb, rest = words[0], words[1:]
    yield Form.BASE, words
    yield Form.PRESENT, (_third_person(verb), *rest)
    yield Form.ING, (_participle(verb), *rest)
    for past in IRREGULAR.get(verb, (_past(verb),)):
        if past != verb:
            yield Form.PAST, (past, *rest)


def plurals(words: tuple[str, ...]) -> Iterator[tuple[str, ...]]:
    """A noun phrase with its last word in the plural."""
    yield (*words[:-1], _third_person(words[-1]))


def _third_person(word: str) -> str:
    if word.endswith(("s", "x", "z", "ch", "sh", "o")):
        return word + "es"
    if word.endswith("y") and word[-2:-1] not in _VOWELS:
        return word[:-1] + "ies"
    return word + "s"


def _participle(word: str) -> str:
    if word.endswith("e") and not word.endswith(("ee", "ye", "oe")):
        return word[:-1] + "ing"
    return (_doubled(word) or word) + "ing"


def _past(word: str) -> str:
    if word.endswith("e"):
        return word + "d"
    if word.endswith("y") and word[-2:-1] not in _VOWELS:
        return word[:-1] + "ied"
    return (_doubled(word) or word) + "ed"


def _doubled(word: str) -> str | None:
    """`stop` doubles its last letter; `look`, `land` and `direct` do not."""
    vowels = sum(letter in _VOWELS for letter in word)
    short = len(word) > 2 and word[-1] not in _VOWELS + "wxy" and word[-2] in _VOWELS and word[-3] not in _VOWELS
    return word + word[-1] if short and vowels == 1 else None

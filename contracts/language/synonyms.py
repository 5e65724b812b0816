"""Other verbs, and nouns, for the verbs of a crew. A crew's own meaning of a word comes first, and so does a name."""

from collections.abc import Collection, Iterator, Mapping
from typing import TypeVar

Meaning = TypeVar("Meaning")

SYNONYMS: dict[str, tuple[str, ...]] = {
    "send": ("dispatch", "despatch", "relocate"),
    "go": ("proceed", "travel", "head over", "come"),
    "carry": ("convey", "bear"),
    "bring": ("bring over", "bring round", "bring along"),
    "put": ("set down", "pop"),
    "search": ("scour", "comb through", "reconnoitre", "canvass", "inspect", "go over", "cover"),
    "take off": ("climb", "ascend", "get airborne"),
    "stop": ("cease",),
    "find": ("track down", "discover"),
}
"""Other verbs for one that a crew has."""

NOUNS: dict[str, tuple[str, ...]] = {
    "deliver": ("delivery",),
    "transport": ("transportation", "transfer"),
    "carry": ("conveyance",),
    "move": ("relocation",),
    "search": ("reconnaissance", "recon"),
}
"""Nouns that ask for what their verb does."""


def also(meanings: Mapping[str, Meaning], taken: Collection[str]) -> Iterator[tuple[str, Meaning, bool]]:
    """Words that no one of this crew uses yet, each with what it means, and whether it is a verb."""
    for table, verbs in ((SYNONYMS, True), (NOUNS, False)):
        for known, others in table.items():
            if known in meanings:
                yield from ((w, meanings[known], verbs) for w in others if w not in meanings and w not in taken)

"""Other verbs, and nouns, for the verbs of a crew. A crew's own meaning of a word comes first, and so does a name."""

from collections.abc import Collection, Iterator, Mapping
from typing import TypeVar

Meaning = TypeVar("Meaning")

SYNONYMS: dict[str, tuple[str, ...]] = {
    "send": ("dispatch", "despatch", "relocate", "reposition", "redeploy", "deploy", "redirect", "reroute"),
    "go": (
        "proceed", "travel", "head over", "come", "trot", "amble", "trundle", "make tracks", "come along", "walk over",
        "drive over",
    ),
    "carry": ("convey", "bear"),
    "bring": ("bring over", "bring round", "bring along"),
    "hand": ("hand across", "pass across", "give over"),
    "put": ("set down", "pop"),
    "hold": ("take hold of", "get hold of", "hang on to"),
    "wave": ("wave goodbye", "wave bye", "wave hi", "wave back"),
    "search": (
        "scour", "comb through", "reconnoitre", "reconnoiter", "canvass", "inspect", "go over", "cover", "look over",
        "check over", "check out",
    ),
    "take off": ("climb", "ascend", "get airborne", "get aloft", "go airborne"),
    "stop": ("cease", "desist"),
    "find": ("track down", "discover", "detect", "pinpoint", "seek out", "hunt down", "hunt for", "search out"),
}  # fmt: skip
"""Other verbs for one that a crew has."""

NOUNS: dict[str, tuple[str, ...]] = {
    "deliver": ("delivery",),
    "transport": ("transportation", "transfer"),
    "carry": ("conveyance",),
    "move": ("relocation",),
    "search": ("reconnaissance", "recon", "hunt", "search operation"),
}
"""Nouns that ask for what their verb does."""


PLACES: dict[str, tuple[str, ...]] = {
    "base": ("home base", "starting point", "start point", "starting position", "start position", "home position"),
    "charger": (
        "charging dock",
        "charging point",
        "charging bay",
        "charging pad",
        "charging base",
        "charging spot",
    ),
    "pickup point": (
        "pick up point",
        "pick up spot",
        "pickup location",
        "loading spot",
        "loading place",
        "pickup place",
        "pick up place",
        "pickup area",
        "loading area",
        "loading bay",
    ),
    "drop off": (
        "drop off spot",
        "drop off location",
        "drop off place",
        "dropoff spot",
        "dropoff location",
        "delivery point",
        "drop point",
    ),
}
"""Other names of a place that has this name or alias."""


def places(names: Collection[str], taken: Collection[str]) -> Iterator[str]:
    """Other names of a place of these names that nothing else of the crew has."""
    return (other for name, others in PLACES.items() if name in names for other in others if other not in taken)


def also(meanings: Mapping[str, Meaning], taken: Collection[str]) -> Iterator[tuple[str, Meaning, bool]]:
    """Words that no one of this crew uses yet, each with what it means, and whether it is a verb."""
    for table, verbs in ((SYNONYMS, True), (NOUNS, False)):
        for known, others in table.items():
            if known in meanings:
                yield from ((w, meanings[known], verbs) for w in others if w not in meanings and w not in taken)

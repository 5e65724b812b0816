"""How a request falls into clauses: between marks, and between joining words."""

from collections.abc import Iterator
from functools import cache
from itertools import islice, pairwise
from typing import NamedTuple

from crew.contracts.language.entry import stands_all
from crew.contracts.language.lexicon import Lexicon
from crew.contracts.language.mention import MentionKind
from crew.contracts.language.stories import CLASSES, JOINED, SPEAKS
from crew.contracts.language.tokens import Shape, Token
from crew.contracts.language.words import REQUESTER

_BOUNDS = frozenset(".!?;:,-()\u2026")
_WHY_WORDS = frozenset(("as", "since", "for"))
_ASKS = frozenset((
    "i", "we", "i'd", "we'd", "i'll", "we'll", "could", "can", "would", "will", "please", "let", "have",
))  # fmt: skip
"""What opens a request behind what it is for."""


class Clause(NamedTuple):
    """Tokens `first` up to `after`, without the words that join it (from `start`)."""

    start: int
    first: int
    after: int
    closed_by: str
    whole: bool
    """It lies between marks, not only between joining words."""


def clauses(tokens: list[Token]) -> Iterator[Clause]:
    """Whole clauses between marks first, then their parts between joining words."""
    begin = 0
    for end in range(len(tokens) + 1):
        if end < len(tokens) and not (tokens[end].shape is Shape.MARK and tokens[end].norm in _BOUNDS):
            continue
        if end > begin:
            yield from _parts(tokens, begin, end)
        begin = end + 1


def _parts(tokens: list[Token], begin: int, end: int) -> Iterator[Clause]:
    closed_by = tokens[end].norm if end < len(tokens) else ""
    whole = Clause(begin, _past_joined(tokens, begin, end), end, closed_by, whole=True)
    yield whole
    yield from parts_of(tokens, whole)


def parts_of(tokens: list[Token], whole: Clause) -> Iterator[Clause]:
    """What joining words part a clause into; nothing where there are none."""
    cuts = [k for k in range(whole.start + 1, whole.after) if _joins(tokens, k)]
    if tokens[whole.start].norm == "for":  # "for the demo I need ..."
        asks = (k for k in range(whole.start + 2, min(whole.start + 10, whole.after)) if tokens[k].norm in _ASKS)
        cuts = sorted({*cuts, *islice(asks, 1)})
    for start, after in pairwise((whole.start, *cuts, whole.after)):
        if (start, after) != (whole.start, whole.after):
            closed_by = whole.closed_by if after == whole.after else ""
            yield Clause(start, _past_joined(tokens, start, after), after, closed_by, whole=False)


def _joins(tokens: list[Token], at: int) -> bool:
    word, following = tokens[at].norm, tokens[at + 1].norm if at + 1 < len(tokens) else ""
    if word in _WHY_WORDS:
        return following in SPEAKS
    if word == "so":
        return following not in _degrees()
    return word in JOINED and (at == 0 or tokens[at - 1].norm not in JOINED)


def _past_joined(tokens: list[Token], at: int, end: int) -> int:
    while at < end and tokens[at].norm in JOINED:
        at += 1
    return at


def names(tokens: list[Token], clause: Clause, lexicon: Lexicon, but: MentionKind | None = None) -> bool:
    """Whether a clause names a robot, a place, an object or a run-time value."""
    return any(
        e.kind not in (MentionKind.ACTION, but) and e.name != REQUESTER and stands_all(tokens, k, e.words)
        for k in range(clause.first, clause.after)
        for e in lexicon.names.get(tokens[k].norm, ())
    )


@cache
def _degrees() -> frozenset[str]:
    """What `so` strengthens."""
    words = (w.split()[0] for name in ("feeling", "late", "very") for w in CLASSES[name].split("|"))
    return frozenset(words) | {"far", "much", "that"}

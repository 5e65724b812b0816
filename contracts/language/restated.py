"""A name that is said again in other words: `the dog, er, the quadruped I mean` corrects nothing.

Only where both names mean the same one thing, or the second is one of the robots that the first may mean.
"""

from crew.contracts.language.entry import Entry, Words, stands_all
from crew.contracts.language.lexicon import Lexicon, match
from crew.contracts.language.lookahead import ARTICLES
from crew.contracts.language.mention import ROBOT_KINDS, MentionKind
from crew.contracts.language.rewrites import HESITATIONS
from crew.contracts.language.tokens import Token

_LINKS: tuple[Words, ...] = (
    ("i", "mean"), ("i", "meant"), ("or", "rather"), ("sorry",), ("that", "is"), ("that", "is", "to", "say"),
    ("i", "should", "say"), ("or", "should", "i", "say"), ("correction",), ("excuse", "me"), ("well",), ("you", "know"),
)  # fmt: skip
_TAILS: tuple[Words, ...] = (("i", "mean"), ("i", "meant"), ("rather",), ("that", "is"), ("i", "should", "say"))
_MARKS = frozenset((",", "-", "\u2026", "(", ")"))
_THINGS = (*ROBOT_KINDS, MentionKind.OBJECT, MentionKind.LOCATION)


def restated(tokens: list[Token], lexicon: Lexicon) -> list[Token]:
    """The tokens of a request without names that are said again at once, kept in the narrower wording."""
    out: list[Token] = []
    at = 0
    while at < len(tokens):
        name = match(lexicon.names, tokens, at)
        end = _again(tokens, at, name, lexicon) if name is not None and name.kind in _THINGS else None
        if end is None or name is None:
            out.append(tokens[at])
            at += 1
            continue
        again, at = end
        out.extend(again)
    return out


def _again(tokens: list[Token], at: int, name: Entry, lexicon: Lexicon) -> tuple[list[Token], int] | None:
    """The name that follows in other words, and where it is over."""
    begin = at + len(name.words)
    second, said = _past_links(tokens, begin)
    named = second
    while named < len(tokens) and tokens[named].norm in ARTICLES:
        named += 1
    other = match(lexicon.names, tokens, named) if begin < named < len(tokens) else None
    if other is None or not _same(name, other) or tokens[at + len(name.words) - 1].possessive:
        return None
    end = named + len(other.words)
    tail = next((t for t in _TAILS for k in (end, end + 1) if stands_all(tokens, k, t) and _marks(tokens, end, k)), ())
    after = end
    if tail:
        after += (tokens[end].norm in _MARKS) + len(tail)
    if not said and not tail:
        return None
    after += after < len(tokens) and tokens[after].norm in _MARKS and begin < second
    return tokens[named:end], after


def _past_links(tokens: list[Token], at: int) -> tuple[int, bool]:
    """Past marks, hesitations and corrections, and whether there was one of the latter."""
    said = False
    while at < len(tokens):
        link = next((words for words in _LINKS if stands_all(tokens, at, words)), ())
        if tokens[at].norm not in _MARKS and tokens[at].norm not in HESITATIONS and not link:
            break
        said = said or bool(link) or tokens[at].norm in HESITATIONS
        at += len(link) or 1
    return at, said


def _marks(tokens: list[Token], begin: int, end: int) -> bool:
    return all(t.norm in _MARKS for t in tokens[begin:end])


def _same(name: Entry, other: Entry) -> bool:
    """Whether the second name ends at what the first one named."""
    robots = name.kind in ROBOT_KINDS and other.kind in ROBOT_KINDS
    if not robots and name.kind is not other.kind:
        return False
    narrower = set(other.values) <= set(name.values) if robots else other.values == name.values
    return narrower and len(other.values) == 1 and not other.plural and not name.plural

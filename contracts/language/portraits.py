"""What is said of the person who is looked for, beside a name: `an elderly woman in her eighties`, `male, 62`.

A search cannot heed it and need not. It is taken out where it stands at that person's name, and shown.
"""

import re
from functools import cache

from crew.contracts.language.entry import stands_all
from crew.contracts.language.frames import framing
from crew.contracts.language.lexicon import Lexicon, match
from crew.contracts.language.mention import MentionKind, Unread
from crew.contracts.language.persons import DESCRIBING, HELPERS, LOST, NO_PEOPLE, NOUNS, SUFFIXES, TAILS, YEARS_OLD
from crew.contracts.language.stories import CLASSES
from crew.contracts.language.tokens import Shape, Token
from crew.contracts.language.words import AFFECTIVE

_LONGEST = 10
_ENDS = frozenset((
    "and", "then", "in", "on", "at", "within", "inside", "somewhere", "from", "with", "please", "now", "last", "for",
    "to", "over", "across", "throughout", "is", "has", "by", "using", "so", "as", "once", "when", "after",
))  # fmt: skip


def portrayed(text: str, tokens: list[Token], lexicon: Lexicon) -> tuple[list[Token], list[Unread]]:
    """The tokens without what is said of a person, and what was left out."""
    known = set(lexicon.reports.values())
    tokens = _whoever_is(tokens) if known and "person" in lexicon.names else tokens
    gone: dict[int, int] = {}
    lost: set[int] = set()
    at = 0
    while at < len(tokens):
        end = _person(tokens, at, known, lexicon)
        if end is None or _is_called(tokens, at, end):
            at += 1
            continue
        if match(lexicon.names, tokens, at) is None:
            lost.add(at)
        gone.update(_described(tokens, at))
        after = _past_lost(tokens, end)
        while (tail := _tail(tokens, after, lexicon)) > after:
            gone[after] = tail
            after = tail
        at = after
    dropped = {k for first, after in gone.items() for k in range(first, after)}
    noted = [_noted(text, tokens, first, after) for first, after in sorted(gone.items())]
    left = [said for k, t in enumerate(tokens) if k not in dropped for said in _lost(t, k in lost)]
    return left, noted


def _lost(token: Token, lost: bool) -> list[Token]:
    """`a ranger who has gone missing`: a missing ranger."""
    return [token._replace(norm=LOST[0]), token] if lost else [token]


def _whoever_is(tokens: list[Token]) -> list[Token]:
    """`to the injured`: to the injured person."""
    out: list[Token] = []
    for at, token in enumerate(tokens):
        out.append(token)
        after = at + 1
        article = at > 0 and tokens[at - 1].norm in ("the", "our", "any")
        ends = after == len(tokens) or tokens[after].shape is Shape.MARK or tokens[after].norm in _ENDS
        if article and token.norm in LOST and ends and not stands_all(tokens, after, ("and", "found")):
            out.append(token._replace(norm="person"))
    return out


def _person(tokens: list[Token], at: int, known: set[str], lexicon: Lexicon) -> int | None:
    """Past the name of a person who may be looked for."""
    name = match(lexicon.names, tokens, at)
    if name is not None and name.kind is MentionKind.VALUE and set(name.values) <= known and not name.plural:
        end = at + len(name.words)
        return None if tokens[end - 1].possessive else end
    lost = at + 1 < len(tokens) and tokens[at].norm in HELPERS and _compiled("who").match(_said(tokens, at + 1, at + 7))
    return at + 1 if lost and known else None


def _is_called(tokens: list[Token], at: int, end: int) -> bool:
    """`young man, ...`: whoever is spoken to."""
    begin = next((k + 1 for k in range(at - 1, -1, -1) if tokens[k].shape is Shape.MARK), 0)
    closed = end == len(tokens) or tokens[end].shape is Shape.MARK
    return closed and _said(tokens, begin, end) in framing()


def lost_person(tokens: list[Token], at: int, lexicon: Lexicon) -> tuple[int, tuple[str, ...]] | None:
    """`missing trail worker`, `lost cameraman`: a missing worker, a lost man."""
    if tokens[at].norm not in LOST or not lexicon.reports or match(lexicon.names, tokens, at) is not None:
        return None
    for end in range(at + 1, min(at + 4, len(tokens))):
        word = tokens[end]
        if word.shape is not Shape.WORD or word.possessive:
            return None
        ends = end + 1 == len(tokens) or tokens[end + 1].shape is Shape.MARK or tokens[end + 1].norm in (*_ENDS, "who")
        if ends and (person := _kind_of_person(word.norm)) is not None:
            return end + 1 - at, (tokens[at].norm, person)
        if match(lexicon.names, tokens, end) is not None or match(lexicon.functions, tokens, end) is not None:
            return None
    return None


def _kind_of_person(word: str) -> str | None:
    """A plainer word for a person: `man` for a cameraman."""
    if word in NOUNS:
        return word
    return next(
        (s for s in sorted(SUFFIXES, key=len, reverse=True) if word.endswith(s) and word not in NO_PEOPLE), None
    )


def _past_lost(tokens: list[Token], at: int) -> int:
    """Past the adjective of `a hiker missing`."""
    return at + (at < len(tokens) and tokens[at].norm in LOST)


def _described(tokens: list[Token], at: int) -> dict[int, int]:
    """The adjectives in front of a name that are left out."""
    found: dict[int, int] = {}
    begin = at
    while begin > 0:
        aged = next((k for k in (begin - 3, begin - 4) if k >= 0 and _fits("aged", tokens, k, begin)), None)
        if aged is not None:
            found[aged], begin = begin, aged
        elif tokens[begin - 1].norm in DESCRIBING:
            found[begin - 1], begin = begin, begin - 1
        elif [t.norm for t in tokens[max(0, begin - 2) : begin]] == ["unaccounted", "for"]:
            found[begin - 2], begin = begin, begin - 2
        elif tokens[begin - 1].norm in AFFECTIVE or tokens[begin - 1].norm in LOST:
            begin -= 1
        else:
            break
    return found


def _tail(tokens: list[Token], at: int, lexicon: Lexicon) -> int:
    """Past the longest thing said of a person that stands here; `at` if there is none."""
    for end in range(min(at + _LONGEST, len(tokens)), at, -1):
        closed = end == len(tokens) or tokens[end].shape is Shape.MARK or tokens[end].norm in _ENDS
        named = any(_named(tokens, k, lexicon) for k in range(at, end))
        if closed and not named and _fits("tails", tokens, at, end):
            return end
    return at


def _named(tokens: list[Token], at: int, lexicon: Lexicon) -> bool:
    """Whether a robot, a place or an object is named here."""
    name = match(lexicon.names, tokens, at)
    return name is not None and name.kind not in (MentionKind.VALUE, MentionKind.ACTION)


def _fits(table: str, tokens: list[Token], first: int, after: int) -> bool:
    return _compiled(table).fullmatch(_said(tokens, first, after)) is not None


def _said(tokens: list[Token], first: int, after: int) -> str:
    return " ".join(t.norm for t in tokens[first:after])


@cache
def _compiled(table: str) -> re.Pattern[str]:
    gone, since, very = (CLASSES[name] for name in ("gone", "since", "very"))
    who = f"(?:, )?(?:who|that|which) (?:(?:{very}) )*(?:{gone})(?: (?:{since}))*"
    astray = f"(?:, )?(?:who's|that's|which's) (?:(?:{very}) )*(?:{CLASSES['astray']})(?: (?:{since}))*"
    tables = {
        "tails": "|".join((*TAILS, who, astray)),
        "aged": f"{YEARS_OLD}|{YEARS_OLD} old",
        "who": f"{who}|{astray}",
    }
    return re.compile(tables[table].replace("old old", "old"))


def _noted(text: str, tokens: list[Token], first: int, after: int) -> Unread:
    first += tokens[first].shape is Shape.MARK
    span = (tokens[first].start, tokens[after - 1].end)
    return Unread(text[slice(*span)], span)

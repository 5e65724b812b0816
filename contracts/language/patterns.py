"""Wordings with names in them: `have {object} {done}` is put into plainer words, the names kept where they stand.

`(a|b)` is a choice and may be empty. `{object}`, `{place}`, `{robot}` stand for a name with its article, `{operator}`
for a noun of whoever asks, `{owner}` for a robot's possessive, `{giver}` for a robot that hands things over,
`{carrier}` for one with a tray, `{flier}` and `{driver}` for one that takes off or stops, `{zone}`, `{person}` and
`{height}` for these, `{it}` a pronoun, `{done}` and `{doing}` for such a form of one of the crew's verbs; in the
plainer words these two are the verb itself. `^` and `$` are where a clause begins and ends, `^^` and `$$` where the
request does.
"""

import re
from collections import Counter, defaultdict
from collections.abc import Callable, Iterator, Mapping
from functools import cache
from typing import NamedTuple

from crew.contracts.language.entry import Entry, Words, stands_all
from crew.contracts.language.figures import figure
from crew.contracts.language.inflect import Form, inflections
from crew.contracts.language.lexicon import Lexicon, match
from crew.contracts.language.lookahead import SOFT, past_all
from crew.contracts.language.mention import ROBOT_KINDS, MentionKind
from crew.contracts.language.tokens import Shape, Token
from crew.contracts.language.words import REQUESTER, SELF_WORDS

_PART = re.compile(r"\(([^()]*)\)|\{(\w+)\}|(\S+)")
_OPENS = frozenset(("and", "then", "please", "so", "now", "just", "kindly", "to", "also", "okay", "ok", "well", "hey"))
_ASKING = frozenset(("can", "could", "would", "will", "may", "might", "if", "mind"))
_CLOSES = frozenset(("and", "then", "please", "so", "now", "over", "thanks"))
_PASSED = SOFT | {"one"}
_SELVES = frozenset((*SELF_WORDS, "us"))
_SAME_PAST = frozenset(("put", "set"))
_NONE: frozenset[int] = frozenset()
_NO_WORDS: frozenset[str] = frozenset()

Found = tuple[int, tuple[Token, ...]]
"""Where a name is over, and what is kept of it."""


class Slot(NamedTuple):
    """A name's place in a pattern."""

    name: str


Element = tuple[Words, ...] | Slot


class Pattern(NamedTuple):
    """One wording, and what is said for it."""

    begins: str
    elements: tuple[Element, ...]
    ends: str
    plain: tuple[str | Slot, ...]


def compiled(wording: str, plain: str) -> Pattern:
    """A pattern from its two templates."""
    begins = next((mark for mark in ("^^", "^") if wording.startswith(mark + " ")), "")
    ends = next((mark for mark in ("$$", "$") if wording.endswith(" " + mark)), "")
    inner = wording[len(begins) : len(wording) - len(ends) or None]
    elements: list[Element] = []
    for group, slot, word in _PART.findall(inner):
        if slot:
            elements.append(Slot(slot))
        else:
            choices = {tuple(w.split()): None for w in (group.split("|") if not word else (word,))}
            elements.append(tuple(sorted(choices, key=len, reverse=True)))
    said = tuple(Slot(w[1:-1]) if w.startswith("{") else w for w in plain.split())
    return Pattern(begins, tuple(elements), ends, said)


def replaced(tokens: list[Token], templates: tuple[tuple[str, str], ...], lexicon: Lexicon) -> list[Token]:
    """The tokens with every wording in its plainer words; of several that fit at a place the first."""
    index = _indexed(templates)
    possible = index.always.union(*(index.needing.get(token.norm, _NONE) for token in tokens))
    loose = index.loose & possible
    out: list[Token] = []
    at = 0
    while at < len(tokens):
        for k in sorted(index.beginning.get(tokens[at].norm, _NONE) & possible | loose):
            found = _fits(index.patterns[k], tokens, at, lexicon)
            if found is not None:
                end, plain = found
                out.extend(plain)
                at = end
                break
        else:
            out.append(tokens[at])
            at += 1
    return out


class Index(NamedTuple):
    """Patterns by number, and which of them are worth trying on a request, and where."""

    patterns: tuple[Pattern, ...]
    beginning: Mapping[str, frozenset[int]]
    """By the word that they begin with."""
    loose: frozenset[int]
    """Those that begin with a name, or may begin with the next word."""
    needing: Mapping[str, frozenset[int]]
    """By a word without which they fit nowhere; of several such the one that fewest patterns hold."""
    always: frozenset[int]
    """Those that hold no such word."""


@cache
def _indexed(templates: tuple[tuple[str, str], ...]) -> Index:
    patterns = tuple(compiled(*template) for template in templates)
    held = Counter(word for pattern in patterns for words in _needed(pattern) for word in words)
    beginning, needing = defaultdict[str, set[int]](set), defaultdict[str, set[int]](set)
    loose, always = set(), set()
    for k, pattern in enumerate(patterns):
        first = pattern.elements[0]
        if isinstance(first, Slot) or () in first:
            loose.add(k)
        else:
            for words in first:
                beginning[words[0]].add(k)
        rarest = min(_needed(pattern), key=lambda words: sum(held[word] for word in words), default=_NO_WORDS)
        for word in rarest:
            needing[word].add(k)
        if not rarest:
            always.add(k)
    return Index(patterns, _frozen(beginning), frozenset(loose), _frozen(needing), frozenset(always))


def _needed(pattern: Pattern) -> list[frozenset[str]]:
    """For each element that is no name and can't be left out: the first words of its choices."""
    spoken = (e for e in pattern.elements if not isinstance(e, Slot) and () not in e)
    return [frozenset(words[0] for words in element) for element in spoken]


def _frozen(table: Mapping[str, set[int]]) -> dict[str, frozenset[int]]:
    return {word: frozenset(numbers) for word, numbers in table.items()}


def _fits(pattern: Pattern, tokens: list[Token], at: int, lexicon: Lexicon) -> tuple[int, list[Token]] | None:
    if (pattern.begins == "^^" and at) or (pattern.begins == "^" and not begins(tokens, at)):
        return None
    for end, parts in _ways(pattern.elements, tokens, at, lexicon):
        closed = not pattern.ends or (end >= len(tokens) if pattern.ends == "$$" else ends(tokens, end))
        if closed and end > at:
            return end, list(_said(pattern, tokens, at, end, parts))
    return None


Part = tuple[str, int, int, tuple[Token, ...]]
"""A slot's name, the tokens that it covers, and what is kept of them."""


def _ways(
    elements: tuple[Element, ...], tokens: list[Token], at: int, lexicon: Lexicon
) -> Iterator[tuple[int, tuple[Part, ...]]]:
    if not elements:
        yield at, ()
        return
    first, rest = elements[0], elements[1:]
    if isinstance(first, Slot):
        found = SLOTS[first.name](tokens, at, lexicon) if at < len(tokens) else None
        if found is not None:
            for end, parts in _ways(rest, tokens, found[0], lexicon):
                yield end, ((first.name, at, *found), *parts)
        return
    for words in first:
        if not words or stands_all(tokens, at, words):
            yield from _ways(rest, tokens, at + len(words), lexicon)


def _said(pattern: Pattern, tokens: list[Token], at: int, end: int, parts: tuple[Part, ...]) -> Iterator[Token]:
    """Names as they stand; each other word over what was said around it."""
    left = list(parts)
    place = at
    for k, item in enumerate(pattern.plain):
        if isinstance(item, Slot):
            part = next(p for p in left if p[0] == item.name)
            left.remove(part)
            yield from part[3]
            place = part[2]
            continue
        later = (i for i in pattern.plain[k + 1 :] if isinstance(i, Slot))
        ahead = next((p for i in later for p in left if p[0] == i.name), None)
        stop = end if ahead is None else ahead[1]
        covers = tokens[place:stop] or tokens[max(at, stop - 1) : max(at, stop - 1) + 1]
        yield Token(item, covers[0].start, covers[-1].end, Shape.WORD if item.isalpha() else Shape.MARK)


def begins(tokens: list[Token], at: int) -> bool:
    """Whether what stands here is asked for, and not told of somebody."""
    if not at or tokens[at - 1].shape is Shape.MARK or tokens[at - 1].norm in _OPENS:
        return True
    asked = at > 1 and tokens[at - 2].norm in _ASKING
    return asked and tokens[at - 1].norm in ("you", "we", "u")


def ends(tokens: list[Token], at: int) -> bool:
    """Whether a clause ends in front of this place."""
    return at >= len(tokens) or tokens[at].shape is Shape.MARK or tokens[at].norm in _CLOSES


def past_article(tokens: list[Token], at: int) -> int:
    """Past articles, `one`, and words of affection."""
    return past_all(tokens, at, _PASSED)


def _name(tokens: list[Token], at: int, lexicon: Lexicon) -> tuple[Entry | None, int]:
    start = past_article(tokens, at)
    name = match(lexicon.names, tokens, start) if start < len(tokens) else None
    return name, start + (0 if name is None else len(name.words))


def _of_kind(*kinds: MentionKind) -> Callable[[list[Token], int, Lexicon], Found | None]:
    def read(tokens: list[Token], at: int, lexicon: Lexicon) -> Found | None:
        name, end = _name(tokens, at, lexicon)
        if name is None or name.kind not in kinds or tokens[end - 1].possessive:
            return None
        return end, tuple(tokens[at:end])

    return read


def _operator(tokens: list[Token], at: int, lexicon: Lexicon) -> Found | None:
    name, end = _name(tokens, at, lexicon)
    own = name is not None and name.name == REQUESTER and not set(name.words) & _SELVES
    return (end, tuple(tokens[at:end])) if own and not tokens[end - 1].possessive else None


def _giver(tokens: list[Token], at: int, lexicon: Lexicon) -> Found | None:
    """A robot that can hand things over."""
    name, end = _name(tokens, at, lexicon)
    skills = {ref.skill for e in lexicon.names.get("hand", ()) if e.words == ("hand",) for ref in e.means}
    robot = name is not None and name.kind in ROBOT_KINDS and not tokens[end - 1].possessive
    able = name is not None and all(skills & lexicon.members.get(str(v), frozenset()) for v in name.values)
    return (end, tuple(tokens[at:end])) if robot and able else None


def _carrier(tokens: list[Token], at: int, lexicon: Lexicon) -> Found | None:
    """A robot that carries things on its back."""
    name, end = _name(tokens, at, lexicon)
    robot = name is not None and name.kind in ROBOT_KINDS and not tokens[end - 1].possessive
    able = name is not None and any(set(name.values) <= hosts for hosts in lexicon.hosts.values())
    return (end, tuple(tokens[at:end])) if robot and able else None


def _owner(tokens: list[Token], at: int, lexicon: Lexicon) -> Found | None:
    name, end = _name(tokens, at, lexicon)
    owns = name is not None and name.kind in ROBOT_KINDS and tokens[end - 1].possessive
    return (end, (*tokens[at : end - 1], tokens[end - 1]._replace(possessive=False))) if owns else None


def _it(tokens: list[Token], at: int, lexicon: Lexicon) -> Found | None:
    return (at + 1, (tokens[at],)) if tokens[at].norm in ("it", "them") else None


def _of_form(*forms: Form) -> Callable[[list[Token], int, Lexicon], Found | None]:
    def read(tokens: list[Token], at: int, lexicon: Lexicon) -> Found | None:
        for entry in lexicon.names.get(tokens[at].norm, ()):
            if entry.kind is not MentionKind.ACTION or not stands_all(tokens, at, entry.words):
                continue
            same = Form.PAST in forms and entry.form is Form.BASE and entry.words[0] in _SAME_PAST
            base = entry.words if same else _base(entry, lexicon) if entry.form in forms else None
            if base is not None:
                end = at + len(entry.words)
                said = tokens[at:end]
                return end, tuple(token._replace(norm=word) for token, word in zip(said, base, strict=True))
        return None

    return read


def _base(entry: Entry, lexicon: Lexicon) -> Words | None:
    """The verb of which this is a form."""
    verbs = (e for found in lexicon.names.values() for e in found if e.kind is MentionKind.ACTION)
    alike = (e for e in verbs if e.form is Form.BASE and len(e.words) == len(entry.words) and e.means == entry.means)
    return next((e.words for e in alike if (entry.form, entry.words) in inflections(e.words)), None)


def _whom(tokens: list[Token], at: int, lexicon: Lexicon) -> Found | None:
    """Somebody, by a name or a pronoun."""
    pronoun = tokens[at].norm in ("him", "her", "them")
    return (at + 1, (tokens[at],)) if pronoun else _of_kind(MentionKind.VALUE)(tokens, at, lexicon)


def _height(tokens: list[Token], at: int, _: Lexicon) -> Found | None:
    """A figure in metres."""
    value = figure(tokens, at)
    return (value.after, tuple(tokens[at : value.after])) if value is not None and value.metres else None


def _able(verb: str) -> Callable[[list[Token], int, Lexicon], Found | None]:
    """A robot that has a skill of this name."""

    def read(tokens: list[Token], at: int, lexicon: Lexicon) -> Found | None:
        name, end = _name(tokens, at, lexicon)
        if name is None or name.kind not in ROBOT_KINDS or tokens[end - 1].possessive or name.plural:
            return None
        able = all(verb in lexicon.members.get(str(v), frozenset()) for v in name.values)
        return (end, tuple(tokens[at:end])) if able else None

    return read


SLOTS: Mapping[str, Callable[[list[Token], int, Lexicon], Found | None]] = {
    "object": _of_kind(MentionKind.OBJECT),
    "zone": _of_kind(MentionKind.ZONE),
    "person": _whom,
    "height": _height,
    "flier": _able("takeoff"),
    "driver": _able("stop"),
    "place": _of_kind(MentionKind.LOCATION),
    "robot": _of_kind(*ROBOT_KINDS),
    "operator": _operator,
    "giver": _giver,
    "carrier": _carrier,
    "owner": _owner,
    "it": _it,
    "done": _of_form(Form.PAST),
    "doing": _of_form(Form.ING),
}
"""What may stand in a slot."""

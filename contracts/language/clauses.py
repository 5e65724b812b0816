"""Clauses that are no part of the request: what people say of themselves, who is calling, headings, stories.

A clause of a closed kind (`stories.py`) is left out and noted. Any other one that only tells something becomes one
unread piece, which is asked back. What names anything of the crew, a figure, a condition or a negation stays as it is.
"""

from typing import NamedTuple

from crew.contracts.language.addressed import called, in_front_of_name
from crew.contracts.language.beside import beside
from crew.contracts.language.clause import Clause, clauses, names, parts_of
from crew.contracts.language.closed_kinds import class_words, fits, fits_of_person, said_between
from crew.contracts.language.courtesies import CALLING, CALLING_ALL, ENDEARED, THANKS, WANTED_FOR
from crew.contracts.language.endings import is_over
from crew.contracts.language.entry import stands_all
from crew.contracts.language.figures import is_numeral
from crew.contracts.language.frames import framing
from crew.contracts.language.inflect import Form
from crew.contracts.language.lexicon import Lexicon
from crew.contracts.language.mention import MentionKind, Unread
from crew.contracts.language.speaking import of_the_speaker, told_behind
from crew.contracts.language.stories import (
    ABOUT_A_PERSON,
    FINITE,
    HARMLESS,
    OWN_CHOICE,
    POSSESSORS,
    PURPOSES,
    SUBJECTS,
)
from crew.contracts.language.tokens import Shape, Token

_PEOPLE = frozenset(("him", "her", "them", "he", "she", "they", "his", "their"))
_AUXILIARY = frozenset(
    ("have", "has", "get", "gets", "got", "need", "needs", "want", "wants", "like", "likes", "give", "make")
)
_LONGEST_SUBJECT = 4
_LONGEST_CLAUSE = 24


class Pared(NamedTuple):
    """What is left to be read, what was left out without asking, and what is asked back."""

    tokens: list[Token]
    noted: list[Unread]
    asked: list[Unread]


def pare(text: str, tokens: list[Token], lexicon: Lexicon) -> Pared:
    """Take out the clauses that are no part of the request."""
    gone: set[int] = set()
    kept: dict[int, Token] = {}
    noted: list[Unread] = []
    asked: list[Unread] = []
    for clause in clauses(tokens):
        said = range(clause.start, clause.after)
        if gone & set(said) or len(said) > _LONGEST_CLAUSE:
            continue
        if (dropped := _harmless(tokens, clause, lexicon, kept)) is not None:
            gone.update(dropped)
            if dropped:
                noted.append(_unread(text, tokens, dropped))
        elif any(is_numeral(tokens, k) for k in said) or not _tells(tokens, clause, lexicon):
            continue
        elif not _in_part_harmless(tokens, clause, lexicon):
            gone.update(said)
            asked.append(_unread(text, tokens, range(clause.first, clause.after)))
    left = [kept.get(k, token) for k, token in enumerate(tokens) if k in kept or k not in gone]
    return Pared(left, noted, asked)


def _in_part_harmless(tokens: list[Token], clause: Clause, lexicon: Lexicon) -> bool:
    """Whether a part of it goes, so that the others are looked at one by one."""
    parts = parts_of(tokens, clause) if clause.whole else ()
    return any(_harmless(tokens, part, lexicon, {}) is not None for part in parts)


def _unread(text: str, tokens: list[Token], said: range) -> Unread:
    span = (tokens[said[0]].start, tokens[said[-1]].end)
    return Unread(text[slice(*span)], span)


def _harmless(tokens: list[Token], clause: Clause, lexicon: Lexicon, kept: dict[int, Token]) -> range | None:
    """The tokens that a harmless clause loses; None if it is none."""
    if clause.first == clause.after:
        return None
    if is_over(tokens, clause.first, clause.after, lexicon) or _is_story(HARMLESS, tokens, clause, lexicon):
        return range(clause.start, clause.after)
    if clause.whole and said_between(tokens, clause.first, clause.after) in framing():
        return None
    if _of_closed_kind(tokens, clause, lexicon):
        return range(clause.start, clause.after)
    told = of_the_speaker(tokens, clause, kept, lexicon) or _of_a_person(tokens, clause, kept, lexicon)
    told = told or called(tokens, clause, lexicon)
    if told is None and clause.whole:
        told = told_behind(tokens, clause, lexicon) or beside(tokens, clause.first, clause.after, lexicon)
    return in_front_of_name(tokens, clause, lexicon) if told is None else told


def _is_story(patterns: tuple[str, ...], tokens: list[Token], clause: Clause, lexicon: Lexicon) -> bool:
    """Whether a clause fits a pattern and names nothing of the crew but a person."""
    said = said_between(tokens, clause.first, clause.after)
    return fits(patterns, said) and not names(tokens, clause, lexicon, but=MentionKind.VALUE)


def _of_closed_kind(tokens: list[Token], clause: Clause, lexicon: Lexicon) -> bool:
    """Whether the whole clause is a thanks, a call, an endearment, or says what something is for."""
    said = said_between(tokens, clause.first, clause.after)
    if fits((*THANKS, *CALLING_ALL), said) or (clause.whole and fits(OWN_CHOICE, said)):
        return True
    if _is_story((*WANTED_FOR, *CALLING), tokens, clause, lexicon):
        return True
    purpose = clause.whole or tokens[clause.start].norm == "for"
    for_what = purpose and fits(PURPOSES, said_between(tokens, clause.start, clause.after))
    endeared = clause.whole and fits(ENDEARED, said)
    return (for_what or endeared) and not names(tokens, clause, lexicon)


def _of_a_person(tokens: list[Token], clause: Clause, kept: dict[int, Token], lexicon: Lexicon) -> range | None:
    """`my brother is lost`: the person is kept for `him`."""
    value = _person(lexicon)
    said = said_between(tokens, clause.first, clause.after)
    if not value or names(tokens, clause, lexicon, but=MentionKind.VALUE) or not fits_of_person(ABOUT_A_PERSON, said):
        return None
    _keep_person(tokens, clause, value, kept)
    return range(clause.start, clause.after)


def _keep_person(tokens: list[Token], clause: Clause, value: str, kept: dict[int, Token]) -> None:
    """Keep whom the clause tells of, where `him` or `her` follows."""
    if not any(t.norm in _PEOPLE for t in tokens[clause.after :]):
        return
    people = frozenset((*class_words("people"), *class_words("person")))
    who = [k for k in range(clause.first, clause.after) if tokens[k].norm in people]
    others = any(t.norm in people for k, t in enumerate(tokens) if k not in range(clause.first, clause.after))
    if who and not others:
        kept[who[-1]] = tokens[who[-1]]._replace(norm=value, possessive=False)


def _person(lexicon: Lexicon) -> str:
    """The one run-time value that is a person, by a name of one word; empty if there is none."""
    known = set(lexicon.reports.values())
    named = {e.name for e in lexicon.names.get("person", ()) if e.kind is MentionKind.VALUE and e.name in known}
    return next(iter(named)) if len(named) == 1 == len(known) else ""


def _tells(tokens: list[Token], clause: Clause, lexicon: Lexicon) -> bool:
    """Whether a clause only tells something: its own subject, a finite verb, and nothing of the crew."""
    norms = [t.norm for t in tokens[clause.first : clause.after]]
    reason = not clause.whole and tokens[clause.start].norm in ("because", "'cause", "since", "as")
    if not norms or (len(norms) < 3 and not reason) or clause.closed_by == "?":
        return False
    if any(t.shape is not Shape.WORD for t in tokens[clause.first : clause.after]):
        return False
    if " ".join(norms) in framing():
        return False
    turning = lexicon.vocabulary.turning
    if any(n in turning or n.endswith("n't") for n in norms) or names(tokens, clause, lexicon):
        return False
    asking = (k for k, n in enumerate(norms, clause.first) if n not in _AUXILIARY and _is_action(lexicon, tokens, k))
    if any(not _past(lexicon, tokens, k) for k in asking):
        return False
    opens = norms[0] in SUBJECTS or (norms[0] in POSSESSORS and norms[1:2] and norms[1] not in FINITE)
    behind = norms[1 : _LONGEST_SUBJECT + 1]
    past = any(_past(lexicon, tokens, k) for k in range(clause.first + 1, clause.after))
    told = past or any(n in FINITE for n in behind) or ("'" in norms[0] and norms[0] in SUBJECTS)
    return bool(opens and told) and not (norms[0] in ("i", "we", "i'd", "you") and _wishes(norms))


def _wishes(norms: list[str]) -> bool:
    """`I would like ...`, `I want ...`: a request."""
    return (
        any(n in ("want", "need", "like", "wish", "would", "prefer", "love") for n in norms[1:4]) or norms[0] == "i'd"
    )


def _is_action(lexicon: Lexicon, tokens: list[Token], at: int) -> bool:
    return any(
        e.kind is MentionKind.ACTION and stands_all(tokens, at, e.words) for e in lexicon.names.get(tokens[at].norm, ())
    )


def _past(lexicon: Lexicon, tokens: list[Token], at: int) -> bool:
    """Whether a verb of the crew is told of, and asks for nothing."""
    entries = [e for e in lexicon.names.get(tokens[at].norm, ()) if stands_all(tokens, at, e.words)]
    return bool(entries) and all(e.kind is MentionKind.ACTION and e.form is Form.PAST for e in entries)

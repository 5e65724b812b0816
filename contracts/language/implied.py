"""Requests without a verb: `rover to base`, `red cube to room_b`, `victim location?`. The verb that they imply is read.

Only where nothing else was asked for, and only where one name and one place stand side by side.
"""

from collections.abc import Iterator

from crew.contracts.language.inflect import Form
from crew.contracts.language.lexicon import Lexicon
from crew.contracts.language.mention import MentionKind, StepRef
from crew.contracts.language.piece import Piece, before, behind
from crew.contracts.language.words import PLACE_NOUNS, Role

_MOVED = {True: ("go", "send"), False: ("carry", "bring", "take", "put")}
"""Verbs that mean what `robot to place` and `thing to place` mean."""
_PUT = ("put", "place")
_FIND = "find"
_PLACES = (MentionKind.LOCATION, MentionKind.VALUE, MentionKind.POINT)


def implied_verbs(pieces: list[Piece], lexicon: Lexicon) -> None:
    """Insert the verb of a request that has none."""
    if any(p.is_action for p in pieces):
        return
    if (noun := _place_asked_for(pieces)) is not None:
        noun.role, noun.kind, noun.name = Role.MENTION, MentionKind.ACTION, _FIND
        noun.means = tuple(dict.fromkeys(_means((_FIND,), lexicon)))
        return
    for at, piece in enumerate(pieces):
        words = _words(pieces, at)
        means = tuple(dict.fromkeys(_means(words, lexicon)))
        if words and means:
            verb = Piece(piece.first, piece.after, Role.MENTION, norm=words[0], kind=MentionKind.ACTION, name=words[0])
            verb.means, verb.form = means, Form.BASE
            owner = piece if piece.is_robot else before(pieces, at)
            by_robot = owner is not None and owner.is_robot
            pieces.insert((at + 1 if piece.is_robot else at) if by_robot else _first_of_name(pieces, at), verb)
            return


def _place_asked_for(pieces: list[Piece]) -> Piece | None:
    """The noun of `victim location?`, if nothing else was said."""
    loose = [p for p in pieces if p.role in (Role.WORD, Role.UNREAD)]
    named = [p for p in pieces if p.kind is not None]
    asked = len(loose) == 1 and loose[0].norm in PLACE_NOUNS and [p.kind for p in named] == [MentionKind.VALUE]
    return loose[0] if asked else None


def _words(pieces: list[Piece], at: int) -> tuple[str, ...]:
    """The verbs that a preposition between a name and a place implies; none if it does not stand there."""
    piece, owner, place = pieces[at], before(pieces, at), behind(pieces, at)
    if piece.is_robot and place is not None and place.kind in _PLACES and _alone(pieces, at):
        return _MOVED[True] if pieces[at + 1] is place else ()  # "tb3 home"
    if owner is None or place is None or place.kind not in _PLACES or not _alone(pieces, at):
        return ()
    if piece.role is Role.AT and owner.is_robot:
        return _MOVED[True]
    if piece.role is Role.TO and (owner.is_robot or owner.kind is MentionKind.OBJECT):
        return _MOVED[owner.is_robot]
    return _PUT if piece.role is Role.AT and owner.kind is MentionKind.OBJECT else ()


def _alone(pieces: list[Piece], at: int) -> bool:
    """Nothing but one name, one place and soft words: whatever else was said would need a verb of its own."""
    named = [p for p in pieces if p.is_entity]
    odd = (Role.UNREAD, Role.WORD, Role.NOT, Role.NO, Role.EXCEPT, Role.AVOID, Role.AND, Role.BE, Role.PRONOUN)
    return len(named) == 2 and not any(p.role in odd for p in pieces)


def _first_of_name(pieces: list[Piece], at: int) -> int:
    """Where the owner's noun phrase begins, so that the verb governs it as its object."""
    index = at
    while index > 0 and (pieces[index - 1].is_entity or pieces[index - 1].role is Role.DETERMINER):
        index -= 1
    return index


def _means(words: tuple[str, ...], lexicon: Lexicon) -> Iterator[StepRef]:
    for word in words:
        for entry in lexicon.names.get(word, ()):
            if entry.kind is MentionKind.ACTION and entry.words == (word,):
                yield from entry.means

"""Requests without a verb: `rover to base`, `red cube to room_b`, `victim location?`. The verb that they imply is read.

Only where nothing else was asked for, and only where one name and one place stand side by side.
"""

from collections.abc import Iterator

from crew.contracts.language.inflect import Form
from crew.contracts.language.lexicon import Lexicon
from crew.contracts.language.mention import ROBOT_KINDS, Direction, MentionKind, StepRef, Unread
from crew.contracts.language.piece import SOFT, Piece, before, behind
from crew.contracts.language.tokens import Token
from crew.contracts.language.words import PLACE_NOUNS, REQUESTER, Role

_MOVED = {True: ("go", "send"), False: ("carry", "bring", "take", "put")}
"""Verbs that mean what `robot to place` and `thing to place` mean."""
_PUT = ("put", "place")
_FIND = "find"
_BOUND = ("has to", "needs to", "have to", "need to", "ought to", "shall", "is to")
"""What makes a state one that is to be brought about."""
_FETCHED = ("fetch", "bring")
"""Verbs that move a thing to whoever speaks, where no goal is named."""
_CLAUSE_MARKS = frozenset((".", ";", ","))
_SURE_MARKS = frozenset((",", ":"))
_PLACES = (MentionKind.LOCATION, MentionKind.VALUE, MentionKind.POINT)


def implied_verbs(pieces: list[Piece], text: str, tokens: list[Token], lexicon: Lexicon) -> list[Unread]:
    """Insert the verb of a request that has none; return what was left unsaid and has to be asked back."""
    doubtful = _wished_states(pieces, text, tokens)
    if any(p.is_action for p in pieces):
        _second_clauses(pieces, lexicon)
        return []
    if (noun := _place_asked_for(pieces)) is not None:
        noun.role, noun.kind, noun.name = Role.MENTION, MentionKind.ACTION, _FIND
        noun.means = tuple(dict.fromkeys(_means((_FIND,), lexicon)))
        return []
    for at in range(len(pieces)):
        if _insert(pieces, at, _words(pieces, at), lexicon):
            return doubtful
    return _unsaid(pieces, text, tokens, lexicon)


def _wished_states(pieces: list[Piece], text: str, tokens: list[Token]) -> list[Unread]:
    """`I need the cube to be in room_b`, `it is needed that the bottle is on the table`: a state is wished for.

    `The rover must be at base` may be a guess as well: it is read as a wish, and asked back.
    """
    doubtful = []
    idle = not any(p.is_action for p in pieces)
    for at, piece in enumerate(pieces):
        placed = piece.role is Role.BE and at + 1 < len(pieces) and pieces[at + 1].role is Role.AT
        if not placed or at == 0:
            continue
        denied = at > 1 and pieces[at - 2].role is Role.NOT
        if pieces[at - 1].role is Role.TO and piece.norm == "be" and not denied:
            pieces[at - 1].become(Role.FILLER)
            piece.become(Role.FILLER)
        elif (
            piece.norm in ("is", "are", "be")
            and any(p.role is Role.FILLER and p.norm.endswith(" that") for p in pieces[:at])
        ) or (idle and piece.norm == "be" and pieces[at - 1].norm in _BOUND):
            piece.become(Role.FILLER)
        elif idle and piece.norm == "be" and pieces[at - 1].norm in ("must", "should"):
            span = (tokens[pieces[at - 1].first].start, tokens[piece.after - 1].end)
            doubtful.append(Unread(text[slice(*span)], span, "shall be brought or go there"))
            piece.become(Role.FILLER)
    return doubtful


def fetched(pieces: list[Piece], lexicon: Lexicon) -> None:
    """`fetch the bottle from table_a`: to whoever speaks, where no goal is named."""
    goals = (p for p in pieces if p.is_entity and not p.is_robot and p.kind is not MentionKind.OBJECT)
    at = next((k for k, p in enumerate(pieces) if p.is_action and p.norm in _FETCHED), None)
    if at is None or any(p.role is Role.PRONOUN for p in pieces) or sum(p.is_action for p in pieces) > 1:
        return
    things = [p for p in pieces if p.kind is MentionKind.OBJECT]
    placed = any(not _is_origin(pieces, p) for p in goals)
    verb = pieces[at]
    if len(things) == 1 and not placed and {r.contract for r in verb.means} & lexicon.to_requester:
        goal = Piece(verb.first, verb.after, Role.MENTION, norm=REQUESTER, kind=MentionKind.VALUE, name=REQUESTER)
        goal.values, goal.direction = (REQUESTER,), Direction.TO
        pieces.insert(at + 1, goal)


def _is_origin(pieces: list[Piece], place: Piece) -> bool:
    link = before(pieces, pieces.index(place))
    return place.kind is MentionKind.LOCATION and link is not None and link.role is Role.FROM


def _second_clauses(pieces: list[Piece], lexicon: Lexicon) -> None:
    """`search the area and rover to the victim`: the verb of a clause that has none beside one that has."""
    for at in range(len(pieces) - 1, 1, -1):
        robot, link = pieces[at - 1], pieces[at]
        opening = before(pieces, at - 1)
        begins = opening is not None and (opening.role in (Role.AND, Role.THEN) or opening.norm in _CLAUSE_MARKS)
        place, end = behind(pieces, at), None
        if place is not None:
            end = behind(pieces, pieces.index(place))
        ends = end is None or end.role in (Role.PUNCTUATION, Role.AND, Role.THEN, Role.AFTER)
        if robot.is_robot and begins and link.role is Role.TO and place is not None and place.kind in _PLACES and ends:
            _insert(pieces, at, _MOVED[True], lexicon)


def _insert(pieces: list[Piece], at: int, words: tuple[str, ...], lexicon: Lexicon) -> bool:
    """Put the verb of these words in its place."""
    means = tuple(dict.fromkeys(_means(words, lexicon)))
    if not words or not means:
        return False
    piece = pieces[at]
    verb = Piece(piece.first, piece.after, Role.MENTION, norm=words[0], kind=MentionKind.ACTION, name=words[0])
    verb.means, verb.form = means, Form.BASE
    owner = piece if piece.is_robot else before(pieces, at)
    by_robot = owner is not None and owner.is_robot
    pieces.insert((at + 1 if piece.is_robot else at) if by_robot else _first_of_name(pieces, at), verb)
    return True


def _unsaid(pieces: list[Piece], text: str, tokens: list[Token], lexicon: Lexicon) -> list[Unread]:
    """`bottle, table_b`, `charger. dog.`, `survivor? west half`: two names and nothing that joins them."""
    named = [p for p in pieces if p.is_entity]
    quiet = (Role.FILLER, Role.PUNCTUATION, Role.DETERMINER)
    if len(named) not in (1, 2) or any(p.role not in quiet for p in pieces if not p.is_entity):
        return []
    verbs = _verbs_for(named)
    mover = next((p for p in named if p.is_robot), None)
    at = next(k for k, p in enumerate(pieces) if p is (mover or named[0]))
    if mover is named[-1]:
        pieces.insert(pieces.index(named[0]), pieces.pop(at))
        at = pieces.index(mover)
    if not _insert(pieces, at, verbs, lexicon):
        return []
    if _plainly(pieces, named):
        return []
    ends = sorted((p.first, p.after) for p in named)
    span = (tokens[ends[0][0]].start, tokens[ends[-1][1] - 1].end)
    return [Unread(text[slice(*span)], span, " or ".join(verbs[:2]))]


def _plainly(pieces: list[Piece], named: list[Piece]) -> bool:
    """Whether two names mean one thing only: a thing beside a place may be told to be there; a question may be one."""
    marks = {p.norm for p in pieces[:-1] if p.role is Role.PUNCTUATION}
    told = any(p.kind is MentionKind.OBJECT for p in named) and not any(p.name == REQUESTER for p in named)
    asked = pieces[-1].norm == "?" or not marks <= _SURE_MARKS
    return len(named) == 2 and not asked and not (told and marks != {":"})


def _verbs_for(named: list[Piece]) -> tuple[str, ...]:
    """The verbs that one or two names by themselves imply."""
    kinds = {p.kind for p in named}
    if len(named) == 1:
        return _FETCHED[1:] if kinds == {MentionKind.OBJECT} else ()
    robots, goals = kinds & set(ROBOT_KINDS), kinds & {MentionKind.LOCATION, MentionKind.POINT}
    goals |= {p.kind for p in named if p.name == REQUESTER}
    if robots and goals:
        return _MOVED[True]
    if MentionKind.OBJECT in kinds and goals:
        return _MOVED[False]
    return (_FIND,) if kinds == {MentionKind.VALUE, MentionKind.ZONE} else ()


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
    if owner is None and piece.role is Role.TO and place is not None and place.kind in _PLACES and _alone(pieces, at):
        taken = next((p for p in pieces[at:] if p.is_entity and p is not place), None)
        link = before(pieces, pieces.index(taken)) if taken is not None else None
        if taken is not None and taken.kind is MentionKind.OBJECT and link is not None and link.role is Role.WITH:
            link.become(Role.FILLER)
            return _MOVED[False]  # "off to room_b with the bottle"
        return _MOVED[True] if taken is not None and taken.is_robot else ()  # "to the charger, dog"
    if owner is not None and owner.role is Role.PUNCTUATION and owner.norm in _SURE_MARKS:
        called = before(pieces, at, SOFT | {Role.PUNCTUATION})
        owner = called if called is not None and called.is_robot else owner  # "rover, back to base"
    if owner is None or place is None or place.kind not in _PLACES or not _alone(pieces, at):
        return ()
    if piece.role is Role.AT and owner.is_robot:
        return _MOVED[True]
    if piece.role is Role.TO and (owner.is_robot or owner.kind is MentionKind.OBJECT):
        return _MOVED[owner.is_robot]
    return _PUT if piece.role is Role.AT and owner.kind is MentionKind.OBJECT else ()


def _alone(pieces: list[Piece], at: int) -> bool:
    """Nothing but one name, one place and soft words: whatever else was said would need a verb of its own.

    The robot that does it may follow: `cube to room_b, by dog`.
    """
    doers = (k for k in range(len(pieces)) if _does_it(pieces, at, k) or _is_called(pieces, k))
    helper = next((pieces[k] for k in doers if any(p.kind is MentionKind.OBJECT for p in pieces)), None)
    named = [p for p in pieces if p.is_entity and p is not helper]
    odd = (Role.UNREAD, Role.WORD, Role.NOT, Role.NO, Role.EXCEPT, Role.AVOID, Role.AND, Role.BE, Role.PRONOUN)
    return len(named) == 2 and not any(p.role in odd for p in pieces)


def _does_it(pieces: list[Piece], link: int, at: int) -> bool:
    """`cube to room_b by the dog`, `on the dog`: who takes a thing where it shall go."""
    owner = before(pieces, link)
    taken = owner is not None and owner.kind is MentionKind.OBJECT and at > link and pieces[at].is_robot
    by = before(pieces, at, SOFT - {Role.FILLER}) if taken else None
    return by is not None and (by.role is Role.WITH or by.norm in ("on", "onto"))


def _is_called(pieces: list[Piece], at: int) -> bool:
    """`humanoid, bottle onto table_b`: who is to do it."""
    opens = before(pieces, at, SOFT | {Role.PUNCTUATION}) is None
    return pieces[at].is_robot and opens and at + 1 < len(pieces) and pieces[at + 1].norm in _SURE_MARKS


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

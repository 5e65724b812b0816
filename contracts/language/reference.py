"""Who does what: pronouns and their antecedents, robots and the verbs they belong to, the order that was asked for."""

from collections.abc import Iterator
from itertools import pairwise

from crew.contracts.language.inflect import Form
from crew.contracts.language.lexicon import Lexicon
from crew.contracts.language.mention import Ambiguity, Direction, MentionKind
from crew.contracts.language.piece import PLACE_ROLES, SOFT, Piece, before, behind
from crew.contracts.language.tokens import Token
from crew.contracts.language.words import PLACE_NOUNS, Role

_PLACES = (MentionKind.VALUE, MentionKind.LOCATION, MentionKind.POINT)
_ROBOTS = (MentionKind.ROBOT, MentionKind.ROBOT_CLASS)
_PEOPLE = frozenset(("him", "her", "his"))
_ANYBODY = _PEOPLE | {"them", "they", "their"}
_WISHES = ("want", "need", "like", "have")
_ORDERING = frozenset((Role.THEN, Role.AFTER, Role.FIRST))
_PASSED = SOFT | {Role.BE, Role.TO}

Group = tuple[MentionKind, ...]


def pronouns(pieces: list[Piece], tokens: list[Token], lexicon: Lexicon) -> list[Ambiguity]:
    """Give each pronoun its antecedent; a doubtful one makes the request ambiguous."""
    doubts = []
    for at, piece in enumerate(pieces):
        if piece.role is Role.PRONOUN and (why := _resolve(pieces, at, lexicon)):
            span = (tokens[piece.first].start, tokens[piece.after - 1].end)
            doubts.append(Ambiguity(f"'{piece.norm}' {why}", span))
    return doubts


def _resolve(pieces: list[Piece], at: int, lexicon: Lexicon) -> str | None:
    """Resolve one pronoun, or say why it cannot be."""
    pronoun = pieces[at]
    if pronoun.norm in ("its", "their") and at + 1 < len(pieces) and pieces[at + 1].is_entity:
        pronoun.become(Role.FILLER)  # "its charging station"
        return None
    earlier = [p for p in pieces[:at] if p.is_entity and p.direction is not Direction.FROM]
    for group in _groups(pieces, at, lexicon):
        if group == (MentionKind.ZONE,) and _sought(pieces, pronoun, lexicon):
            return None
        found = [p for p in earlier if p.kind in group and _able(pieces, at, p, lexicon) and not _part(p, lexicon)]
        if not found:
            continue
        if not found[-1].positive:
            return f"would refer to {found[-1].name}, which the request excludes"
        if len({p.name for p in found}) > 1:
            return "could refer to " + " or ".join(dict.fromkeys(p.name for p in found))
        pronoun.resolve(found[-1])
        return None
    ahead = [p for p in pieces[at + 1 :] if p.kind is MentionKind.VALUE]
    if pronoun.norm in _PEOPLE and len({p.name for p in ahead}) == 1 and ahead[0].positive:
        pronoun.resolve(ahead[0])  # "find him, the hiker"
        return None
    told = _told_behind(pieces, at) if pronoun.norm in ("it", "them") else None
    if told is not None:
        pronoun.resolve(told)  # "put it on table_a, the cube"
        return None
    return None if _sought(pieces, pronoun, lexicon) else "refers to nothing that the request names"


def _sought(pieces: list[Piece], pronoun: Piece, lexicon: Lexicon) -> bool:
    """`find him, send the rover to him`: whoever a search is for, where one is asked for and nobody else is named."""
    known = set(lexicon.reports.values())
    searched = any(p.is_action and p.positive and any(r.skill in lexicon.reports for r in p.means) for p in pieces)
    if pronoun.norm not in _ANYBODY or len(known) != 1 or not searched:
        return False
    name = known.pop()
    pronoun.role, pronoun.kind, pronoun.name, pronoun.values = Role.MENTION, MentionKind.VALUE, name, (name,)
    return True


def _groups(pieces: list[Piece], at: int, lexicon: Lexicon) -> Iterator[Group]:
    """What a pronoun in this place can stand for, the likeliest first."""
    pronoun, previous = pieces[at], before(pieces, at)
    if pronoun.norm in _PEOPLE:
        yield (MentionKind.VALUE,)
        return
    if pronoun.norm == "them" and previous is not None and previous.role is Role.TO:
        yield (MentionKind.VALUE,)
    if pronoun.norm in ("there", "over there") or (previous is not None and previous.role in PLACE_ROLES):
        yield _PLACES
        yield (MentionKind.ZONE,)
        return
    verb = _verb_of(pieces, at)
    steps = {(r.contract, r.step) for r in verb.means} if verb is not None else set()
    if steps & lexicon.object_steps:
        yield (MentionKind.OBJECT,)
    if steps & lexicon.zone_steps:
        yield (MentionKind.ZONE,) if pronoun.norm == "it" else (MentionKind.VALUE,)
    yield _ROBOTS
    yield (MentionKind.VALUE,)
    yield (MentionKind.OBJECT,)


def _told_behind(pieces: list[Piece], at: int) -> Piece | None:
    """The one thing that is named behind a mark at the end of the request, by itself."""
    named = [p for p in pieces if p.kind is MentionKind.OBJECT]
    if (
        len(named) != 1
        or pieces.index(named[0]) < at
        or named[0] is not next((p for p in reversed(pieces) if p.role not in SOFT | {Role.PUNCTUATION}), None)
    ):
        return None
    opening = before(pieces, pieces.index(named[0]))
    return named[0] if opening is not None and opening.role is Role.PUNCTUATION else None


def _part(candidate: Piece, lexicon: Lexicon) -> bool:
    """`load it on the dog and deliver it there`: a robot's own back is nowhere to deliver to."""
    return candidate.kind is MentionKind.LOCATION and candidate.name in lexicon.hosts


def _verb_of(pieces: list[Piece], at: int) -> Piece | None:
    """The verb whose subject or object stands here."""
    previous, following = before(pieces, at), behind(pieces, at, _PASSED)
    if previous is not None and previous.is_action:
        return previous
    return following if following is not None and following.is_action else None


def _able(pieces: list[Piece], at: int, candidate: Piece, lexicon: Lexicon) -> bool:
    """Whether a robot that the pronoun could mean has the skill that the verb asks for."""
    verb = _verb_of(pieces, at)
    if not candidate.is_robot or verb is None:
        return True
    skills = {ref.skill for ref in verb.means}
    return any(lexicon.members.get(str(name), frozenset()) & skills for name in candidate.values)


def place_pronouns(pieces: list[Piece]) -> None:
    """`its position`, `their location`: the noun adds nothing to the pronoun."""
    for owner, noun in pairwise(pieces):
        if owner.role is Role.PRONOUN and owner.norm in ("its", "their", "his", "her") and noun.norm in PLACE_NOUNS:
            noun.become(Role.FILLER)


def participles(pieces: list[Piece]) -> None:
    """A past form asks for something only in a passive (`must be searched`) or after `once`."""
    for at, piece in enumerate(pieces):
        auxiliary = pieces[at - 1] if at and pieces[at - 1].role is Role.BE else None
        wished = any(p.role is Role.FILLER and p.norm.endswith(" that") for p in pieces[:at])
        lasting = auxiliary is not None and (auxiliary.norm == "be" or (wished and auxiliary.norm in ("is", "are")))
        if piece.is_action and piece.form is Form.ING and auxiliary is not None and lasting:
            auxiliary.become(Role.FILLER)  # "must be searching"
        if piece.is_action and piece.form is Form.PAST:
            passive = auxiliary is not None and (auxiliary.norm in ("be", "were") or wished)
            if _found(pieces, at):
                piece.become(Role.FILLER)
                continue
            if passive or _courteous(pieces, at) or _in_time_clause(pieces, at) or _wanted_done(pieces, at):
                if auxiliary is not None:
                    auxiliary.become(Role.FILLER)
            else:
                piece.become(Role.UNREAD)
    for at, piece in enumerate(pieces):
        if piece.role is Role.BE:
            negated = at + 1 < len(pieces) and pieces[at + 1].role is Role.NOT
            piece.become(Role.FILLER if negated or _ends_where(pieces, at) else Role.UNREAD)


def _found(pieces: list[Piece], at: int) -> bool:
    """`the found person`."""
    owner = pieces[at - 1] if at else None
    named = pieces[at + 1] if at + 1 < len(pieces) else None
    if owner is not None and owner.kind is MentionKind.VALUE and pieces[at].norm in ("found", "located"):
        return named is None or named.role is Role.PUNCTUATION  # "send the rover to the person found"
    determined = owner is not None and owner.role is Role.DETERMINER
    return determined and named is not None and named.kind is MentionKind.VALUE


def _courteous(pieces: list[Piece], at: int) -> bool:
    """`would it be all right if you brought me the bottle`."""
    for piece in reversed(pieces[:at]):
        if piece.role is Role.FILLER and piece.norm.endswith((" if", " if you")):
            return True
        if not (piece.role in SOFT or piece.is_robot):
            return False
    return False


def _wanted_done(pieces: list[Piece], at: int) -> bool:
    """`I want the area searched`."""
    if at == 0 or not pieces[at - 1].is_entity:
        return False
    verb = before(pieces, at - 1, frozenset((Role.DETERMINER, Role.QUANTIFIER)))
    if (
        verb is not None
        and verb.norm in ("have", "get")
        and verb.is_action
        and before(pieces, pieces.index(verb)) is None
    ):
        verb.become(Role.FILLER)  # "have the cube brought to me"
        return True
    if verb is not None and verb.role is Role.BE and verb.norm == "have":
        subject = before(pieces, pieces.index(verb), frozenset((Role.DETERMINER,)))
        if subject is None or (subject.role is Role.FILLER and subject.norm not in ("i", "we", "they")):
            verb.become(Role.FILLER)  # "would it be possible to have the area searched"
            return True
    return verb is not None and (verb.role is Role.FILLER or verb.is_action) and verb.norm.endswith(_WISHES)


def _in_time_clause(pieces: list[Piece], at: int) -> bool:
    clause = (p.role for p in reversed(pieces[:at]) if p.role in (Role.PUNCTUATION, Role.AFTER, Role.AND))
    return next(clause, None) is Role.AFTER


def _ends_where(pieces: list[Piece], at: int) -> bool:
    """The verb of `to where the victim is`."""
    owner = before(pieces, at)
    if owner is None or not owner.is_entity:
        return False
    previous = before(pieces, pieces.index(owner))
    return previous is not None and previous.role is Role.TO and previous.norm == "to where"


def governors(pieces: list[Piece]) -> None:
    """Tie every mention to the verb that it belongs to."""
    last: Piece | None = None
    for at, piece in enumerate(pieces):
        if piece.is_action:
            last = piece
        elif piece.is_robot:
            piece.governor = _governor_of_robot(pieces, at, last)
        elif piece.is_entity:
            piece.governor = last
    _shared_subjects(pieces)


def _shared_subjects(pieces: list[Piece]) -> None:
    """In `the drone should search and land` the drone does both."""
    earlier: Piece | None = None
    for at, piece in enumerate(pieces):
        if piece.role is Role.PUNCTUATION and piece.norm not in (",", ":", "-"):
            earlier = None
        if not piece.is_action:
            continue
        link = before(pieces, at)
        robots = [p for p in pieces if p.is_robot and p.governor is piece]
        joined = link is not None and link.role in (Role.AND, Role.THEN)
        if any(p.first < piece.first for p in robots):
            earlier = piece
        elif robots:
            earlier = None
        elif joined:
            piece.governor = earlier


def _governor_of_robot(pieces: list[Piece], at: int, last: Piece | None) -> Piece | None:
    previous, following = before(pieces, at), behind(pieces, at, _PASSED)
    if following is not None and following.role is Role.THEN and _opens(previous):
        following = behind(pieces, pieces.index(following), _PASSED)  # "and the rover could then go to them"
    if previous is not None and previous.is_action:
        return previous
    purpose = at + 1 < len(pieces) and pieces[at + 1].role is Role.TO
    if purpose and following is not None and following.is_action:
        return following
    if previous is not None and previous.role is Role.WITH:
        return last or next((p for p in pieces[at:] if p.is_action), None)
    if following is not None and following.is_action:
        return following
    if _called(pieces, at, previous) and (verb := behind(pieces, at + 1, _PASSED)) is not None and verb.is_action:
        return verb
    if previous is not None and previous.role in (Role.AND, Role.PUNCTUATION):
        partner = before(pieces, pieces.index(previous))
        return partner.governor if partner is not None and partner.is_robot else None
    return None


def _opens(previous: Piece | None) -> bool:
    return previous is not None and previous.role in (Role.AND, Role.PUNCTUATION)


def _called(pieces: list[Piece], at: int, previous: Piece | None) -> bool:
    """Whether a robot is called by its name: `rover, go to base`."""
    opens = previous is None or (previous.role is Role.PUNCTUATION and previous.norm != ",")
    return opens and at + 1 < len(pieces) and pieces[at + 1].norm in (",", ":", "-")


def orders(pieces: list[Piece]) -> Iterator[tuple[Piece, Piece]]:
    """Pairs of verbs that the request puts in order."""
    for at, piece in enumerate(pieces):
        if piece.role not in _ORDERING:
            continue
        earlier = next((p for p in reversed(pieces[:at]) if p.is_action and p.positive), None)
        later = [p for p in pieces[at + 1 :] if p.is_action and p.positive]
        if piece.role is Role.THEN and earlier is not None and later:
            yield earlier, later[0]
        elif piece.role is Role.FIRST and len(later) > 1:
            yield later[0], later[1]
        elif piece.role is Role.AFTER and later:
            if earlier is not None and not _starts_clause(pieces, at):
                yield later[0], earlier
            elif len(later) > 1:
                yield later[0], later[1]


def _starts_clause(pieces: list[Piece], at: int) -> bool:
    previous = before(pieces, at)
    return previous is None or previous.role in (Role.PUNCTUATION, Role.AND)

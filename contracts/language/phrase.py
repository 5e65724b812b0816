"""Noun phrases: modifiers, heads and places. What does not resolve whole is kept verbatim as unknown, never trimmed."""

from itertools import pairwise

from crew.contracts.language.inflect import Form
from crew.contracts.language.lexicon import Lexicon
from crew.contracts.language.mention import Direction, MentionKind
from crew.contracts.language.piece import PLACE_ROLES, PREPOSITIONS, Piece, before, behind
from crew.contracts.language.tokens import Token
from crew.contracts.language.words import AFFECTIVE, PLACE_NOUNS, ZONE_NOUNS, Role
from crew.contracts.plan import Zone

_OPENS = PREPOSITIONS | {Role.DETERMINER, Role.QUANTIFIER}
_FINDING = frozenset((
    "find", "locate", "look", "search", "track down", "discover", "detect", "seek out", "hunt down", "hunt for",
))  # fmt: skip
_NO_ARTICLE = frozenset((Role.DETERMINER, Role.QUANTIFIER))
_PLACES = (MentionKind.VALUE, MentionKind.LOCATION, MentionKind.OBJECT)


def noun_phrases(pieces: list[Piece]) -> list[Piece]:
    """Join words that belong to one name; afterwards each mention stands for a whole noun phrase."""
    joined = _possessives(_modifiers(pieces))
    joined = _of_phrases(joined)
    _neighbours(joined)
    _after_verb_and_article(joined)
    return joined


def directions(pieces: list[Piece], tokens: list[Token]) -> None:
    """Origins and destinations; a robot in the place of a place is no known place."""
    for at, piece in enumerate(pieces):
        if not piece.is_entity:
            continue
        previous = before(pieces, at, _NO_ARTICLE | {Role.FILLER})
        role = previous.role if previous is not None else None
        if role is Role.FROM:
            piece.direction = Direction.FROM
        elif role is Role.TO or (role is Role.NEAR and piece.near_is_at):
            piece.direction = Direction.TO
        elif role is Role.AT:
            piece.direction = Direction.AT
        elif role is Role.AND and previous is not None and not piece.is_robot:
            partner = before(pieces, pieces.index(previous), _NO_ARTICLE | {Role.FILLER})
            if partner is not None and partner.kind is piece.kind:
                piece.direction = partner.direction  # "to room_a and room_b"
        missed = piece.is_robot and previous is not None and _looked_for(pieces, at, previous)
        if missed or (piece.is_robot and role in (Role.TO, Role.AT, Role.NEAR, Role.FROM)):
            piece.become_unknown(piece.first, piece.after)
            piece.name = " ".join(t.norm for t in tokens[piece.first : piece.after])


def _looked_for(pieces: list[Piece], at: int, previous: Piece) -> bool:
    """`find the helicopter`, `look for the drone`: no robot is told to do that, one is to be found."""
    if pieces[at - 1].role is not Role.DETERMINER:
        return False
    verb = before(pieces, pieces.index(previous)) if previous.role is Role.FOR else previous
    return verb is not None and verb.is_action and verb.norm in _FINDING and verb.form is Form.BASE


def hosts(pieces: list[Piece], lexicon: Lexicon) -> None:
    """`on the dog` is its tray, if the crew's only trays are the dog's."""
    parts = {robots: name for name, robots in lexicon.hosts.items()}
    for at, piece in enumerate(pieces):
        previous = before(pieces, at, _NO_ARTICLE) if piece.is_robot else None
        part = parts.get(frozenset(str(value) for value in piece.values))
        if part is not None and previous is not None and previous.norm in ("on", "onto"):
            piece.kind, piece.name, piece.values = MentionKind.LOCATION, part, (part,)


def loose_ends(pieces: list[Piece], lexicon: Lexicon) -> None:
    """Prepositions and quantifiers that fit nothing they stand before are unread."""
    sweeping = False
    for at, piece in enumerate(pieces):
        if piece.is_action:
            sweeping = any((ref.contract, ref.step) in lexicon.zone_steps for ref in piece.means)
        following = behind(pieces, at, _NO_ARTICLE | {Role.OF, Role.FILLER})
        kind = following.kind if following is not None else None
        beside = following is not None and following.near_is_at and not sweeping
        far = piece.role is Role.NEAR and not beside
        if piece.role is Role.OVER and kind is MentionKind.OBJECT and at and pieces[at - 1].is_action:
            piece.become(Role.FILLER)  # "bring over the cube"
        elif far or (piece.role is Role.OVER and kind is not MentionKind.ZONE):
            piece.become(Role.UNREAD)
        elif piece.role is Role.QUANTIFIER and kind is not MentionKind.ZONE:
            if following is not None and following.is_robot and piece.norm in ("all", "both", "every", "each"):
                following.every = True
            else:
                piece.become(Role.UNREAD)


def _modifiers(pieces: list[Piece]) -> list[Piece]:
    """Runs of unknown words with the name that they belong to."""
    out: list[Piece] = []
    at = 0
    while at < len(pieces):
        end = at
        while end < len(pieces) and pieces[end].role is Role.WORD:
            end += 1
        if end == at:
            out.append(pieces[at])
            at += 1
            continue
        head = pieces[end] if end < len(pieces) else None
        at = end + _join_run(out, pieces[at:end], head)
    return out


def _join_run(out: list[Piece], run: list[Piece], head: Piece | None) -> int:
    """Add a run of unknown words to `out`; 1 if its head was added with it."""
    previous = out[-1] if out else None
    opens = previous is not None and (previous.role in _OPENS or previous.is_action)
    if previous is not None and previous.kind is MentionKind.ZONE and run[0].norm in ZONE_NOUNS:
        run[0].become(Role.FILLER)
        out.append(run.pop(0))
        opens = False
    if not run:
        return 0
    if previous is not None and _bare_direction(previous) and run[0].first == previous.after:
        previous.become_unknown(previous.first, run[-1].after)  # "the west gate" is no half
        return 0
    if head is not None and (head.is_robot or head.kind is MentionKind.VALUE) and all(w.norm in AFFECTIVE for w in run):
        head.first = run[0].first
        out.append(head)
        return 1
    joins = head is not None and head.is_entity and not head.is_robot and not run[-1].possessive
    if head is not None and joins:
        if all(w.norm in head.modifiers or w.norm in _felt(head) for w in run) or _zone_noun(run, head):
            head.first = run[0].first
            out.append(head)
            return 1
        if opens:
            head.become_unknown(run[0].first, head.after)
            out.append(head)
            return 1
    if opens and not (head is not None and (head.is_robot or head.is_action)):
        possessive = run[-1].possessive
        run[0].become_unknown(run[0].first, run[-1].after)
        run[0].possessive = possessive
        out.append(run[0])
    else:
        out.extend(run)
    return 0


def _felt(head: Piece) -> frozenset[str]:
    """`my missing little girl`: what tells how somebody feels about a person stands beside what tells of them."""
    return AFFECTIVE if head.kind is MentionKind.VALUE else frozenset()


def _bare_direction(piece: Piece) -> bool:
    return piece.kind is MentionKind.ZONE and piece.after - piece.first == 1


def _zone_noun(run: list[Piece], head: Piece) -> bool:
    return head.kind is MentionKind.ZONE and len(run) == 1 and run[0].norm in ZONE_NOUNS


def _possessives(pieces: list[Piece]) -> list[Piece]:
    """`the victim's position` is the victim as a place; `the victim's bag` is unknown."""
    out: list[Piece] = []
    for piece in pieces:
        owner = out[-1] if out else None
        if owner is None or not owner.possessive or not owner.is_entity:
            out.append(piece)
        elif piece.norm in PLACE_NOUNS and owner.kind in _PLACES:
            owner.after, owner.possessive = piece.after, False
        elif piece.role is Role.WORD or piece.is_entity:
            owner.become_unknown(owner.first, piece.after)
        else:
            out.append(piece)
    return out


def _of_phrases(pieces: list[Piece]) -> list[Piece]:
    """`X of Y`: a part of a zone, the place of a thing, or something unknown."""
    at = 1
    while at < len(pieces) - 1:
        whole = behind(pieces, at)
        part = pieces[at - 1]
        if pieces[at].role is not Role.OF or whole is None or not whole.is_entity:
            at += 1
            continue
        end = pieces.index(whole) + 1
        if part.norm in PLACE_NOUNS and whole.kind in _PLACES:
            whole.first = part.first
            pieces[at - 1 : end] = [whole]
        elif _nested(part, whole):
            part.after = whole.after
            pieces[at:end] = []
        elif part.is_entity and not part.is_robot:
            part.become_unknown(part.first, whole.after)
            pieces[at:end] = []
        else:
            at += 1
    return pieces


def _neighbours(pieces: list[Piece]) -> None:
    """Two names side by side for one thing: `the north area`, `the rover tb3`."""
    for left, right in pairwise(pieces):
        if _nested(left, right):
            left.after = right.after
            right.become(Role.FILLER)
        elif _nested(right, left):
            right.first = left.first
            left.become(Role.FILLER)


def _is_place(piece: Piece) -> bool:
    return piece.kind in (MentionKind.LOCATION, MentionKind.ZONE)


def _nested(inner: Piece, outer: Piece) -> bool:
    if inner.is_robot and outer.is_robot:
        return set(inner.values) <= set(outer.values)
    if inner.kind is not MentionKind.ZONE or outer.kind is not MentionKind.ZONE:
        return False
    a, b = inner.values[0], outer.values[0]
    return isinstance(a, Zone) and isinstance(b, Zone) and b.covers(a)


def _after_verb_and_article(pieces: list[Piece]) -> None:
    """In `search the land` the second word is a thing, not a verb; in `report the coordinates` it says the same.

    So it is after a preposition, in `in your hand`.
    """
    for at, (place, owner, piece) in enumerate(zip(pieces, pieces[1:], pieces[2:], strict=False)):
        described = piece.form is Form.PAST and at + 3 < len(pieces) and pieces[at + 3].kind is MentionKind.VALUE
        if place.role in PLACE_ROLES and owner.role is Role.DETERMINER and piece.is_action and not described:
            piece.become_unknown(piece.first, piece.after)
    for at, (piece, head) in reversed(list(enumerate(pairwise(pieces)))):
        placed = at and pieces[at - 1].role in (Role.DETERMINER, *PLACE_ROLES)
        if (
            placed
            and piece.form is Form.ING
            and (piece.is_action or piece.kind is MentionKind.UNKNOWN)
            and _is_place(head)
        ):
            piece.become_unknown(piece.first, head.after)  # "the loading dock"
            pieces.pop(at + 1)
    for at, (owner, piece) in enumerate(pairwise(pieces)):
        mine = owner.norm in ("my", "our") or (owner.norm == "your" and before(pieces, at) is None)
        if owner.role is Role.DETERMINER and mine and piece.is_action:
            piece.become(Role.UNREAD)  # "my hands are full"
    for verb, article, piece in zip(pieces, pieces[1:], pieces[2:], strict=False):
        if verb.is_action and article.role is Role.DETERMINER and piece.is_action and article.norm in ("the", "a"):
            if set(verb.means) & set(piece.means):
                piece.become(Role.FILLER)
            else:
                piece.become_unknown(piece.first, piece.after)

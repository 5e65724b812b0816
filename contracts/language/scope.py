"""Polarity: what a negation excludes, where it ends, and which requests cannot be read in one way only."""

from crew.contracts.language.mention import Ambiguity, MentionKind
from crew.contracts.language.piece import SOFT, Piece, before, behind
from crew.contracts.language.tokens import Token
from crew.contracts.language.words import Role
from crew.contracts.plan import Zone

_NEGATIONS = frozenset((Role.NOT, Role.NO, Role.EXCEPT, Role.AVOID))
_ENDS = frozenset((Role.PUNCTUATION, Role.BREAK, Role.THEN))
_PASSED = SOFT | {Role.BE, Role.CAUSE}
_WISHES = frozenset(("want", "need", "like", "have"))
_NEEDS = frozenset(("want", "need", "wants", "needs"))
_WHY = {
    Role.CONDITION: "a condition",
    Role.ALTERNATIVE: "a choice between alternatives",
    Role.CORRECTION: "a correction of itself",
}


def polarities(pieces: list[Piece], tokens: list[Token]) -> list[Ambiguity]:
    """Mark what is excluded; return what makes the request ambiguous."""
    doubts = [_doubt(f"the request contains {_WHY[p.role]}", p, tokens) for p in pieces if p.role in _WHY]
    at = 0
    while at < len(pieces):
        if pieces[at].role in _NEGATIONS:
            at = _negate(pieces, at, tokens, doubts)
        else:
            at += 1
    return doubts


def contradictions(pieces: list[Piece], tokens: list[Token]) -> list[Ambiguity]:
    """Everything that is both wanted and excluded."""
    excluded = [p for p in pieces if p.kind is not None and not p.positive and not p.aside]
    return [
        _doubt(f"{p.name or p.norm} is both wanted and excluded", p, tokens)
        for p in pieces
        if p.kind is not None and p.positive and any(_clash(p, other) for other in excluded)
    ]


def _negate(pieces: list[Piece], at: int, tokens: list[Token], doubts: list[Ambiguity]) -> int:
    """Read one negation; return where the reader goes on."""
    negation = pieces[at]
    if negation.role is Role.NO and at and pieces[at - 1].is_action and pieces[at - 1].norm in _NEEDS:
        doubts.append(_doubt("nothing may be needed", negation, tokens))  # "room_a needs no bottle"
    if negation.role is Role.NO and (at + 1 == len(pieces) or pieces[at + 1].role in (Role.PUNCTUATION, Role.FILLER)):
        doubts.append(_doubt("the request contains a correction of itself", negation, tokens))
        return at + 1
    end = next((k for k in range(at + 1, len(pieces)) if pieces[k].role in _ENDS), len(pieces))
    inside = pieces[at + 1 : end]
    if len(inside) > 1 and inside[0].role is Role.WORD and negation.role is Role.NOT and _names_next(inside):
        inside[0].become(Role.FILLER)  # "do not touch the bottle": the bottle is left out of everything
    scope = [*_subject(pieces, at), *(p for p in inside if p.kind is not None)]
    if not scope:
        doubts.append(_doubt(f"nothing follows '{negation.norm}' that it could exclude", negation, tokens))
    wished = any(p.is_action and p.norm in _WISHES for p in inside)
    if wished and any(p.role is Role.PRONOUN for p in inside):
        doubts.append(_doubt("what was asked for may be unwanted", negation, tokens))  # "..., I don't want that"
    if any(p.role in _NEGATIONS for p in inside):
        doubts.append(_doubt("the request negates twice", negation, tokens))
    if _goes_on(inside):
        doubts.append(_doubt(f"it is not clear where '{negation.norm}' ends", negation, tokens))
    _exclude(scope)
    if negation.role is Role.AVOID:
        negation.become(Role.UNREAD)
    return end


def _names_next(inside: list[Piece]) -> bool:
    following = next((p for p in inside[1:] if p.role not in SOFT), None)
    return following is not None and following.is_entity and following.kind is not MentionKind.UNKNOWN


def _subject(pieces: list[Piece], at: int) -> list[Piece]:
    """The robot in front of the negation: `the rover must not move`."""
    robot = before(pieces, at, _PASSED)
    following = behind(pieces, at, _PASSED | {Role.TO})
    if robot is None or not robot.is_robot or not (following is None or following.is_action or following.role in _ENDS):
        return []
    owner = before(pieces, pieces.index(robot))
    return [] if owner is not None and (owner.is_action or owner.role is Role.WITH) else [robot]


def _goes_on(inside: list[Piece]) -> bool:
    joined = next((k for k, p in enumerate(inside) if p.role is Role.AND), len(inside))
    return any(p.is_action for p in inside[joined:])


def _exclude(scope: list[Piece]) -> None:
    acting = any(p.is_action for p in scope)
    robots = any(p.is_robot for p in scope)
    bare = not any(p.is_entity for p in scope)
    for piece in scope:
        piece.positive = False
        piece.bare = piece.is_action and bare
        piece.aside = acting and robots and not piece.is_robot


def _clash(wanted: Piece, excluded: Piece) -> bool:
    if wanted.is_robot and excluded.is_robot:
        return set(wanted.values) <= set(excluded.values)
    if wanted.is_action and excluded.is_action:
        return excluded.bare and {r.skill for r in wanted.means} <= {r.skill for r in excluded.means}
    if MentionKind.UNKNOWN in (wanted.kind, excluded.kind):
        return wanted.kind is excluded.kind and wanted.name == excluded.name
    return wanted.kind is excluded.kind and bool(_keys(wanted) & _keys(excluded))


def _keys(piece: Piece) -> set[str]:
    return {v if isinstance(v, str) else repr(v) for v in piece.values if isinstance(v, str | float | Zone) or v}


def _doubt(why: str, piece: Piece, tokens: list[Token]) -> Ambiguity:
    return Ambiguity(why, (tokens[piece.first].start, tokens[piece.after - 1].end))

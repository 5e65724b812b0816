"""For whom something is done: `for me` says where to bring it only if nothing else does."""

from crew.contracts.language.lexicon import Lexicon
from crew.contracts.language.mention import MentionKind
from crew.contracts.language.piece import Piece, before
from crew.contracts.language.tokens import Token
from crew.contracts.language.words import REQUESTER, Role

_SELF = frozenset(("me", "us", "myself"))
_GOALS = (MentionKind.LOCATION, MentionKind.POINT)
_SOFT = frozenset((Role.DETERMINER, Role.FILLER))


def beneficiaries(pieces: list[Piece], tokens: list[Token], lexicon: Lexicon) -> None:
    """Pass over the person for whom something is done, where that names no place to bring it to.

    `put it on the table for me`, `find her for us`, `wave to the operator`, `tell me where`; not `fetch it for me`.
    """
    _addressed(pieces, tokens)
    for at, link in enumerate(pieces):
        person = next((p for p in pieces[at + 1 : at + 3] if p.role is not Role.DETERMINER), link)
        named = person.is_entity and person.name == REQUESTER
        verb = next((p for p in reversed(pieces[: at + 1]) if p.is_action), None)
        if verb is None or person is link or person.after - person.first != 1:
            continue
        said = tokens[person.first].norm in _SELF
        thanked = link.role is Role.FOR and said and (not named or not _receives(pieces, at, verb, lexicon))
        greeted = link.role in (Role.TO, Role.AT, Role.FOR) and named and _gesture(verb, lexicon)
        told = link is verb and said and not named and all(r.skill in lexicon.reports for r in verb.means)
        if thanked or greeted:
            link.become(Role.FILLER)
        if thanked or greeted or told:
            person.become(Role.FILLER)


def _addressed(pieces: list[Piece], tokens: list[Token]) -> None:
    """`me, I need ...`, `here, take ...`: the person is no goal before anything was asked for."""
    for at, piece in enumerate(pieces):
        if piece.is_action:
            return
        opens = before(pieces, at, _SOFT | {Role.PUNCTUATION}) is None
        closed = at + 1 < len(pieces) and pieces[at + 1].role is Role.PUNCTUATION
        if piece.is_entity and piece.name == REQUESTER and opens and closed:
            topic = at + 2 < len(pieces) and tokens[pieces[at + 2].first].norm in ("i", "we")
            piece.become(Role.FILLER if topic else Role.UNREAD)


def _receives(pieces: list[Piece], at: int, verb: Piece, lexicon: Lexicon) -> bool:
    """Whether `for me` may be where the thing shall go."""
    contracts = {ref.contract for ref in verb.means}
    if not contracts & lexicon.to_requester:
        return False
    begins = pieces.index(verb)
    placed = {
        link.role
        for k, p in enumerate(pieces[begins:at], begins)
        if p.kind in _GOALS and (link := before(pieces, k, _SOFT)) is not None
    }
    return Role.TO not in placed and not (Role.AT in placed and not contracts & lexicon.by_hand)


def _gesture(verb: Piece, lexicon: Lexicon) -> bool:
    """Whether a verb means only skills without arguments."""
    return bool(verb.means) and all(ref.skill in lexicon.gestures for ref in verb.means)

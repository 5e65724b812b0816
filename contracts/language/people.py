"""Who is meant by `man` or `my brother`: whoever a search is for, and nobody where none was asked for."""

from crew.contracts.language.inflect import Form
from crew.contracts.language.lexicon import Lexicon
from crew.contracts.language.mention import Ambiguity, Direction, MentionKind
from crew.contracts.language.persons import APART, BROAD, NOUNS
from crew.contracts.language.piece import Piece, before, behind
from crew.contracts.language.tokens import Token
from crew.contracts.language.words import PLACE_NOUNS, ZONE_NOUNS, Role

_PRONOUNS = frozenset(("him", "her", "them", "he", "she", "they", "there", "his", "their", "it", "its"))


_GENERAL = frozenset(("person", "victim", "casualty", "survivor", "patient", "find"))
"""What anybody is called who is looked for, `whoever you find` among them."""
_TOLD = frozenset(("tell", "give", "ask", "show", "let", "have", "get", "make", "want", "need", "order", "use"))
_AREA_NOUNS = frozenset((*ZONE_NOUNS, "site", "field", "home", "base", "start"))


def people(pieces: list[Piece], tokens: list[Token], lexicon: Lexicon) -> list[Ambiguity]:
    """Make unknown who is named by a noun alone where nobody is searched for; doubt two who may be different people."""
    found = [p for p in pieces if p.kind is MentionKind.VALUE and p.name in set(lexicon.reports.values())]
    for piece in [p for p in found if _not_sought(pieces, p, tokens)]:
        piece.become_unknown(piece.first, piece.after)
        found.remove(piece)
    said = {id(p): tokens[p.after - 1].norm for p in found}
    loose = [p for p in found if said[id(p)] in NOUNS]
    sought = any(
        (r.contract, r.step) in lexicon.zone_steps for p in pieces if p.is_action and p.positive for r in p.means
    )
    if loose and not sought:
        for piece in loose:
            piece.become_unknown(piece.first, piece.after)
        return []
    none = [p for p in found if sought and not p.positive and _denied(pieces, p)]
    if none:
        return [Ambiguity("nobody may be missing", (tokens[none[0].first].start, tokens[none[0].after - 1].end))]
    goals = [p for p in found if p.direction is Direction.TO]
    two = [p for p in loose for other in found if _differ(p, other, said) and (p in goals or other in goals)]
    return [Ambiguity("two people may be meant", (tokens[p.first].start, tokens[p.after - 1].end)) for p in two[:1]]


def _not_sought(pieces: list[Piece], person: Piece, tokens: list[Token]) -> bool:
    """`tell the man to search`, `search with the man`, `the man searches`, `the guest area`: nobody is looked for."""
    at = pieces.index(person)
    said = {t.norm for t in tokens[person.first : person.after]}
    if said & _PRONOUNS or said & PLACE_NOUNS:
        return False
    link, following = before(pieces, at), behind(pieces, at, frozenset((Role.MODAL, Role.TO, Role.FILLER)))
    if link is not None and (link.role is Role.WITH or (link.is_action and link.norm in _TOLD)):
        return True
    beside = pieces[at + 1] if at + 1 < len(pieces) else None
    if beside is not None and beside.is_entity and {tokens[beside.first].norm} & _AREA_NOUNS:
        return beside.first == person.after
    opens = link is None or link.role in (Role.PUNCTUATION, Role.AND, Role.THEN)
    if not opens or following is None or not following.is_action or following.form is Form.PAST:
        return False
    told = following is not beside or following.form is not Form.BASE
    return told or any(p.role is Role.DETERMINER for p in pieces[max(0, at - 1) : at]) or _caused(pieces, at)


def _denied(pieces: list[Piece], person: Piece) -> bool:
    """`there is no missing person`."""
    link = before(pieces, pieces.index(person))
    return link is not None and link.role is Role.NO


def _caused(pieces: list[Piece], at: int) -> bool:
    return any(p.norm in _TOLD for p in pieces[max(0, at - 2) : at] if p.role is Role.FILLER)


def _differ(piece: Piece, other: Piece, said: dict[int, str]) -> bool:
    one, another = said[id(piece)], said[id(other)]
    if piece is other or one == another or another in _PRONOUNS | _GENERAL:
        return False
    broad = {one, another} & BROAD
    apart = any((one in a and another in b) or (one in b and another in a) for a, b in APART)
    return apart or not broad

"""Who is meant by `man` or `my brother`: whoever a search is for, and nobody where none was asked for."""

from crew.contracts.language.lexicon import Lexicon
from crew.contracts.language.mention import Ambiguity, Direction, MentionKind
from crew.contracts.language.piece import Piece
from crew.contracts.language.stories import PERSON_NOUNS, PERSON_PLURALS
from crew.contracts.language.tokens import Token

_NOUNS = frozenset((*PERSON_NOUNS, *PERSON_PLURALS))


def people(pieces: list[Piece], tokens: list[Token], lexicon: Lexicon) -> list[Ambiguity]:
    """Make unknown who is named by a noun alone where nobody is searched for; doubt two who may be different people."""
    found = [p for p in pieces if p.kind is MentionKind.VALUE and p.name in set(lexicon.reports.values())]
    said = {id(p): tokens[p.after - 1].norm for p in found}
    loose = [p for p in found if said[id(p)] in _NOUNS]
    sought = any(
        (r.contract, r.step) in lexicon.zone_steps for p in pieces if p.is_action and p.positive for r in p.means
    )
    if loose and not sought:
        for piece in loose:
            piece.become_unknown(piece.first, piece.after)
        return []
    goals = [p for p in found if p.direction is Direction.TO]
    two = [p for p in loose for other in found if _differ(p, other, said) and (p in goals or other in goals)]
    return [Ambiguity("two people may be meant", (tokens[p.first].start, tokens[p.after - 1].end)) for p in two[:1]]


def _differ(piece: Piece, other: Piece, said: dict[int, str]) -> bool:
    pronouns = ("him", "her", "them", "he", "she", "they", "there")
    return piece is not other and said[id(piece)] != said[id(other)] and said[id(other)] not in pronouns

"""What stands at a place in a request, and what stands before and after it."""

from collections.abc import Collection

from crew.contracts.language.entry import Entry, stands
from crew.contracts.language.lexicon import Lexicon, match
from crew.contracts.language.mention import MentionKind
from crew.contracts.language.piece import Piece
from crew.contracts.language.tokens import Shape, Token
from crew.contracts.language.words import AFFECTIVE, Role

ARTICLES = frozenset(("the", "a", "an", "all", "both", "your", "our", "my", "any", "this", "that", "these", "those"))

SOFT = ARTICLES | AFFECTIVE
"""What may stand in front of a name and says nothing."""


def named(tokens: list[Token], at: int, lexicon: Lexicon) -> tuple[Entry | None, int]:
    """The name that stands here, past one article, and where it is over; without one, where the article is over."""
    start = at + (at < len(tokens) and tokens[at].norm in ARTICLES)
    name = match(lexicon.names, tokens, start) if start < len(tokens) else None
    return name, start + (0 if name is None else len(name.words))


def past_all(tokens: list[Token], at: int, words: Collection[str]) -> int:
    """The next position, past every one of these words that stands here."""
    while at < len(tokens) and tokens[at].norm in words:
        at += 1
    return at


class Lookahead:
    """The tokens of one request, with the pieces that were made of them so far."""

    def __init__(self, tokens: list[Token], lexicon: Lexicon) -> None:
        self.tokens = tokens
        self.lexicon = lexicon
        self.pieces: list[Piece] = []

    def _clause_begins(self, at: int) -> bool:
        return all(p.role in (Role.FILLER, Role.PUNCTUATION) for p in self.pieces[-1:])

    def _clause_ends(self, at: int) -> bool:
        if at >= len(self.tokens) or self.tokens[at].shape is Shape.MARK:
            return True
        entry = match(self.lexicon.functions, self.tokens, at)
        return entry is not None and entry.role in (Role.AND, Role.THEN, Role.BREAK, Role.FILLER)

    def _past_name(self, at: int) -> int:
        """Past one name and its articles, or `at` if no name stands here."""
        start = self._past(self._past(at, tuple(ARTICLES)), tuple(AFFECTIVE))
        entry = self._name(start)
        return at if entry is None or entry.kind is MentionKind.ACTION else start + len(entry.words)

    def _connective(self, at: int) -> bool:
        if self.tokens[at].shape is Shape.MARK:
            return True
        entry = match(self.lexicon.functions, self.tokens, at)
        return entry is not None and entry.role not in (Role.FILLER, Role.PRONOUN, Role.DETERMINER)

    def _special(self, role: Role, at: int) -> Entry | None:
        """A function word of a role that holds only before a fitting word."""
        for entry in self.lexicon.special.get(self.tokens[at].norm, ()) if at < len(self.tokens) else ():
            if entry.role is role and stands(self.tokens, at, entry.words):
                return entry
        return None

    def _name(self, at: int) -> Entry | None:
        return match(self.lexicon.names, self.tokens, at) if at < len(self.tokens) else None

    def _action(self, at: int, shorter_than: int = 99) -> Entry | None:
        """The longest action phrase that starts here, up to a number of words."""
        if at >= len(self.tokens):
            return None
        for entry in self.lexicon.names.get(self.tokens[at].norm, ()):
            fits = entry.kind is MentionKind.ACTION and len(entry.words) <= shorter_than
            if fits and stands(self.tokens, at, entry.words):
                return entry
        return None

    def _past(self, at: int, words: tuple[str, ...]) -> int:
        """The next position, past one of the words if it stands here."""
        return at + 1 if at < len(self.tokens) and self.tokens[at].norm in words else at

    def _action_takes_zone(self, at: int) -> bool:
        for back in range(at - 1, -1, -1):
            entry = self._action(back)
            if entry is not None:
                return any((ref.contract, ref.step) in self.lexicon.zone_steps for ref in entry.means)
        return False

    def _negated(self) -> bool:
        bounds = (p.role for p in reversed(self.pieces) if p.role in (Role.NOT, Role.PUNCTUATION, Role.BREAK))
        return next(bounds, None) is Role.NOT

    def _name_is_place(self, at: int) -> bool:
        """A place may be called like a verb; then `send the rover to ...` names the place."""
        entry = match(self.lexicon.names, self.tokens, at)
        return entry is not None and entry.kind is not MentionKind.ACTION

    def _past_named(self, at: int) -> int:
        """Past one name or pronoun, or `at` if none stands here."""
        named = self._past_name(at)
        return named if named > at else self._past(at, ("it", "them", "him", "her"))

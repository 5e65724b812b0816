"""What is said beside the request, or only looks like a part of it: tags, callsigns, what people say of themselves."""

from crew.contracts.language.entry import Entry
from crew.contracts.language.figures import norm_at
from crew.contracts.language.frames import AFTER_A_MARK
from crew.contracts.language.inflect import Form
from crew.contracts.language.lexicon import match
from crew.contracts.language.lookahead import ARTICLES, Lookahead
from crew.contracts.language.mention import ROBOT_KINDS, MentionKind
from crew.contracts.language.piece import Piece, of_entry
from crew.contracts.language.words import Role

_TAG_LINKS = ("and",)
_SELVES = ("i", "we")
_OTHERS = ("it", "him", "her", "them")
_ALLOWED = ("may", "can", "could", "might")


class Asides(Lookahead):
    """Reads one aside at a place, if one stands there."""

    def aside(self, at: int) -> Piece | None:
        """The first aside that fits."""
        for read in (
            self._closer, self._around_person, self._spoken_like, self._own_way, self._future, self._hold_on_to,
            self._as_far_as,
        ):  # fmt: skip
            if (piece := read(at)) is not None:
                return piece
        return None

    def _closer(self, at: int) -> Piece | None:
        """`..., over`, `..., won't you?`: a tag at the end of a sentence."""
        entry = self._special(Role.CLOSER, at)
        if entry is None or not self.pieces:
            return None
        after = at + len(entry.words)
        marked = self.pieces[-1].role is Role.PUNCTUATION or self.tokens[at - 1].norm in _TAG_LINKS
        ends = after == len(self.tokens) or self.tokens[after].norm in (".", "!", "?") or self._tag_follows(after)
        return Piece(at, after, Role.FILLER) if ends and (marked or entry.name not in AFTER_A_MARK) else None

    def _tag_follows(self, at: int) -> bool:
        """Another tag, with or without a mark before it."""
        following = self._past(at, (",",))
        entry = self._special(Role.CLOSER, following)
        ends = () if entry is None else self.tokens[following + len(entry.words) :]
        return entry is not None and (not ends or ends[0].norm in (".", "!", "?"))

    def _around_person(self, at: int) -> Piece | None:
        """`we have a missing hiker, last seen in ...`: who is to be found, and where."""
        if (entry := self._special(Role.PRESENTED, at)) is not None:
            after = at + len(entry.words)
            names = (self._name(after), self._name(after + 1))
            said = any(name is not None and name.kind is MentionKind.VALUE for name in names)
        elif (entry := self._special(Role.WHEREABOUTS, at)) is not None:
            named = next((p for p in reversed(self.pieces) if p.is_entity), None)
            said = named is not None and named.kind is MentionKind.VALUE
        else:
            return None
        return Piece(at, at + len(entry.words), Role.FILLER if said else Role.UNREAD, norm=entry.name)

    def _spoken_like(self, at: int) -> Piece | None:
        """`could you like put it down`."""
        loose = self.tokens[at].norm == "like" and self._action(at + 1) is not None
        asked = bool(self.pieces) and self.pieces[-1].role in (Role.FILLER, Role.MODAL)
        return Piece(at, at + 1, Role.FILLER) if loose and asked else None

    def _hold_on_to(self, at: int) -> Piece | None:
        """`hold on to the bottle` corrects nothing."""
        verb = self._action(at)
        if verb is None or len(verb.words) > 1 or [t.norm for t in self.tokens[at + 1 : at + 3]] != ["on", "to"]:
            return None
        held = self._correction(at) is not None and self._past_named(at + 3) > at + 3
        return of_entry(verb, at, at + 3, False) if held else None

    def _correction(self, at: int) -> Entry | None:
        entry = self.lexicon.longest(self.tokens, at)
        return entry if entry is not None and entry.role is Role.CORRECTION else None

    def _as_far_as(self, at: int) -> Piece | None:
        """`until room_b`: a place is no time."""
        name = self._name(self._past(at + 1, tuple(ARTICLES))) if self.tokens[at].norm in ("until", "till") else None
        place = name is not None and name.kind is MentionKind.LOCATION
        return Piece(at, at + 1, Role.TO, norm="to") if place else None

    def _own_way(self, at: int) -> Piece | None:
        """`I want to go to room_b`, `I have the cube`, `I like it`: the person speaks of themselves."""
        word, previous = self.tokens[at].norm, norm_at(self.tokens, at - 1)
        asked = previous in _ALLOWED
        if word in _SELVES and not asked:
            verb = self._past_frames(at)
            goes = self._action(verb) is not None and norm_at(self.tokens, verb - 1) == "to"
            if goes and self._goes_to(verb):
                return Piece(at, verb, Role.UNREAD)
        if self._action(at) is None or norm_at(self.tokens, at + 1) == "to" or self._have_done(at):
            return None
        wished = {
            "have": previous in ("to", "me", "us") or norm_at(self.tokens, at - 2) in _ALLOWED,
            "like": previous in ("would", "should") or previous.endswith("'d"),
        }.get(word, True)
        return None if wished or self._orders_robot(at + 1) else Piece(at, at + 1, Role.UNREAD)

    def _past_frames(self, at: int) -> int:
        """Past what the person says of their own wishes."""
        while at < len(self.tokens):
            frame = match(self.lexicon.functions, self.tokens, at)
            if frame is None or frame.role is not Role.FILLER or "you" in frame.words:
                break
            at += len(frame.words)
        return at

    def _have_done(self, at: int) -> bool:
        """`have the cube brought to me`."""
        begins = self._clause_begins(at) and norm_at(self.tokens, at - 1) not in _SELVES
        said = begins and norm_at(self.tokens, at) == "have"
        done = self._action(self._past_name(at + 1)) if said else None
        return done is not None and done.form is Form.PAST

    def _orders_robot(self, at: int) -> bool:
        """`have the dog carry it`."""
        name = self._name(self._past(at, tuple(ARTICLES)))
        return (name is not None and name.kind in ROBOT_KINDS) or norm_at(self.tokens, at) in _OTHERS

    def _goes_to(self, at: int) -> bool:
        """A verb of motion with a goal and without an object."""
        verb = self._action(at)
        entry = (
            None if verb is None or at + 1 >= len(self.tokens) else match(self.lexicon.functions, self.tokens, at + 1)
        )
        return entry is not None and entry.role is Role.TO

    def _future(self, at: int) -> Piece | None:
        """`I'm going to search`: no motion, and no request."""
        ahead = self.tokens[at].norm == "going" and norm_at(self.tokens, at + 1) == "to"
        verb = self._action(at + 2) if ahead and not self._name_is_place(at + 2) else None
        return Piece(at, at + 2, Role.UNREAD) if verb is not None else None

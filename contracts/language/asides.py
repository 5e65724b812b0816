"""What is said beside the request, or only looks like a part of it: tags, callsigns, what people say of themselves."""

from crew.contracts.language.entry import Entry
from crew.contracts.language.figures import norm_at
from crew.contracts.language.frames import AFTER_A_MARK
from crew.contracts.language.inflect import Form
from crew.contracts.language.lexicon import match
from crew.contracts.language.lookahead import ARTICLES, Lookahead
from crew.contracts.language.mention import ROBOT_KINDS, MentionKind
from crew.contracts.language.piece import Piece, before, of_entry
from crew.contracts.language.tokens import Shape
from crew.contracts.language.words import AFFECTIVE, QUALITIES, Role

_TAG_LINKS = ("and",)
_SELVES = ("i", "we")
_OTHERS = ("it", "him", "her", "them")
_ALLOWED = ("may", "can", "could", "might")
_LONGEST_NAME = 4
_NEEDED = frozenset(("needed", "wanted", "required", "requested", "expected", "awaited"))
_ASKING = frozenset(("is", "are", "was", "were", "who", "what", "where", "why", "when", "how", "which"))
_NEEDS = frozenset(("need", "needs", "want", "wants", "would"))
_SENT = frozenset(("delivery", "transportation", "transfer", "transport", "package", "parcel"))
_SOMEBODY = frozenset(("they", "people", "somebody", "someone", "everybody", "everyone"))
_RECIPIENTS = frozenset((
    "patient", "patients", "visitor", "visitors", "guest", "guests", "nurse", "nurses", "doctor", "doctors", "client",
    "customer", "resident", "man", "woman", "lady", "gentleman", "child", "colleague", "colleagues", "people", "person",
    "team", "staff", "someone", "somebody",
))  # fmt: skip
"""Who may be in a room that needs something."""


class Asides(Lookahead):
    """Reads one aside at a place, if one stands there."""

    def aside(self, at: int) -> Piece | None:
        """The first aside that fits."""
        for read in (
            self._closer, self._around_person, self._spoken_like, self._own_way, self._future, self._hold_on_to,
            self._as_far_as, self._whoever_listens, self._pointed_there,
            self._own_finding, self._is_to, self._quality, self._down_on, self._needed,
            self._meant_for, self._recipient, self._impersonal, self._some_place, self._he_who_carries,
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
            if entry.words[-1] == "be" and not self._is_at(at + len(entry.words)):
                return None
            timed = (p.role for p in reversed(self.pieces) if p.role in (Role.AFTER, Role.PUNCTUATION))
            said = said and next(timed, None) is not Role.AFTER  # "when the hiker is lost"
            if not said and not {"last", "somewhere"} & set(entry.words):
                return None
        else:
            return None
        return Piece(at, at + len(entry.words), Role.FILLER if said else Role.UNREAD, norm=entry.name)

    def _is_at(self, at: int) -> bool:
        entry = self.lexicon.longest(self.tokens, at) if at < len(self.tokens) else None
        return entry is not None and entry.role is Role.AT

    def _spoken_like(self, at: int) -> Piece | None:
        """`could you like put it down`, `go to like the first room`."""
        said = self.tokens[at].norm == "like" and bool(self.pieces)
        modal = said and self.pieces[-1].is_robot and any(p.role is Role.MODAL for p in self.pieces)
        asked = modal or (said and self.pieces[-1].role in (Role.FILLER, Role.MODAL))
        asked = asked and self._action(at + 1) is not None
        placed = said and self.pieces[-1].role in (Role.TO, Role.AT) and self._past_name(at + 1) > at + 1
        return Piece(at, at + 1, Role.FILLER) if asked or placed else None

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

    def _whoever_listens(self, at: int) -> Piece | None:
        """`somebody take the cube to room_a`."""
        asked = self.tokens[at].norm in ("someone", "somebody") and self._clause_begins(at)
        return Piece(at, at + 1, Role.FILLER) if asked and self._orders(at + 1) else None

    def _orders(self, at: int) -> bool:
        verb = self._action(at)
        return verb is not None and verb.form is Form.BASE

    def _pointed_there(self, at: int) -> Piece | None:
        """`that bottle there, pass it to me`."""
        ends = at + 1 < len(self.tokens) and self.tokens[at + 1].norm in (",", ":")
        shown = bool(self.pieces) and (self.pieces[-1].is_robot or self.pieces[-1].kind is MentionKind.OBJECT)
        alone = shown and not any(p.is_action for p in self.pieces)
        return Piece(at, at + 1, Role.FILLER) if self.tokens[at].norm == "there" and ends and alone else None

    def _needed(self, at: int) -> Piece | None:
        """`the rover is needed at base`, `rover required at 3, 3`."""
        verb = at + (self.tokens[at].norm in ("is", "are"))
        owner = before(self.pieces, len(self.pieces))
        said = norm_at(self.tokens, verb) in _NEEDED and owner is not None and (owner.is_entity or owner.is_action)
        asked = self.tokens[0].norm in _ASKING
        after = self.lexicon.longest(self.tokens, verb + 1) if said and verb + 1 < len(self.tokens) else None
        alone = said and (self._clause_ends(verb + 1) or (after is not None and after.role in (Role.AT, Role.TO)))
        return Piece(at, verb + 1, Role.FILLER, norm="is needed") if alone and not asked else None

    def _own_finding(self, at: int) -> Piece | None:
        """`once I have found him`: of that no robot knows."""
        after = bool(self.pieces) and self.pieces[-1].role is Role.AFTER
        return Piece(at, at + 1, Role.UNREAD) if after and self.tokens[at].norm == "i" else None

    def _is_to(self, at: int) -> Piece | None:
        """`the drone is to search`, `the bottle is for room_b`: what shall be."""
        said = self.tokens[at].norm in ("is", "are") and bool(self.pieces) and self.pieces[-1].is_entity
        asked = self.tokens[0].norm in _ASKING
        if not said or asked or at + 2 >= len(self.tokens):
            return None
        if norm_at(self.tokens, at + 1) == "to":
            verb = self._action(at + 2)
            done = self._action(at + 3) if norm_at(self.tokens, at + 2) == "be" else None
            ordered = (verb is not None and verb.form is Form.BASE) or (done is not None and done.form is Form.PAST)
            return Piece(at, at + 1, Role.FILLER) if ordered else None
        name = self._name(self._past(at + 2, tuple(ARTICLES))) if norm_at(self.tokens, at + 1) == "for" else None
        placed = name is not None and name.kind is MentionKind.LOCATION and self.pieces[-1].kind is MentionKind.OBJECT
        return Piece(at, at + 1, Role.FILLER) if placed else None

    def _quality(self, at: int) -> Piece | None:
        """`do a quick scan`: how well is not for the request to say."""
        opens = self._clause_begins(at) or norm_at(self.tokens, at - 1) in ("a", "an", "another", "the")
        said = self.tokens[at].norm in QUALITIES and opens
        return Piece(at, at + 1, Role.FILLER) if said and self._action(at + 1) is not None else None

    def _down_on(self, at: int) -> Piece | None:
        """`put the bottle down on table_a`."""
        put = any(p.is_action and p.norm in ("put", "place", "set") for p in self.pieces)
        placed = self.tokens[at].norm == "down" and put and norm_at(self.tokens, at + 1) in ("on", "onto")
        return Piece(at, at + 1, Role.FILLER) if placed else None

    def _meant_for(self, at: int) -> Piece | None:
        """`bottle for room_b`: a place is where it goes."""
        name = self._name(self._past(at + 1, tuple(ARTICLES))) if self.tokens[at].norm == "for" else None
        place = name is not None and name.kind is MentionKind.LOCATION
        previous = before(self.pieces, len(self.pieces))
        thing = previous is not None and (previous.kind is MentionKind.OBJECT or previous.norm in _SENT)
        return Piece(at, at + 1, Role.TO, norm="to") if place and thing else None

    def _recipient(self, at: int) -> Piece | None:
        """`the patient in room_b needs ...`: who is there is whom it is for."""
        if (wanting := self._whoever_needs(at)) is not None:
            return wanting
        nobody = self._clause_begins(at) and not any(p.is_entity for p in self.pieces)
        if nobody and self.tokens[at].norm in _SOMEBODY and norm_at(self.tokens, at + 1) in ("need", "needs"):
            return Piece(at, at + 1, Role.FILLER)  # "they need the bottle in room_a"
        behind = range(at + 2, len(self.tokens)) if norm_at(self.tokens, at + 1) in ("need", "needs") else range(0)
        placed = any((e := self._name(k)) is not None and e.kind is MentionKind.LOCATION for k in behind)
        if self.tokens[at].norm in _RECIPIENTS and placed and self._name(at) is None and not self._named_yet():
            return Piece(at, at + 1, Role.FILLER)  # "my colleague needs the bottle in room_b"
        if (
            self.tokens[at].norm not in _RECIPIENTS
            or self._name(at) is not None
            or norm_at(self.tokens, at + 1) not in ("in", "at")
        ):
            return None
        place = self._past_name(at + 2)
        needs = self._action(place) if place > at + 2 else None
        return Piece(at, at + 1, Role.FILLER) if needs is not None and needs.words[0] in _NEEDS else None

    def _whoever_needs(self, at: int) -> Piece | None:
        """`front desk wants the bottle in room_a`: whoever that is, something is wanted at a place."""
        if self._named_yet() or not self._clause_begins(at) or self.tokens[-1].norm == "?":
            return None
        end = at
        while end < min(at + _LONGEST_NAME, len(self.tokens)) and self._says_nothing(end):
            end += 1
        known = [self._name(k) for k in range(end + 1, len(self.tokens))]
        placed = any(e is not None and e.kind is MentionKind.LOCATION for e in known)
        things = any(e is not None and e.kind in (*ROBOT_KINDS, MentionKind.OBJECT) for e in known)
        wants = norm_at(self.tokens, end) in ("needs", "wants") and end > at
        return Piece(at, end, Role.FILLER) if wants and placed and things else None

    def _says_nothing(self, at: int) -> bool:
        """Whether a token is an article or a word that nobody knows."""
        entry = self.lexicon.longest(self.tokens, at)
        unknown = entry is None and self.tokens[at].shape is Shape.WORD and self.tokens[at].norm not in _ASKING
        return unknown or (entry is not None and entry.role is Role.DETERMINER)

    def _some_place(self, at: int) -> Piece | None:
        """`off the table`, `from the table`: one of the tables, and not which."""
        start = self._past(at, ("up", "down"))
        noun = start + 2
        said = norm_at(self.tokens, start) in ("off", "from") and norm_at(self.tokens, start + 1) == "the"
        if not said or noun >= len(self.tokens) or self._name(noun) is not None:
            return None
        if not (self._clause_ends(noun + 1) or norm_at(self.tokens, noun + 1) == "to"):
            return None
        many = [e for found in self.lexicon.names.values() for e in found if self.tokens[noun].norm in e.words]
        places = {e.values for e in many if e.kind is MentionKind.LOCATION}
        taken = any(p.kind is MentionKind.OBJECT for p in self.pieces)
        return Piece(at, noun + 1, Role.FILLER) if taken and len(places) > 1 else None

    def _he_who_carries(self, at: int) -> Piece | None:
        """`put it on the dog and he takes it to room_b`, where a crew looks for nobody."""
        verb = self._action(at + 1) if self.tokens[at].norm in ("he", "she") and not self.lexicon.reports else None
        joined = bool(self.pieces) and self.pieces[-1].role in (Role.AND, Role.THEN, Role.PUNCTUATION)
        robots = {p.values for p in self.pieces if p.is_robot}
        known = verb is not None and verb.form is not Form.PAST and joined and len(robots) == 1
        return Piece(at, at + 1, Role.FILLER) if known else None

    def _named_yet(self) -> bool:
        return any(p.is_entity or p.is_action for p in self.pieces)

    def _impersonal(self, at: int) -> Piece | None:
        """`it must be searched in the north half`: nobody in particular."""
        bound = norm_at(self.tokens, at + 1) in ("must", "has", "needs", "should", "shall", "is")
        if self.tokens[at].norm != "it" or not bound or any(p.is_entity for p in self.pieces):
            return None
        ends = next(
            (k for k in range(at, len(self.tokens)) if self.tokens[k].norm in (".", "!", "?", ";")), len(self.tokens)
        )
        verbs = [e for k in range(at + 2, min(at + 5, ends)) if (e := self._action(k)) is not None]
        sweeps = any((r.contract, r.step) in self.lexicon.zone_steps for e in verbs[:1] for r in e.means)
        zoned = any((e := self._name(k)) is not None and e.kind is MentionKind.ZONE for k in range(at, ends))
        return Piece(at, at + 1, Role.FILLER) if sweeps and zoned else None

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
        name = self._name(self._past(self._past(at, tuple(ARTICLES)), tuple(AFFECTIVE)))
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

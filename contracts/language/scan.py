"""From tokens to pieces: figures first, then the longest known phrase, with the few idioms that need a look ahead."""

from crew.contracts.language.asides import Asides
from crew.contracts.language.entry import Entry, stands_all
from crew.contracts.language.figures import is_numeral, norm_at
from crew.contracts.language.frames import BEFORE_A_MARK
from crew.contracts.language.inflect import Form
from crew.contracts.language.lexicon import Lexicon
from crew.contracts.language.lookahead import ARTICLES
from crew.contracts.language.mention import ROBOT_KINDS, MentionKind
from crew.contracts.language.numbers import Figures, read_figures
from crew.contracts.language.piece import Piece, of_entry
from crew.contracts.language.tokens import Shape, Token
from crew.contracts.language.words import (
    ADVERBS,
    AFFECTIVE,
    BEFALLEN,
    IN_NEED,
    LEFT_ALONE,
    NOTHING_SAID,
    PARTICLES,
    PLACE_NOUNS,
    SELF_WORDS,
    Role,
)

_LIGHT_LINKS = ("and", "to", "by", "with")
_NOT_BEFORE_VERB = frozenset(("to", "from", "at", "in", "the", "into", "of"))
_SEPARABLE = PARTICLES | {"is"}
_MARKS = {
    "&": Role.AND, "/": Role.ALTERNATIVE, ",": Role.PUNCTUATION, ".": Role.PUNCTUATION, ";": Role.PUNCTUATION,
    ":": Role.PUNCTUATION, "!": Role.PUNCTUATION, "?": Role.PUNCTUATION, "-": Role.PUNCTUATION,
    "(": Role.PUNCTUATION, ")": Role.PUNCTUATION, "\u2026": Role.PUNCTUATION,
}  # fmt: skip


class Scanner(Asides):
    """One pass over the tokens of one request."""

    def __init__(self, tokens: list[Token], lexicon: Lexicon) -> None:
        super().__init__(tokens, lexicon)
        self.taken: set[int] = set()
        """Particles that an earlier verb has taken."""
        self.ends: set[int] = set()
        """Where an exclusion is over, whatever follows."""

    def scan(self) -> list[Piece]:
        figures = {f.first: f for f in read_figures(self.tokens, self.lexicon.area, self._action_takes_zone)}
        at = 0
        while at < len(self.tokens):
            piece = _of_figures(figures[at]) if at in figures else self._piece(at)
            self.pieces.append(piece)
            at = piece.after
        return self.pieces

    def _piece(self, at: int) -> Piece:
        if at in self.ends:
            return Piece(at, at + 1, Role.BREAK)
        if at in self.taken:
            return Piece(at, at + 1, Role.FILLER)
        token = self.tokens[at]
        if token.shape is Shape.MARK:
            return Piece(at, at + 1, _MARKS.get(token.norm, Role.UNREAD), norm=token.norm)
        if token.shape is Shape.ODD:
            return Piece(at, at + 1, Role.UNREAD, norm=token.norm)
        return self._idiom(at) or self._phrase(at) or self._loose(at)

    def _idiom(self, at: int) -> Piece | None:
        for read in (
            self.aside, self._light, self._cause, self._separable, self._leave, self._bare_go,
        ):  # fmt: skip
            if (piece := read(at)) is not None:
                return piece
        return None

    def _light(self, at: int) -> Piece | None:
        """`start searching`, `do a search`, `go and find`: the verb that follows is the one that is meant."""
        entry = self._special(Role.LIGHT, at)
        placed = at > 0 and self.tokens[at - 1].norm in _NOT_BEFORE_VERB
        if entry is None or (placed and self._name_is_place(at)):
            return None
        end = at + len(entry.words)
        verb = self._past(end, ("out", "ahead"))
        linked = self._past(verb, _LIGHT_LINKS)
        place = linked > verb and self.tokens[linked - 1].norm == "to" and norm_at(self.tokens, linked) in PLACE_NOUNS
        if self._action(linked) is not None and not place:
            return Piece(at, linked, Role.FILLER)
        return Piece(at, end, Role.FILLER) if self._action(self._past(verb, ("a", "an", "the"))) is not None else None

    def _cause(self, at: int) -> Piece | None:
        """`have the drone search`, `tell the rover to go`, `send the drone to find`: the robot is to do the rest."""
        entry = self._special(Role.CAUSE, at)
        sending = entry is None and self._action(at) is not None
        if entry is None and not sending:
            return None
        start = at + (1 if entry is None else len(entry.words))
        robot_at = self._past(self._past(start, tuple(ARTICLES)), tuple(AFFECTIVE))
        robot = self._name(robot_at)
        called = robot is not None and robot.kind in ROBOT_KINDS
        end = robot_at + len(robot.words) if robot is not None and called else robot_at
        if not called and entry is not None:
            end = self._past(start, ("it", "him", "her", "them"))  # "have it scan the area"
        if end == robot_at:
            return None
        verb = self._past(self._past(end, ("out", "up", "off", "over")), ("to",))
        marked = verb > end and self.tokens[verb - 1].norm == "to"
        action = (self._action(self._past(verb, ("go", "and", "then"))) if marked else None) or self._action(verb)
        if action is None and not sending and self._light(verb) is not None:
            self.taken.update(range(end, verb))
            return Piece(at, start, Role.FILLER)  # "have the drone take a look"
        noun = action is not None and action.words[0] in PLACE_NOUNS and self._past_named(verb + 1) == verb + 1
        if action is None or (sending and not marked) or self._name_is_place(verb) or noun:
            return None
        self.taken.update(range(end, verb))
        return Piece(at, start, Role.FILLER, norm=self.tokens[at].norm)

    def _separable(self, at: int) -> Piece | None:
        """`bring the drone down`, `where the victim is`."""
        name = self._name(at)
        if name is not None and name.kind in ROBOT_KINDS:
            return None  # "fly the flying machine over the field"
        for entry in self.lexicon.names.get(self.tokens[at].norm, ()):
            if entry.kind is MentionKind.ACTION and len(entry.words) == 2 and entry.words[1] in _SEPARABLE:
                end = self._past_named(at + 1)
                moved = end < len(self.tokens) and self._is_link(end)
                if end > at + 1 and not moved and (after := self._particle(end, entry.words[1])) > end:
                    self.taken.update(range(end, after))
                    return of_entry(entry, at, at + 1, False)
        return None

    def _is_link(self, at: int) -> bool:
        """`over to`, `back to`: a preposition, not the second half of a verb."""
        entry = self.lexicon.longest(self.tokens, at)
        return entry is not None and entry.role is Role.TO and len(entry.words) > 1

    def _particle(self, at: int, particle: str) -> int:
        """Past `down`, `back down to the ground`, `on the ground`; `at` if it does not stand here."""
        start = self._past(at, ("back",)) if particle == "down" else at
        after = self._past(start, (particle,))
        if particle != "down":
            return after
        ground = [t.norm for t in self.tokens[after : after + 3]] in (["on", "the", "ground"], ["to", "the", "ground"])
        grounded = ground and self._name(after + 2) is None
        return after + 3 if grounded else after if after > start else at

    def _leave(self, at: int) -> Piece | None:
        """`leave the rover where it is`, `keep the drone still`: what is named is left out, like after `except`."""
        if self.tokens[at].norm not in ("leave", "keep") or self._past_name(at + 1) == at + 1:
            return None
        end = self._past_name(at + 1)
        tails = LEFT_ALONE if end < len(self.tokens) else ()
        tail = next((t for t in tails if stands_all(self.tokens, end, t)), None)
        closed = tail is not None and self._clause_ends(end + len(tail))
        if tail is None or not closed:
            return None
        self.taken.update(range(end, end + len(tail)))
        self.ends.add(end + len(tail) - 1)
        return Piece(at, at + 1, Role.EXCEPT, norm=self.tokens[at].norm)

    def _bare_go(self, at: int) -> Piece | None:
        """`go!` by itself: off with you, and no word of where."""
        alone = self.tokens[at].norm == "go" and self._clause_begins(at) and self._clause_ends(at + 1)
        return Piece(at, at + 1, Role.FILLER) if alone else None

    def _phrase(self, at: int) -> Piece | None:
        entry = self._longest(at)
        if (opener := self._opener(at)) is not None and (entry is None or len(opener.words) >= len(entry.words)):
            return Piece(at, at + len(opener.words), Role.FILLER)
        if entry is None:
            return None
        end = at + len(entry.words)
        if entry.role is Role.FILLER and entry.words[-1] == "that" and self._pointed_at(end):
            return self._shorter(at, end - 1)
        if entry.role is Role.FILLER and end - at > 1 and self._action(end - 1) is not None:
            return Piece(at, end - 1, Role.FILLER)  # `i need`, where `need` is an action of this crew
        if entry.role is Role.MODAL and end < len(self.tokens) and self.tokens[end].norm in ("i", "we"):
            return Piece(at, end, Role.UNREAD)  # "should I search": a question, no request
        if entry.role is Role.DETERMINER and entry.name in ("that", "this") and self._stands_alone(end):
            return Piece(at, end, Role.PRONOUN, norm="it")
        if entry.role is Role.WHOEVER:
            return self._whoever(at, end)
        return of_entry(entry, at, end, self.tokens[end - 1].possessive)

    def _stands_alone(self, at: int) -> bool:
        """Whether `that` before this place is a pronoun: `put that on the table`."""
        if at >= len(self.tokens):
            return True
        entry = self.lexicon.longest(self.tokens, at)
        linked = entry is not None and entry.role in (Role.TO, Role.AT, Role.FROM, Role.AND, Role.THEN, Role.BREAK)
        return linked or self.tokens[at].shape is Shape.MARK

    def _shorter(self, at: int, end: int) -> Piece:
        """A frame without its last word; its verb is left for itself if this crew has it."""
        return Piece(at, end - 1 if end - at > 1 and self._action(end - 1) is not None else end, Role.FILLER)

    def _counts(self, at: int) -> bool:
        """Whether `one` before this place is an article."""
        name = self._name(at)
        return (
            name is not None and not name.plural and name.kind in (*ROBOT_KINDS, MentionKind.OBJECT, MentionKind.VALUE)
        )

    def _pointed_at(self, at: int) -> bool:
        """Whether `that` before this place points at a thing (`I need that bottle`) and opens no clause."""
        name = self._name(at)
        if name is None or name.kind is MentionKind.ACTION or self._action(at) is not None:
            return False
        if norm_at(self.tokens, at + len(name.words)) in _CLAUSED:
            return False
        verb = self._action(at + len(name.words))
        return verb is None or verb.form is Form.PAST

    def _opener(self, at: int) -> Entry | None:
        """`um`, `right`, `yeah`: nothing is said by them where a clause begins and no name or verb stands in them."""
        entry = self._special(Role.OPENER, at)
        if entry is None or not self._clause_begins(at) or self._action(at) is not None:
            return None
        after = at + len(entry.words)
        modifies = self._name(after) is not None and self._action(after) is None and len(entry.words) == 1
        verb = entry.name in BEFORE_A_MARK and not (after == len(self.tokens) or self.tokens[after].shape is Shape.MARK)
        return None if verb or (modifies and entry.name in _MODIFIERS) else entry

    def _longest(self, at: int) -> Entry | None:
        entry = self.lexicon.longest(self.tokens, at)
        if entry is None:
            return self._special(Role.BE, at)
        if entry.role is not Role.MENTION:
            return entry
        previous = self.pieces[-1].role if self.pieces else None
        named = previous in _NAME_FOLLOWS or (bool(self.pieces) and self.pieces[-1].norm in AFFECTIVE)
        if entry.kind is MentionKind.ACTION:
            return self._namesake(entry, at, MentionKind.ACTION) if named else entry
        if not named and len(entry.words) > 1 and entry.kind not in ROBOT_KINDS:
            return self._action(at, len(entry.words) - 1) or entry  # "search area" at the start of a clause
        return entry if named else self._namesake(entry, at, None)

    def _namesake(self, entry: Entry, at: int, unlike: MentionKind | None) -> Entry:
        """Where a name and an action are spelled alike, the place in the sentence decides."""
        alike = (e for e in self.lexicon.names[self.tokens[at].norm] if e.words == entry.words)
        fits = (e for e in alike if (e.kind is not unlike if unlike else e.kind is MentionKind.ACTION))
        return next(fits, entry)

    def _whoever(self, at: int, end: int) -> Piece:
        """`whoever you find`, `anyone` after a verb that finds: the one value that the verb reports."""
        for verb in range(end, min(end + 5, len(self.tokens))):
            action = self._action(verb)
            if action is not None and (value := self._reported(action.means)) is not None:
                return _value(at, verb + len(action.words), value)
            if self._connective(verb):
                break
        if self._negated():
            return Piece(at, end, Role.FILLER)  # "don't send anyone"
        said = next((t for t in BEFALLEN if stands_all(self.tokens, end, t)), None)
        need = end + len(said or ())
        if said is not None and need < len(self.tokens) and self.tokens[need].norm in IN_NEED:
            known = set(self.lexicon.reports.values())
            away = self._past(self._past(need + 1, ("out",)), ("there",))
            return _value(at, away, known.pop()) if len(known) == 1 else Piece(at, need + 1, Role.UNREAD)
        last = next((p for p in reversed(self.pieces) if p.role not in (Role.FOR, Role.FILLER)), None)
        if last is not None and last.kind is MentionKind.ZONE and self.pieces[-1].role is Role.FOR:
            last = next((p for p in reversed(self.pieces) if p.is_action), None)  # "search the area for anyone"
        value = self._reported(last.means) if last is not None and last.is_action else None
        return Piece(at, end, Role.UNREAD) if value is None else _value(at, end, value)

    def _reported(self, means: tuple[object, ...]) -> str | None:
        found = {self.lexicon.reports.get(getattr(ref, "skill", "")) for ref in means} - {None}
        return found.pop() if len(found) == 1 else None

    def _loose(self, at: int) -> Piece:
        token = self.tokens[at]
        if token.norm == "out" and self.pieces and self.pieces[-1].is_action:
            return Piece(at, at + 1, Role.FILLER)  # "find out", "check out"
        name = self._name(self._past(at + 1, tuple(ARTICLES)))
        if token.norm == "off" and name is not None and name.kind is MentionKind.LOCATION:
            return Piece(at, at + 1, Role.FROM, norm=token.norm)  # "take the cube off the table"
        if token.norm in ("one", "1") and (
            self._counts(at + 1) or (self._counts(at + 2) and norm_at(self.tokens, at + 1) in IN_NEED)
        ):
            return Piece(at, at + 1, Role.DETERMINER, norm="a")
        if token.norm in ("he", "she", "it") and self.pieces and self.pieces[-1].is_robot:
            return Piece(at, at + 1, Role.FILLER)  # "the dog he must go"
        if token.norm in NOTHING_SAID and self._negated():
            return Piece(at, at + 1, Role.FILLER)  # "do not drive anywhere"
        unread = is_numeral(self.tokens, at) or token.norm in _NEVER_NAMES or token.norm.endswith("ly")
        return Piece(at, at + 1, Role.UNREAD if unread else Role.WORD, norm=token.norm, possessive=token.possessive)


_MODIFIERS = frozenset(("right", "like", "fine", "good", "great", "cool", "perfect", "quick"))
"""Openers that would belong to a name that follows at once."""
_CLAUSED = frozenset(("is", "are", "shall", "should", "must", "will"))
_NEVER_NAMES = ADVERBS | frozenset(SELF_WORDS)
_NAME_FOLLOWS = frozenset(
    (Role.DETERMINER, Role.QUANTIFIER, Role.TO, Role.AT, Role.OVER, Role.NEAR, Role.FROM, Role.OF)
)


def _of_figures(found: Figures) -> Piece:
    return Piece(
        found.first, found.after, Role.MENTION, kind=found.kind, name=found.name, values=(found.value,), norm=found.name
    )


def _value(first: int, after: int, value: str) -> Piece:
    return Piece(first, after, Role.MENTION, kind=MentionKind.VALUE, name=value, values=(value,), norm=value)

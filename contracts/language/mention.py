"""What a request says, as data: its mentions, the words that nobody read, and what makes it ambiguous."""

from enum import StrEnum

import msgspec

from crew.contracts.plan import SlotValue, Zone


class MentionKind(StrEnum):
    """What a mention names."""

    ACTION = "action"
    ROBOT = "robot"
    ROBOT_CLASS = "robot_class"
    LOCATION = "location"
    OBJECT = "object"
    ZONE = "zone"
    POINT = "point"
    VALUE = "value"
    ALTITUDE = "altitude"
    NUMBER = "number"
    UNKNOWN = "unknown"


ROBOT_KINDS = (MentionKind.ROBOT, MentionKind.ROBOT_CLASS)


class Direction(StrEnum):
    """Whether a place was given as an origin, as a destination, or as where something is or shall be."""

    NONE = "none"
    FROM = "from"
    TO = "to"
    AT = "at"


class StepRef(msgspec.Struct, frozen=True):
    """One thing that an action word can mean. `contract` and `step` are empty for a skill that no contract uses."""

    contract: str
    step: str
    skill: str
    own: bool = False
    """The contract's step declares the word itself, beside the skill's own words."""


class Mention(msgspec.Struct, frozen=True, kw_only=True):
    """One thing that the request names. `values` holds several for a class word and none for what nobody knows."""

    span: tuple[int, int]
    text: str
    kind: MentionKind
    name: str
    """How to call it in a sentence: the resolved name, the figures, or the verbatim text."""
    positive: bool = True
    direction: Direction = Direction.NONE
    values: tuple[SlotValue, ...] = ()
    every: bool = False
    """A class word that asks for all of its members."""
    means: tuple[StepRef, ...] = ()
    governor: int | None = None
    """Index of the action that this mention belongs to; for an action, of the earlier one whose subject it shares."""
    bare: bool = False
    """An excluded action without an entity of its own: the skill itself is excluded."""
    aside: bool = False
    """Part of what an excluded robot was not to do: excluding the robot says it all."""


class Unread(msgspec.Struct, frozen=True):
    """A word that the reader could not take into account."""

    word: str
    span: tuple[int, int]
    meant: str = ""
    """What it may be a slip of, or what was left unsaid: read so, and asked back."""

    def __str__(self) -> str:
        return f"'{self.word}' (read as '{self.meant}')" if self.meant else f"'{self.word}'"


class Ambiguity(msgspec.Struct, frozen=True):
    """Why the request can be read in more than one way, and where."""

    why: str
    span: tuple[int, int]


class Reading(msgspec.Struct, frozen=True, kw_only=True):
    """A request as it was read. Nothing in it was guessed: what was not understood is in `unread`."""

    text: str
    mentions: tuple[Mention, ...] = ()
    unread: tuple[Unread, ...] = ()
    ambiguous: tuple[Ambiguity, ...] = ()
    orders: tuple[tuple[int, int], ...] = ()
    """Pairs of actions, by index in `mentions`: the first was asked to come before the second."""
    passed_over: tuple[Unread, ...] | msgspec.UnsetType = msgspec.UNSET
    """As `noted`; not written down where there is nothing to note, so that older journals still verify."""

    @property
    def noted(self) -> tuple[Unread, ...]:
        """What was left out as no part of the request, or read as the word that it is a slip of, without asking."""
        return () if isinstance(self.passed_over, msgspec.UnsetType) else self.passed_over

    @property
    def wanted(self) -> tuple[Mention, ...]:
        return tuple(m for m in self.mentions if m.positive)

    @property
    def excluded(self) -> tuple[Mention, ...]:
        return tuple(m for m in self.mentions if not m.positive)

    @property
    def actions(self) -> tuple[Mention, ...]:
        """The actions that were asked for."""
        return tuple(m for m in self.mentions if m.positive and m.kind is MentionKind.ACTION)

    def robots_of(self, action: Mention) -> tuple[Mention, ...]:
        """The robots that were named for an action."""
        index = self.mentions.index(action)
        named = tuple(m for m in self.wanted if m.kind in ROBOT_KINDS and m.governor == index)
        return named or (() if action.governor is None else self.robots_of(self.mentions[action.governor]))

    @property
    def excluded_areas(self) -> tuple[Zone, ...]:
        """Zones that nothing may enter; a place that is known only at run time must be compared when it is."""
        return tuple(v for m in self.excluded for v in m.values if isinstance(v, Zone))

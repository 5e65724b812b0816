"""The working unit of the reader: one phrase of the request with what it does or names. Mutable while reading."""

from dataclasses import dataclass, field

from crew.contracts.language.entry import Entry
from crew.contracts.language.inflect import Form
from crew.contracts.language.mention import ROBOT_KINDS, Direction, MentionKind, StepRef
from crew.contracts.language.words import Role
from crew.contracts.plan import SlotValue

ENTITY_KINDS = frozenset(k for k in MentionKind if k is not MentionKind.ACTION)
PLACE_ROLES = frozenset((Role.TO, Role.AT, Role.NEAR, Role.FROM))
PREPOSITIONS = PLACE_ROLES | {Role.OVER, Role.OF, Role.FOR, Role.WITH}
SOFT = frozenset((Role.FILLER, Role.MODAL, Role.DETERMINER, Role.QUANTIFIER, Role.FIRST))
"""What may stand between two words that belong together."""


@dataclass(slots=True, eq=False)
class Piece:
    """Tokens `first` up to `after`."""

    first: int
    after: int
    role: Role
    norm: str = ""
    kind: MentionKind | None = None
    name: str = ""
    values: tuple[SlotValue, ...] = ()
    means: tuple[StepRef, ...] = ()
    form: Form = Form.BASE
    modifiers: frozenset[str] = field(default_factory=frozenset)
    near_is_at: bool = False
    possessive: bool = False
    every: bool = False
    positive: bool = True
    bare: bool = False
    aside: bool = False
    direction: Direction = Direction.NONE
    governor: "Piece | None" = None

    @property
    def is_action(self) -> bool:
        return self.kind is MentionKind.ACTION

    @property
    def is_entity(self) -> bool:
        return self.kind in ENTITY_KINDS

    @property
    def is_robot(self) -> bool:
        return self.kind in ROBOT_KINDS

    def become(self, role: Role) -> None:
        """Name nothing any more."""
        self.role, self.kind = role, None

    def become_unknown(self, first: int, after: int) -> None:
        """Name something that nobody knows, over these tokens."""
        self.first, self.after, self.role = first, after, Role.MENTION
        self.kind, self.values, self.means, self.possessive = MentionKind.UNKNOWN, (), (), False

    def resolve(self, other: "Piece") -> None:
        """Name what another piece names."""
        self.role, self.kind, self.name, self.values = Role.MENTION, other.kind, other.name, other.values
        self.every, self.near_is_at = other.every, other.near_is_at


def of_entry(entry: Entry, first: int, after: int, possessive: bool) -> Piece:
    """The piece for a phrase of the lexicon."""
    return Piece(
        first,
        after,
        entry.role,
        norm=entry.name,
        kind=entry.kind if entry.role is Role.MENTION else None,
        name=entry.name,
        values=entry.values,
        means=entry.means,
        form=entry.form,
        modifiers=entry.modifiers,
        near_is_at=entry.near_is_at,
        possessive=possessive,
        every=entry.plural,
    )


def before(pieces: list[Piece], at: int, passing: frozenset[Role] = SOFT) -> Piece | None:
    """The nearest earlier piece that is not soft."""
    for index in range(at - 1, -1, -1):
        if pieces[index].role not in passing:
            return pieces[index]
    return None


def behind(pieces: list[Piece], at: int, passing: frozenset[Role] = SOFT) -> Piece | None:
    """The nearest later piece that is not soft."""
    for index in range(at + 1, len(pieces)):
        if pieces[index].role not in passing:
            return pieces[index]
    return None

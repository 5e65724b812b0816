"""Workflow contracts as data: who may do what, in which order, under which guards, and what must never happen.

Semantics live in `matching`, `gate` and `mission`; files are read by `contract_file`.
"""

from collections.abc import Mapping
from enum import StrEnum
from functools import cached_property

import msgspec

from crew.contracts.plan import SlotValue, digest
from crew.contracts.skill import FluentLiteral


class SlotType(StrEnum):
    """The type of a request variable. `value` is a named run-time value (see `Slot.values`)."""

    OBJECT = "object"
    LOCATION = "location"
    ZONE = "zone"
    POINT = "point"
    ALTITUDE = "altitude"
    VALUE = "value"


class Slot(msgspec.Struct, frozen=True, kw_only=True):
    """A request variable shared by all steps."""

    name: str
    types: tuple[SlotType, ...]
    values: tuple[str, ...] = ()
    """Names of the run-time values that a `value` slot accepts."""
    default: SlotValue | None = None
    free: bool = False
    """The planner may choose within the skill's bounds."""
    optional: bool = False
    said_from: bool = False
    """A claim about an origin: it licenses no destination."""
    beyond: str = ""
    """A role: only places that the robot in it does not reach."""


class Condition(msgspec.Struct, frozen=True, kw_only=True):
    """`path: value`, `path: {not: value}`, guarded by `if: {slot: value}`. Unknown never holds.

    Paths: `<role>.<fluent>`, `<slot or value>.<attribute>`, or a run-time value's name for its status.
    A `value` that begins with `$` is a slot's value.
    """

    path: str
    value: FluentLiteral
    negated: bool = False
    when: Mapping[str, str] = {}
    """Slot to value (or `given`): the condition counts only if the slot is bound so."""
    line: int = 0

    def __str__(self) -> str:
        shown = str(self.value).lower() if isinstance(self.value, bool) else self.value
        clause = f"{self.path} is {'not ' if self.negated else ''}{shown}"
        prefix = "".join(f"if {slot} is {value}, " for slot, value in self.when.items())
        return prefix + clause


class SafeState(msgspec.Struct, frozen=True):
    """How a role is brought to safety: the skill to call and the fluents that must then hold."""

    by: str
    reach: Mapping[str, FluentLiteral]


class Role(msgspec.Struct, frozen=True, kw_only=True):
    """A part that one robot plays throughout a mission. `safe` None means an explicit `stay`."""

    name: str
    safe: SafeState | None = None
    line: int = 0


class CallPattern(msgspec.Struct, frozen=True):
    """One admissible call of a step: arguments are literals, `$slot` or `$slot.field`."""

    skill: str
    args: Mapping[str, str | float] = {}


class Step(msgspec.Struct, frozen=True, kw_only=True):
    """One step of a workflow."""

    name: str
    role: str
    do: tuple[CallPattern, ...]
    after: tuple[str, ...] = ()
    optional: bool = False
    needs: tuple[Condition, ...] = ()
    words: tuple[str, ...] = ()
    """Action words of a request that mean this step, beside the skill's own."""
    approval: bool = False
    line: int = 0


class Never(msgspec.Struct, frozen=True, kw_only=True):
    """A property for the proof; the gate never reads it. `starts` is `<role>.<skill>`."""

    starts: str
    with_args: Mapping[str, str | float] = {}
    without_args: Mapping[str, str | float] = {}
    """Arguments that must differ (`{not: value}` in the file)."""
    when: tuple[Condition, ...] = ()
    why: str = ""
    line: int = 0


class Contract(msgspec.Struct, frozen=True, kw_only=True, dict=True):
    """A workflow contract, as loaded and checked against the crew's kinds."""

    name: str
    summary: str
    examples: tuple[str, ...] = ()
    slots: tuple[Slot, ...] = ()
    roles: tuple[Role, ...] = ()
    needs: tuple[Condition, ...] = ()
    steps: tuple[Step, ...] = ()
    asks: tuple[str, ...] = ()
    never: tuple[Never, ...] = ()
    complete: tuple[Condition, ...] = ()
    deadline_s: float = 600.0
    preempts: bool = False
    source: str = ""

    @cached_property
    def digest(self) -> str:
        """Of everything that it says; not of where its file lies."""
        return digest(msgspec.structs.replace(self, source=""))

    @cached_property
    def has_claims(self) -> bool:
        """Whether the request alone may bind a slot: one that says where something is from."""
        return any(slot.said_from for slot in self.slots)

    @cached_property
    def _step_by_name(self) -> dict[str, Step]:
        return {s.name: s for s in self.steps}

    def step(self, name: str) -> Step | None:
        return self._step_by_name.get(name)

    def slot(self, name: str) -> Slot | None:
        return next((s for s in self.slots if s.name == name), None)

    def role(self, name: str) -> Role | None:
        return next((r for r in self.roles if r.name == name), None)

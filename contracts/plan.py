"""Plans as a planner proposes them, and instances as the gate sees them."""

import hashlib
from collections.abc import Mapping
from functools import cached_property

import msgspec

ArgValue = str | float
"""A number, or a name: a location, an object, a run-time value's symbol."""


class Zone(msgspec.Struct, frozen=True, tag="zone"):
    """An axis-aligned rectangle, world ENU, metres."""

    x_min: float
    x_max: float
    y_min: float
    y_max: float

    def contains(self, x: float, y: float) -> bool:
        return self.x_min <= x <= self.x_max and self.y_min <= y <= self.y_max

    def covers(self, other: "Zone") -> bool:
        return self.contains(other.x_min, other.y_min) and self.contains(other.x_max, other.y_max)

    def overlaps(self, other: "Zone") -> bool:
        return (
            self.x_min < other.x_max
            and other.x_min < self.x_max
            and self.y_min < other.y_max
            and other.y_min < self.y_max
        )


class Spot(msgspec.Struct, frozen=True, tag="spot"):
    """A horizontal point that a person wrote in figures, world ENU, metres."""

    x: float
    y: float


SlotValue = str | float | Zone | Spot
"""What a slot of a contract is bound to: a name, a number, a zone or a point."""


class Call(msgspec.Struct, frozen=True):
    """One skill of one robot with its arguments, as yet unchecked."""

    robot: str
    skill: str
    args: Mapping[str, ArgValue] = {}

    def __str__(self) -> str:
        inner = ", ".join(f"{k}={_show(v)}" for k, v in self.args.items())
        return f"{self.robot}.{self.skill}({inner})"


class Plan(msgspec.Struct, frozen=True):
    """A contract's name and an ordered list of calls: a proposal, never a command."""

    contract: str
    steps: tuple[Call, ...] = ()


class InstanceStep(msgspec.Struct, frozen=True, kw_only=True):
    """One call of the plan, tied to the step of the contract that it fills."""

    step: str
    role: str
    call: Call
    after: tuple[str, ...]
    """Present predecessors: `after`, closed over optional steps that the plan leaves out."""


class Instance(msgspec.Struct, frozen=True, kw_only=True, dict=True):
    """A plan matched to its contract under one binding of roles and slots."""

    contract: str
    roles: Mapping[str, str]
    slots: Mapping[str, SlotValue]
    steps: tuple[InstanceStep, ...]

    @cached_property
    def _step_by_name(self) -> dict[str, InstanceStep]:
        return {s.step: s for s in self.steps}

    def step(self, name: str) -> InstanceStep | None:
        return self._step_by_name.get(name)


def digest(value: object) -> str:
    """SHA-256 over the canonical msgpack of any of the core's structs."""
    return hashlib.sha256(msgspec.msgpack.encode(value, order="deterministic")).hexdigest()


def _show(value: ArgValue) -> str:
    return value if isinstance(value, str) else f"{value:g}"

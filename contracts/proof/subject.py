"""What conditions speak of, read anew for the proof: nothing here may come from the gate."""

from collections.abc import Iterable, Iterator, Mapping
from typing import NamedTuple

from crew.contracts.contract import Condition
from crew.contracts.plan import SlotValue, Spot
from crew.contracts.snapshot import FluentValue, Point

STATUS = "status"


class Var(NamedTuple):
    """One thing that a condition can ask for: a robot's fluent, or an attribute of a run-time value."""

    owner: str
    name: str

    def __str__(self) -> str:
        return self.owner if self.name == STATUS else f"{self.owner}.{self.name}"


Names = Mapping[str, str]
"""Role to robot."""
Slots = Mapping[str, SlotValue]


def subject(path: str, roles: Names, slots: Slots) -> Var | None:
    """The variable that a path names; None for a role that nobody plays."""
    head, _, attribute = path.partition(".")
    if head in roles:
        return Var(roles[head], attribute)
    bound = slots.get(head)
    return Var(bound if isinstance(bound, str) else head, attribute or STATUS)


def wanted(condition: Condition, slots: Slots) -> FluentValue | None:
    """The value on the right side; None if it is a slot that is not bound."""
    value = condition.value
    if not isinstance(value, str) or not value.startswith("$"):
        return value
    bound = slots.get(value[1:])
    if isinstance(bound, Spot):
        return Point(bound.x, bound.y)
    return bound if isinstance(bound, str | float) else None


def asked(conditions: Iterable[Condition], roles: Names, slots: Slots) -> Iterator[tuple[Var, FluentValue]]:
    """What conditions ask for, where their `if` is met and their names mean something."""
    for condition in conditions:
        var, value = subject(condition.path, roles, slots), wanted(condition, slots)
        if counts(condition, slots) and var is not None and value is not None:
            yield var, value


def counts(condition: Condition, slots: Slots) -> bool:
    """Whether the `if` in front is met."""
    bound = {slot: slots.get(slot) for slot in condition.when}
    return all(bound[slot] == value or (value == "given" and bound[slot] is not None)
               for slot, value in condition.when.items())  # fmt: skip

"""Properties that contracts declare with `never`, judged by code of their own: the gate has no part in it."""

from collections.abc import Callable, Iterator, Mapping
from itertools import permutations

import msgspec

from crew.contracts.contract import Condition, Contract, Never
from crew.contracts.plan import Call, Instance, SlotValue
from crew.contracts.proof.subject import Names, Slots, Var, asked, counts, subject, wanted
from crew.contracts.snapshot import FluentValue

Values = Mapping[Var, FluentValue]


class Watch(msgspec.Struct, frozen=True, kw_only=True):
    """One `never` under one binding: who plays its roles, what its slots are."""

    contract: Contract
    never: Never
    roles: Names
    slots: Slots

    @property
    def where(self) -> str:
        return f"{self.contract.source or self.contract.name}:{self.never.line}"

    def concerns(self, call: Call) -> bool:
        """Whether this call is the start that the property speaks of."""
        role, _, skill = self.never.starts.partition(".")
        if call.robot != self.roles.get(role) or call.skill != skill:
            return False
        same = all(call.args.get(n) == self._meant(v) for n, v in self.never.with_args.items())
        differs = (n in call.args and call.args[n] != self._meant(v) for n, v in self.never.without_args.items())
        return same and all(differs)

    def asks(self) -> Iterator[tuple[Var, FluentValue]]:
        """The variables that its `while` asks for, and the values."""
        yield from asked(self.never.when, self.roles, self.slots)

    def broken(self, values: Values) -> bool:
        """Whether the forbidden state is there."""
        return bool(self.never.when) and all(self._true(c, values) for c in self.never.when)

    def _meant(self, value: str | float) -> SlotValue | None:
        return self.slots.get(value[1:]) if isinstance(value, str) and value.startswith("$") else value

    def _true(self, condition: Condition, values: Values) -> bool:
        return counts(condition, self.slots) and holds(condition, self.roles, self.slots, values)


def holds(condition: Condition, roles: Names, slots: Slots, values: Values) -> bool:
    """Whether a condition is true of these values; a variable without a value is nothing in particular."""
    var, value = subject(condition.path, roles, slots), wanted(condition, slots)
    if var is None or value is None:
        return False
    return (values.get(var) == value) is not condition.negated


def own_watches(contract: Contract, instance: Instance, slots: Slots) -> Iterator[Watch]:
    """The properties of the contract that the plan itself follows."""
    for never in contract.never:
        yield Watch(contract=contract, never=never, roles=instance.roles, slots=slots)


def foreign_watches(
    other: Contract, slots: Slots, instance: Instance, able: Callable[[str], list[str]]
) -> Iterator[Watch]:
    """The properties of a contract that the request could also have meant, for all robots able to play its roles.

    Its roles are played by robots of the plan where they can be.
    """
    acting = set(instance.roles.values())
    for never in other.never:
        role, _, skill = never.starts.partition(".")
        if not any(item.call.skill == skill for item in instance.steps):
            continue
        names = list(dict.fromkeys([role, *(c.path.partition(".")[0] for c in never.when)]))
        roles = [name for name in names if other.role(name) is not None]
        for cast in _casts(roles, acting, able):
            yield Watch(contract=other, never=never, roles=cast, slots=slots)


def _casts(roles: list[str], acting: set[str], able: Callable[[str], list[str]]) -> Iterator[dict[str, str]]:
    offers = {role: able(role) for role in roles}
    narrowed = {role: [r for r in robots if r in acting] or robots for role, robots in offers.items()}
    everyone = sorted({robot for robots in narrowed.values() for robot in robots})
    for picked in permutations(everyone, len(roles)):
        if all(robot in narrowed[role] for role, robot in zip(roles, picked, strict=True)):
            yield dict(zip(roles, picked, strict=True))


__all__ = ["Watch", "foreign_watches", "holds", "own_watches"]

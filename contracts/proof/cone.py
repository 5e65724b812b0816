"""The cone of influence of one decision: what it reads, and the worlds that it can tell apart."""

from collections.abc import Iterable, Iterator, Mapping
from itertools import product
from typing import NamedTuple

from crew.contracts.proof.subject import STATUS, Var
from crew.contracts.proof.trouble import Facts
from crew.contracts.proof.world import CONDITIONS, OK, READABLE, Ground, Possible
from crew.contracts.snapshot import FluentValue

Classes = tuple[tuple[Var, Possible], ...]


class World(NamedTuple):
    """One world of a cone: a value for each variable, and all values that the decision can't tell from it."""

    facts: Facts
    alike: Classes


class Cone:
    """Variables with the values that they are compared with."""

    def __init__(self, asked: Iterable[tuple[Var, FluentValue]], bound: Iterable[str], ground: Ground) -> None:
        self._ground = ground
        self._compared: dict[Var, set[FluentValue]] = {}
        for var, value in asked:
            self._compared.setdefault(var, set()).add(value)
        self._owners = sorted({*bound, *(var.owner for var in self._compared if ground.is_value(var))})
        self.fluents = tuple(sorted(var for var in self._compared if not ground.is_value(var)))

    def worlds(self, possible: Mapping[Var, Possible]) -> Iterator[World]:
        """All worlds that can be told apart, with every run-time value in order unless its condition is asked for."""
        offers = [self._classes(var, possible.get(var, self._ground.domain(var))) for var in self.fluents]
        values = [self._conditions(owner) for owner in self._owners]
        for told in product(*values):
            for classes in product(*offers):
                alike = tuple(zip(self.fluents, classes, strict=True))
                facts = (*((var, min(c, key=str)) for var, c in alike), *(fact for some in told for fact in some))
                yield World(facts, alike)

    def is_disorder(self, world: World) -> bool:
        """Whether a run-time value is not in order."""
        told = dict(world.facts)
        return any(told[Var(owner, STATUS)] != OK for owner in self._owners)

    def disorders(self, world: World) -> Iterator[World]:
        """The same world with one of its run-time values in another condition."""
        for owner in self._owners:
            status = Var(owner, STATUS)
            for condition in CONDITIONS:
                facts = tuple((var, condition if var == status else value) for var, value in world.facts)
                if facts != world.facts:
                    yield World(facts, world.alike)

    def _classes(self, var: Var, possible: Possible) -> list[Possible]:
        """What a variable may be, split by the values that it is compared with."""
        compared = self._compared.get(var, set())
        known = [frozenset((value,)) for value in sorted(possible & compared, key=str)]
        rest = possible - compared
        return [*known, rest] if rest else known

    def _conditions(self, owner: str) -> list[Facts]:
        """What a run-time value may be, attributes included."""
        attributes = sorted(var for var in self._compared if var.owner == owner and var.name != STATUS)
        offers = [[min(c, key=str) for c in self._classes(var, self._ground.domain(var))] for var in attributes]
        status = Var(owner, STATUS)
        wanted = CONDITIONS if status in self._compared else (OK,)
        return [
            ((status, condition), *zip(attributes, values, strict=True))
            for condition in wanted
            for values in (product(*offers) if condition in READABLE else [[offer[0] for offer in offers]])
        ]

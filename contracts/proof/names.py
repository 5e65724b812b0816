"""Which names a proof needs: those that rules mention, and two of each sort that nothing tells apart."""

from collections.abc import Iterable, Iterator
from math import hypot

from crew.contracts.contract import Condition, Contract
from crew.contracts.site import Location, Rules

TWINS = 2
"""Of names that nothing tells apart, one may be meant and another may be there instead."""


def locations(rules: Rules) -> tuple[str, ...]:
    """Locations that stand for all of the crew's."""
    kept = {name for group in sorts(rules) for name in group[:TWINS]}
    return tuple(p.name for p in rules.crew.locations if p.name in kept or _is_special(p, rules))


def objects(rules: Rules) -> tuple[str, ...]:
    """Objects that stand for all of the crew's."""
    kept = {name for group in sorts(rules) for name in group[:TWINS]} | mentioned(rules)
    return tuple(thing.name for thing in rules.crew.objects if thing.name in kept)


def sorts(rules: Rules) -> tuple[tuple[str, ...], ...]:
    """Names that nothing tells apart: no contract mentions them, the same robots reach them, none is near another."""
    groups: dict[tuple[str, ...], list[str]] = {}
    for place in rules.crew.locations:
        if not _is_special(place, rules):
            reached = tuple(spec.name for spec in rules.crew.robots if place.name in spec.reach)
            groups.setdefault(("location", *reached), []).append(place.name)
    known = mentioned(rules)
    for thing in rules.crew.objects:
        if thing.name not in known:
            groups.setdefault(("object",), []).append(thing.name)
    return tuple(tuple(group) for group in groups.values())


def is_first_of_its_sort(values: Iterable[object], rules: Rules) -> bool:
    """Whether names that nothing tells apart are used in the order of the crew file: no renaming of another choice."""
    used = list(dict.fromkeys(value for value in values if isinstance(value, str)))
    return all([name for name in used if name in group] == list(group[: sum(n in group for n in used)])
               for group in sorts(rules))  # fmt: skip


def mentioned(rules: Rules) -> frozenset[str]:
    """Every name that a contract of the rules writes down itself."""
    return frozenset(name for contract in rules.contracts.values() for name in _written(contract))


def conditions(contract: Contract) -> Iterator[Condition]:
    """Every condition of a contract, wherever it stands."""
    yield from contract.needs
    yield from contract.complete
    for step in contract.steps:
        yield from step.needs
    for never in contract.never:
        yield from never.when


def _written(contract: Contract) -> Iterator[str]:
    values: list[object] = [slot.default for slot in contract.slots]
    for condition in conditions(contract):
        values += [condition.path.partition(".")[0], condition.value, *condition.when.values()]
    for step in contract.steps:
        values += [value for pattern in step.do for value in pattern.args.values()]
    for never in contract.never:
        values += [*never.with_args.values(), *never.without_args.values()]
    for role in contract.roles:
        values += [] if role.safe is None else role.safe.reach.values()
    return _texts(values)


def _texts(values: Iterable[object]) -> Iterator[str]:
    return (value for value in values if isinstance(value, str))


def _is_special(place: Location, rules: Rules) -> bool:
    """Whether a contract names the place, or telemetry could take it for another one."""
    kinds = rules.kinds.values()
    widest = max((f.tolerance_m for kind in kinds for f in kind.fluents), default=0.0)
    if place.name in mentioned(rules):
        return True
    others = (p for p in rules.crew.locations if p.name != place.name)
    return any(hypot(p.x - place.x, p.y - place.y) <= 2 * widest for p in others)

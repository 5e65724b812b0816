"""Guards in a contract file: what the path names, and whether its value can ever be that."""

from crew.contracts.contract import SlotType
from crew.contracts.files.contract_model import GuardModel
from crew.contracts.files.contract_scope import Scope
from crew.contracts.files.contract_value import check_operand
from crew.contracts.files.source import Loc, Problems

GIVEN = "given"
"""In an `if`: the slot is bound, whatever to."""
VALUE_ATTRIBUTES = {"status": "status", "near": "bool", "at": "place"}
OBJECT_ATTRIBUTES = {"at": "place"}


def check_guards(guards: list[GuardModel], loc: Loc, scope: Scope, problems: Problems) -> None:
    for index, guard in enumerate(guards):
        check_guard(guard, (*loc, index), scope, problems)


def check_guard(guard: GuardModel, loc: Loc, scope: Scope, problems: Problems) -> None:
    """Every clause of one mapping, and the `if` in front of it."""
    if not guard.clauses:
        problems.at(loc, "a guard without a path", fix="write `path: value`, as in {carrier.at: pickup}")
    for slot, value in guard.when.items():
        _check_when(slot, value, (*loc, "if", slot), scope, problems)
    for path, compared in guard.clauses.items():
        where: Loc = (*loc, path)
        domain = _domain(path, where, scope, problems)
        if domain is not None:
            operand: Loc = (*where, "not") if compared.negated else where
            check_operand(compared.value, domain, operand, scope, problems)


def _check_when(name: str, value: str, loc: Loc, scope: Scope, problems: Problems) -> None:
    """Slots that are bound to numbers (zones, points, altitudes) can only be `given`."""
    slot = scope.slots.get(name)
    if slot is None:
        problems.unknown(loc, "unknown slot", name, scope.slots, key=True)
        return
    names: dict[SlotType, list[str]] = {
        SlotType.OBJECT: scope.objects,
        SlotType.LOCATION: scope.locations,
        SlotType.VALUE: list(slot.values),
    }
    valid = [GIVEN, *(word for kind in slot.types for word in names.get(kind, []))]
    if value not in valid:
        problems.unknown(loc, f"slot {name} is never that", value, valid)


def _domain(path: str, loc: Loc, scope: Scope, problems: Problems) -> str | None:
    """The domain of what the path names, or None with the problem recorded."""
    head, dot, attribute = path.partition(".")
    if head in scope.casts:
        return _fluent_domain(head, attribute, loc, scope, problems)
    if head in scope.values:
        return _attribute_domain(
            f"run-time value {head}", attribute if dot else "status", loc, VALUE_ATTRIBUTES, problems
        )
    if head in scope.slots:
        return _slot_domain(head, attribute, dot, loc, scope, problems)
    valid = [f"{role}.{f.name}" for role in scope.casts for kind in scope.kinds_of(role) for f in kind.fluents]
    problems.unknown(loc, "a guard on nothing known", path, [*valid, *scope.values, *scope.slots], key=True)
    return None


def _fluent_domain(role: str, name: str, loc: Loc, scope: Scope, problems: Problems) -> str | None:
    fluent = scope.fluent_of(role, name)
    if fluent is not None:
        return fluent.domain
    kinds = scope.kinds_of(role)
    valid = [f"{role}.{f.name}" for f in (kinds[0].fluents if kinds else ()) if scope.fluent_of(role, f.name)]
    what = f"unknown fluent of {' or '.join(kind.name for kind in kinds) or 'the role'}"
    problems.unknown(loc, what, f"{role}.{name}" if name else role, valid, key=True)
    return None


def _slot_domain(name: str, attribute: str, dot: str, loc: Loc, scope: Scope, problems: Problems) -> str | None:
    kinds = scope.slots[name].types
    if not kinds:
        return None
    attributes: dict[str, str] = {}
    if SlotType.OBJECT in kinds:
        attributes |= OBJECT_ATTRIBUTES
    if SlotType.VALUE in kinds:
        attributes |= VALUE_ATTRIBUTES
    if kinds == (SlotType.VALUE,) and not dot:
        return "status"
    return _attribute_domain(f"slot {name}", attribute, loc, attributes, problems)


def _attribute_domain(
    owner: str, attribute: str, loc: Loc, attributes: dict[str, str], problems: Problems
) -> str | None:
    domain = attributes.get(attribute)
    if domain is None:
        problems.unknown(
            loc, f"{owner} has no such attribute", str(loc[-1]), _dotted(str(loc[-1]), attributes), key=True
        )
    return domain


def _dotted(path: str, attributes: dict[str, str]) -> list[str]:
    return [f"{path.partition('.')[0]}.{name}" for name in attributes]

"""Values in a contract file against what they stand for: arguments of skills, operands of guards, defaults of slots."""

import math
from collections.abc import Set as AbstractSet

from crew.contracts.contract import Slot, SlotType
from crew.contracts.files.contract_scope import PLACE_SLOTS, Scope, fields_of
from crew.contracts.files.file_model import advice, show
from crew.contracts.files.source import Loc, Problems
from crew.contracts.site import Crew
from crew.contracts.skill import NOTHING, Entity, Param
from crew.contracts.snapshot import STATUSES

_DOMAIN_SLOTS = {
    "place": PLACE_SLOTS,
    "object": {SlotType.OBJECT},
    "number": {SlotType.ALTITUDE},
}


def check_operand(value: bool | float | str, domain: str, loc: Loc, scope: Scope, problems: Problems) -> None:
    """The right side of a guard against the domain of its left side."""
    if isinstance(value, str) and value.startswith("$"):
        _check_slot(value, _DOMAIN_SLOTS.get(domain, set()), f"a guard on {_article(domain)}", loc, scope, problems)
    elif domain in ("bool", "number"):
        fits = isinstance(value, bool) if domain == "bool" else isinstance(value, float)
        if not fits:
            allowed = "true or false" if domain == "bool" else "a number"
            fix = advice(value, allowed, loc)
            problems.at(loc, "value outside the domain", observed=show(value), allowed=allowed, fix=fix)
    elif not isinstance(value, str):
        problems.at(loc, "value outside the domain", observed=show(value), allowed=f"the name of {_article(domain)}")
    elif value not in (valid := _operands(domain, scope)):
        problems.unknown(loc, f"unknown {domain}", value, valid)


def _article(noun: str) -> str:
    return f"an {noun}" if noun.startswith("o") else f"a {noun}"


def _operands(domain: str, scope: Scope) -> list[str]:
    if domain == "status":
        return list(STATUSES)
    return [*scope.objects, NOTHING] if domain == "object" else scope.locations + scope.values


def check_argument(value: bool | float | str, param: Param, loc: Loc, scope: Scope, problems: Problems) -> None:
    """One argument of a call against its declaration."""
    if isinstance(value, str) and value.startswith("$"):
        if "." in value and value[1:].partition(".")[0] in scope.slots:
            _check_field(value, param, loc, scope, problems)
        else:
            _check_slot(value, _argument_slots(param), f"argument {param.name}", loc, scope, problems)
        _check_default_fits(value, param, scope, problems)
    elif param.is_number:
        _check_number(value, param, loc, scope.crew, problems)
    elif not isinstance(value, str):
        allowed = f"the name of {_article(param.entity)}"
        problems.at(loc, f"argument {param.name} is no name", observed=show(value), allowed=allowed)
    elif value not in (valid := _names(param, scope)):
        problems.unknown(loc, f"unknown {param.entity}", value, valid)


def _check_number(value: bool | float | str, param: Param, loc: Loc, crew: Crew, problems: Problems) -> None:
    if isinstance(value, str):
        fix = advice(value, "a number", (*loc, f"_{param.unit}"))
        problems.at(loc, f"argument {param.name} is no number", observed=show(value), allowed="a number", fix=fix)
        return
    low, high = _bounds(param, crew)
    if not low <= value <= high:
        allowed = f"{low:g} to {high:g} {param.unit}".strip()
        problems.at(loc, f"argument {param.name} out of bounds", observed=show(value), allowed=allowed)


def _bounds(param: Param, crew: Crew) -> tuple[float, float]:
    low = -math.inf if param.ge is None else param.ge
    high = math.inf if param.le is None else param.le
    sides = {"x": (crew.area.x_min, crew.area.x_max), "y": (crew.area.y_min, crew.area.y_max)}
    side = sides.get(param.axis, (low, high))
    return max(low, side[0]), min(high, side[1])


def _check_default_fits(reference: str, param: Param, scope: Scope, problems: Problems) -> None:
    slot = scope.slots.get(reference[1:])
    if slot is not None and isinstance(slot.default, float) and param.is_number:
        _check_number(slot.default, param, ("slots", slot.name, "default"), scope.crew, problems)


def _argument_slots(param: Param) -> AbstractSet[SlotType]:
    if param.is_number:
        return {SlotType.ALTITUDE}
    if param.entity is Entity.OBJECT:
        return {SlotType.OBJECT}
    values = {SlotType.VALUE} if param.entity is Entity.TARGET else set()
    return {SlotType.LOCATION, *values}


def _names(param: Param, scope: Scope) -> list[str]:
    if param.entity is Entity.OBJECT:
        return scope.objects
    places = [place.name for place in scope.crew.locations]
    return places + (scope.values if param.entity is Entity.TARGET else scope.parts)


def _check_field(written: str, param: Param, loc: Loc, scope: Scope, problems: Problems) -> None:
    """`$slot.field` is a number that one of the slot's types has."""
    name, _, field = written[1:].partition(".")
    fields = fields_of(scope.slots[name])
    if field not in fields:
        problems.unknown(loc, f"slot {name} has no such field", written, [f"${name}.{known}" for known in fields])
    elif not param.is_number:
        allowed = _slot_words(_argument_slots(param))
        problems.at(loc, f"argument {param.name} takes no number", observed=written, allowed=allowed)


def _check_slot(
    written: str, wanted: AbstractSet[SlotType], purpose: str, loc: Loc, scope: Scope, problems: Problems
) -> None:
    """`$slot` must be a slot of which some type is wanted."""
    slot = scope.slots.get(written[1:])
    if slot is None:
        problems.unknown(loc, "unknown slot", written, [f"${known}" for known in scope.slots])
    elif slot.types and not wanted & set(slot.types):
        observed = f"{written}, which is {_slot_words(set(slot.types))}"
        problems.at(loc, f"{purpose} can't be this slot", observed=observed, allowed=_slot_words(wanted))


def _slot_words(types: AbstractSet[SlotType]) -> str:
    return " or ".join("a run-time value" if t is SlotType.VALUE else t.value for t in sorted(types)) or "no slot"


def check_default(slot: Slot, scope: Scope, problems: Problems) -> None:
    """A default must be a value of one of the slot's types."""
    if slot.default is None:
        return
    loc: Loc = ("slots", slot.name, "default")
    if isinstance(slot.default, float):
        if slot.types and SlotType.ALTITUDE not in slot.types:
            allowed = " or ".join(slot.types)
            problems.at(loc, "default of another type", observed=show(slot.default), allowed=f"a {allowed}")
        return
    names = {
        SlotType.OBJECT: scope.objects,
        SlotType.LOCATION: scope.locations,
        SlotType.ZONE: scope.zones,
        SlotType.VALUE: list(slot.values),
    }
    valid = [name for kind in slot.types for name in names.get(kind, [])]
    if slot.types and slot.default not in valid:
        number = ["a number"] if SlotType.ALTITUDE in slot.types else []
        problems.unknown(loc, "default of another type", str(slot.default), valid + number)

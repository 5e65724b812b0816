"""Requests as the proof sees them: which values a person named. Language is switched off; words are whatever fits.

Whether a plan holds what was asked for is said by the real containment check alone.
"""

from collections.abc import Iterator, Mapping, Sequence
from itertools import product

from crew.contracts.contract import Contract, Slot, SlotType
from crew.contracts.language.containment import Finding, check_containment
from crew.contracts.language.licence import licensed_values, resolved, used_slots
from crew.contracts.language.mention import Direction, Mention, MentionKind, Reading, StepRef
from crew.contracts.plan import Instance, SlotValue, Spot, Zone
from crew.contracts.proof.names import is_first_of_its_sort, locations, objects
from crew.contracts.site import Rules


def requests(instance: Instance, rules: Rules) -> Iterator[Reading]:
    """The shortest request that could ask for this plan, and those that also claim what no call carries."""
    contract = rules.contracts[instance.contract]
    plain = (*_actions(contract, instance), *_slots(contract, instance, rules))
    claimed = [slot for slot in contract.slots if slot.said_from and slot.name not in used_slots(instance, contract)]
    offers = [[(), *((_mention(value, slot, rules),) for value in _named_values(slot, rules))] for slot in claimed]
    for extra in product(*offers):
        mentions = (*plain, *(mention for some in extra for mention in some))
        if is_first_of_its_sort((v for m in mentions for v in m.values), rules):
            yield Reading(text="", mentions=mentions)


def objection(reading: Reading, instance: Instance, rules: Rules) -> Finding | None:
    """What the real containment check has against the plan, with every word understood."""
    return check_containment(reading, instance, rules, confirmed=True)


def wider_requests(reading: Reading, instance: Instance, other: Contract, rules: Rules) -> Iterator[Reading]:
    """Requests that name what another contract asks for and that this plan still gets through with."""
    missing = [slot for slot in required(other) if licensed_values(reading, slot, rules) is None]
    offers = [[_mention(value, slot, rules) for value in _named_values(slot, rules)] for slot in missing]
    for extra in product(*offers):
        wider = Reading(text="", mentions=(*reading.mentions, *extra))
        named = (v for m in wider.mentions for v in m.values)
        if is_first_of_its_sort(named, rules) and objection(wider, instance, rules) is None:
            yield wider


def required(contract: Contract) -> list[Slot]:
    """The slots that a request must name for the contract to be meant."""
    return [s for s in contract.slots if s.default is None and not s.free and not s.optional]


def meant(reading: Reading, contract: Contract, rules: Rules) -> Iterator[dict[str, SlotValue]]:
    """The contract's slots as the request binds them, in every way; nothing if a required one is not named."""
    slots = list(contract.slots)
    offers: list[Sequence[SlotValue | None]] = []
    for slot in slots:
        values = licensed_values(reading, slot, rules)
        if values is None and slot in required(contract):
            return
        default = None if slot.default is None else resolved(slot.default, slot, rules.crew)
        offers.append(values or [default])
    for picked in product(*offers):
        yield {slot.name: value for slot, value in zip(slots, picked, strict=True) if value is not None}


def _actions(contract: Contract, instance: Instance) -> Iterator[Mention]:
    for item in instance.steps:
        if contract.asks and item.step not in contract.asks:
            continue
        ref = StepRef(contract.name, item.step, item.call.skill, own=True)
        yield Mention(span=(0, 0), text=item.step, kind=MentionKind.ACTION, name=item.step, means=(ref,))


def _slots(contract: Contract, instance: Instance, rules: Rules) -> Iterator[Mention]:
    for name in used_slots(instance, contract):
        slot, value = contract.slot(name), instance.slots.get(name)
        if slot is None or value is None or slot.free:
            continue
        if slot.default is None or value != resolved(slot.default, slot, rules.crew):
            yield _mention(value, slot, rules)


def _mention(value: SlotValue, slot: Slot, rules: Rules) -> Mention:
    direction = Direction.FROM if slot.said_from else Direction.NONE
    shown = value if isinstance(value, str) else str(value)
    return Mention(span=(0, 0), text=shown, kind=_kind(value, rules), name=shown, direction=direction, values=(value,))


def _kind(value: SlotValue, rules: Rules) -> MentionKind:
    if isinstance(value, Zone):
        return MentionKind.ZONE
    if isinstance(value, Spot):
        return MentionKind.POINT
    if not isinstance(value, str):
        return MentionKind.ALTITUDE
    if rules.crew.value(value) is not None:
        return MentionKind.VALUE
    is_object = any(thing.name == value for thing in rules.crew.objects)
    return MentionKind.OBJECT if is_object else MentionKind.LOCATION


def _named_values(slot: Slot, rules: Rules) -> list[SlotValue]:
    area = rules.crew.area
    values: Mapping[SlotType, Sequence[SlotValue]] = {
        SlotType.VALUE: slot.values,
        SlotType.OBJECT: objects(rules),
        SlotType.LOCATION: locations(rules),
        SlotType.ZONE: [zone.zone for zone in rules.crew.zones[:1]],
        SlotType.POINT: [Spot((area.x_min + area.x_max) / 2, (area.y_min + area.y_max) / 2)],
        SlotType.ALTITUDE: [2.0],
    }
    return [value for kind in slot.types for value in values[kind]]

"""Which values the request allows for a slot, and how values are compared. Shared by the check and the planner."""

from collections.abc import Iterable, Iterator, Mapping
from math import isclose

from crew.contracts.contract import Contract, Slot, SlotType
from crew.contracts.language.mention import Direction, Mention, MentionKind, Reading
from crew.contracts.plan import Instance, SlotValue, Spot, Zone
from crew.contracts.site import Crew, Rules

TOLERANCE = 1e-6

_KIND_OF_TYPE: Mapping[SlotType, MentionKind] = {
    SlotType.OBJECT: MentionKind.OBJECT,
    SlotType.LOCATION: MentionKind.LOCATION,
    SlotType.ZONE: MentionKind.ZONE,
    SlotType.POINT: MentionKind.POINT,
    SlotType.ALTITUDE: MentionKind.ALTITUDE,
    SlotType.VALUE: MentionKind.VALUE,
}


def licensed_values(reading: Reading, slot: Slot, rules: Rules) -> tuple[SlotValue, ...] | None:
    """The values that the request allows for a slot, the plainest first; None if it is silent.

    What nobody knows is licensed verbatim where a name of this slot could stand: it closes the slot to everything else.
    """
    fitting = (m for m in reading.wanted if _licenses(m, slot, reading, rules))
    named = [m for m in fitting if not any(v in rules.parts for v in m.values)]
    if named:
        first = Direction.FROM if slot.said_from else Direction.TO
        ranked = sorted(named, key=lambda m: m.direction is not first)
        return tuple(_distinct(v for m in ranked for v in m.values))
    unknown = [m.name for m in reading.wanted if m.kind is MentionKind.UNKNOWN and _could_fill(m, slot, reading)]
    return tuple(unknown) or None


def fits(mention: Mention, slot: Slot) -> bool:
    """Whether a mention has the type of a slot."""
    if mention.kind is MentionKind.VALUE:
        return SlotType.VALUE in slot.types and any(v in slot.values for v in mention.values)
    return any(_KIND_OF_TYPE[t] is mention.kind for t in slot.types)


def claims(reading: Reading, contract: Contract, rules: Rules) -> dict[str, SlotValue]:
    """Slots that no call carries and that the request alone binds, such as a claimed origin."""
    carried = {name for step in contract.steps for pattern in step.do for name in slots_in(pattern.args.values())}
    found: dict[str, SlotValue] = {}
    for slot in contract.slots:
        values = licensed_values(reading, slot, rules) if slot.name not in carried else None
        if values:
            found[slot.name] = values[0]
    return found


def slots_in(args: Iterable[object]) -> Iterator[str]:
    """The slots that a call pattern's arguments refer to."""
    return (a[1:].partition(".")[0] for a in args if isinstance(a, str) and a.startswith("$"))


def used_slots(instance: Instance, contract: Contract) -> dict[str, tuple[int, str]]:
    """The slots that the instance's calls carry, each with the first step and argument that shows it."""
    found: dict[str, tuple[int, str]] = {}
    for index, item in enumerate(instance.steps):
        step = contract.step(item.step)
        for pattern in step.do if step is not None else ():
            if pattern.skill == item.call.skill and set(pattern.args) == set(item.call.args):
                for arg, value in pattern.args.items():
                    for name in slots_in((value,)):
                        found.setdefault(name, (index, arg))
    return found


def resolved(value: SlotValue, slot: Slot, crew: Crew) -> SlotValue:
    """A zone's name as its rectangle; everything else as it is."""
    if isinstance(value, str) and SlotType.ZONE in slot.types:
        return next((z.zone for z in crew.zones if z.name == value), value)
    return value


def same(a: SlotValue, b: SlotValue) -> bool:
    """Equality up to rounding of figures."""
    if isinstance(a, str) or isinstance(b, str):
        return a == b
    left, right = _numbers(a), _numbers(b)
    return len(left) == len(right) and all(isclose(p, q, abs_tol=TOLERANCE) for p, q in zip(left, right, strict=True))


def shown(value: SlotValue, crew: Crew) -> str:
    """A value as a person would say it: a zone by its name if it has one."""
    if isinstance(value, Zone):
        name = next((z.name for z in crew.zones if same(z.zone, value)), None)
        return name or f"x {value.x_min:g} to {value.x_max:g}, y {value.y_min:g} to {value.y_max:g}"
    if isinstance(value, Spot):
        return f"({value.x:g}, {value.y:g})"
    return value if isinstance(value, str) else f"{value:g}"


def _licenses(mention: Mention, slot: Slot, reading: Reading, rules: Rules) -> bool:
    if not fits(mention, slot):
        return False
    if mention.kind is MentionKind.OBJECT and mention.direction in (Direction.TO, Direction.FROM):
        return False  # "carry the bottle to the cube": an object is no place
    if not slot.said_from or mention.direction is not Direction.AT:
        return (mention.direction is Direction.FROM) is slot.said_from
    goals = [m for m in reading.wanted if m.direction is Direction.TO or m.kind is MentionKind.VALUE]
    if _put_there(mention, reading, rules):
        goals = [m for m in goals if m.governor == mention.governor]
    return any(m is not mention for m in goals)  # "the bottle on table_a to room_a"


def _put_there(mention: Mention, reading: Reading, rules: Rules) -> bool:
    """Whether something may be put at a place: `put the cube on table_a and send the dog to room_a`."""
    means = reading.mentions[mention.governor].means if mention.governor is not None else ()
    patterns = (
        (skill, pattern)
        for ref in means
        if (contract := rules.contracts.get(ref.contract)) is not None and (step := contract.step(ref.step)) is not None
        for pattern in step.do
        if pattern.skill == ref.skill
        for kind in rules.kinds.values()
        if (skill := kind.skill(ref.skill)) is not None
    )
    return any(s.puts and str(p.args.get(s.puts[1], "")).startswith("$") for s, p in patterns)


def _could_fill(mention: Mention, slot: Slot, reading: Reading) -> bool:
    """Whether an unknown name stands where a name for this slot would."""
    if slot.said_from or mention.direction is Direction.FROM:
        return slot.said_from and mention.direction is Direction.FROM
    types = set(slot.types)
    if mention.direction is Direction.TO:
        return bool(types & {SlotType.LOCATION, SlotType.POINT, SlotType.VALUE})
    if any(m.kind is MentionKind.UNKNOWN and m is not mention for m in reading.wanted):
        return bool(types & {SlotType.OBJECT, SlotType.ZONE})
    return bool(types - {SlotType.ALTITUDE})


def _distinct(values: Iterable[SlotValue]) -> list[SlotValue]:
    kept: list[SlotValue] = []
    for value in values:
        if not any(same(value, other) for other in kept):
            kept.append(value)
    return kept


def _numbers(value: SlotValue) -> tuple[float, ...]:
    if isinstance(value, Zone):
        return value.x_min, value.x_max, value.y_min, value.y_max
    if isinstance(value, Spot):
        return value.x, value.y
    return (float(value),) if not isinstance(value, str) else ()

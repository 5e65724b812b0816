"""The planner as an adversary: every plan of a contract that differs in more than names and independent order.

Plans are built here, but whether one is an instance is said by the real `check_call` and `match` alone.
"""

from collections.abc import Iterator, Mapping, Sequence
from itertools import product

from crew.contracts.contract import CallPattern, Contract, Slot, SlotType, Step
from crew.contracts.gate.arguments import bounds, check_call
from crew.contracts.language.licence import slots_in
from crew.contracts.matching import match, needed_skills, robot_skills
from crew.contracts.plan import ArgValue, Call, Instance, Plan, SlotValue, Spot, Zone
from crew.contracts.proof.names import is_first_of_its_sort, locations, objects
from crew.contracts.refusal import Refusal
from crew.contracts.site import Rules

Chosen = tuple[tuple[Step, CallPattern], ...]


def plans(contract: Contract, rules: Rules) -> Iterator[tuple[Plan, Instance | Refusal]]:
    """Every plan, with what the real matching says of it."""
    for chosen in _choices(contract):
        for robots in _casts(contract, chosen, rules):
            for slots in _bindings(contract, chosen, rules):
                yield from _judged(contract, chosen, robots, slots, rules)


def _judged(
    contract: Contract, chosen: Chosen, robots: Mapping[str, str], slots: Mapping[str, SlotValue], rules: Rules
) -> Iterator[tuple[Plan, Instance | Refusal]]:
    calls = {step.name: _call(robots[step.role], pattern, slots) for step, pattern in chosen}
    refusal = next((r for call in calls.values() if (r := check_call(call, rules)) is not None), None)
    for order in orders(contract, {name: call.robot for name, call in calls.items()}):
        plan = Plan(contract.name, tuple(calls[name] for name in order))
        yield plan, refusal or match(plan, rules)


def _choices(contract: Contract) -> Iterator[Chosen]:
    """Which optional steps are there, and which alternative each step takes; the fullest first."""
    offers: list[list[tuple[Step, CallPattern] | None]] = []
    for step in contract.steps:
        takes: list[tuple[Step, CallPattern] | None] = [(step, pattern) for pattern in step.do]
        offers.append([*takes, None] if step.optional else takes)
    for picked in product(*offers):
        chosen = tuple(item for item in picked if item is not None)
        if chosen:
            yield chosen


def _casts(contract: Contract, chosen: Chosen, rules: Rules) -> Iterator[dict[str, str]]:
    """Role to robot; of robots that nothing tells apart, the first that is free."""
    roles = list(dict.fromkeys(step.role for step, _ in chosen))
    yield from _cast(roles, {}, contract, rules)


def _cast(roles: Sequence[str], taken: dict[str, str], contract: Contract, rules: Rules) -> Iterator[dict[str, str]]:
    if not roles:
        yield taken
        return
    alike: set[object] = set()
    needed = needed_skills(contract, roles[0], rules)
    for spec in rules.crew.robots:
        sort = (spec.kind, spec.reach)
        if spec.name in taken.values() or sort in alike or not needed <= robot_skills(spec.name, rules):
            continue
        alike.add(sort)
        yield from _cast(roles[1:], {**taken, roles[0]: spec.name}, contract, rules)


def _bindings(contract: Contract, chosen: Chosen, rules: Rules) -> Iterator[dict[str, SlotValue]]:
    """Slots that the calls carry, with every value that could make a difference."""
    used = list(dict.fromkeys(name for _, pattern in chosen for name in slots_in(pattern.args.values())))
    slots = [slot for name in used if (slot := contract.slot(name)) is not None]
    written = [value for _, pattern in chosen for value in pattern.args.values()]
    for values in product(*([v for v in _values(s, chosen, rules) if _fits_all(s, v, written)] for s in slots)):
        if is_first_of_its_sort(values, rules):
            yield {slot.name: value for slot, value in zip(slots, values, strict=True)}


def _values(slot: Slot, chosen: Chosen, rules: Rules) -> list[SlotValue]:
    found: list[SlotValue] = []
    for kind in slot.types:
        if kind is SlotType.VALUE:
            found += slot.values
        elif kind is SlotType.OBJECT:
            found += objects(rules)
        elif kind is SlotType.LOCATION:
            found += locations(rules)
        else:
            found += _figures(kind, slot, chosen, rules)
    return found


def _fits_all(slot: Slot, value: SlotValue, written: Sequence[ArgValue]) -> bool:
    """Whether a value has every field that calls ask of the slot; a value without fields is asked for as a whole."""
    refs = [w[1:].partition(".")[::2] for w in written if isinstance(w, str) and w.startswith("$")]
    fields = {field for name, field in refs if name == slot.name}
    return all(hasattr(value, field) if field else not isinstance(value, Zone | Spot) for field in fields)


def _figures(kind: SlotType, slot: Slot, chosen: Chosen, rules: Rules) -> list[SlotValue]:
    """One value for slots of figures: no guard compares figures with anything but their own slot."""
    crew, area = rules.crew, rules.crew.area
    if kind is SlotType.ZONE:
        named = {zone.name: zone.zone for zone in crew.zones}
        return [named.get(str(slot.default), next(iter(named.values()), area))]
    if kind is SlotType.POINT:
        return [Spot(area.x_min + (area.x_max - area.x_min) / 3, area.y_min + (area.y_max - area.y_min) / 3)]
    return [slot.default if isinstance(slot.default, float) else _number(slot.name, chosen, rules)]


def _number(slot: str, chosen: Chosen, rules: Rules) -> float:
    """A number within the bounds of every argument that the slot fills."""
    low, high = -1e6, 1e6
    for _, pattern in chosen:
        skills = [skill for kind in rules.kinds.values() if (skill := kind.skill(pattern.skill)) is not None]
        for name, value in pattern.args.items():
            for skill in skills if value == f"${slot}" else ():
                param = skill.param(name)
                if param is not None and param.is_number:
                    a, b = bounds(param, rules)
                    low, high = max(low, a), min(high, b)
    return (low + high) / 2


def _call(robot: str, pattern: CallPattern, slots: Mapping[str, SlotValue]) -> Call:
    return Call(robot, pattern.skill, {name: _argument(value, slots) for name, value in pattern.args.items()})


def _argument(value: ArgValue, slots: Mapping[str, SlotValue]) -> ArgValue:
    if not isinstance(value, str) or not value.startswith("$"):
        return value
    name, _, field = value[1:].partition(".")
    bound = slots[name]
    if isinstance(bound, Zone | Spot):
        return float(getattr(bound, field))
    return bound


def predecessors(contract: Contract, present: Sequence[str]) -> dict[str, frozenset[str]]:
    """For each present step all present steps that come before it, near or far."""
    after = {step.name: step.after for step in contract.steps}
    closed: dict[str, frozenset[str]] = {}
    for name in present:
        found, waiting = set[str](), list(after[name])
        while waiting:
            other = waiting.pop()
            if other not in found:
                found.add(other)
                waiting += after.get(other, ())
        closed[name] = frozenset(found) & frozenset(present)
    return closed


def orders(contract: Contract, robots: Mapping[str, str]) -> Iterator[tuple[str, ...]]:
    """One order of the steps for each way in which every robot can have its own steps queued."""
    before = predecessors(contract, list(robots))
    owned = [[n for n, holder in robots.items() if holder == robot] for robot in dict.fromkeys(robots.values())]
    for queues in _queues(owned, before):
        order = _merge(queues, before)
        if order is not None:
            yield order


def _queues(owned: Sequence[Sequence[str]], before: Mapping[str, frozenset[str]]) -> Iterator[list[tuple[str, ...]]]:
    """One queue for each robot, in every combination; made one at a time, for there may be very many."""
    if not owned:
        yield []
        return
    for queue in _extensions((), owned[0], before):
        for others in _queues(owned[1:], before):
            yield [queue, *others]


def _extensions(
    start: tuple[str, ...], rest: Sequence[str], before: Mapping[str, frozenset[str]]
) -> Iterator[tuple[str, ...]]:
    """The orders of one robot's steps that keep what the contract orders among them."""
    if not rest:
        yield start
    for name in rest:
        if not before[name] & set(rest):
            yield from _extensions((*start, name), [other for other in rest if other != name], before)


def _merge(queues: Sequence[Sequence[str]], before: Mapping[str, frozenset[str]]) -> tuple[str, ...] | None:
    """The queues as one order that keeps them all; None if they wait for each other."""
    rest, done = [list(queue) for queue in queues], list[str]()
    while any(rest):
        ready = next((queue for queue in rest if queue and before[queue[0]] <= set(done)), None)
        if ready is None:
            return None
        done.append(ready.pop(0))
    return tuple(done)

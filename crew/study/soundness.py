"""Whether a proposal is sound, by the declarations alone: kinds, crew file, contract file.

The study's own judgement, so that a figure never counts the gate's word. It must not import the gate, the matcher or
the reader of requests.
"""

import math
from collections.abc import Iterator, Mapping, Sequence

from crew.contracts.contract import CallPattern, Contract, SlotType, Step
from crew.contracts.plan import ArgValue, Call
from crew.contracts.site import Rules
from crew.contracts.skill import Entity, Param, Skill

Binding = dict[str, ArgValue]


def ungrounded(call: Call, rules: Rules) -> str:
    """Why a call is not grounded in the crew's registry and site; empty if it is."""
    spec = next((robot for robot in rules.crew.robots if robot.name == call.robot), None)
    if spec is None:
        return f"the crew has no {call.robot}"
    skill = next((s for s in rules.kinds[spec.kind].skills if s.name == call.skill), None)
    if skill is None:
        return f"a {spec.kind} has no skill {call.skill}"
    return _signature(call, skill) or next(_values(call, skill, spec.reach, rules), "")


def _signature(call: Call, skill: Skill) -> str:
    given, params = set(call.args), {p.name: p for p in skill.params}
    if given - set(params):
        return f"{skill.name} takes no {sorted(given - set(params))[0]}"
    required = {name for name, p in params.items() if not p.optional}
    if required - given:
        return f"{skill.name} lacks {sorted(required - given)[0]}"
    if not any(given - required == set(form) for form in skill.forms):
        return f"{skill.name} takes another set of arguments"
    return ""


def _values(call: Call, skill: Skill, reach: Sequence[str], rules: Rules) -> Iterator[str]:
    for param in skill.params:
        if param.name in call.args:
            value = call.args[param.name]
            yield from (
                _number(param, value, rules) if param.entity is Entity.NONE else _name(param, value, reach, rules)
            )
    for low, high in skill.ranges:
        ends = [call.args.get(low), call.args.get(high)]
        numbers = [v for v in ends if not isinstance(v, str) and v is not None]
        if len(numbers) == 2 and not numbers[0] < numbers[1]:
            yield f"{low} is not below {high}"


def _number(param: Param, value: ArgValue, rules: Rules) -> Iterator[str]:
    if isinstance(value, str | bool) or not math.isfinite(value):
        yield f"{param.name} is no finite number"
        return
    area = rules.crew.area
    edges = {"x": (area.x_min, area.x_max), "y": (area.y_min, area.y_max)}.get(param.axis, (-math.inf, math.inf))
    if not (param.ge is None or value >= param.ge) or not (param.le is None or value <= param.le):
        yield f"{param.name} is beyond the skill's bounds"
    elif not edges[0] <= value <= edges[1]:
        yield f"{param.name} is outside the operational area"


def _name(param: Param, value: ArgValue, reach: Sequence[str], rules: Rules) -> Iterator[str]:
    crew = rules.crew
    places = [place.name for place in crew.locations]
    parts = [part.name for robot in crew.robots for part in rules.kinds[robot.kind].parts]
    known: dict[Entity, list[str]] = {
        Entity.OBJECT: [thing.name for thing in crew.objects],
        Entity.LOCATION: places + parts,
        Entity.TARGET: places + [v.name for v in crew.values],
    }
    if value not in known[param.entity]:
        yield f"there is no {param.entity} {value}"
    elif param.reach and value not in reach:
        yield f"{value} is out of reach"


def inadmissible(contract: str, calls: Sequence[Call], rules: Rules) -> str:
    """Why calls are no composition that the contract admits; empty if they are.

    Arguments count where the contract fixes them, binds two steps to one value, or wants another sort of thing than the
    one that is named; whether a name exists at all is a matter of grounding and not asked.
    """
    declared = rules.contracts.get(contract)
    if declared is None:
        return f"the crew has no contract {contract}"
    if not calls:
        return "there is no step"
    ways = list(_castings(declared, calls, 0, (), {}, {}, rules))
    if not ways:
        return f"{contract} admits no such set of calls, robots and values"
    whole = [steps for steps in ways if not _missing(declared, steps)]
    if not whole:
        return f"{contract} asks for {_missing(declared, ways[0])} as well"
    return "" if any(_in_order(declared, steps) for steps in whole) else f"the order is against {contract}"


def _castings(
    contract: Contract,
    calls: Sequence[Call],
    index: int,
    taken: tuple[str, ...],
    roles: Mapping[str, str],
    bound: Mapping[str, ArgValue],
    rules: Rules,
) -> Iterator[tuple[str, ...]]:
    """Every way in which each call is another step of the contract, under one cast and one binding."""
    if index == len(calls):
        yield taken
        return
    call = calls[index]
    for step in contract.steps:
        fits = step.name not in taken and roles.get(step.role, call.robot) == call.robot
        double = any(robot == call.robot and role != step.role for role, robot in roles.items())
        if not fits or double or not _able(call.robot, step.role, contract, rules):
            continue
        for pattern in step.do:
            now = _bind(pattern, call, bound)
            cast = {**roles, step.role: call.robot}
            if now is not None and _sorted(contract, now, cast, rules):
                yield from _castings(contract, calls, index + 1, (*taken, step.name), cast, now, rules)


def _bind(pattern: CallPattern, call: Call, bound: Mapping[str, ArgValue]) -> Binding | None:
    """The values that a call gives to the contract's variables; None if it is another call, or says otherwise."""
    if pattern.skill != call.skill:
        return None
    now = dict(bound)
    for name, wanted in pattern.args.items():
        given = call.args.get(name)
        if given is None:
            continue
        if not isinstance(wanted, str) or not wanted.startswith("$"):
            if given != wanted:
                return None
        elif now.setdefault(wanted, given) != given:
            return None
    return now


def _sorted(contract: Contract, bound: Mapping[str, ArgValue], cast: Mapping[str, str], rules: Rules) -> bool:
    """Whether every name that exists is of a sort that its variable takes, and beyond a robot's reach where it must."""
    crew = rules.crew
    places = {place.name for place in crew.locations}
    for slot in contract.slots:
        value = bound.get(f"${slot.name}")
        if not isinstance(value, str):
            continue
        sorts = {SlotType.OBJECT: {thing.name for thing in crew.objects}, SlotType.LOCATION: places}
        sorts[SlotType.VALUE] = {v.name for v in crew.values}
        known = set().union(*sorts.values(), *({part.name} for part in rules.parts.values()))
        fits = any(value in sorts.get(sort, ()) for sort in slot.types if sort is not SlotType.VALUE)
        if value in known and not fits and value not in slot.values:
            return False
        near = next((r.reach for r in crew.robots if r.name == cast.get(slot.beyond)), ())
        if slot.beyond and value in near:
            return False
    return True


def _able(robot: str, role: str, contract: Contract, rules: Rules) -> bool:
    """Whether a robot has a skill for every step of a role, and for its safe state."""
    kind = next((rules.kinds[r.kind] for r in rules.crew.robots if r.name == robot), None)
    if kind is None:
        return False
    skills = {skill.name for skill in kind.skills}
    safe = next((r.safe.by for r in contract.roles if r.name == role and r.safe is not None), None)
    needed = [{p.skill for p in step.do} for step in contract.steps if step.role == role]
    return all(skills & options for options in needed) and (safe is None or safe in skills)


def _missing(contract: Contract, steps: Sequence[str]) -> str:
    return ", ".join(step.name for step in contract.steps if not step.optional and step.name not in steps)


def _in_order(contract: Contract, steps: Sequence[str]) -> bool:
    place = {name: index for index, name in enumerate(steps)}
    return all(place[b] < place[name] for name in steps for b in _earlier(contract, name) if b in place)


def _earlier(contract: Contract, name: str) -> set[str]:
    """Every step that comes before one, directly or by way of others."""
    by_name: dict[str, Step] = {step.name: step for step in contract.steps}
    found: set[str] = set()
    waiting = list(by_name[name].after)
    while waiting:
        found.add(step := waiting.pop())
        waiting += [s for s in by_name[step].after if s not in found]
    return found

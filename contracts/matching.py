"""Plans matched to contracts: calls map one to one onto steps under one binding of roles and slots.

A mismatch is diagnosed by the assignment that came furthest: skills, arguments, roles, completeness, order.
"""

from collections.abc import Iterator, Mapping

import msgspec

from crew.contracts.codes import Code
from crew.contracts.contract import CallPattern, Contract, Slot, SlotType, Step
from crew.contracts.plan import ArgValue, Call, Instance, InstanceStep, Plan, SlotValue, Spot, Zone
from crew.contracts.refusal import Refusal
from crew.contracts.site import Rules

MAX_STEPS = 64
MAX_ASSIGNMENTS = 20_000
FIELDS: Mapping[SlotType, tuple[str, ...]] = {
    SlotType.ZONE: ("x_min", "x_max", "y_min", "y_max"),
    SlotType.POINT: ("x", "y"),
}
"""The fields that a composite slot is bound by."""


class Binding(msgspec.Struct, frozen=True):
    """Which step each call fills, and what the roles and slots are bound to so far."""

    steps: tuple[Step, ...] = ()
    roles: Mapping[str, str] = {}
    slots: Mapping[str, SlotValue] = {}
    parts: Mapping[str, Mapping[str, float]] = {}
    """Composite slots: field to number."""


def match(plan: Plan, rules: Rules) -> Instance | Refusal:
    """The plan as an instance of its contract, or why it is none."""
    if not 0 < len(plan.steps) <= MAX_STEPS:
        message = f"a plan has 1 to {MAX_STEPS} steps, this one {len(plan.steps)}"
        return Refusal(code=Code.MALFORMED_PLAN, message=message, field="steps", observed=str(len(plan.steps)))
    contract = rules.contracts.get(plan.contract)
    if contract is None:
        known = ", ".join(sorted(rules.contracts)) or "none"
        message = f"the crew has no contract {plan.contract!r} (known: {known})"
        return Refusal(
            code=Code.UNKNOWN_CONTRACT, message=message, field="contract", observed=plan.contract, allowed=known
        )
    return _foreign_call(plan, contract) or _assign(plan, contract, rules)


def _foreign_call(plan: Plan, contract: Contract) -> Refusal | None:
    skills = {pattern.skill for step in contract.steps for pattern in step.do}
    for index, call in enumerate(plan.steps):
        if call.skill not in skills:
            allowed = ", ".join(sorted(skills))
            message = f"{contract.name} has no step that does {call.skill!r} (it does: {allowed})"
            return _refuse(Code.NOT_IN_CONTRACT, message, index, call, allowed, contract)
    return None


def _assign(plan: Plan, contract: Contract, rules: Rules) -> Instance | Refusal:
    """Search the assignments; keep the refusal of the one that came furthest."""
    best: tuple[int, Refusal] | None = None
    for tried, outcome in enumerate(_assignments(plan, contract, rules)):
        if isinstance(outcome, Instance):
            return outcome
        if best is None or outcome[0] > best[0]:
            best = outcome
        if tried >= MAX_ASSIGNMENTS:
            message = f"the plan could be read in more than {MAX_ASSIGNMENTS} ways; give fewer steps of one skill"
            return Refusal(code=Code.MALFORMED_PLAN, message=message, field="steps")
    assert best is not None
    return best[1]


def _assignments(plan: Plan, contract: Contract, rules: Rules) -> Iterator[Instance | tuple[int, Refusal]]:
    """Depth-first over the calls: instances, or refusals with how far they came."""
    stack: list[Binding] = [Binding()]
    while stack:
        binding = stack.pop()
        index = len(binding.steps)
        if index == len(plan.steps):
            yield _finish(plan, contract, rules, binding)
            continue
        call = plan.steps[index]
        for step in reversed(contract.steps):
            for pattern in reversed(step.do):
                if pattern.skill != call.skill:
                    continue
                outcome = _extend(binding, step, pattern, call, contract, rules)
                if isinstance(outcome, Binding):
                    stack.append(outcome)
                else:
                    yield 2 * index, outcome


def _extend(
    binding: Binding, step: Step, pattern: CallPattern, call: Call, contract: Contract, rules: Rules
) -> Binding | Refusal:
    index = len(binding.steps)
    if step in binding.steps:
        message = f"{contract.name} does {call.skill!r} once, in step {step.name}; the plan asks for it again"
        return _refuse(Code.NOT_IN_CONTRACT, message, index, call, "once", contract, step)
    roles = _bind_role(binding.roles, step, call, contract, rules)
    if isinstance(roles, str):
        return _refuse(Code.WRONG_ROLE, roles, index, call, step.role, contract, step)
    slots, parts = dict(binding.slots), {name: dict(fields) for name, fields in binding.parts.items()}
    problem = _bind_args(slots, parts, pattern, call, contract, rules)
    if problem:
        return _refuse(Code.NOT_IN_CONTRACT, problem, index, call, "", contract, step)
    return Binding((*binding.steps, step), roles, slots, parts)


def _bind_role(
    roles: Mapping[str, str], step: Step, call: Call, contract: Contract, rules: Rules
) -> Mapping[str, str] | str:
    robot = roles.get(step.role)
    if robot is not None and robot != call.robot:
        return f"{robot} already plays {step.role}; a role keeps one robot, so {call.robot} can't take step {step.name}"
    other = next((role for role, name in roles.items() if name == call.robot and role != step.role), None)
    if other is not None:
        return f"{call.robot} already plays {other}; different roles are different robots"
    lacking = sorted(needed_skills(contract, step.role, rules) - robot_skills(call.robot, rules))
    if lacking:
        return f"{call.robot} can't play {step.role}: it lacks {', '.join(lacking)}"
    return {**roles, step.role: call.robot}


def needed_skills(contract: Contract, role: str, rules: Rules) -> frozenset[str]:
    """Skills that a robot needs to play a role. A step with alternative skills asks for none of them beforehand."""
    needed = {step.do[0].skill for step in contract.steps if step.role == role and len({p.skill for p in step.do}) == 1}
    declared = contract.role(role)
    if declared is not None and declared.safe is not None:
        needed.add(declared.safe.by)
    return frozenset(needed)


def robot_skills(robot: str, rules: Rules) -> frozenset[str]:
    """The names of a robot's skills; empty for a robot that the crew does not have."""
    kind = rules.kind_of(robot)
    return frozenset() if kind is None else frozenset(s.name for s in kind.skills)


def _bind_args(
    slots: dict[str, SlotValue],
    parts: dict[str, dict[str, float]],
    pattern: CallPattern,
    call: Call,
    contract: Contract,
    rules: Rules,
) -> str:
    """Unify a call's arguments with a pattern, in place; a sentence if they do not fit."""
    if set(pattern.args) != set(call.args):
        return f"{call} gives {_names(call.args)}, the step takes {_names(pattern.args)}"
    for name, wanted in pattern.args.items():
        problem = _bind_arg(slots, parts, wanted, call.args[name], contract, rules)
        if problem:
            return f"{name}: {problem}"
    return ""


def _bind_arg(
    slots: dict[str, SlotValue],
    parts: dict[str, dict[str, float]],
    wanted: ArgValue,
    given: ArgValue,
    contract: Contract,
    rules: Rules,
) -> str:
    if not isinstance(wanted, str) or not wanted.startswith("$"):
        return "" if wanted == given else f"{given} where the contract says {wanted}"
    name, _, field = wanted[1:].partition(".")
    slot = contract.slot(name)
    if slot is None:
        return f"the contract has no slot {name}"
    if field:
        return _bind_field(parts, slot, field, given)
    if name in slots:
        return "" if slots[name] == given else f"{given}, but {name} is already {slots[name]}"
    problem = _type_problem(slot, given, rules)
    if not problem:
        slots[name] = given
    return problem


def _bind_field(parts: dict[str, dict[str, float]], slot: Slot, field: str, given: ArgValue) -> str:
    if isinstance(given, str):
        return f"{given!r} where {slot.name}.{field} is a number"
    fields = parts.setdefault(slot.name, {})
    if fields.setdefault(field, float(given)) != float(given):
        return f"{given:g}, but {slot.name}.{field} is already {fields[field]:g}"
    return ""


def _type_problem(slot: Slot, given: ArgValue, rules: Rules) -> str:
    """Whether a plain argument can be this slot's value."""
    if not isinstance(given, str):
        return "" if SlotType.ALTITUDE in slot.types else f"a number where {slot.name} is a {' or '.join(slot.types)}"
    crew = rules.crew
    fits = (
        (SlotType.VALUE in slot.types and given in slot.values)
        or (SlotType.LOCATION in slot.types and crew.location(given) is not None)
        or (SlotType.OBJECT in slot.types and any(o.name == given for o in crew.objects))
    )
    return "" if fits else f"{given!r} is no {' or '.join((*slot.values, *slot.types))} for {slot.name}"


def _finish(plan: Plan, contract: Contract, rules: Rules, binding: Binding) -> Instance | tuple[int, Refusal]:
    """All calls have a step: complete the slots, then check that nothing is missing and the order holds."""
    rank = 2 * len(plan.steps)
    slots = dict(binding.slots)
    for name, fields in binding.parts.items():
        composite = _composite(fields)
        if composite is None or (name in slots and slots[name] != composite):
            message = f"slot {name} of {contract.name} is bound inconsistently"
            return rank, Refusal(code=Code.NOT_IN_CONTRACT, message=message, field=name)
        slots[name] = composite
    reached = _within_reach(contract, binding.roles, slots, rules)
    if reached is not None:
        return rank, reached
    present = {step.name for step in binding.steps}
    missing = [s.name for s in contract.steps if not s.optional and s.name not in present]
    if missing:
        message = f"the plan lacks {', '.join(missing)}, which {contract.name} requires"
        observed = ", ".join(s.name for s in binding.steps)
        refusal = Refusal(
            code=Code.INCOMPLETE_PLAN, message=message, field="steps", observed=observed, allowed=", ".join(missing)
        )
        return rank + 1, refusal
    before = {step.name: _closed_after(step, contract, present) for step in binding.steps}
    return _in_order(plan, contract, binding, before, slots, rank + 2)


def _within_reach(
    contract: Contract, roles: Mapping[str, str], slots: Mapping[str, SlotValue], rules: Rules
) -> Refusal | None:
    """A place that must lie beyond the reach of a role, and does not."""
    for slot in contract.slots:
        robot, value = rules.crew.robot(roles.get(slot.beyond, "")), slots.get(slot.name)
        if robot is not None and value in robot.reach:
            message = f"{value} is within {robot.name}'s reach; {contract.name} is for places beyond it"
            allowed = f"a place beyond {', '.join(robot.reach)}"
            return Refusal(
                code=Code.NOT_IN_CONTRACT, message=message, field=slot.name, observed=str(value), allowed=allowed
            )
    return None


def _in_order(
    plan: Plan,
    contract: Contract,
    binding: Binding,
    before: Mapping[str, tuple[str, ...]],
    slots: Mapping[str, SlotValue],
    rank: int,
) -> Instance | tuple[int, Refusal]:
    done: set[str] = set()
    for index, step in enumerate(binding.steps):
        early = [name for name in before[step.name] if name not in done]
        if early:
            message = f"step {step.name} comes before {', '.join(early)}; {contract.name} wants it after"
            return rank, _refuse(Code.OUT_OF_ORDER, message, index, plan.steps[index], ", ".join(early), contract, step)
        done.add(step.name)
    steps = tuple(
        InstanceStep(step=step.name, role=step.role, call=call, after=before[step.name])
        for step, call in zip(binding.steps, plan.steps, strict=True)
    )
    return Instance(contract=contract.name, roles=binding.roles, slots=slots, steps=steps)


def _composite(fields: Mapping[str, float]) -> Zone | Spot | None:
    if set(fields) == set(FIELDS[SlotType.ZONE]):
        return Zone(**fields)
    if set(fields) == set(FIELDS[SlotType.POINT]):
        return Spot(**fields)
    return None


def _closed_after(step: Step, contract: Contract, present: set[str]) -> tuple[str, ...]:
    """The present predecessors of a step, looking through optional steps that the plan leaves out."""
    found: list[str] = []
    waiting, seen = list(step.after), set[str]()
    while waiting:
        name = waiting.pop(0)
        if name in seen:
            continue
        seen.add(name)
        if name in present:
            found.append(name)
        elif (absent := contract.step(name)) is not None:
            waiting.extend(absent.after)
    return tuple(found)


def _names(args: Mapping[str, object]) -> str:
    return ", ".join(args) or "no arguments"


def _refuse(
    code: Code, message: str, index: int, call: Call, allowed: str, contract: Contract, step: Step | None = None
) -> Refusal:
    line = f"{contract.name}:{step.line}" if step is not None and step.line else ""
    return Refusal(code=code, message=message, field=f"steps[{index}]", observed=str(call), allowed=allowed, line=line)

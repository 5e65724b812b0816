"""Small changes to a plan that may answer a refusal, by its code. Each is only a candidate: the gate decides."""

from collections.abc import Callable, Iterator

from msgspec.structs import replace

from crew.contracts.codes import Code
from crew.contracts.contract import CallPattern, Contract, Step
from crew.contracts.explain.case import PlanCase
from crew.contracts.explain.edit import LARGE, MIDDLE, SMALL, Edit, value_edit, with_args, with_call, with_steps
from crew.contracts.explain.new_step import new_calls, slot_value
from crew.contracts.explain.words import step_index
from crew.contracts.gate.arguments import bounds, names_for
from crew.contracts.language.licence import licensed_values, shown, used_slots
from crew.contracts.matching import FIELDS, robot_skills
from crew.contracts.plan import ArgValue, Call, Plan, SlotValue, Spot, Zone
from crew.contracts.refusal import Refusal, show
from crew.contracts.skill import Param, Skill


def plan_edits(case: PlanCase, refusal: Refusal) -> Iterator[Edit]:
    """Candidates for this refusal, in no order."""
    index = step_index(refusal)
    if index is None or index >= len(case.plan.steps):
        index = None
    for codes, edits in _BY_CODE:
        if refusal.code in codes:
            yield from edits(case, index, refusal)


def _argument(case: PlanCase, index: int | None, refusal: Refusal) -> Iterator[Edit]:
    """Another value for the argument that the refusal names: a bound, a known name, the text read as a number."""
    name = refusal.field.rpartition(".args.")[2]
    skill = None if index is None else _skill(case, case.plan.steps[index])
    param = None if skill is None else skill.param(name)
    if index is None or skill is None or param is None:
        return
    call = case.plan.steps[index]
    for value in _values(param, call, case):
        yield value_edit(case, index, name, value)
    for low, high in skill.ranges:
        if name == low and high in call.args and low in call.args:
            swapped = with_args(call, {low: call.args[high], high: call.args[low]})
            yield Edit(f"{low} and {high} swapped in {call.skill}", SMALL, with_call(case, index, swapped))


def _values(param: Param, call: Call, case: PlanCase) -> list[ArgValue]:
    given, spec = call.args.get(param.name), case.rules.crew.robot(call.robot)
    if not param.is_number:
        names = spec.reach if param.reach and spec is not None else names_for(param.entity, case.rules)
        return [name for name in names if name != given]
    low, high = bounds(param, case.rules)
    number = _number(given)
    if number is not None and low <= number <= high:
        return [number]
    if number is None:
        return [low, high]
    return [low if number < low else high]


def _number(given: ArgValue | None) -> float | None:
    """A given value as an ordinary number; None if it is none."""
    try:
        number = float(given) if given is not None else float("nan")
    except (ValueError, OverflowError):
        return None
    return number if abs(number) < float("inf") else None


def _forms(case: PlanCase, index: int | None, refusal: Refusal) -> Iterator[Edit]:
    """Arguments left out or added until the call has one of the forms that the contract's steps give it."""
    contract = case.rules.contracts.get(case.plan.contract)
    skill = None if index is None else _skill(case, case.plan.steps[index])
    if index is None or contract is None or skill is None:
        return
    call = case.plan.steps[index]
    for pattern in (p for step in contract.steps for p in step.do if p.skill == call.skill):
        dropped = sorted(set(call.args) - set(pattern.args))
        added = {
            n: slot_value(w, skill.param(n), contract, case) for n, w in pattern.args.items() if n not in call.args
        }
        if not (dropped or added) or any(value is None for value in added.values()):
            continue
        parts = [f"without {', '.join(dropped)}"] if dropped else []
        parts += [f"with {name} {show(value)}" for name, value in added.items()]
        new = with_args(call, {**dict.fromkeys(dropped), **added})
        yield Edit(f"{call.skill} {' and '.join(parts)}", SMALL + 0.1 * len(parts), with_call(case, index, new))


def _robot(case: PlanCase, index: int | None, refusal: Refusal) -> Iterator[Edit]:
    """Another robot, for this call alone and wherever the plan has the same one."""
    if index is None:
        return
    old = case.plan.steps[index]
    for spec in case.rules.crew.robots:
        if spec.name == old.robot or old.skill not in robot_skills(spec.name, case.rules):
            continue
        alone = with_call(case, index, replace(old, robot=spec.name))
        yield Edit(f"{spec.name} instead of {old.robot} for {old.skill}", MIDDLE, alone)
        able = robot_skills(spec.name, case.rules)
        steps = tuple(
            replace(c, robot=spec.name) if c.robot == old.robot and c.skill in able else c for c in case.plan.steps
        )
        if steps != alone.plan.steps:
            yield Edit(f"{spec.name} wherever the plan has {old.robot}", MIDDLE + 0.1, with_steps(case, steps))


def _other_skill(case: PlanCase, index: int | None, refusal: Refusal) -> Iterator[Edit]:
    """A skill of the same robot, as the plan's contract calls it."""
    contract = case.rules.contracts.get(case.plan.contract)
    if index is None or contract is None:
        return
    old = case.plan.steps[index]
    for step in contract.steps:
        for call in new_calls(step, contract, case):
            if call.robot == old.robot and call.skill != old.skill:
                yield Edit(f"{call} instead of {old}", MIDDLE, with_call(case, index, call))


def _left_out(case: PlanCase, index: int | None, refusal: Refusal) -> Iterator[Edit]:
    """A plan without the step that the refusal speaks of."""
    if index is not None and len(case.plan.steps) > 1:
        steps = (*case.plan.steps[:index], *case.plan.steps[index + 1 :])
        yield Edit(f"without {case.plan.steps[index]}", LARGE, with_steps(case, steps))


def _other_contract(case: PlanCase, index: int | None, refusal: Refusal) -> Iterator[Edit]:
    for name in case.rules.contracts:
        if name != case.plan.contract:
            plan = Plan(name, case.plan.steps)
            yield Edit(f"contract {name} instead of {case.plan.contract}", MIDDLE, replace(case, plan=plan))


def _step_added(case: PlanCase, index: int | None, refusal: Refusal) -> Iterator[Edit]:
    """A step of the contract that the plan lacks, where the contract's order puts it."""
    contract = case.rules.contracts.get(case.plan.contract)
    if contract is None:
        return
    filled = _filled(case, contract)
    present = {step.name for step in filled if step is not None}
    for step in contract.steps:
        if step.name not in present:
            at = _place(step, contract, filled)
            for call in new_calls(step, contract, case):
                steps = (*case.plan.steps[:at], call, *case.plan.steps[at:])
                yield Edit(f"with {call} as step {at + 1}", MIDDLE, with_steps(case, steps))


def _in_order(case: PlanCase, index: int | None, refusal: Refusal) -> Iterator[Edit]:
    """The plan's own steps, in the contract's order."""
    contract = case.rules.contracts.get(case.plan.contract)
    if contract is None:
        return
    filled = _filled(case, contract)
    rank = {step.name: k for k, step in enumerate(contract.steps)}
    pairs = sorted(
        zip(case.plan.steps, filled, strict=True), key=lambda p: len(rank) if p[1] is None else rank[p[1].name]
    )
    steps = tuple(call for call, _ in pairs)
    if steps != case.plan.steps:
        order = ", ".join(call.skill for call in steps)
        yield Edit(f"the steps in the contract's order: {order}", SMALL + 0.2, with_steps(case, steps))


def _filled(case: PlanCase, contract: Contract) -> list[Step | None]:
    """For each call the contract's step that it most likely fills: the next one whose constants it has."""
    free = list(contract.steps)
    found: list[Step | None] = []
    for call in case.plan.steps:
        step = next((s for s in free if any(_could_be(call, pattern) for pattern in s.do)), None)
        if step is not None:
            free.remove(step)
        found.append(step)
    return found


def _could_be(call: Call, pattern: CallPattern) -> bool:
    """Whether a call does a pattern's skill with its constant arguments."""
    fixed = {n: w for n, w in pattern.args.items() if not (isinstance(w, str) and w.startswith("$"))}
    return call.skill == pattern.skill and all(call.args.get(name) == value for name, value in fixed.items())


def _place(step: Step, contract: Contract, filled: list[Step | None]) -> int:
    """The index in the plan before everything that comes later in the contract."""
    later = [s.name for s in contract.steps[contract.steps.index(step) + 1 :]]
    return next((k for k, s in enumerate(filled) if s is not None and s.name in later), len(filled))


def _slots(case: PlanCase, index: int | None, refusal: Refusal) -> Iterator[Edit]:
    """What the request allows for a slot, in place of what the plan has."""
    instance = case.instance
    contract = None if instance is None else case.rules.contracts.get(instance.contract)
    if instance is None or contract is None:
        return
    for name in used_slots(instance, contract):
        slot = contract.slot(name)
        allowed = None if slot is None else licensed_values(case.mission.reading, slot, case.rules)
        default = () if slot is None or slot.default is None else (slot.default,)
        for value in allowed or default:
            changed = _with_slot(case, contract, name, value)
            if changed.plan != case.plan:
                yield Edit(f"{name} {shown(value, case.rules.crew)}", SMALL, changed)


def _with_slot(case: PlanCase, contract: Contract, name: str, value: SlotValue) -> PlanCase:
    """The plan with one slot bound otherwise, in every call that carries it."""
    zone = next((z.zone for z in case.rules.crew.zones if z.name == value), value)
    instance = case.instance
    assert instance is not None
    steps = []
    for item in instance.steps:
        declared = contract.step(item.step)
        patterns = () if declared is None else declared.do
        pattern = next((p for p in patterns if (p.skill, set(p.args)) == (item.call.skill, set(item.call.args))), None)
        changes = {} if pattern is None else {a: _part(w, name, zone) for a, w in pattern.args.items()}
        steps.append(with_args(item.call, {a: v for a, v in changes.items() if v is not None}))
    return with_steps(case, tuple(steps))


def _part(wanted: ArgValue, slot: str, value: SlotValue) -> ArgValue | None:
    """What an argument of a pattern becomes once its slot has this value; None if it carries another."""
    if wanted == f"${slot}" and not isinstance(value, Zone | Spot):
        return value
    head, _, field = wanted[1:].partition(".") if isinstance(wanted, str) else ("", "", "")
    fits = head == slot and isinstance(value, Zone | Spot) and any(field in fields for fields in FIELDS.values())
    return getattr(value, field, None) if fits else None


def _named_robot(case: PlanCase, index: int | None, refusal: Refusal) -> Iterator[Edit]:
    """The robot that the request names for an action."""
    if refusal.field.endswith(".robot"):
        yield from _robot(case, index, refusal)


def _skill(case: PlanCase, call: Call) -> Skill | None:
    kind = case.rules.kind_of(call.robot)
    return None if kind is None else kind.skill(call.skill)


C = Code
_Edits = Callable[[PlanCase, int | None, Refusal], Iterator[Edit]]
_BY_CODE: tuple[tuple[frozenset[Code], _Edits], ...] = (
    (frozenset({C.BAD_ARGUMENT, C.OUT_OF_BOUNDS, C.UNKNOWN_LOCATION, C.UNKNOWN_OBJECT}), _argument),
    (frozenset({C.MISSING_ARGUMENT, C.UNKNOWN_ARGUMENT, C.NOT_IN_CONTRACT}), _forms),
    (frozenset({C.UNKNOWN_ROBOT, C.UNKNOWN_SKILL, C.WRONG_ROLE, C.FORBIDDEN_BY_REQUEST}), _robot),
    (frozenset({C.UNKNOWN_ROBOT, C.UNKNOWN_SKILL, C.NOT_IN_CONTRACT}), _other_skill),
    (
        frozenset({C.NOT_IN_CONTRACT, C.NOT_REQUESTED, C.FORBIDDEN_BY_REQUEST, C.WRONG_ROLE, C.PRECONDITION_FAILED}),
        _left_out,
    ),
    (
        frozenset(
            {C.UNKNOWN_CONTRACT, C.NOT_IN_CONTRACT, C.INCOMPLETE_PLAN}
            | {C.NOT_REQUESTED, C.REQUEST_DROPPED, C.UNKNOWN_SKILL}
        ),
        _other_contract,
    ),
    (
        frozenset(
            {C.INCOMPLETE_PLAN, C.PRECONDITION_FAILED, C.REQUEST_DROPPED}
            | {C.NO_TARGET_FIX, C.NO_VALUE, C.MALFORMED_PLAN}
        ),
        _step_added,
    ),
    (frozenset({C.OUT_OF_ORDER, C.PRECONDITION_FAILED, C.NOT_REQUESTED}), _in_order),
    (frozenset({C.NOT_REQUESTED, C.REQUEST_DROPPED, C.NOT_IN_CONTRACT, C.FORBIDDEN_BY_REQUEST}), _slots),
    (frozenset({C.NOT_REQUESTED}), _named_robot),
)
"""The kinds of change that may answer a code."""

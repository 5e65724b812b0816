"""Calls that would fill a step of a contract: what a plan that lacks the step could have said."""

from collections.abc import Iterator

from crew.contracts.contract import CallPattern, Contract, Slot, SlotType, Step
from crew.contracts.explain.case import PlanCase
from crew.contracts.gate.arguments import bounds
from crew.contracts.language.licence import licensed_values
from crew.contracts.matching import needed_skills, robot_skills
from crew.contracts.plan import ArgValue, Call, SlotValue, Spot, Zone
from crew.contracts.skill import Param


def new_calls(step: Step, contract: Contract, case: PlanCase) -> Iterator[Call]:
    """One call for each robot that can play the step's role and each way to do it."""
    for robot in _players(step, contract, case):
        kind = case.rules.kind_of(robot)
        for pattern in step.do:
            skill = None if kind is None else kind.skill(pattern.skill)
            if skill is None:
                continue
            args = {
                name: slot_value(wanted, skill.param(name), contract, case) for name, wanted in pattern.args.items()
            }
            if all(value is not None for value in args.values()):
                yield Call(robot, pattern.skill, {n: v for n, v in args.items() if v is not None})


def _players(step: Step, contract: Contract, case: PlanCase) -> list[str]:
    """The robot that the plan has in this role already, or else all that can play it."""
    mates = {p.skill for s in contract.steps if s.role == step.role for p in s.do}
    needed = needed_skills(contract, step.role, case.rules)
    able = [r.name for r in case.rules.crew.robots if needed <= robot_skills(r.name, case.rules)]
    playing = [name for name in able if any(c.robot == name and c.skill in mates for c in case.plan.steps)]
    return playing or able


def slot_value(wanted: ArgValue, param: Param | None, contract: Contract, case: PlanCase) -> ArgValue | None:
    """A literal, or a slot's value: as the plan has it, as the request allows it, its default, or within bounds."""
    if not isinstance(wanted, str) or not wanted.startswith("$"):
        return wanted
    given = _given(wanted, contract, case)
    if given is not None:
        return given
    name, _, field = wanted[1:].partition(".")
    slot = contract.slot(name)
    value = None if slot is None else _allowed(slot, case)
    if isinstance(value, Zone | Spot):
        found = getattr(value, field, None)
        return found if isinstance(found, float) else None
    if value is None and slot is not None and slot.free and param is not None and param.is_number:
        low, high = bounds(param, case.rules)
        return (low + high) / 2
    return value


def _given(wanted: str, contract: Contract, case: PlanCase) -> ArgValue | None:
    """What another call of the plan gives for the same slot."""
    patterns: dict[str, list[CallPattern]] = {}
    for step in contract.steps:
        for pattern in step.do:
            patterns.setdefault(pattern.skill, []).append(pattern)
    for call in case.plan.steps:
        for pattern in patterns.get(call.skill, ()):
            for name, other in pattern.args.items():
                if other == wanted and name in call.args:
                    return call.args[name]
    return None


def _allowed(slot: Slot, case: PlanCase) -> SlotValue | None:
    found = licensed_values(case.mission.reading, slot, case.rules)
    value = found[0] if found else slot.default
    if SlotType.ZONE in slot.types and isinstance(value, str):
        return next((z.zone for z in case.rules.crew.zones if z.name == value), None)
    return value

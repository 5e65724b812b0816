"""What a contract's names mean in a crew: calls that fit skills, an order without circles, guards that can hold."""

import re
from collections.abc import Iterator
from graphlib import CycleError, TopologicalSorter

from crew.contracts.contract import SlotType
from crew.contracts.files.contract_guard import check_guard, check_guards
from crew.contracts.files.contract_model import ContractModel, StepModel
from crew.contracts.files.contract_place import check_places
from crew.contracts.files.contract_role import check_roles
from crew.contracts.files.contract_scope import PLAIN_TYPES, Scope
from crew.contracts.files.contract_value import check_argument, check_default
from crew.contracts.files.source import Loc, Problems
from crew.contracts.skill import Skill

_PLACEHOLDER = re.compile(r"\{([^{}]*)\}")


def check(model: ContractModel, scope: Scope, problems: Problems) -> None:
    """Every mistake of meaning in one contract, added to `problems`."""
    _check_slots(model, scope, problems)
    check_roles(model, scope, problems)
    _check_examples(model, problems)
    for name, step in model.steps.items():
        _check_step(name, step, model, scope, problems)
    _check_order(model, problems)
    _check_step_names(model.asks, ("asks",), model, problems)
    check_guards(model.needs, ("needs",), scope, problems)
    check_guards(model.complete, ("complete",), scope, problems)
    _check_never(model, scope, problems)


def _check_slots(model: ContractModel, scope: Scope, problems: Problems) -> None:
    for name, slot in model.slots.items():
        loc: Loc = ("slots", name)
        if name in model.roles or name in scope.values:
            other = "role" if name in model.roles else "run-time value"
            problems.key(loc, f"slot and {other} of one name", observed=repr(name), fix="rename the slot")
        for index, word in enumerate(slot.type):
            if word not in PLAIN_TYPES and word not in scope.values:
                problems.unknown((*loc, "type", index), "unknown slot type", word, [*PLAIN_TYPES, *scope.values])
        if slot.free and slot.default is not None:
            fix = "a default is used before the planner may choose; keep one of them"
            problems.key((*loc, "free"), f"slot {name} is free and has a default", fix=fix)
        if slot.beyond is not None and slot.beyond not in model.roles:
            problems.unknown((*loc, "beyond"), "unknown role", slot.beyond, model.roles)
        elif slot.beyond is not None and SlotType.LOCATION not in scope.slots[name].types:
            problems.key(
                (*loc, "beyond"), f"slot {name} is never a location", fix="remove it, or add location to the type"
            )
        check_default(scope.slots[name], scope, problems)


def _check_examples(model: ContractModel, problems: Problems) -> None:
    for index, example in enumerate(model.examples):
        loc: Loc = ("examples", index)
        for name in _PLACEHOLDER.findall(example):
            if name not in model.slots and name not in model.roles:
                problems.unknown(loc, "unknown slot or role in an example", name, [*model.slots, *model.roles])
        if not _balanced(example):
            fix = "alternatives stand in (a|b), slots and roles in {name}"
            problems.at(loc, "brackets that don't match", observed=repr(example), fix=fix)


def _balanced(text: str) -> bool:
    closing = {"(": ")", "{": "}"}
    awaited: list[str] = []
    for char in text:
        if char in closing:
            awaited.append(closing[char])
        elif char in closing.values() and (not awaited or awaited.pop() != char):
            return False
    return not awaited


def _check_step(name: str, step: StepModel, model: ContractModel, scope: Scope, problems: Problems) -> None:
    loc: Loc = ("steps", name)
    if step.role not in model.roles:
        problems.unknown((*loc, "role"), "unknown role", step.role, model.roles)
    _check_step_names(step.after, (*loc, "after"), model, problems)
    check_guards(step.needs, (*loc, "needs"), scope, problems)
    for index, call in enumerate(step.do):
        for skill, args in call.items():
            where: Loc = (*loc, "do", index, skill)
            declared = _skill(skill, step, where, scope, problems)
            if declared is not None:
                _check_call(declared, args, where, scope, problems)
                check_places(declared, args, step.role, where, scope, problems)


def _skill(name: str, step: StepModel, loc: Loc, scope: Scope, problems: Problems) -> Skill | None:
    """The skill as declared by a kind that may play the step's role, or else by any kind of the crew."""
    found = scope.skill_of(step.role, name) if step.role in scope.casts else None
    if found is None:
        found = next((skill for kind in scope.kinds if (skill := kind.skill(name))), None)
    if found is None:
        kinds = ", ".join(kind.name for kind in scope.kinds) or "none"
        what = f"unknown skill: no kind of crew {scope.crew.name} has it ({kinds})"
        valid = [skill.name for kind in scope.kinds for skill in kind.skills]
        problems.unknown(loc, what, name, valid, key=True)
    return found


def _check_call(skill: Skill, args: dict[str, float | str], loc: Loc, scope: Scope, problems: Problems) -> None:
    for name, value in args.items():
        _check_arg(skill, name, value, (*loc, name), scope, problems)
    missing = [p.name for p in skill.params if not p.optional and p.name not in args]
    if missing:
        problems.key(loc, f"{skill.name} lacks {', '.join(missing)}", fix="write a value or a $slot for each argument")
    _check_form(skill, args, loc, problems)
    _check_ranges(skill, args, loc, problems)


def _check_arg(
    skill: Skill,
    name: str,
    value: bool | float | str,
    loc: Loc,
    scope: Scope,
    problems: Problems,
    *,
    negated: bool = False,
) -> None:
    """One argument, by name and value; under `not` the value stands one level down."""
    param = skill.param(name)
    if param is None:
        valid = [p.name for p in skill.params]
        problems.unknown(loc, f"unknown argument of {skill.name}", name, valid, key=True)
    else:
        check_argument(value, param, (*loc, "not") if negated else loc, scope, problems)


def _check_ranges(skill: Skill, args: dict[str, float | str], loc: Loc, problems: Problems) -> None:
    for low, high in skill.ranges:
        a, b = args.get(low), args.get(high)
        if isinstance(a, float) and isinstance(b, float) and a >= b:
            problems.at((*loc, low), "swapped range", observed=f"{low} {a:g}, {high} {b:g}", allowed=f"{low} < {high}")


def _check_form(skill: Skill, args: dict[str, float | str], loc: Loc, problems: Problems) -> None:
    given = {name for name in args if (param := skill.param(name)) and param.optional}
    if given in [set(form) for form in skill.forms]:
        return
    forms = " or ".join("{" + ", ".join(form) + "}" for form in skill.forms)
    mixed = not any(given <= set(form) for form in skill.forms)
    what = f"{skill.name} mixes its forms" if mixed else f"{skill.name} lacks an argument"
    observed = "{" + ", ".join(sorted(given)) + "}"
    fix = "for both, write a list of two calls" if mixed else ""
    problems.key(loc, what, observed=observed, allowed=f"exactly one of {forms}", fix=fix)


def _check_step_names(names: list[str], loc: Loc, model: ContractModel, problems: Problems) -> None:
    for index, name in enumerate(names):
        if name not in model.steps:
            problems.unknown((*loc, index), "unknown step", name, model.steps)
        elif name in names[:index]:
            problems.at((*loc, index), "step listed twice", observed=repr(name), fix="remove one")


def _check_order(model: ContractModel, problems: Problems) -> None:
    for cycle in _circles(model):
        shown = " after ".join([*cycle, cycle[0]])
        fix = "no plan could have this order; remove one `after`"
        problems.key(("steps", cycle[0], "after"), "circular order", observed=shown, fix=fix)


def _circles(model: ContractModel) -> Iterator[list[str]]:
    """Circles of `after`, disjoint, each from its first step in the file on."""
    order = list(model.steps)
    after = {name: set(step.after) for name, step in model.steps.items()}
    while True:
        try:
            TopologicalSorter(after).prepare()
        except CycleError as error:
            circle: list[str] = error.args[1][:0:-1]
            first = circle.index(min(circle, key=order.index))
            yield circle[first:] + circle[:first]
            after = {name: before for name, before in after.items() if name not in circle}
        else:
            return


def _check_never(model: ContractModel, scope: Scope, problems: Problems) -> None:
    for index, never in enumerate(model.never):
        loc: Loc = ("never", index)
        skill = _starts(never.starts, (*loc, "starts"), scope, problems)
        if skill is not None:
            for name, compared in never.with_args.items():
                where: Loc = (*loc, "with", name)
                _check_arg(skill, name, compared.value, where, scope, problems, negated=compared.negated)
        check_guard(never.during, (*loc, "while"), scope, problems)


def _starts(text: str, loc: Loc, scope: Scope, problems: Problems) -> Skill | None:
    role, _, name = text.partition(".")
    found = scope.skill_of(role, name) if role in scope.casts else None
    if found is None:
        valid = [f"{known}.{skill.name}" for known in scope.casts for k in scope.kinds_of(known) for skill in k.skills]
        fix = "write <role>.<skill>"
        problems.unknown(loc, "not the start of a skill by a role", text, valid, fix=fix)
    return found

"""One small change to a decision's inputs, in words, with how large a change it is."""

from collections.abc import Mapping
from typing import NamedTuple

from msgspec.structs import replace

from crew.contracts.explain.case import Case, PlanCase
from crew.contracts.plan import ArgValue, Call, Plan
from crew.contracts.refusal import show

SMALL, MIDDLE, LARGE, ASKED = 1.0, 1.4, 2.0, 3.0
"""A value moved or a person's word; another robot, step or contract; a step left out; another request."""


class Edit(NamedTuple):
    """A change: what it says, its size, and the case that it leads to."""

    text: str
    size: float
    case: Case


def with_steps(case: PlanCase, steps: tuple[Call, ...]) -> PlanCase:
    """The case with other calls in its plan."""
    return replace(case, plan=Plan(case.plan.contract, steps))


def with_call(case: PlanCase, index: int, call: Call) -> PlanCase:
    """The case with one call of its plan replaced."""
    return with_steps(case, (*case.plan.steps[:index], call, *case.plan.steps[index + 1 :]))


def with_args(call: Call, changes: Mapping[str, ArgValue | None]) -> Call:
    """The call with arguments changed; None takes one away."""
    args = {name: value for name, value in {**call.args, **changes}.items() if value is not None}
    return Call(call.robot, call.skill, args)


def value_edit(case: PlanCase, index: int, name: str, value: ArgValue, size: float = SMALL) -> Edit:
    """One argument's value, wherever the plan gives the same value under the same name."""
    old = case.plan.steps[index].args.get(name)
    steps = tuple(
        with_args(call, {name: value}) if k == index or (old is not None and call.args.get(name) == old) else call
        for k, call in enumerate(case.plan.steps)
    )
    skills = dict.fromkeys(call.skill for call, was in zip(steps, case.plan.steps, strict=True) if call != was)
    instead = "" if old is None else f" instead of {repr(old) if isinstance(old, str) else show(old)}"
    return Edit(f"{name} {show(value)}{instead} in {', '.join(skills)}", size, with_steps(case, steps))

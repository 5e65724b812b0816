"""A model's tool call as a plan. Everything that does not have the tool's shape is unreadable; nothing is repaired."""

from typing import Any

import msgspec

from crew.actors.planner.backend import PlanUnreadable
from crew.contracts.plan import ArgValue, Call, Plan

MAX_STEPS = 64
MAX_TEXT = 200
"""Longest name or text value, characters."""


class _Argument(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    name: str
    value: float | str


class _Step(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    robot: str
    skill: str
    args: list[_Argument]


class _Submission(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    contract: str
    steps: list[_Step]


def read_submission(submitted: Any) -> Plan:
    """The plan in the tool's input. Raises PlanUnreadable that says where it has another shape."""
    try:
        found = msgspec.convert(submitted, type=_Submission, strict=True)
    except msgspec.ValidationError as error:
        raise PlanUnreadable(f"the submitted plan does not have the tool's shape: {error}") from error
    if len(found.steps) > MAX_STEPS:
        raise PlanUnreadable(f"the submitted plan has {len(found.steps)} steps, at most {MAX_STEPS} are read")
    return Plan(_short(found.contract), tuple(_call(step, number) for number, step in enumerate(found.steps, 1)))


def _call(step: _Step, number: int) -> Call:
    args: dict[str, ArgValue] = {}
    for argument in step.args:
        if argument.name in args:
            raise PlanUnreadable(f"step {number} of the submitted plan gives {_short(argument.name)!r} twice")
        args[_short(argument.name)] = _short(argument.value) if isinstance(argument.value, str) else argument.value
    return Call(_short(step.robot), _short(step.skill), args)


def _short(text: str) -> str:
    if len(text) > MAX_TEXT:
        raise PlanUnreadable(f"the submitted plan holds a text of {len(text)} characters, at most {MAX_TEXT} are read")
    return text

"""The first two groups of checks: does the robot have the skill, and are the arguments what the skill declares?"""

import math
from collections.abc import Iterator
from difflib import get_close_matches

from crew.contracts.codes import ORDER, Code
from crew.contracts.plan import ArgValue, Call
from crew.contracts.refusal import Refusal, show
from crew.contracts.site import Rules
from crew.contracts.skill import Entity, Param, Skill


def check_call(call: Call, rules: Rules) -> Refusal | None:
    """Capability, then arguments. None means that the call is well formed for its robot."""
    kind = rules.kind_of(call.robot)
    if kind is None:
        names = [r.name for r in rules.crew.robots]
        return _refuse(Code.UNKNOWN_ROBOT, "robot", call.robot, names, f"the crew has no robot {call.robot!r}")
    skill = kind.skill(call.skill)
    if skill is None:
        names = [s.name for s in kind.skills]
        return _refuse(Code.UNKNOWN_SKILL, "skill", call.skill, names, f"{call.robot} has no skill {call.skill!r}")
    return check_arguments(call, skill, rules)


def check_arguments(call: Call, skill: Skill, rules: Rules) -> Refusal | None:
    """Missing, unknown and wrongly typed arguments, unknown names, values out of bounds: the earliest code counts."""
    return (
        _missing(call, skill)
        or _unknown(call, skill)
        or min(_problems(call, skill, rules), key=lambda refusal: ORDER[refusal.code], default=None)
    )


def _problems(call: Call, skill: Skill, rules: Rules) -> Iterator[Refusal]:
    """What is wrong with the values: at most one problem for each argument, and swapped ranges."""
    for param in skill.params:
        if param.name in call.args:
            problem = _bad_value(call, param)
            if problem is None:
                problem = _out_of_bounds(call, param, rules) if param.is_number else _bad_name(call, param, rules)
            if problem is not None:
                yield problem
    swapped = _swapped(call, skill)
    if swapped is not None:
        yield swapped


def _missing(call: Call, skill: Skill) -> Refusal | None:
    for name in skill.required:
        if name not in call.args:
            return _argument(Code.MISSING_ARGUMENT, call, name, "nothing", "a value", "is missing")
    given = skill.optional.intersection(call.args)
    if given in skill.form_sets:
        return None
    shown = " or ".join(", ".join(form) or "nothing" for form in skill.forms)
    partial = any(given < form for form in skill.form_sets)
    code = Code.MISSING_ARGUMENT if partial else Code.UNKNOWN_ARGUMENT
    return _argument(code, call, "", ", ".join(sorted(given)) or "nothing", shown, "takes another set of arguments")


def _unknown(call: Call, skill: Skill) -> Refusal | None:
    for name in call.args:
        if skill.param(name) is None:
            valid = ", ".join(p.name for p in skill.params) or "no arguments"
            return _argument(Code.UNKNOWN_ARGUMENT, call, name, name, valid, "is not an argument of the skill")
    return None


def _bad_value(call: Call, param: Param) -> Refusal | None:
    value = call.args[param.name]
    if not param.is_number:
        if isinstance(value, str) and value:
            return None
        return _argument(
            Code.BAD_ARGUMENT, call, param.name, show(value), f"the name of a {param.entity}", "is no name"
        )
    if isinstance(value, bool) or not isinstance(value, int | float):
        return _argument(Code.BAD_ARGUMENT, call, param.name, repr(value), "a number", "is not a number")
    if not _is_finite(value):
        observed = show(value) if isinstance(value, float) else "a huge number"
        return _argument(Code.BAD_ARGUMENT, call, param.name, observed, "a finite number", "is not finite")
    return None


def _is_finite(value: float) -> bool:
    """Whether a number is an ordinary one; an integer beyond any float is not."""
    try:
        return math.isfinite(value)
    except OverflowError:
        return False


def _bad_name(call: Call, param: Param, rules: Rules) -> Refusal | None:
    return _unknown_name(call, param, rules) or (_out_of_reach(call, param, rules) if param.reach else None)


def _out_of_reach(call: Call, param: Param, rules: Rules) -> Refusal | None:
    spec, place = rules.crew.robot(call.robot), str(call.args[param.name])
    reach = () if spec is None else spec.reach
    if place in reach:
        return None
    allowed = ", ".join(reach) or "nothing"
    return _argument(Code.OUT_OF_BOUNDS, call, param.name, place, allowed, f"is out of {call.robot}'s reach")


def _unknown_name(call: Call, param: Param, rules: Rules) -> Refusal | None:
    value = str(call.args[param.name])
    code = Code.UNKNOWN_OBJECT if param.entity is Entity.OBJECT else Code.UNKNOWN_LOCATION
    valid = names_for(param.entity, rules)
    if value in valid:
        return None
    message = f"the crew knows no {param.entity} {value!r}"
    return _refuse(code, f"args.{param.name}", value, valid, message)


def names_for(entity: Entity, rules: Rules) -> list[str]:
    """The names that an argument of this entity may carry."""
    crew = rules.crew
    if entity is Entity.OBJECT:
        return [o.name for o in crew.objects]
    places = [p.name for p in crew.locations]
    return [*places, *rules.parts] if entity is Entity.LOCATION else [v.name for v in crew.values] + places


def bounds(param: Param, rules: Rules) -> tuple[float, float]:
    """Inclusive limits of a numeric argument: the kind's, narrowed by the operational area on its axis."""
    low = -math.inf if param.ge is None else param.ge
    high = math.inf if param.le is None else param.le
    area = rules.crew.area
    if param.axis == "x":
        return max(low, area.x_min), min(high, area.x_max)
    if param.axis == "y":
        return max(low, area.y_min), min(high, area.y_max)
    return low, high


def _out_of_bounds(call: Call, param: Param, rules: Rules) -> Refusal | None:
    value = call.args[param.name]
    assert not isinstance(value, str), "checked before"
    low, high = bounds(param, rules)
    if low <= value <= high:
        return None
    what = "is outside the operational area" if param.axis else "is out of bounds"
    allowed = f"{low:g} to {high:g} {param.unit}".strip()
    return _argument(Code.OUT_OF_BOUNDS, call, param.name, f"{value:g} {param.unit}".strip(), allowed, what)


def _swapped(call: Call, skill: Skill) -> Refusal | None:
    for low, high in skill.ranges:
        a, b = call.args.get(low), call.args.get(high)
        if isinstance(a, int | float) and isinstance(b, int | float) and a >= b:
            return _argument(
                Code.BAD_ARGUMENT, call, low, f"{low}={a:g}, {high}={b:g}", f"{low} < {high}", "is no range"
            )
    return None


def _argument(code: Code, call: Call, name: str, observed: ArgValue, allowed: str, what: str) -> Refusal:
    field = f"args.{name}" if name else "args"
    subject = f"{call.robot}.{call.skill} {name}".strip()
    message = f"{subject} {what}: {observed}; allowed: {allowed}"
    return Refusal(code=code, message=message, field=field, observed=str(observed), allowed=allowed)


def _refuse(code: Code, field: str, observed: str, valid: list[str], message: str) -> Refusal:
    close = get_close_matches(observed, valid, n=1, cutoff=0.6)
    hint = f"; did you mean {close[0]!r}?" if close else ""
    allowed = ", ".join(valid) or "none"
    return Refusal(
        code=code, message=f"{message}{hint} (known: {allowed})", field=field, observed=observed, allowed=allowed
    )

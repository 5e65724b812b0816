"""Places that a call's arguments name: within the reach of a robot that may act, and part of exactly one that hosts."""

from collections.abc import Mapping

from crew.contracts.files.contract_scope import Scope
from crew.contracts.files.source import Loc, Problems
from crew.contracts.skill import Param, Skill


def check_places(
    skill: Skill, args: Mapping[str, float | str], role: str, loc: Loc, scope: Scope, problems: Problems
) -> None:
    """Every constant place of a call, added to `problems`; what a slot names is the gate's business."""
    for param in skill.params:
        value = args.get(param.name)
        if isinstance(value, str) and not value.startswith("$"):
            _check_reach(param, value, role, (*loc, param.name), scope, problems)
            if value in scope.parts:
                _check_host(value, role, (*loc, param.name), scope, problems)


def _check_reach(param: Param, place: str, role: str, loc: Loc, scope: Scope, problems: Problems) -> None:
    if not param.reach or role not in scope.casts or place not in scope.locations:
        return
    reach = [name for robot in scope.casts[role] for name in robot.reach]
    if place not in reach:
        names = " or ".join(robot.name for robot in scope.casts[role]) or "no robot"
        problems.unknown(loc, f"out of reach of {names}", place, reach)


def _check_host(place: str, role: str, loc: Loc, scope: Scope, problems: Problems) -> None:
    """One other role's robot has the part, whoever plays it: otherwise nobody could tell whose is meant."""
    hosts = [other for other in scope.casts if other != role and _has(place, other, scope)]
    if len(hosts) != 1:
        observed = f"roles with a {place}: {', '.join(hosts) or 'none'}"
        fix = f"give exactly one other role to robots with a {place}"
        problems.at(loc, f"whose {place} is not clear", observed=observed, allowed="one", fix=fix)


def _has(place: str, role: str, scope: Scope) -> bool:
    kinds = scope.kinds_of(role)
    return bool(kinds) and all(kind.part(place) for kind in kinds)

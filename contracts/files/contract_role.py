"""Roles of a contract: somebody in the crew can play each, all at once, and each can be brought to safety."""

from crew.contracts.files.contract_model import ContractModel
from crew.contracts.files.contract_scope import Scope, needed_skills
from crew.contracts.files.contract_value import check_operand
from crew.contracts.files.source import Loc, Problems, nearest_name


def check_roles(model: ContractModel, scope: Scope, problems: Problems) -> None:
    used = _used(model)
    for name in model.roles:
        loc: Loc = ("roles", name)
        if name in scope.values:
            problems.key(loc, "role and run-time value of one name", observed=repr(name), fix="rename the role")
        if name not in used:
            problems.key(loc, "unused role", observed=repr(name), fix="give it a step, or remove it")
        elif name in scope.uncast:
            _report_uncast(name, model, scope, problems)
        else:
            _check_safe(name, model, scope, problems)
    _check_distinct(used, scope, problems)


def _used(model: ContractModel) -> list[str]:
    """Roles that steps name, or meant to name: a misspelt role is a problem of the step alone."""
    named = {step.role for step in model.steps.values()}
    meant = {nearest_name(role, model.roles) for role in named if role not in model.roles}
    return [role for role in model.roles if role in named | meant]


def _report_uncast(role: str, model: ContractModel, scope: Scope, problems: Problems) -> None:
    """No robot has every skill of the role; skills that no kind has at all are problems of their own."""
    real = {skill.name for kind in scope.kinds for skill in kind.skills}
    needed = needed_skills(model, role) & real
    lacking = [f"{spec.name} lacks {', '.join(_lacks(needed, scope, spec.kind))}" for spec in scope.casts[role]]
    problems.key(
        ("roles", role),
        f"no robot of crew {scope.crew.name} can play {role}",
        observed="; ".join(lacking) or "a crew without robots",
        allowed=f"a robot with {', '.join(sorted(needed)) or 'its skills'}",
        fix="split the role, or add such a robot to the crew",
    )


def _lacks(needed: set[str], scope: Scope, kind: str) -> list[str]:
    return sorted(name for name in needed if scope.by_name[kind].skill(name) is None)


def _check_distinct(used: list[str], scope: Scope, problems: Problems) -> None:
    """Different roles are different robots: each must find one of its own."""
    taken: dict[str, str] = {}
    for role in used:
        if role not in scope.uncast and not _place(role, scope, taken, set()):
            names = ", ".join(spec.name for spec in scope.casts[role])
            what = f"no robot is left for role {role}"
            fix = "different roles are different robots; join the roles, or add a robot to the crew"
            problems.key(("roles", role), what, observed=f"only {names} can play it, and other roles need it", fix=fix)


def _place(role: str, scope: Scope, taken: dict[str, str], tried: set[str]) -> bool:
    """Bipartite matching, one augmenting path."""
    for spec in scope.casts[role]:
        if spec.name in tried:
            continue
        tried.add(spec.name)
        if spec.name not in taken or _place(taken[spec.name], scope, taken, tried):
            taken[spec.name] = role
            return True
    return False


def _check_safe(role: str, model: ContractModel, scope: Scope, problems: Problems) -> None:
    safe = model.roles[role].safe
    if safe is None:
        return
    loc: Loc = ("roles", role, "safe")
    kinds = scope.kinds_of(role)
    if not kinds or not all((skill := kind.skill(safe.by)) and skill.safe for kind in kinds):
        valid = [skill.name for skill in (kinds[0].skills if kinds else ()) if skill.safe]
        names = " or ".join(kind.name for kind in kinds)
        problems.unknown((*loc, "by"), f"not a safe skill of {names or 'the role'}", safe.by, valid)
    for fluent, value in safe.reach.items():
        _check_reach(role, fluent, value, (*loc, "reach", fluent), scope, problems)


def _check_reach(role: str, name: str, value: bool | float | str, loc: Loc, scope: Scope, problems: Problems) -> None:
    fluent = scope.fluent_of(role, name)
    if fluent is None:
        kinds = scope.kinds_of(role)
        valid = [f.name for f in (kinds[0].fluents if kinds else ())]
        what = f"unknown fluent of {' or '.join(kind.name for kind in kinds) or 'the role'}"
        problems.unknown(loc, what, name, valid, key=True)
    elif isinstance(value, str) and value.startswith("$"):
        fix = "a safe state must hold whatever was asked for; write a value"
        problems.at(loc, "slot in a safe state", observed=repr(value), fix=fix)
    else:
        check_operand(value, fluent.domain, loc, scope, problems)

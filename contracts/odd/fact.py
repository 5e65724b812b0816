"""What is certain whenever the gate asks about a step: what skills, guards and earlier steps have made sure of."""

from collections.abc import Iterator, Mapping

from crew.contracts.contract import CallPattern, Condition, Contract, Step
from crew.contracts.matching import needed_skills, robot_skills
from crew.contracts.site import Rules
from crew.contracts.skill import FluentLiteral, Kind, Skill

Facts = Mapping[str, tuple[FluentLiteral, str]]
"""Path to its value and, in a few words, why it is certain."""


def kinds_of(role: str, contract: Contract, rules: Rules) -> list[Kind]:
    """The kinds that may play a role, each once."""
    needed = needed_skills(contract, role, rules)
    able = [r for r in rules.crew.robots if needed <= robot_skills(r.name, rules)]
    return list({r.kind: rules.kinds[r.kind] for r in able}.values())


def skills_of(role: str, name: str, contract: Contract, rules: Rules) -> list[Skill]:
    """A skill as each kind that may play the role declares it."""
    return [skill for kind in kinds_of(role, contract, rules) if (skill := kind.skill(name))]


def before(step: Step, contract: Contract) -> list[Step]:
    """Every step that comes before this one, nearest first."""
    found: list[Step] = []
    waiting = list(step.after)
    while waiting:
        earlier = contract.step(waiting.pop(0))
        if earlier is not None and earlier not in found:
            found.append(earlier)
            waiting.extend(earlier.after)
    return found


def needed_by_skill(step: Step, contract: Contract, rules: Rules) -> Facts:
    """What every alternative of a step asks of its own robot, so that a guard need not."""
    common: dict[str, FluentLiteral] | None = None
    for call in step.do:
        for skill in skills_of(step.role, call.skill, contract, rules):
            asked = {f"{step.role}.{fluent}": value for fluent, value in skill.all_needs.items()}
            common = asked if common is None else dict(common.items() & asked.items())
    skills = " and ".join(dict.fromkeys(call.skill for call in step.do))
    return {path: (value, f"{skills} needs it already") for path, value in (common or {}).items()}


def guarded(step: Step) -> Facts:
    """What the step's own guards have made sure of."""
    return {c.path: (c.value, "a guard of this step says so") for c in step.needs if _plain(c)}


def brought_about(step: Step, contract: Contract, rules: Rules) -> Facts:
    """What the only earlier step that touches a fluent leaves it at; steps beside this one may touch it too."""
    touched: dict[str, list[tuple[Step, FluentLiteral]]] = {}
    for other in contract.steps:
        if other is not step and step not in before(other, contract):
            for path, value in effects_of(other, contract, rules):
                touched.setdefault(path, []).append((other, value))
    earlier = before(step, contract)
    return {
        path: (found[0][1], f"step {found[0][0].name} has brought it about")
        for path, found in touched.items()
        if len({value for _, value in found}) == 1
        and any(other in earlier and not other.optional for other, _ in found)
    }


def effects_of(step: Step, contract: Contract, rules: Rules) -> Iterator[tuple[str, FluentLiteral]]:
    """The fluents that any call of a step changes, as the contract would write them."""
    for call in step.do:
        for skill in skills_of(step.role, call.skill, contract, rules):
            for fluent, value in skill.effects.items():
                yield f"{step.role}.{fluent}", written(value, call)


def written(value: FluentLiteral, call: CallPattern) -> FluentLiteral:
    """An effect's value with the call's own argument in place of the skill's."""
    if not isinstance(value, str) or not value.startswith("$"):
        return value
    names = ("target", "location") if value in ("$place", "$point") else (value[1:],)
    return next((call.args[name] for name in names if name in call.args), value)


def _plain(condition: Condition) -> bool:
    return not condition.negated and not condition.when

"""A robot's card in prose: what it can do, within which bounds, under which conditions, and to what effect."""

from collections.abc import Iterator

from crew.contracts.gate.arguments import bounds
from crew.contracts.render.wording import fluent_words, listed
from crew.contracts.site import RobotSpec, Rules
from crew.contracts.skill import Entity, Kind, Param, Published, Skill


def robot_card(robot: str, rules: Rules) -> str:
    """One robot of a crew; bounds are narrowed by its operational area. Raises KeyError for an unknown robot."""
    spec, kind = rules.crew.robot(robot), rules.kind_of(robot)
    if spec is None or kind is None:
        raise KeyError(f"{robot!r} (known: {', '.join(known.name for known in rules.crew.robots)})")
    called = f" (also {', '.join(spec.aliases)})" if spec.aliases else ""
    return "\n".join([f"Robot {robot}{called}, a {kind.name}. {kind.about}", *_lines(spec, kind, rules)]) + "\n"


def _lines(spec: RobotSpec, kind: Kind, rules: Rules) -> Iterator[str]:
    if spec.reach:
        yield f"Reaches: {listed(spec.reach)}."
    yield from (f"Carries {part.name}: {part.about}" for part in kind.parts)
    yield "Skills:"
    for skill in kind.skills:
        yield f"- {signature(skill)}: {skill.about}"
        yield from (f"    {_param(param, rules)}" for param in skill.params)
        yield from (f"    {line}" for line in _behaviour(skill))
    if kind.publishes:
        yield "Publishes:"
        yield from (f"- {value.name} ({value.type}), {_made(value)}: {value.about}" for value in kind.publishes)


def _made(value: Published) -> str:
    return f"by {listed(value.by)}" if value.by else "all the time"


def signature(skill: Skill) -> str:
    """`navigate_to(target | x, y)`: required arguments, then each form of the optional ones."""
    required = ", ".join(param.name for param in skill.params if not param.optional)
    forms = " | ".join(", ".join(form) for form in skill.forms if form)
    return f"{skill.name}({', '.join(part for part in (required, forms) if part)})"


def _param(param: Param, rules: Rules) -> str:
    about = f" {param.about}" if param.about else ""
    if not param.is_number:
        names = {Entity.TARGET: "a run-time value or a location", Entity.OBJECT: "an object"}
        return f"{param.name}: {names.get(param.entity, 'a location')}.{about}"
    low, high = bounds(param, rules)
    frame = f", {param.frame}" if param.frame else ""
    return f"{param.name}: {low:g} to {high:g} {param.unit}{frame}.{about}"


def _behaviour(skill: Skill) -> Iterator[str]:
    if skill.needs:
        yield f"needs: {fluent_words(skill.needs)}"
    if skill.step_needs:
        yield f"needs as a step, not as a safe state: {fluent_words(skill.step_needs)}"
    if skill.effects:
        yield f"effect: {fluent_words(skill.effects)}"
    if skill.puts:
        yield f"effect: {skill.puts[0]} is seen at {skill.puts[1]}"
    if skill.during:
        yield f"while running: {fluent_words(skill.during)}"
    if skill.may:
        yield f"a failure may leave: {listed((fluent_words(left) for left in skill.may), word='or')}"
    if skill.reports:
        yield f"renews: {listed(skill.reports)}"

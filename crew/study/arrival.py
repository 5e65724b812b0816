"""How far from its goal a mission ended, measured on the simulation's truth. Knows kinds, and no robot."""

import math

from crew.contracts.language.words import REQUESTER
from crew.contracts.site import Rules
from crew.contracts.skill import NOTHING, Entity, Skill
from crew.messages import PlannedStep, SimTruth

Spot = tuple[float, float]


def goal_error_m(steps: tuple[PlannedStep, ...], truth: SimTruth, rules: Rules) -> float | None:
    """From what was to arrive (the object that the plan handles, else the robot of the last destination) to where.

    Horizontal, metres. An object without a destination was for the person who asks, if it is let go. None if the plan
    goes nowhere.
    """
    handled = next((name for step in reversed(steps) if (name := _object(step, rules)) in truth.targets), None)
    for step in reversed(steps):
        goal = _goal(step, truth, rules)
        if goal is not None:
            return _apart_m(truth.targets[handled] if handled else truth.poses.get(step.robot), goal)
    if handled is None or REQUESTER not in truth.targets or not any(_lets_go(step, rules) for step in steps):
        return None
    return _apart_m(truth.targets[handled], truth.targets[REQUESTER][:2])


def true_places(truth: SimTruth, rules: Rules) -> dict[str, tuple[float, float, float]]:
    """Where each object of the crew truly is: x, y, z."""
    return {thing.name: truth.targets[thing.name] for thing in rules.crew.objects if thing.name in truth.targets}


def _apart_m(subject: tuple[float, ...] | None, goal: Spot) -> float | None:
    return None if subject is None else round(math.dist(subject[:2], goal), 3)


def _skill(step: PlannedStep, rules: Rules) -> Skill | None:
    kind = rules.kind_of(step.robot)
    return None if kind is None else kind.skill(step.skill)


def _object(step: PlannedStep, rules: Rules) -> str | None:
    skill = _skill(step, rules)
    params = () if skill is None else skill.params
    found = (step.args.get(p.name) for p in params if p.entity is Entity.OBJECT)
    return next((name for name in found if isinstance(name, str)), None)


def _lets_go(step: PlannedStep, rules: Rules) -> bool:
    """Whether the robot holds nothing afterwards; an object that is held up is brought to nobody."""
    skill = _skill(step, rules)
    return skill is not None and NOTHING in skill.effects.values()


def _goal(step: PlannedStep, truth: SimTruth, rules: Rules) -> Spot | None:
    """Where a step goes to in the world: a run-time value's true place, a location, a point; not a part of a robot."""
    skill = _skill(step, rules)
    for param in () if skill is None else skill.params:
        name = step.args.get(param.name)
        if param.entity in (Entity.TARGET, Entity.LOCATION) and isinstance(name, str):
            if name in truth.targets:
                return truth.targets[name][:2]
            place = rules.crew.location(name)
            return None if place is None else (place.x, place.y)
    x, y = step.args.get("x"), step.args.get("y")
    return (x, y) if isinstance(x, float) and isinstance(y, float) else None

"""What an excluded mention forbids: robots, names, places by overlap, and skills."""

from collections.abc import Iterator, Mapping

from crew.contracts.contract import Contract
from crew.contracts.language.licence import resolved, same, shown, used_slots
from crew.contracts.language.mention import ROBOT_KINDS, Mention, MentionKind
from crew.contracts.plan import ArgValue, Instance, SlotValue, Spot, Zone
from crew.contracts.site import Rules
from crew.contracts.skill import Kind, Skill

Found = tuple[str, str]
"""The field of the plan and what stands there."""


def violation(mention: Mention, instance: Instance, contract: Contract, rules: Rules) -> Found | None:
    """Where a plan uses what the request excludes."""
    if mention.kind in ROBOT_KINDS:
        return _acting(mention, instance)
    if mention.kind is MentionKind.ACTION:
        return _done(mention, instance, contract, rules) if mention.bare else None
    return _used(mention, instance, contract, rules)


def excluded_skills(mention: Mention, kind: Kind) -> frozenset[str]:
    """The skills of a kind that a bare negated verb excludes.

    "Do not move" excludes more than the skills called so: all during which the robot does what locomotion does.
    """
    named = {ref.skill for ref in mention.means}
    hit = [s for s in kind.skills if s.name in named]
    during = [s.during for s in hit if s.during and _is_locomotion(s, kind)]
    wider = (s.name for s in kind.skills if any(d.items() <= s.during.items() for d in during))
    return frozenset((*(s.name for s in hit), *wider))


def _is_locomotion(skill: Skill, kind: Kind) -> bool:
    fluents = (kind.fluent(name) for name in skill.effects)
    return any(fluent is not None and fluent.domain == "place" for fluent in fluents)


def _acting(mention: Mention, instance: Instance) -> Found | None:
    for index, item in enumerate(instance.steps):
        if item.call.robot in mention.values:
            return f"steps[{index}].robot", str(item.call)
    return None


def _done(mention: Mention, instance: Instance, contract: Contract, rules: Rules) -> Found | None:
    own = {ref.step for ref in mention.means if ref.contract == contract.name and ref.own}
    for index, item in enumerate(instance.steps):
        kind = rules.kind_of(item.call.robot)
        skills = excluded_skills(mention, kind) if kind is not None else frozenset()
        if item.step in own or item.call.skill in skills:
            return f"steps[{index}]", str(item.call)
    return None


def _used(mention: Mention, instance: Instance, contract: Contract, rules: Rules) -> Found | None:
    found = list(_values(instance, contract, rules))
    searched = any(isinstance(value, Zone) for _, value in found)
    for field, value in found:
        if any(_touches(excluded, value, rules, searched) for excluded in mention.values):
            return field, shown(value, rules.crew)
    return None


def _values(instance: Instance, contract: Contract, rules: Rules) -> Iterator[tuple[str, SlotValue]]:
    """Everything that the calls carry: slots as wholes, names and points as they stand."""
    for name, (index, arg) in used_slots(instance, contract).items():
        slot, value = contract.slot(name), instance.slots.get(name)
        if slot is not None and value is not None:
            yield f"steps[{index}].args.{arg}", resolved(value, slot, rules.crew)
    for index, item in enumerate(instance.steps):
        for arg, value in item.call.args.items():
            if isinstance(value, str):
                yield f"steps[{index}].args.{arg}", value
        spot = _spot(item.call.args)
        if spot is not None:
            yield f"steps[{index}].args.x", spot


def _spot(args: Mapping[str, ArgValue]) -> Spot | None:
    x, y = args.get("x"), args.get("y")
    if isinstance(x, str) or isinstance(y, str) or x is None or y is None:
        return None
    return Spot(x, y)


def _touches(excluded: SlotValue, value: SlotValue, rules: Rules, searched: bool) -> bool:
    """Equality, or overlap where one of them is a zone. A named place lies where it lies.

    Where a run-time value will lie is not known, unless the plan itself looks for it in a zone that is compared here.
    """
    if isinstance(value, str) and (place := rules.crew.location(value)) is not None and not isinstance(excluded, str):
        value = Spot(place.x, place.y)
    if isinstance(excluded, str) and isinstance(value, Zone):
        place = rules.crew.location(excluded)
        return place is not None and value.contains(place.x, place.y)
    if isinstance(excluded, Zone | Spot) and isinstance(value, str):
        return rules.crew.value(value) is not None and not searched
    if isinstance(excluded, Zone) and isinstance(value, Zone):
        return excluded.overlaps(value)
    if isinstance(excluded, Zone) and isinstance(value, Spot):
        return excluded.contains(value.x, value.y)
    if isinstance(excluded, Spot) and isinstance(value, Zone):
        return value.contains(excluded.x, excluded.y)
    return same(excluded, value)

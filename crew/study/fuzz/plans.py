"""Plans from no planner: what a person means, left as it is or made wrong at one or two places, near every limit."""

import math
from collections.abc import Callable, Sequence
from random import Random

import msgspec

from crew.contracts.plan import ArgValue, Call, Plan
from crew.contracts.site import Rules
from crew.contracts.skill import Param, Skill
from crew.study.fuzz.wish import APPROACH, WISHES, Wish

STRANGE: tuple[ArgValue, ...] = (
    *(math.nan, math.inf, -math.inf, 1e308, -0.0, True),
    *("", "none", "victim", "requester", "payload_tray", "$object", "room_b2", "north_half"),
)
ROBOTS = ("iris", "tb3", "tb4", "g1", "go2", "iris2", "")
SKILLS = ("hover", "deliver", "pick_up", "land", "stop", "takeoff", "navigate_to", "navigate", "fly_to", "wave")


class Made(msgspec.Struct, frozen=True):
    """A plan, and whether it is one that a person would call right in a world that is in order."""

    plan: Plan
    right: bool
    how: str


def make(wish: Wish, rules: Rules, fits: frozenset[str], chance: Random) -> Made:
    """A plan for a request. `fits` are the supporting skills that the world has room for; a right plan keeps to it."""
    right = _right(wish, rules, fits, chance)
    if wish.calls and chance.random() < 0.45:
        return Made(right, True, "right")
    if not wish.calls or (wish.tempting and chance.random() < 0.4):
        plan = _tempting(wish, chance)
        if chance.random() < 0.6:
            return Made(plan, False, "tempting")
        right = plan
    plan, told = right, []
    for _ in range(chance.choice((1, 1, 1, 2))):
        change = chance.choice(CHANGES)
        plan = change(plan, wish, rules, chance)
        told.append(change.__name__.strip("_"))
    return Made(plan, False, " and ".join(told))


def _right(wish: Wish, rules: Rules, fits: frozenset[str], chance: Random) -> Plan:
    """The calls that are meant, with heights chosen within the bounds and up to them, and supporting ones that fit."""
    height = chance.choice((2.0, 10.0, 5.0, round(chance.uniform(2.0, 10.0), 2)))
    calls = [_with(c, altitude=height) if "altitude" in wish.free and "altitude" in c.args else c for c in wish.calls]
    kept = [
        c
        for c in calls
        if not wish.supports(c) or (_supporting(c) in fits and (c.skill != "land" or chance.random() < 0.9))
    ]
    if "land" in wish.optional and len(kept) > 1 and kept[-1].skill == "land" and chance.random() < 0.3:
        kept[-1], kept[-2] = kept[-2], kept[-1]
        kept = kept if kept[-1].skill == "navigate_to" else [*kept[:-2], kept[-1], kept[-2]]
    if wish.contract == "abort" and chance.random() < 0.5:
        kept.reverse()
    return Plan(wish.contract, tuple(kept))


def _supporting(call: Call) -> str:
    return "approach" if call == APPROACH else call.skill


def _tempting(wish: Wish, chance: Random) -> Plan:
    """What a planner would be tempted to do: a wrong plan that is close at hand, or another request's."""
    if wish.tempting and chance.random() < 0.7:
        return chance.choice(wish.tempting)
    other = chance.choice([w for w in WISHES if w.crew == wish.crew and w.calls])
    return Plan(other.contract, other.calls)


Change = Callable[[Plan, Wish, Rules, Random], Plan]


def _another_request(plan: Plan, wish: Wish, rules: Rules, chance: Random) -> Plan:
    return _tempting(wish, chance)


def _swapped(plan: Plan, wish: Wish, rules: Rules, chance: Random) -> Plan:
    steps = list(plan.steps)
    if len(steps) > 1:
        a, b = chance.sample(range(len(steps)), 2)
        steps[a], steps[b] = steps[b], steps[a]
    return Plan(plan.contract, tuple(steps))


def _dropped(plan: Plan, wish: Wish, rules: Rules, chance: Random) -> Plan:
    index = chance.randrange(max(1, len(plan.steps)))
    return Plan(plan.contract, plan.steps[:index] + plan.steps[index + 1 :])


def _doubled(plan: Plan, wish: Wish, rules: Rules, chance: Random) -> Plan:
    if not plan.steps:
        return plan
    call, index = chance.choice(plan.steps), chance.randrange(len(plan.steps) + 1)
    return Plan(plan.contract, (*plan.steps[:index], call, *plan.steps[index:]))


def _added(plan: Plan, wish: Wish, rules: Rules, chance: Random) -> Plan:
    others = [c for w in WISHES if w.crew == wish.crew for c in w.calls]
    index = chance.randrange(len(plan.steps) + 1)
    return Plan(plan.contract, (*plan.steps[:index], chance.choice(others), *plan.steps[index:]))


def _other_contract(plan: Plan, wish: Wish, rules: Rules, chance: Random) -> Plan:
    return Plan(chance.choice([*sorted(rules.contracts), "search", ""]), plan.steps)


def _other_robot(plan: Plan, wish: Wish, rules: Rules, chance: Random) -> Plan:
    return _one(plan, chance, lambda call: Call(chance.choice(ROBOTS), call.skill, call.args))


def _all_to_another(plan: Plan, wish: Wish, rules: Rules, chance: Random) -> Plan:
    robot = chance.choice(ROBOTS)
    return Plan(plan.contract, tuple(Call(robot, c.skill, c.args) for c in plan.steps))


def _other_skill(plan: Plan, wish: Wish, rules: Rules, chance: Random) -> Plan:
    return _one(plan, chance, lambda call: Call(call.robot, chance.choice(SKILLS), call.args))


def _at_the_limit(plan: Plan, wish: Wish, rules: Rules, chance: Random) -> Plan:
    """A number at its limit, or the next one beyond or within."""

    def change(call: Call) -> Call:
        names = [n for n, v in call.args.items() if not isinstance(v, str)]
        if not names:
            return call
        name = chance.choice(names)
        limit = chance.choice(_limits(_param(call, name, rules), rules) or [float(call.args[name])])
        near = chance.choice((limit, math.nextafter(limit, math.inf), math.nextafter(limit, -math.inf)))
        return _with(call, **{name: near})

    return _one(plan, chance, change)


def _by_a_hair(plan: Plan, wish: Wish, rules: Rules, chance: Random) -> Plan:
    """A number that differs from what was asked for by a hair, or by a step."""

    def change(call: Call) -> Call:
        names = [n for n, v in call.args.items() if not isinstance(v, str)]
        if not names:
            return call
        name = chance.choice(names)
        value = float(call.args[name])
        near = chance.choice(
            (math.nextafter(value, math.inf), value + 1e-5, value + 1e-3, value + 0.05, value - 0.5, value + 2.0)
        )
        return _with(call, **{name: near})

    return _one(plan, chance, change)


def _strange_value(plan: Plan, wish: Wish, rules: Rules, chance: Random) -> Plan:
    def change(call: Call) -> Call:
        return _with(call, **{chance.choice(sorted(call.args)): chance.choice(STRANGE)}) if call.args else call

    return _one(plan, chance, change)


def _substituted(plan: Plan, wish: Wish, rules: Rules, chance: Random) -> Plan:
    """Another name of the same sort, or figures where a name was meant."""
    crew = rules.crew
    names = [p.name for p in crew.locations] + [v.name for v in crew.values] + [o.name for o in crew.objects]

    def change(call: Call) -> Call:
        named = [n for n, v in call.args.items() if isinstance(v, str)]
        if not named:
            return call
        return _with(call, **{chance.choice(named): chance.choice(names)})

    return _one(plan, chance, change)


def _other_zone(plan: Plan, wish: Wish, rules: Rules, chance: Random) -> Plan:
    zone = chance.choice(rules.crew.zones).zone if rules.crew.zones else rules.crew.area
    edges: dict[str, ArgValue] = {"x_min": zone.x_min, "x_max": zone.x_max, "y_min": zone.y_min, "y_max": zone.y_max}
    steps = tuple(_with(c, **edges) if "x_min" in c.args else c for c in plan.steps)
    return Plan(plan.contract, steps)


def _arguments(plan: Plan, wish: Wish, rules: Rules, chance: Random) -> Plan:
    """One argument too many, too few, or under another name."""

    def change(call: Call) -> Call:
        if not call.args or chance.random() < 0.4:
            return Call(call.robot, call.skill, {**call.args, chance.choice(("speed", "x", "target", "altitude")): 1.0})
        name = chance.choice(sorted(call.args))
        rest = {k: v for k, v in call.args.items() if k != name}
        return Call(call.robot, call.skill, rest if chance.random() < 0.5 else {**rest, f"{name}_": call.args[name]})

    return _one(plan, chance, change)


CHANGES: Sequence[Change] = (
    *(_another_request, _swapped, _dropped, _doubled, _added, _other_contract, _other_robot),
    *(_all_to_another, _other_skill, _at_the_limit, _at_the_limit, _by_a_hair, _strange_value, _substituted),
    *(_substituted, _other_zone, _arguments),
)


def _one(plan: Plan, chance: Random, change: Callable[[Call], Call]) -> Plan:
    if not plan.steps:
        return plan
    index = chance.randrange(len(plan.steps))
    return Plan(plan.contract, (*plan.steps[:index], change(plan.steps[index]), *plan.steps[index + 1 :]))


def _with(call: Call, **changes: ArgValue) -> Call:
    return Call(call.robot, call.skill, {**call.args, **changes})


def _param(call: Call, name: str, rules: Rules) -> Param | None:
    kind = rules.kind_of(call.robot)
    skill: Skill | None = None if kind is None else kind.skill(call.skill)
    return None if skill is None else skill.param(name)


def _limits(param: Param | None, rules: Rules) -> list[float]:
    if param is None:
        return []
    area = rules.crew.area
    own = {"x": [area.x_min, area.x_max], "y": [area.y_min, area.y_max]}.get(param.axis, [])
    return own or [limit for limit in (param.ge, param.le) if limit is not None]

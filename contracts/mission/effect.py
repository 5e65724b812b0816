"""Effects: what a skill is expected to change, whether telemetry has shown it, and the predicted world of a dry run."""

from collections.abc import Mapping, Sequence
from types import MappingProxyType

from msgspec.structs import replace

from crew.contracts.gate.guard import Scope, Truth, robot_fluent_is, value_is
from crew.contracts.mission_state import StepRecord
from crew.contracts.plan import Call, Zone
from crew.contracts.site import Rules
from crew.contracts.skill import FluentLiteral, Skill
from crew.contracts.snapshot import (
    FluentValue,
    Point,
    RobotState,
    Snapshot,
    Stamped,
    StampedValue,
    ValueReading,
)


def effect_values(skill: Skill, call: Call) -> dict[str, FluentValue]:
    """A skill's effects with its arguments filled in. `$place` is the target or the point that the call names."""
    return {fluent: _resolve(value, call) for fluent, value in skill.effects.items()}


def _resolve(value: FluentLiteral, call: Call) -> FluentValue:
    if not isinstance(value, str) or not value.startswith("$"):
        return value
    if value in ("$place", "$point"):
        target = call.args.get("target", call.args.get("location"))
        return target if isinstance(target, str) else Point(_number(call, "x"), _number(call, "y"))
    return call.args[value[1:]]


def _number(call: Call, name: str) -> float:
    value = call.args[name]
    assert not isinstance(value, str), f"{name} passed the argument check"
    return float(value)


def unseen_effect(record: StepRecord, scope: Scope) -> str:
    """Empty once telemetry newer than the dispatch shows every effect; otherwise the first that it does not show."""
    call = record.call
    kind = scope.rules.kind_of(call.robot)
    skill = None if kind is None else kind.skill(call.skill)
    state = scope.world.robots.get(call.robot)
    if skill is None or state is None:
        return f"{call.robot} was not heard"
    for fluent, wanted in effect_values(skill, call).items():
        stamped = state.fluents.get(fluent)
        if stamped is None or stamped.source_ns <= record.dispatched_ns:
            return f"{call.robot}.{fluent} has not been observed since the dispatch"
        verdict = robot_fluent_is(call.robot, fluent, wanted, scope)
        if verdict.truth is not Truth.HOLDS:
            return f"{call.robot}.{fluent} is {verdict.observed}"
    for name in skill.reports:
        published = scope.world.values.get(name)
        if published is None or published.source != call.robot or published.received_ns < record.dispatched_ns:
            return f"{call.robot} has not published {name} since the dispatch"
    return _not_put(skill, record, scope)


def _not_put(skill: Skill, record: StepRecord, scope: Scope) -> str:
    """Empty once the object is seen where the call puts it, by the place's host or as the object's own position.

    A robot that looks at itself alone (a scope without roles) leaves another robot's part to the orchestrator.
    """
    if skill.puts is None:
        return ""
    thing, place = (str(record.call.args[name]) for name in skill.puts)
    part = scope.rules.parts.get(place)
    if part is None:
        stamped = scope.world.values.get(thing)
        if stamped is None or stamped.reading.stamp_ns <= record.dispatched_ns:
            return f"{thing} has not been seen since the dispatch"
        verdict = value_is(thing, "at", place, scope)
        return "" if verdict.truth is Truth.HOLDS else f"{thing}.at is {verdict.observed}, not {place}"
    host = scope.rules.host_of(place, scope.roles.values())
    if not host:
        return "" if not scope.roles else f"nobody in this mission has a {place}"
    state = scope.world.robots.get(host)
    seen = None if state is None else state.fluents.get(part.holds)
    if seen is None or seen.source_ns <= record.dispatched_ns:
        return f"{host}.{part.holds} has not been observed since the dispatch"
    verdict = robot_fluent_is(host, part.holds, thing, scope)
    return "" if verdict.truth is Truth.HOLDS else f"{host}.{part.holds} is {verdict.observed}"


def safe_state_missing(robot: str, reach: Mapping[str, FluentLiteral], scope: Scope, since_ns: int = 0) -> str:
    """Empty if a safe state holds in fresh telemetry that is newer than `since_ns`; otherwise what is missing."""
    state = scope.world.robots.get(robot)
    for fluent, wanted in reach.items():
        stamped = None if state is None else state.fluents.get(fluent)
        if since_ns and (stamped is None or stamped.source_ns <= since_ns):
            return f"{robot}.{fluent} has not been observed since the last dispatch"
        verdict = robot_fluent_is(robot, fluent, wanted, scope)
        if verdict.truth is not Truth.HOLDS:
            return f"{robot}.{fluent} is {verdict.observed if verdict.truth is Truth.FAILS else verdict.truth}"
    return ""


def assumed_world(world: Snapshot, mission_id: str, rules: Rules, now_ns: int) -> Snapshot:
    """The world that validation starts from: every robot available, leased and idle; what is known counts as fresh.

    Robots are taken to keep clear of each other: where they will be by then is not known.
    """
    robots = {}
    for spec in rules.crew.robots:
        known = world.robots.get(spec.name) or RobotState(name=spec.name)
        relations = {f.name: f.resting for f in rules.kinds[spec.kind].fluents if f.relation is not None}
        robots[spec.name] = replace(
            known,
            kind_digest=rules.kinds[spec.kind].digest,
            unavailable="",
            running="",
            lease=mission_id,
            fluents={
                **{name: Stamped(s.value, now_ns, now_ns) for name, s in known.fluents.items()},
                **{name: Stamped(v, now_ns, now_ns) for name, v in relations.items() if v is not None},
            },
        )
    return replace(world, robots=robots)


def predict(
    world: Snapshot,
    call: Call,
    skill: Skill,
    rules: Rules,
    now_ns: int,
    avoid: Sequence[Zone] = (),
    roles: Mapping[str, str] = MappingProxyType({}),
) -> Snapshot:
    """The world after a successful call. Values that it publishes are assumed good, and outside the zones to avoid.

    `roles` are the mission's: at a part of a robot, its host sees what was put there.
    """
    state = world.robots[call.robot]
    fluents = dict(state.fluents)
    fluents.update({name: Stamped(v, now_ns, now_ns) for name, v in effect_values(skill, call).items()})
    values = dict(world.values)
    for name in skill.reports:
        position = somewhere(rules.crew.area, avoid)
        reading = ValueReading(name=name, status="ok", position=position, stamp_ns=now_ns)
        values[name] = StampedValue(reading, call.robot, now_ns)
    robots = {**world.robots, call.robot: replace(state, fluents=fluents)}
    _put(call, skill, rules, now_ns, robots, values, roles)
    return replace(world, robots=robots, values=values)


def _put(
    call: Call,
    skill: Skill,
    rules: Rules,
    now_ns: int,
    robots: dict[str, RobotState],
    values: dict[str, StampedValue],
    roles: Mapping[str, str],
) -> None:
    """Predict where an object lies that the call puts somewhere, in place."""
    if skill.puts is None:
        return
    thing, place = (str(call.args[name]) for name in skill.puts)
    part, host, location = rules.parts.get(place), rules.host_of(place, roles.values()), rules.crew.location(place)
    if part is not None and host:
        told = {**robots[host].fluents, part.holds: Stamped(thing, now_ns, now_ns)}
        robots[host] = replace(robots[host], fluents=told)
    elif location is not None:
        reading = ValueReading(name=thing, status="ok", position=Point(location.x, location.y), stamp_ns=now_ns)
        values[thing] = StampedValue(reading, call.robot, now_ns)


def somewhere(area: Zone, avoid: Sequence[Zone]) -> Point:
    """The middle of the area, or the first point of a coarse grid that no zone to avoid holds, if there is one."""
    grid = [
        Point(area.x_min + (area.x_max - area.x_min) * i / 8, area.y_min + (area.y_max - area.y_min) * j / 8)
        for i in (4, 1, 2, 3, 5, 6, 7)
        for j in (4, 1, 2, 3, 5, 6, 7)
    ]
    return next((p for p in grid if not any(z.contains(p.x, p.y) for z in avoid)), grid[0])

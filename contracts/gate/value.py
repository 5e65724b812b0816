"""The gate's last group of checks: values that exist only now, resolved to the places that a dispatch pins."""

import math

from crew.contracts.codes import Code
from crew.contracts.gate.guard import age
from crew.contracts.gate.scope import is_position, skill_of
from crew.contracts.gate.sighting import question, why_no_position
from crew.contracts.mission_state import MissionState
from crew.contracts.plan import Call, InstanceStep, Zone
from crew.contracts.refusal import Refusal
from crew.contracts.site import Rules
from crew.contracts.snapshot import Point, Snapshot, StampedValue


def check_values(
    call: Call, step: str, mission: MissionState, world: Snapshot, rules: Rules, now_ns: int
) -> Refusal | dict[str, Point]:
    """Every symbolic argument as the place it means now, or the refusal of the first that means none."""
    places: dict[str, Point] = {}
    for param in skill_of(call, rules).targets:
        name = call.args.get(param.name)
        if not isinstance(name, str):
            continue
        location = rules.crew.location(name)
        if location is not None:
            places[param.name] = Point(location.x, location.y)
            continue
        outcome = _usable(name, step, mission, world, rules, now_ns)
        if isinstance(outcome, str):
            message = f"{call.robot}.{call.skill} needs a fix of {name}: {outcome}"
            code = Code.NO_TARGET_FIX if is_position(name, rules) else Code.NO_VALUE
            return Refusal(
                code=code,
                message=message,
                field=f"args.{param.name}",
                observed=outcome,
                allowed="a fresh fix",
                question=question(name, world.values.get(name)),
            )
        excluded = next((z for z in mission.reading.excluded_areas if z.contains(outcome.x, outcome.y)), None)
        if excluded is not None:
            where = f"({outcome.x:.2f}, {outcome.y:.2f})"
            return Refusal(
                code=Code.FORBIDDEN_BY_REQUEST,
                message=f"{name} is at {where}, inside an area that the request excludes: {_zone(excluded)}",
                field=f"args.{param.name}",
                observed=where,
                allowed=f"outside {_zone(excluded)}",
            )
        places[param.name] = outcome
    return places


def _zone(zone: Zone) -> str:
    return f"x {zone.x_min:g} to {zone.x_max:g}, y {zone.y_min:g} to {zone.y_max:g}"


def _usable(name: str, step: str, mission: MissionState, world: Snapshot, rules: Rules, now_ns: int) -> Point | str:
    """A run-time value's position, or in a few words why it can't be used."""
    stamped = world.values.get(name)
    if stamped is None:
        return "absent: nothing was published"
    reading, position = stamped.reading, stamped.reading.position
    if reading.status != "ok" or position is None:
        return why_no_position(name, stamped)
    if not all(map(math.isfinite, (position.x, position.y, position.z))):
        return f"not finite: {stamped.source} published ({position.x:g}, {position.y:g})"
    area = rules.crew.area
    if not area.contains(position.x, position.y):
        return f"outside the operational area: ({position.x:.2f}, {position.y:.2f})"
    return _stale(stamped, step, mission, rules, now_ns) or position


def _stale(stamped: StampedValue, step: str, mission: MissionState, rules: Rules, now_ns: int) -> str:
    reading = stamped.reading
    declared = rules.publication(stamped.source, reading.name)
    if declared is None:
        return f"published by {stamped.source}, whose kind publishes no {reading.name}"
    age_s = age(reading.stamp_ns, now_ns)
    if not 0.0 <= age_s <= declared.max_age_s:
        return f"stale: {age_s:.1f} s old, at most {declared.max_age_s:g} s"
    since_ns = _published_since(reading.name, step, mission, rules)
    if since_ns is not None and reading.stamp_ns < since_ns:
        return "stale: older than the step that publishes it (a fix of an earlier mission is no fix)"
    return ""


def _published_since(name: str, step: str, mission: MissionState, rules: Rules) -> int | None:
    """When the plan's own first publishing step was dispatched; None if the plan does not publish the value."""
    assert mission.instance is not None
    stamps = [
        mission.steps[other.step].dispatched_ns
        for other in mission.instance.steps
        if other.step != step and _reports(other, name, rules) and mission.steps[other.step].sequence
    ]
    return min(stamps, default=None)


def _reports(step: InstanceStep, name: str, rules: Rules) -> bool:
    return name in skill_of(step.call, rules).reports

"""The gate: one pure function that every dispatch passes at the moment it happens. It performs nothing.

Checks run in the order of the codes: capability, arguments, workflow, containment, state, run-time values.
"""

import math
from collections.abc import Iterable, Mapping

from crew.contracts.arguments import check_call
from crew.contracts.codes import Code
from crew.contracts.contract import Condition
from crew.contracts.decision import Decision
from crew.contracts.guard import SECOND_NS, Scope, Truth, Verdict, age, evaluate, robot_fluent_is
from crew.contracts.language.containment import Finding, check_containment
from crew.contracts.language.mention import Reading
from crew.contracts.mission_state import ACTIVE, CONSUMED, MissionState, Purpose, StepPhase, enabled
from crew.contracts.plan import Call, Instance, InstanceStep
from crew.contracts.refusal import Refusal, show
from crew.contracts.site import Rules
from crew.contracts.skill import Entity, Skill
from crew.contracts.snapshot import Point, Snapshot, StampedValue


class Gate:
    """The enforcing authorizer. It remembers containment findings by identity, since request and instance never change."""

    def __init__(self) -> None:
        self._findings: dict[tuple[int, int, bool], tuple[Reading, Instance, Finding | None]] = {}

    def authorize(
        self, call: Call, mission: MissionState, world: Snapshot, rules: Rules, now_ns: int, purpose: Purpose
    ) -> Decision:
        """Judge one call against everything that is known now."""
        step = _step_for(call, mission, purpose)
        refusal = (
            check_call(call, rules)
            or _check_workflow(call, step, mission, rules, purpose)
            or (self._check_containment(mission, rules) if purpose is Purpose.EXECUTE else None)
            or _check_state(call, step, mission, world, rules, now_ns, purpose)
        )
        places: Mapping[str, Point] = {}
        if refusal is None:
            outcome = _check_values(call, step, mission, world, rules, now_ns)
            refusal, places = (outcome, {}) if isinstance(outcome, Refusal) else (None, outcome)
        return Decision(
            mission=mission.id,
            step=step,
            call=call,
            purpose=purpose,
            at_ns=now_ns,
            refusal=refusal,
            places=places,
        )

    def _check_containment(self, mission: MissionState, rules: Rules) -> Refusal | None:
        assert mission.instance is not None
        key = (id(mission.reading), id(mission.instance), mission.confirmed)
        known = self._findings.get(key)
        if known is None or known[0] is not mission.reading or known[1] is not mission.instance:
            finding = check_containment(mission.reading, mission.instance, rules, confirmed=mission.confirmed)
            if len(self._findings) > 64:
                self._findings.clear()
            known = self._findings[key] = (mission.reading, mission.instance, finding)
        return None if known[2] is None else finding_refusal(known[2])


def finding_refusal(finding: Finding) -> Refusal:
    """A containment finding as a refusal."""
    return Refusal(code=finding.code, message=finding.message, field=finding.field, allowed=", ".join(finding.allowed))


def scope_of(mission: MissionState, world: Snapshot, rules: Rules, now_ns: int) -> Scope:
    """What the names in a mission's guards mean."""
    instance = mission.instance
    if instance is None:
        return Scope(rules=rules, world=world, now_ns=now_ns)
    return Scope(
        rules=rules, world=world, now_ns=now_ns, roles=instance.roles, slots=instance.slots, pins=pins_of(mission)
    )


def pins_of(mission: MissionState) -> dict[str, Point]:
    """Run-time values as they were pinned by the steps dispatched so far: symbol to place."""
    pins: dict[str, Point] = {}
    for record in mission.steps.values():
        for argument, point in record.places.items():
            symbol = record.call.args.get(argument)
            if isinstance(symbol, str):
                pins[symbol] = point
    return pins


# --- workflow


def _step_for(call: Call, mission: MissionState, purpose: Purpose) -> str:
    """The step that a call would fill: an enabled one first, then any with the same call."""
    if mission.instance is None:
        return ""
    if purpose is Purpose.SAFE:
        role = next((role for role, robot in mission.instance.roles.items() if robot == call.robot), "")
        return f"safe:{role}" if role else ""
    same = [s.step for s in mission.instance.steps if s.call == call]
    ready = {name for name in same if mission.steps[name].phase is StepPhase.DECIDING} | set(enabled(mission))
    return next((name for name in same if name in ready), same[0] if same else "")


def _check_workflow(call: Call, step: str, mission: MissionState, rules: Rules, purpose: Purpose) -> Refusal | None:
    if mission.instance is None:
        return Refusal(code=Code.MALFORMED_PLAN, message="the mission has no validated plan", field="plan")
    contract = rules.contracts.get(mission.instance.contract)
    if contract is None:
        message = f"the crew has no contract {mission.instance.contract!r}"
        return Refusal(code=Code.UNKNOWN_CONTRACT, message=message, field="contract")
    if purpose is Purpose.SAFE:
        role = contract.role(step.removeprefix("safe:"))
        if role is None or role.safe is None or role.safe.by != call.skill or call.args:
            message = f"{call} is no declared safe state of {contract.name}"
            return Refusal(code=Code.NOT_IN_PLAN, message=message, field="skill", observed=str(call))
        return None
    if not step:
        message = f"{call} is no step of the validated plan"
        allowed = ", ".join(str(s.call) for s in mission.instance.steps)
        return Refusal(code=Code.NOT_IN_PLAN, message=message, field="call", observed=str(call), allowed=allowed)
    return _check_transition(step, mission)


def _check_transition(step: str, mission: MissionState) -> Refusal | None:
    assert mission.instance is not None
    record = mission.steps[step]
    if record.phase in CONSUMED:
        message = f"step {step} was authorised before ({record.phase}); a step is never sent twice"
        return Refusal(code=Code.ALREADY_CONSUMED, message=message, field=step, observed=str(record.phase))
    declared = mission.instance.step(step)
    assert declared is not None
    waiting = [name for name in declared.after if mission.steps[name].phase is not StepPhase.SUCCEEDED]
    if waiting:
        phases = ", ".join(f"{name} is {mission.steps[name].phase}" for name in waiting)
        message = f"step {step} comes after {', '.join(waiting)}: {phases}"
        return Refusal(code=Code.OUT_OF_ORDER, message=message, field=step, observed=phases, allowed="succeeded")
    return None


# --- state


def _check_state(
    call: Call, step: str, mission: MissionState, world: Snapshot, rules: Rules, now_ns: int, purpose: Purpose
) -> Refusal | None:
    skill = _skill(call, rules)
    executing = purpose is Purpose.EXECUTE
    return (
        _check_availability(call, mission, world, rules)
        or _check_busy(call, step, mission, world)
        or _check_freshness(call, world, rules, now_ns)
        or _check_preconditions(call, skill, mission, world, rules, now_ns)
        or (_check_guards(step, mission, world, rules, now_ns) if executing else None)
        or (_check_deadline(mission, rules, now_ns) if executing else None)
        or (_check_approval(step, mission, rules) if executing else None)
    )


def _check_availability(call: Call, mission: MissionState, world: Snapshot, rules: Rules) -> Refusal | None:
    state = world.robots.get(call.robot)
    if world.stopped or (state is not None and state.stopped):
        whose = "the crew is" if world.stopped else f"{call.robot} is"
        message = f"{whose} stopped; nothing moves before a reset (crew reset)"
        return Refusal(code=Code.STOPPED, message=message, field=call.robot, observed="stopped", allowed="released")
    reason = "never heard of" if state is None else state.unavailable
    kind = rules.kind_of(call.robot)
    if state is not None and not reason and kind is not None and state.kind_digest != kind.digest:
        reason = "announces another declaration of its kind"
    if reason:
        message = f"{call.robot} is unavailable: {reason} (crew status)"
        return Refusal(
            code=Code.ROBOT_UNAVAILABLE, message=message, field=call.robot, observed=reason, allowed="available"
        )
    assert state is not None
    if state.lease != mission.id:
        holder = state.lease or "nobody"
        message = f"{call.robot} is leased to {holder}, not to {mission.id}"
        return Refusal(code=Code.ROBOT_LEASED, message=message, field=call.robot, observed=holder, allowed=mission.id)
    return None


def _check_busy(call: Call, step: str, mission: MissionState, world: Snapshot) -> Refusal | None:
    records: Iterable[tuple[str, object]] = [
        *mission.steps.items(),
        *((f"safe:{r}", s) for r, s in mission.safe.items()),
    ]
    running = next(
        (
            name
            for name, record in records
            if name != step and record.phase in ACTIVE and record.call.robot == call.robot  # type: ignore[attr-defined]
        ),
        world.robots[call.robot].running,
    )
    if not running:
        return None
    message = f"{call.robot} is still busy with {running}"
    return Refusal(code=Code.ROBOT_BUSY, message=message, field=call.robot, observed=running, allowed="idle")


def _check_freshness(call: Call, world: Snapshot, rules: Rules, now_ns: int) -> Refusal | None:
    """A robot whose telemetry has gone quiet takes no call, whether or not a guard reads it."""
    kind = rules.kind_of(call.robot)
    assert kind is not None
    fluents = world.robots[call.robot].fluents
    for declared in kind.fluents:
        stamped = fluents.get(declared.name)
        if stamped is None:
            continue
        age_s = age(stamped.source_ns, now_ns)
        if 0.0 <= age_s <= declared.max_age_s:
            return None
    newest = max((s.source_ns for s in fluents.values()), default=None)
    seen = "nothing heard yet" if newest is None else f"newest state is {(now_ns - newest) / SECOND_NS:.1f} s old"
    message = f"state of {call.robot} is stale: {seen}; is its adapter running? (crew status)"
    return Refusal(code=Code.STATE_STALE, message=message, field=call.robot, observed=seen, allowed="fresh telemetry")


def _check_preconditions(
    call: Call, skill: Skill, mission: MissionState, world: Snapshot, rules: Rules, now_ns: int
) -> Refusal | None:
    scope = scope_of(mission, world, rules, now_ns)
    for fluent, wanted in skill.needs.items():
        verdict = robot_fluent_is(call.robot, fluent, wanted, scope)
        refusal = _judge(f"{call.robot}.{fluent}", f"is {show(wanted)}", verdict, "")
        if refusal is not None:
            return refusal
    return None


def _check_guards(step: str, mission: MissionState, world: Snapshot, rules: Rules, now_ns: int) -> Refusal | None:
    assert mission.instance is not None
    contract = rules.contracts[mission.instance.contract]
    declared = contract.step(step)
    assert declared is not None
    entry = () if mission.sent_any else contract.needs
    scope = scope_of(mission, world, rules, now_ns)
    for condition in (*entry, *declared.needs):
        line = f"{contract.name}:{condition.line}"
        refusal = _judge(condition.path, _wanted(condition), evaluate(condition, scope), line, scope)
        if refusal is not None:
            return refusal
    return None


def _wanted(condition: Condition) -> str:
    return f"is {'not ' if condition.negated else ''}{show(condition.value)}"


def _judge(path: str, wanted: str, verdict: Verdict, line: str, scope: Scope | None = None) -> Refusal | None:
    if verdict.truth is Truth.HOLDS:
        return None
    aged = "" if verdict.age_s is None else f" ({verdict.age_s:.1f} s old, at most {verdict.max_age_s:g} s)"
    if verdict.truth is Truth.FAILS:
        message = f"needs that {path} {wanted}, observed {verdict.observed}"
        code = Code.PRECONDITION_FAILED
    elif scope is not None and path.partition(".")[0] not in scope.roles:
        message = f"needs that {path} {wanted}, but no usable value was published"
        code = Code.NO_TARGET_FIX if _is_position(path.partition(".")[0], scope.rules) else Code.NO_VALUE
    else:
        message = f"needs that {path} {wanted}, but its state is {verdict.truth}{aged}"
        code = Code.STATE_STALE
    return Refusal(code=code, message=message, field=path, observed=verdict.observed, allowed=wanted, line=line)


def _check_deadline(mission: MissionState, rules: Rules, now_ns: int) -> Refusal | None:
    assert mission.instance is not None
    limit_s = rules.contracts[mission.instance.contract].deadline_s
    spent_s = (now_ns - mission.started_ns) / SECOND_NS if mission.started_ns else 0.0
    if spent_s <= limit_s:
        return None
    message = f"the mission has run {spent_s:.0f} s, its contract allows {limit_s:g} s"
    return Refusal(
        code=Code.DEADLINE_PASSED,
        message=message,
        field="deadline_s",
        observed=f"{spent_s:.0f} s",
        allowed=f"{limit_s:g} s",
    )


def _check_approval(step: str, mission: MissionState, rules: Rules) -> Refusal | None:
    assert mission.instance is not None
    declared = rules.contracts[mission.instance.contract].step(step)
    if declared is None or not declared.approval or step in mission.approvals:
        return None
    message = f"step {step} waits for a person's approval"
    return Refusal(code=Code.APPROVAL_MISSING, message=message, field=step, observed="none", allowed="an approval")


# --- run-time values


def _check_values(
    call: Call, step: str, mission: MissionState, world: Snapshot, rules: Rules, now_ns: int
) -> Refusal | dict[str, Point]:
    """Every symbolic argument as the place it means now, or the refusal of the first that means none."""
    places: dict[str, Point] = {}
    for param in _skill(call, rules).params:
        name = call.args.get(param.name)
        if param.entity is not Entity.TARGET or not isinstance(name, str):
            continue
        location = rules.crew.location(name)
        if location is not None:
            places[param.name] = Point(location.x, location.y)
            continue
        outcome = _usable(name, step, mission, world, rules, now_ns)
        if isinstance(outcome, str):
            message = f"{call.robot}.{call.skill} needs a fix of {name}: {outcome}"
            code = Code.NO_TARGET_FIX if _is_position(name, rules) else Code.NO_VALUE
            return Refusal(
                code=code, message=message, field=f"args.{param.name}", observed=outcome, allowed="a fresh fix"
            )
        places[param.name] = outcome
    return places


def _usable(name: str, step: str, mission: MissionState, world: Snapshot, rules: Rules, now_ns: int) -> Point | str:
    """A run-time value's position, or in a few words why it can't be used."""
    stamped = world.values.get(name)
    if stamped is None:
        return "absent: nothing was published"
    reading, position = stamped.reading, stamped.reading.position
    if reading.status != "ok" or position is None:
        return f"{reading.status}: {stamped.source} reports no position"
    if not all(map(math.isfinite, (position.x, position.y, position.z))):
        return f"not finite: {stamped.source} published ({position.x:g}, {position.y:g})"
    area = rules.crew.area
    if not area.contains(position.x, position.y):
        return f"outside the operational area: ({position.x:.2f}, {position.y:.2f})"
    return _stale(stamped, step, mission, rules, now_ns) or position


def _stale(stamped: StampedValue, step: str, mission: MissionState, rules: Rules, now_ns: int) -> str:
    reading = stamped.reading
    kind = rules.kind_of(stamped.source)
    declared = None if kind is None else next((p for p in kind.publishes if p.name == reading.name), None)
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
    return name in _skill(step.call, rules).reports


def _is_position(name: str, rules: Rules) -> bool:
    return any(p.name == name and p.type == "position" for kind in rules.kinds.values() for p in kind.publishes)


def _skill(call: Call, rules: Rules) -> Skill:
    kind = rules.kind_of(call.robot)
    skill = None if kind is None else kind.skill(call.skill)
    assert skill is not None, f"{call} passed the capability check"
    return skill

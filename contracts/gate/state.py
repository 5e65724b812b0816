"""The gate's fifth group of checks: stop, availability, lease, freshness, preconditions, deadline, approval."""

from collections.abc import Iterator

from crew.contracts.codes import ORDER, Code
from crew.contracts.contract import Condition
from crew.contracts.gate.approval import check_approval
from crew.contracts.gate.guard import (
    SECOND_NS,
    Scope,
    Truth,
    Verdict,
    age,
    evaluate,
    robot_fluent_is,
    value_name,
)
from crew.contracts.gate.scope import is_position, scope_of, skill_of
from crew.contracts.mission_state import ACTIVE, MissionState, Purpose
from crew.contracts.plan import Call
from crew.contracts.refusal import Refusal, show
from crew.contracts.site import Rules
from crew.contracts.snapshot import Snapshot


def check_state(
    call: Call, step: str, mission: MissionState, world: Snapshot, rules: Rules, now_ns: int, purpose: Purpose
) -> Refusal | None:
    """The first check of state that fails. A safe call is exempt from guards, deadline and approval."""
    return (
        _check_availability(call, mission, world, rules)
        or _check_busy(call, step, mission, world)
        or _check_freshness(call, world, rules, now_ns, purpose)
        or min(_conditions(call, step, mission, world, rules, now_ns, purpose), key=_rank, default=None)
    )


def check_unheard(
    call: Call, step: str, mission: MissionState, world: Snapshot, rules: Rules, now_ns: int
) -> Refusal | None:
    """What a dry run can say against a step although some state was never heard: staleness is left out."""
    found = _conditions(call, step, mission, world, rules, now_ns, Purpose.EXECUTE)
    return min((r for r in found if r.code is not Code.STATE_STALE), key=_rank, default=None)


def _conditions(
    call: Call, step: str, mission: MissionState, world: Snapshot, rules: Rules, now_ns: int, purpose: Purpose
) -> Iterator[Refusal]:
    """Every condition on the call that does not hold: preconditions; for a step also guards, deadline, approval."""
    scope = scope_of(mission, world, rules, now_ns)
    yield from _preconditions(call, scope, purpose)
    if purpose is Purpose.EXECUTE:
        yield from _guards(step, mission, scope)
        refusals = (
            _check_deadline(mission, rules, now_ns),
            check_approval(call, step, mission, world, rules, now_ns),
        )
        yield from (r for r in refusals if r is not None)


def _rank(refusal: Refusal) -> int:
    return ORDER[refusal.code]


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
    running = world.robots[call.robot].running
    for name, record in (*mission.steps.items(), *((f"safe:{role}", r) for role, r in mission.safe.items())):
        if record.phase in ACTIVE and record.call.robot == call.robot and name != step:
            running = name
    if not running:
        return None
    message = f"{call.robot} is still busy with {running}"
    return Refusal(code=Code.ROBOT_BUSY, message=message, field=call.robot, observed=running, allowed="idle")


def _check_freshness(call: Call, world: Snapshot, rules: Rules, now_ns: int, purpose: Purpose) -> Refusal | None:
    """A robot takes no step while any fluent of its own is too old, whether or not a guard reads it.

    A safe call asks only for those that show its effect: a drone that lost its position may still be told to land.
    """
    kind = rules.kind_of(call.robot)
    assert kind is not None
    fluents = world.robots[call.robot].fluents
    watched = skill_of(call, rules).effects if purpose is Purpose.SAFE else fluents
    heard = False
    for declared in kind.own_fluents:
        stamped = fluents.get(declared.name)
        if stamped is None or declared.name not in watched:
            continue
        heard, age_s = True, age(stamped.source_ns, now_ns)
        if not 0.0 <= age_s <= declared.max_age_s:
            return _stale(call, f"{call.robot}.{declared.name}", f"{age_s:.1f} s old", f"{declared.max_age_s:g} s")
    return None if heard else _stale(call, call.robot, "nothing heard yet", "fresh telemetry")


def _stale(call: Call, field: str, observed: str, allowed: str) -> Refusal:
    message = (
        f"state of {call.robot} is stale: {field} {observed}, allowed {allowed}; is its adapter running? (crew status)"
    )
    return Refusal(code=Code.STATE_STALE, message=message, field=field, observed=observed, allowed=allowed)


def _preconditions(call: Call, scope: Scope, purpose: Purpose) -> Iterator[Refusal]:
    skill = skill_of(call, scope.rules)
    for fluent, wanted in (skill.needs if purpose is Purpose.SAFE else skill.all_needs).items():
        verdict = robot_fluent_is(call.robot, fluent, wanted, scope)
        if verdict.truth is not Truth.HOLDS:
            yield _unmet(f"{call.robot}.{fluent}", f"is {show(wanted)}", verdict, "")


def _guards(step: str, mission: MissionState, scope: Scope) -> Iterator[Refusal]:
    assert mission.instance is not None
    contract = scope.rules.contracts[mission.instance.contract]
    declared = contract.step(step)
    assert declared is not None
    entry = contract.needs if contract.needs and not mission.sent_any else ()
    for condition in (*entry, *declared.needs):
        verdict = evaluate(condition, scope)
        if verdict.truth is not Truth.HOLDS:
            line = f"{contract.name}:{condition.line}"
            yield _unmet(condition.path, _wanted(condition), verdict, line, scope)


def _wanted(condition: Condition) -> str:
    return f"is {'not ' if condition.negated else ''}{show(condition.value)}"


def _unmet(path: str, wanted: str, verdict: Verdict, line: str, scope: Scope | None = None) -> Refusal:
    """A condition that does not hold, as a refusal."""
    aged = "" if verdict.age_s is None else f" ({verdict.age_s:.1f} s old, at most {verdict.max_age_s:g} s)"
    if verdict.truth is Truth.FAILS:
        message = f"needs that {path} {wanted}, observed {verdict.observed}"
        code = Code.PRECONDITION_FAILED
    elif scope is not None and path.partition(".")[0] not in scope.roles:
        name, near = value_name(path, scope), path.endswith(".near")
        message = f"needs that {path} {wanted}, but no usable value of {name} was published: {verdict.observed}{aged}"
        code = Code.NO_TARGET_FIX if is_position(name, scope.rules) and not near else Code.NO_VALUE
    else:
        message = f"needs that {path} {wanted}, but its state is {verdict.truth}{aged}"
        code = Code.STATE_STALE
    return Refusal(code=code, message=message, field=path, observed=verdict.observed, allowed=wanted, line=line)


def _check_deadline(mission: MissionState, rules: Rules, now_ns: int) -> Refusal | None:
    assert mission.instance is not None
    limit_s = rules.contracts[mission.instance.contract].deadline_s
    spent_s = (now_ns - mission.started_ns) / SECOND_NS if mission.started_ns >= 0 else 0.0
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

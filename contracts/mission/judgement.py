"""Whether what was hoped for is seen: an effect, a safe state, completion. Pure; empty means yes."""

from crew.contracts.gate.guard import Truth, evaluate
from crew.contracts.gate.scope import scope_of
from crew.contracts.mission.effect import safe_state_missing, unseen_effect
from crew.contracts.mission.record import find
from crew.contracts.mission_state import MissionState
from crew.contracts.plan import Call
from crew.contracts.site import Rules
from crew.contracts.snapshot import Snapshot


def judge(what: str, mission: MissionState, world: Snapshot, rules: Rules, now_ns: int) -> str:
    """What is missing for `effect:<sequence>`, `safe:<role>` or `complete`; empty if nothing is. Pure."""
    kind, _, subject = what.partition(":")
    if kind == "effect":
        return missing_effect(int(subject), mission, world, rules, now_ns)
    if kind == "safe":
        return missing_safety(subject, mission, world, rules, now_ns)
    return missing_completion(mission, world, rules, now_ns)


def missing_effect(sequence: int, mission: MissionState, world: Snapshot, rules: Rules, now_ns: int) -> str:
    """The first effect of a dispatch that telemetry does not show yet."""
    found = find(mission, sequence)
    if found is None:
        return f"no dispatch has sequence {sequence}"
    return unseen_effect(found[1], scope_of(mission, world, rules, now_ns))


def missing_safety(role: str, mission: MissionState, world: Snapshot, rules: Rules, now_ns: int) -> str:
    """Why a role is not in its safe state; empty for a role that stays."""
    assert mission.instance is not None
    declared = rules.contracts[mission.instance.contract].role(role)
    if declared is None or declared.safe is None:
        return ""
    robot = mission.instance.roles[role]
    records = (*mission.steps.values(), *mission.safe.values())
    since_ns = max((r.dispatched_ns for r in records if r.call.robot == robot), default=0)
    return safe_state_missing(robot, declared.safe.reach, scope_of(mission, world, rules, now_ns), since_ns)


def safe_call(role: str, mission: MissionState, rules: Rules) -> Call | None:
    """The call that brings a role to its safe state; None for a role that stays."""
    assert mission.instance is not None
    declared = rules.contracts[mission.instance.contract].role(role)
    if declared is None or declared.safe is None:
        return None
    return Call(mission.instance.roles[role], declared.safe.by)


def missing_completion(mission: MissionState, world: Snapshot, rules: Rules, now_ns: int) -> str:
    """The first completion condition that does not hold."""
    assert mission.instance is not None
    scope = scope_of(mission, world, rules, now_ns)
    for condition in rules.contracts[mission.instance.contract].complete:
        head = condition.path.partition(".")[0]
        role = rules.contracts[mission.instance.contract].role(head)
        if role is not None and head not in scope.roles:
            continue
        verdict = evaluate(condition, scope)
        if verdict.truth is not Truth.HOLDS:
            return f"{condition}, but it is {verdict.observed} ({verdict.truth})"
    return ""

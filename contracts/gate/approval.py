"""A person's approval of one step: of exactly this call, of this plan, in this state of the world. Pure."""

from collections.abc import Mapping

from crew.contracts.codes import Code
from crew.contracts.gate.guard import SECOND_NS
from crew.contracts.gate.value import check_values
from crew.contracts.mission_state import Approval, MissionState
from crew.contracts.plan import Call, digest
from crew.contracts.refusal import Refusal
from crew.contracts.site import Rules
from crew.contracts.snapshot import FluentValue, Point, Snapshot

APPROVAL_S = 10.0
"""Mission time for which an approval holds once it was given: it is for the dispatch that waits, not for later ones."""


def wants_approval(step: str, mission: MissionState, rules: Rules) -> bool:
    """Whether the contract wants a person to approve this step."""
    assert mission.instance is not None
    declared = rules.contracts[mission.instance.contract].step(step)
    return declared is not None and declared.approval


def subject_of(call: Call, step: str, mission: MissionState, world: Snapshot, rules: Rules, now_ns: int) -> str:
    """The digest of what a person would approve now.

    Mission, step, call, plan and contract; the places that the call's symbols mean; and what the robot's telemetry says
    in words (`airborne`, `tray`). Figures differ from one moment to the next, and guards are judged anew anyway.
    """
    assert mission.instance is not None
    values = check_values(call, step, mission, world, rules, now_ns)
    return digest(
        (
            mission.id,
            step,
            call,
            mission.plan,
            rules.contracts[mission.instance.contract].digest,
            values if isinstance(values, Mapping) else str(values.code),
            condition_of(call.robot, world),
        )
    )


def condition_of(robot: str, world: Snapshot) -> dict[str, FluentValue]:
    """What a robot's telemetry says in words, by fluent."""
    state = world.robots.get(robot)
    fluents = {} if state is None else state.fluents
    return {name: s.value for name, s in sorted(fluents.items()) if not isinstance(s.value, float | Point)}


def approved(
    call: Call, step: str, mission: MissionState, world: Snapshot, rules: Rules, now_ns: int
) -> tuple[Approval, ...]:
    """The mission's approvals, and one of exactly this: what a person's yes would add now."""
    subject = subject_of(call, step, mission, world, rules, now_ns)
    return (*mission.approvals, Approval(step=step, subject=subject, at_ns=now_ns))


def check_approval(
    call: Call, step: str, mission: MissionState, world: Snapshot, rules: Rules, now_ns: int
) -> Refusal | None:
    """None if the step needs no approval, or has a fresh one of exactly this."""
    if not wants_approval(step, mission, rules):
        return None
    given = [approval for approval in mission.approvals if approval.step == step]
    if not given:
        return _missing(step, f"step {step} waits for a person's approval", "none")
    subject = subject_of(call, step, mission, world, rules, now_ns)
    age_s = (now_ns - given[-1].at_ns) / SECOND_NS
    if given[-1].subject != subject:
        return _missing(step, f"step {step} was approved for something that has changed since", "another state")
    if not 0.0 <= age_s <= APPROVAL_S:
        return _missing(step, f"the approval of step {step} is {age_s:.1f} s old", f"{age_s:.1f} s old")
    return None


def _missing(step: str, message: str, observed: str) -> Refusal:
    return Refusal(
        code=Code.APPROVAL_MISSING,
        message=f"{message}; approve it with crew approve",
        field=step,
        observed=observed,
        allowed=f"an approval of exactly this call, at most {APPROVAL_S:g} s old",
    )

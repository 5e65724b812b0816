"""Whole-plan validation: arguments, matching, then the gate's own `authorize` along the plan over predicted state."""

import msgspec
from msgspec.structs import replace

from crew.contracts.codes import GROUP_OF, Code, Group
from crew.contracts.decision import Authorizer
from crew.contracts.gate.approval import approved, wants_approval
from crew.contracts.gate.arguments import check_call
from crew.contracts.gate.state import check_unheard
from crew.contracts.gate.value import check_values
from crew.contracts.language.reading import noted_lines
from crew.contracts.matching import match
from crew.contracts.mission.effect import assumed_world, predict
from crew.contracts.mission_state import MissionState, Phase, Purpose, Question, StepPhase, StepRecord
from crew.contracts.plan import Instance, Plan, digest
from crew.contracts.refusal import Refusal
from crew.contracts.site import Rules
from crew.contracts.snapshot import Snapshot


class Validation(msgspec.Struct, frozen=True, kw_only=True):
    """The verdict on a plan: an instance, perhaps with a question to a person, or a refusal."""

    instance: Instance | None = None
    question: Question | None = None
    refusal: Refusal | None = None


def validate(
    plan: Plan, mission: MissionState, world: Snapshot, rules: Rules, now_ns: int, authorizer: Authorizer
) -> Validation:
    """Judge a proposal as a whole before anything moves. Availability and values of the mission itself are assumed."""
    for index, call in enumerate(plan.steps):
        refusal = check_call(call, rules)
        if refusal is not None:
            return Validation(refusal=_at(refusal, index))
    instance = match(plan, rules)
    if isinstance(instance, Refusal):
        return Validation(refusal=instance)
    refusal = _dry_run(instance, mission, world, rules, now_ns, authorizer)
    if refusal is not None and refusal.code is Code.UNREAD_WORDS:
        told = replace(mission, confirmed=True)
        refusal = _dry_run(instance, told, world, rules, now_ns, authorizer)
        if refusal is None:
            return Validation(instance=instance, question=_question(mission, plan, instance))
    if refusal is not None:
        return Validation(refusal=refusal)
    return Validation(instance=instance)


def pending_steps(instance: Instance) -> dict[str, StepRecord]:
    """A fresh record for each step of an instance, in the plan's order."""
    return {s.step: StepRecord(call=s.call) for s in instance.steps}


def _dry_run(
    instance: Instance, mission: MissionState, world: Snapshot, rules: Rules, now_ns: int, authorizer: Authorizer
) -> Refusal | None:
    """The gate's own decisions along the plan, as if every approval were given; they are asked for in their turn."""
    state = replace(mission, phase=Phase.EXECUTING, instance=instance, steps=pending_steps(instance), started_ns=now_ns)
    predicted = assumed_world(world, mission.id, rules, now_ns)
    for index, step in enumerate(instance.steps):
        if wants_approval(step.step, state, rules):
            yes = approved(step.call, step.step, state, predicted, rules, now_ns)
            state = replace(state, approvals=yes)
        decision = authorizer.authorize(step.call, state, predicted, rules, now_ns, Purpose.EXECUTE)
        refusal, places = decision.refusal, decision.places
        if refusal is not None and refusal.code is Code.STATE_STALE:
            refusal = check_unheard(step.call, step.step, state, predicted, rules, now_ns)
            if refusal is None:
                outcome = check_values(step.call, step.step, state, predicted, rules, now_ns)
                refusal, places = (outcome, {}) if isinstance(outcome, Refusal) else (None, outcome)
        if refusal is not None:
            return _at(refusal, index)
        kind = rules.kind_of(step.call.robot)
        skill = None if kind is None else kind.skill(step.call.skill)
        assert skill is not None, f"{step.call} passed the capability check"
        avoid = mission.reading.excluded_areas
        predicted = predict(predicted, step.call, skill, rules, now_ns, avoid, instance.roles)
        done = StepRecord(
            call=step.call,
            phase=StepPhase.SUCCEEDED,
            sequence=index + 1,
            dispatched_ns=now_ns,
            places=places,
        )
        state = replace(state, steps={**state.steps, step.step: done})
    return None


def _at(refusal: Refusal, index: int) -> Refusal:
    """A refusal with its place in the plan; containment speaks of the plan as a whole and names its own."""
    if refusal.field.startswith("steps[") or GROUP_OF[refusal.code] is Group.CONTAINMENT:
        return refusal
    field = f"steps[{index}].{refusal.field}" if refusal.field else f"steps[{index}]"
    return replace(refusal, field=field)


def _question(mission: MissionState, plan: Plan, instance: Instance) -> Question:
    unread = tuple(u.word for u in mission.reading.unread)
    calls = "; ".join(str(s.call) for s in instance.steps)
    lost = ", ".join(repr(u.word) for u in mission.reading.unread if not u.meant)
    read = "".join(f"I read {u.word!r} as '{u.meant}'. " for u in mission.reading.unread if u.meant)
    left = f"I did not understand {lost} and would leave it out. " if lost else ""
    noted = "".join(f"{line[0].upper()}{line[1:]}. " for line in noted_lines(mission.reading))
    text = f"{read}{left}{noted}I would do: {calls}."
    token = digest((mission.id, mission.reading, plan))[:16]
    return Question(text=f"{text} Shall I?", token=token, unread=unread)

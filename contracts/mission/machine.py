"""The mission machine: a table of handlers, each a pure function of state and event. It performs nothing.

`step(state, event)` gives the next state and the effects for the shell. What the table does not list changes nothing.
"""

from collections.abc import Callable, Mapping
from typing import Any

from msgspec.structs import replace

from crew.contracts.codes import Code
from crew.contracts.contract import Contract
from crew.contracts.gate.authorize import finding_refusal
from crew.contracts.language.containment import check_reading
from crew.contracts.mission import event as ev
from crew.contracts.mission.consent import answered, ask, without
from crew.contracts.mission.ending import ENDING, end_now, halt
from crew.contracts.mission.record import accept, confirm, find, next_steps, put, result_phase
from crew.contracts.mission.validation import pending_steps
from crew.contracts.mission_state import ACTIVE, ENDS, MissionState, Phase, Purpose, StepPhase
from crew.contracts.refusal import Refusal

Result = tuple[MissionState, tuple[ev.AnyEffect, ...]]
Handler = Callable[[MissionState, Any, Mapping[str, Contract]], Result]

MAX_REPLANS = 1


def step(state: MissionState, event: ev.AnyEvent, contracts: Mapping[str, Contract]) -> Result:
    """The next state, and what the shell shall do."""
    row = TABLE.get((state.phase, type(event)))
    return (state, ()) if row is None else row[0](state, event, contracts)


# --- before anything moves


def _start(state: MissionState, event: ev.Started, contracts: Mapping[str, Contract]) -> Result:
    return replace(state, phase=Phase.PLANNING), (ev.AskPlanner(),)


def _proposed(state: MissionState, event: ev.Proposed, contracts: Mapping[str, Contract]) -> Result:
    planned = replace(
        state, phase=Phase.VALIDATING, plan=event.plan, planner=event.planner, contract=event.plan.contract
    )
    return planned, (ev.ValidatePlan(plan=event.plan),)


def _planner_failed(state: MissionState, event: ev.PlannerFailed, contracts: Mapping[str, Contract]) -> Result:
    if event.refusal is not None:
        return _replan(state, event.refusal)
    finding = check_reading(state.reading)
    if finding is None:
        return end_now(state, Phase.REJECTED, event.reason)
    refused = replace(state, refusal=finding_refusal(finding))
    return end_now(refused, Phase.REJECTED, f"{event.reason}; {finding.message}")


def _validated(state: MissionState, event: ev.Validated, contracts: Mapping[str, Contract]) -> Result:
    verdict = event.validation
    if verdict.refusal is not None or verdict.instance is None:
        refusal = verdict.refusal or Refusal(code=Code.MALFORMED_PLAN, message="the plan has no instance")
        return _replan(state, refusal)
    bound = replace(state, instance=verdict.instance, steps=pending_steps(verdict.instance), question=verdict.question)
    if verdict.question is not None:
        return replace(bound, phase=Phase.ASKING), (ev.AskPerson(),)
    return _wait(bound, contracts)


def _replan(state: MissionState, refusal: Refusal) -> Result:
    refused = replace(state, refusal=refusal)
    if state.replans >= MAX_REPLANS:
        return end_now(refused, Phase.REJECTED, refusal.message)
    return replace(refused, phase=Phase.PLANNING, replans=state.replans + 1), (ev.AskPlanner(feedback=refusal),)


def _answered(state: MissionState, event: ev.Answered, contracts: Mapping[str, Contract]) -> Result:
    question = state.question
    if question is None or event.token != question.token:
        return state, ()
    if event.yes:
        return _wait(replace(state, confirmed=True, question=None), contracts)
    message = "the person did not confirm: " + question.text
    refused = replace(state, refusal=Refusal(code=Code.UNREAD_WORDS, message=message, field="request"))
    return end_now(refused, Phase.REJECTED, message)


def _wait(state: MissionState, contracts: Mapping[str, Contract]) -> Result:
    assert state.instance is not None
    robots = tuple(sorted(set(state.instance.roles.values())))
    preempts = contracts[state.instance.contract].preempts
    return replace(state, phase=Phase.WAITING, refusal=None), (ev.TakeLeases(robots=robots, preempts=preempts),)


def _leased(state: MissionState, event: ev.Leased, contracts: Mapping[str, Contract]) -> Result:
    return next_steps(replace(state, phase=Phase.EXECUTING, started_ns=event.at_ns))


def _cancel_early(state: MissionState, event: ev.CancelAsked, contracts: Mapping[str, Contract]) -> Result:
    return end_now(state, Phase.CANCELLED, f"cancelled by {event.by}")


# --- while executing


def _decided(state: MissionState, event: ev.Decided, contracts: Mapping[str, Contract]) -> Result:
    decision = event.decision
    record = state.steps.get(decision.step)
    if record is None or decision.purpose is not Purpose.EXECUTE or record.phase is not StepPhase.DECIDING:
        return state, ()
    if decision.mission != state.id or decision.call != record.call:
        return state, ()
    if decision.refusal is None:
        sent = replace(
            record,
            phase=StepPhase.SENT,
            sequence=state.sequence + 1,
            dispatched_ns=event.at_ns,
            places=decision.places,
        )
        spent = replace(state, sequence=sent.sequence, approvals=without(state, decision.step))
        send = ev.Send(
            sequence=sent.sequence,
            call=record.call,
            step=decision.step,
            places=decision.places,
            approval=decision.subject,
        )
        return put(spent, decision.step, sent), (send,)
    refusal = decision.refusal
    if refusal.code is Code.APPROVAL_MISSING:
        return ask(state, decision)
    refused = replace(record, phase=StepPhase.REFUSED, code=refusal.code, detail=refusal.message)
    state = replace(put(state, decision.step, refused), refusal=refusal)
    if state.sent_any or _aborts(state, contracts):
        return halt(state, refusal.message, contracts)
    return end_now(state, Phase.REJECTED, refusal.message)


def _aborts(state: MissionState, contracts: Mapping[str, Contract]) -> bool:
    """Whether this is an abort: one that is refused makes its robots safe all the same."""
    assert state.instance is not None
    return contracts[state.instance.contract].preempts


def _outcome(state: MissionState, event: ev.Outcome, contracts: Mapping[str, Contract]) -> Result:
    found = find(state, event.sequence)
    if found is None or found[1].phase not in ACTIVE:
        return state, ()
    name, record = found
    if event.result == "succeeded":
        return confirm(state, name, record)
    ended = replace(record, phase=result_phase(event.result), code=event.code, detail=event.detail)
    message = f"step {name} ({record.call}) {event.result}: {event.detail or event.code or 'no reason given'}"
    return halt(put(state, name, ended), message, contracts)


def _effect_seen(state: MissionState, event: ev.EffectSeen, contracts: Mapping[str, Contract]) -> Result:
    found = find(state, event.sequence)
    if found is None or found[1].phase is not StepPhase.CONFIRMING:
        return state, ()
    state = put(state, found[0], replace(found[1], phase=StepPhase.SUCCEEDED))
    return (state, (ev.JudgeCompletion(),)) if _all_done(state) else next_steps(state)


def _all_done(state: MissionState) -> bool:
    return all(r.phase is StepPhase.SUCCEEDED for r in state.steps.values())


def _completion(state: MissionState, event: ev.CompletionJudged, contracts: Mapping[str, Contract]) -> Result:
    if not _all_done(state):
        return state, ()
    if not event.missing:
        return end_now(state, Phase.COMPLETED, "every step was done and the contract's completion was observed")
    return halt(state, f"every step was done, but the mission is not complete: {event.missing}", contracts)


def _cancel(state: MissionState, event: ev.CancelAsked, contracts: Mapping[str, Contract]) -> Result:
    return halt(state, f"cancelled by {event.by}", contracts, Phase.CANCELLING)


def _stopped(state: MissionState, event: ev.StoppedAll, contracts: Mapping[str, Contract]) -> Result:
    refusal = Refusal(code=Code.STOPPED, message=f"stopped by {event.by}", field="crew", observed="stopped")
    return halt(replace(state, refusal=refusal), refusal.message, contracts)


def _deadline(state: MissionState, event: ev.DeadlineHit, contracts: Mapping[str, Contract]) -> Result:
    limit_s = contracts[state.contract].deadline_s
    message = f"the contract's deadline of {limit_s:g} s passed"
    refusal = Refusal(code=Code.DEADLINE_PASSED, message=message, field="deadline_s", allowed=f"{limit_s:g} s")
    return halt(replace(state, refusal=refusal), message, contracts)


P = Phase
_REPLAN = (P.PLANNING, P.REJECTED)
_EARLY: dict[tuple[Phase, type], tuple[Handler, tuple[Phase, ...]]] = {
    (phase, ev.CancelAsked): (_cancel_early, (P.CANCELLED,))
    for phase in (P.RECEIVED, P.PLANNING, P.VALIDATING, P.ASKING, P.WAITING)
}
TABLE: dict[tuple[Phase, type], tuple[Handler, tuple[Phase, ...]]] = {
    **_EARLY,
    (P.RECEIVED, ev.Started): (_start, (P.PLANNING,)),
    (P.PLANNING, ev.Proposed): (_proposed, (P.VALIDATING,)),
    (P.PLANNING, ev.PlannerFailed): (_planner_failed, _REPLAN),
    (P.VALIDATING, ev.Validated): (_validated, (P.ASKING, P.WAITING, *_REPLAN)),
    (P.ASKING, ev.Answered): (_answered, (P.WAITING, P.REJECTED)),
    (P.WAITING, ev.Leased): (_leased, (P.EXECUTING,)),
    (P.EXECUTING, ev.Decided): (_decided, (P.EXECUTING, P.REJECTED, P.HALTING)),
    (P.EXECUTING, ev.Answered): (answered, (P.EXECUTING, P.REJECTED, P.HALTING)),
    (P.EXECUTING, ev.Accepted): (accept, (P.EXECUTING,)),
    (P.EXECUTING, ev.Outcome): (_outcome, (P.EXECUTING, P.HALTING)),
    (P.EXECUTING, ev.EffectSeen): (_effect_seen, (P.EXECUTING,)),
    (P.EXECUTING, ev.CompletionJudged): (_completion, (P.COMPLETED, P.HALTING)),
    (P.EXECUTING, ev.CancelAsked): (_cancel, (P.CANCELLING,)),
    (P.EXECUTING, ev.StoppedAll): (_stopped, (P.HALTING,)),
    (P.EXECUTING, ev.DeadlineHit): (_deadline, (P.HALTING,)),
    **ENDING,
}
"""(phase, event) to its handler and the phases that it may lead to."""


def diagram() -> str:
    """The machine as a Mermaid state diagram, drawn from the table."""
    edges: dict[tuple[Phase, Phase], list[str]] = {}
    for (phase, event), (_, targets) in TABLE.items():
        for target in targets:
            if target is not phase:
                edges.setdefault((phase, target), []).append(event.__name__)
    lines = ["stateDiagram-v2", f"    [*] --> {P.RECEIVED}"]
    lines += [f"    {a} --> {b}: {', '.join(sorted(names))}" for (a, b), names in edges.items()]
    return "\n".join([*lines, *(f"    {end} --> [*]" for end in Phase if end in ENDS)]) + "\n"

"""The mission machine of an unenforced plan: its steps one after another as they are listed, whatever becomes of each.

What is no matter of enforcement (planning, leases, a person's cancel, a stop, the deadline, the end) is the mission
machine's own. Nothing is planned again: the replan belongs to the gate.
"""

from collections.abc import Callable, Mapping
from typing import Any

from msgspec.structs import replace

from crew.contracts.contract import Contract
from crew.contracts.mission import event as ev
from crew.contracts.mission.ending import end_now, halt
from crew.contracts.mission.machine import Result, step
from crew.contracts.mission.record import find, put, result_phase
from crew.contracts.mission.validation import Validation, pending_steps
from crew.contracts.mission_state import ACTIVE, OPEN, MissionState, Phase, StepPhase
from crew.contracts.pass_through import AS_LISTED, listed
from crew.contracts.plan import Plan
from crew.contracts.site import Rules

Handler = Callable[[MissionState, Any, Mapping[str, Contract]], Result]


def step_listed(state: MissionState, event: ev.AnyEvent, contracts: Mapping[str, Contract]) -> Result:
    """The next state of an unenforced mission, and what the shell shall do."""
    handler = TABLE.get((state.phase, type(event)), step)
    return handler(state, event, contracts)


def accept_listed(plan: Plan, rules: Rules) -> Validation:
    """Every plan is good."""
    return Validation(instance=listed(plan, rules))


def with_listed(rules: Rules) -> Rules:
    """The rules of a crew that is not enforced: with the contract that such plans run under."""
    return replace(rules, contracts={**rules.contracts, AS_LISTED.name: AS_LISTED})


def _planner_failed(state: MissionState, event: ev.PlannerFailed, contracts: Mapping[str, Contract]) -> Result:
    return end_now(state, Phase.REJECTED, event.reason)


def _validated(state: MissionState, event: ev.Validated, contracts: Mapping[str, Contract]) -> Result:
    instance = event.validation.instance
    assert instance is not None, "an unenforced plan is never refused"
    if not instance.steps:
        return end_now(state, Phase.REJECTED, "the plan has no steps")
    bound = replace(state, phase=Phase.WAITING, contract=AS_LISTED.name, instance=instance)
    robots = tuple(sorted(set(instance.roles.values())))
    return replace(bound, steps=pending_steps(instance)), (ev.TakeLeases(robots=robots),)


def _leased(state: MissionState, event: ev.Leased, contracts: Mapping[str, Contract]) -> Result:
    return _next(replace(state, phase=Phase.EXECUTING, started_ns=event.at_ns), contracts)


def _outcome(state: MissionState, event: ev.Outcome, contracts: Mapping[str, Contract]) -> Result:
    found = find(state, event.sequence)
    if event.result == "succeeded" or found is None or found[1].phase not in ACTIVE:
        return step(state, event, contracts)
    name, record = found
    ended = replace(record, phase=result_phase(event.result), code=event.code, detail=event.detail)
    return _next(put(state, name, ended), contracts)


def _effect_seen(state: MissionState, event: ev.EffectSeen, contracts: Mapping[str, Contract]) -> Result:
    found = find(state, event.sequence)
    if found is None or found[1].phase is not StepPhase.CONFIRMING:
        return state, ()
    return _next(put(state, found[0], replace(found[1], phase=StepPhase.SUCCEEDED)), contracts)


def _next(state: MissionState, contracts: Mapping[str, Contract]) -> Result:
    """Send the first step that was not sent yet, or end the mission."""
    name = next((name for name, record in state.steps.items() if record.phase in OPEN), None)
    if name is not None:
        deciding = replace(state.steps[name], phase=StepPhase.DECIDING)
        return put(state, name, deciding), (ev.Authorise(step=name),)
    failed = [f"{n} ({r.call}) {r.phase}: {r.detail or r.code}" for n, r in state.steps.items() if r.code or r.detail]
    if not failed:
        return end_now(state, Phase.COMPLETED, "every step was sent, and said to be done")
    return halt(state, f"{len(failed)} of {len(state.steps)} steps were not done: {'; '.join(failed)}", contracts)


P = Phase
TABLE: dict[tuple[Phase, type], Handler] = {
    (P.PLANNING, ev.PlannerFailed): _planner_failed,
    (P.VALIDATING, ev.Validated): _validated,
    (P.WAITING, ev.Leased): _leased,
    (P.EXECUTING, ev.Outcome): _outcome,
    (P.EXECUTING, ev.EffectSeen): _effect_seen,
}
"""Where it differs from the mission machine."""

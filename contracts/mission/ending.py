"""How a mission ends early: running skills are cancelled, every role reaches its declared safe state."""

from collections.abc import Callable, Mapping
from typing import Any

from msgspec.structs import replace

from crew.contracts.contract import Contract
from crew.contracts.mission import event as ev
from crew.contracts.mission.record import SAFE, accept, confirm, find, put, result_phase
from crew.contracts.mission_state import ACTIVE, OPEN, MissionState, Phase, Purpose, StepPhase, StepRecord

Result = tuple[MissionState, tuple[ev.AnyEffect, ...]]
_ENDED = {Phase.HALTING: Phase.HALTED, Phase.CANCELLING: Phase.CANCELLED}


def end_now(state: MissionState, phase: Phase, message: str) -> Result:
    """End a mission that has nothing in flight."""
    return replace(state, phase=phase, message=message, question=None), (ev.Finish(),)


def halt(state: MissionState, message: str, contracts: Mapping[str, Contract], phase: Phase = Phase.HALTING) -> Result:
    """Begin an early end: cancel what runs (a skill that is its role's safe state runs on), make the rest safe."""
    instance = state.instance
    assert instance is not None
    contract = contracts[instance.contract]
    state = replace(state, phase=phase, message=message, steps=_undecide(state.steps), question=None)
    effects: list[ev.AnyEffect] = []
    for role, robot in instance.roles.items():
        running = [state.steps[name] for name in state.active(robot)]
        if not running:
            effects.append(ev.MakeSafe(role=role))
        effects += [
            ev.CancelRunning(robot=robot, sequence=record.sequence)
            for record in running
            if not _is_safe_skill(contract, role, record)
        ]
    return state, tuple(effects)


def _undecide(steps: Mapping[str, StepRecord]) -> dict[str, StepRecord]:
    """A step that was being decided, or asked for, when the end began is not sent any more."""
    return {name: replace(r, phase=StepPhase.PENDING) if r.phase in OPEN else r for name, r in steps.items()}


def _is_safe_skill(contract: Contract, role: str, record: StepRecord) -> bool:
    declared = contract.role(role)
    return declared is not None and declared.safe is not None and declared.safe.by == record.call.skill


def _settle(state: MissionState, role: str) -> Result:
    """A role is safe, or can't be commanded; the last one ends the mission."""
    state = replace(state, settled=(*state.settled, role))
    assert state.instance is not None
    if set(state.instance.roles) - set(state.settled):
        return state, ()
    return end_now(state, _ENDED[state.phase], state.message)


def _safe_holds(state: MissionState, event: ev.SafeHolds, contracts: Mapping[str, Contract]) -> Result:
    return _settle(state, event.role) if _is_awaited(event.role, state) else (state, ())


def _is_awaited(role: str, state: MissionState) -> bool:
    """Whether a role still waits for its verdict. While its robot runs something, it may leave a safe state again."""
    assert state.instance is not None
    robot = state.instance.roles.get(role)
    judged = role in state.settled or role in state.safe
    return robot is not None and not judged and not state.active(robot)


def _decided(state: MissionState, event: ev.Decided, contracts: Mapping[str, Contract]) -> Result:
    decision = event.decision
    role = decision.step.removeprefix(SAFE)
    assert state.instance is not None
    known = decision.mission == state.id and state.instance.roles.get(role) == decision.call.robot
    if decision.purpose is not Purpose.SAFE or not known or not _is_awaited(role, state):
        return state, ()
    if decision.refusal is not None:
        refused = StepRecord(
            call=decision.call,
            phase=StepPhase.REFUSED,
            code=decision.refusal.code,
            detail=decision.refusal.message,
        )
        return _settle(put(state, decision.step, refused), role)
    record = StepRecord(
        call=decision.call, phase=StepPhase.SENT, sequence=state.sequence + 1, dispatched_ns=event.at_ns
    )
    state = put(replace(state, sequence=record.sequence), decision.step, record)
    return state, (ev.Send(sequence=record.sequence, call=decision.call, step=decision.step),)


def _outcome(state: MissionState, event: ev.Outcome, contracts: Mapping[str, Contract]) -> Result:
    found = find(state, event.sequence)
    if found is None or found[1].phase not in ACTIVE:
        return state, ()
    name, record = found
    if event.result == "succeeded":
        return confirm(state, name, record)
    phase = result_phase(event.result)
    state = put(state, name, replace(record, phase=phase, code=event.code, detail=event.detail))
    return _after_record(state, name, record)


def _effect_seen(state: MissionState, event: ev.EffectSeen, contracts: Mapping[str, Contract]) -> Result:
    found = find(state, event.sequence)
    if found is None or found[1].phase is not StepPhase.CONFIRMING:
        return state, ()
    name, record = found
    return _after_record(put(state, name, replace(record, phase=StepPhase.SUCCEEDED)), name, record)


def _after_record(state: MissionState, name: str, record: StepRecord) -> Result:
    """A safe call that ended settles its role; a step that ended leaves its robot to be made safe."""
    if name.startswith(SAFE):
        return _settle(state, name.removeprefix(SAFE))
    assert state.instance is not None
    role = next(s.role for s in state.instance.steps if s.step == name)
    if state.active(record.call.robot):
        return state, ()
    return state, (ev.MakeSafe(role=role),)


Handler = Callable[[MissionState, Any, Mapping[str, Contract]], Result]
_HANDLERS: tuple[tuple[type, Handler], ...] = (
    (ev.SafeHolds, _safe_holds),
    (ev.Decided, _decided),
    (ev.Outcome, _outcome),
    (ev.EffectSeen, _effect_seen),
)
ENDING: dict[tuple[Phase, type], tuple[Handler, tuple[Phase, ...]]] = {
    **{(phase, event): (handler, (phase, ended)) for phase, ended in _ENDED.items() for event, handler in _HANDLERS},
    **{(phase, ev.Accepted): (accept, (phase,)) for phase in _ENDED},
}
"""The rows of the table for the two phases of an early end."""

"""Looking up and replacing the records of a mission's dispatches, and which steps come next."""

from collections.abc import Mapping

from msgspec.structs import replace

from crew.contracts.contract import Contract
from crew.contracts.mission import event as ev
from crew.contracts.mission_state import MissionState, StepPhase, StepRecord, enabled

SAFE = "safe:"
RESULTS: dict[str, StepPhase] = {
    "succeeded": StepPhase.SUCCEEDED,
    "failed": StepPhase.FAILED,
    "cancelled": StepPhase.CANCELLED,
    "refused": StepPhase.REFUSED,
    "unknown": StepPhase.UNKNOWN,
}
"""What a robot may report of a dispatch, as the phase that its step ends in."""


def result_phase(result: str) -> StepPhase:
    """The phase that a report ends a step in; a word that nobody knows tells nothing."""
    return RESULTS.get(result, StepPhase.UNKNOWN)


def find(state: MissionState, sequence: int) -> tuple[str, StepRecord] | None:
    """The record with this sequence: a step's name, or `safe:<role>`."""
    for name, record in state.steps.items():
        if record.sequence == sequence:
            return name, record
    for role, record in state.safe.items():
        if record.sequence == sequence:
            return SAFE + role, record
    return None


def put(state: MissionState, name: str, record: StepRecord) -> MissionState:
    """The state with one record replaced."""
    if name.startswith(SAFE):
        return replace(state, safe={**state.safe, name.removeprefix(SAFE): record})
    return replace(state, steps={**state.steps, name: record})


def next_steps(state: MissionState) -> tuple[MissionState, tuple[ev.AnyEffect, ...]]:
    """Mark every enabled step as being decided, and ask for its authorisation."""
    names = enabled(state)
    for name in names:
        state = put(state, name, replace(state.steps[name], phase=StepPhase.DECIDING))
    return state, tuple(ev.Authorise(step=name) for name in names)


def confirm(state: MissionState, name: str, record: StepRecord) -> tuple[MissionState, tuple[ev.AnyEffect, ...]]:
    """A robot says that it succeeded: its word starts the look for the effect, once."""
    if record.phase is StepPhase.CONFIRMING:
        return state, ()
    watch = ev.WatchEffect(sequence=record.sequence)
    return put(state, name, replace(record, phase=StepPhase.CONFIRMING)), (watch,)


def accept(
    state: MissionState, event: ev.Accepted, contracts: Mapping[str, Contract]
) -> tuple[MissionState, tuple[ev.AnyEffect, ...]]:
    """A robot took a dispatch."""
    found = find(state, event.sequence)
    if found is None or found[1].phase is not StepPhase.SENT:
        return state, ()
    return put(state, found[0], replace(found[1], phase=StepPhase.RUNNING)), ()

"""The machine's side of the bargain, checked at every event: it records what it does, and no end comes early."""

from collections.abc import Iterator, Sequence

from crew.contracts.mission import event as ev
from crew.contracts.mission.record import SAFE
from crew.contracts.mission_state import ACTIVE, ENDS, MissionState, Phase, StepPhase, StepRecord
from crew.contracts.proof.trouble import Trouble


def kept_promises(
    before: MissionState, after: MissionState, event: ev.AnyEvent, effects: Sequence[ev.AnyEffect]
) -> Iterator[Trouble]:
    """Sent only by an allowed decision, done only when the effect was seen, asked for when it begins."""
    watched = {e.sequence for e in effects if isinstance(e, ev.WatchEffect)}
    sends = {e.step for e in effects if isinstance(e, ev.Send)}
    allowed = isinstance(event, ev.Decided) and event.decision.refusal is None
    for name, record in _changed(before, after):
        if record.phase is StepPhase.CONFIRMING and record.sequence not in watched:
            yield Trouble("machine", f"nobody looks for the effect of {name}", name)
        if (record.phase is StepPhase.SENT) != (name in sends) or (name in sends and not allowed):
            yield Trouble("machine", f"{name} is recorded as sent without being sent, or the reverse", name)
        if record.phase is StepPhase.SUCCEEDED and not isinstance(event, ev.EffectSeen):
            yield Trouble("machine", f"{name} counts as done before its effect was seen", name)
    if after.phase in ENDS and before.phase not in ENDS:
        yield from _early_end(after)


def _changed(before: MissionState, after: MissionState) -> Iterator[tuple[str, StepRecord]]:
    """Records whose phase an event changed."""
    for name, record in after.steps.items():
        if before.steps[name].phase is not record.phase:
            yield name, record
    for role, record in after.safe.items():
        was = before.safe.get(role)
        if was is None or was.phase is not record.phase:
            yield SAFE + role, record


def _early_end(end: MissionState) -> Iterator[Trouble]:
    """Nothing runs on after an end, and nobody is forgotten in an early one."""
    for name, record in (*end.steps.items(), *end.safe.items()):
        if record.phase in ACTIVE:
            yield Trouble("machine", f"the mission is {end.phase} while {record.call} still runs", name)
    moved = any(record.sequence for record in end.steps.values())
    if end.phase in (Phase.HALTED, Phase.CANCELLED) and moved and end.instance is not None:
        for role in end.instance.roles:
            if role not in end.settled:
                yield Trouble("unsafe_end", f"the mission is {end.phase} although nobody made the {role} safe", role)

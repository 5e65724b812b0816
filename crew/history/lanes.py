"""A mission as lanes in time: its phases, and for each robot what it was held for, carried out, or was refused."""

from collections.abc import Iterator

import msgspec

from crew.contracts.mission.record import SAFE
from crew.contracts.mission_state import ENDS, MissionState, Phase, StepPhase, StepRecord
from crew.history.history import MissionHistory

MISSION = "mission"
"""The name of the mission's own lane."""

_SAID = {
    Phase.RECEIVED: ("planning", "received"),
    Phase.PLANNING: ("planning", "planning"),
    Phase.VALIDATING: ("planning", "checking the plan"),
    Phase.ASKING: ("asking", "asking a person"),
    Phase.WAITING: ("held", "waiting for its robots"),
    Phase.EXECUTING: ("executing", "executing"),
    Phase.HALTING: ("safe", "halting: robots reach their safe states"),
    Phase.CANCELLING: ("safe", "cancelling: robots reach their safe states"),
}
"""Phase to a lane's colour and words."""
_BAD = {
    StepPhase.FAILED: "failed",
    StepPhase.CANCELLED: "cancelled",
    StepPhase.UNKNOWN: "unknown",
    StepPhase.REFUSED: "refused",
}


class Span(msgspec.Struct, frozen=True, kw_only=True):
    """A stretch of a lane. `kind`: planning, asking, held, executing, skill, safe, failed, cancelled, unknown."""

    lane: str
    kind: str
    label: str
    start_ns: int
    end_ns: int
    title: str
    open: bool = False
    """It had not ended when the journal did."""


class Mark(msgspec.Struct, frozen=True, kw_only=True):
    """A moment of a lane. `kind`: refused, seen, value, and the mission's outcomes."""

    lane: str
    kind: str
    at_ns: int
    title: str


class Track(msgspec.Struct, kw_only=True):
    """One dispatch from its authorisation to its end. A time of -1 has not come."""

    name: str
    record: StepRecord
    sent_ns: int = -1
    accepted_ns: int = -1
    claimed_ns: int = -1
    """The robot said that it had succeeded; from here telemetry was looked at."""
    ended_ns: int = -1

    @property
    def safe(self) -> bool:
        return self.name.startswith(SAFE)


class Lanes(msgspec.Struct, frozen=True, kw_only=True):
    """Everything to draw for one mission, mission time."""

    names: tuple[str, ...]
    spans: tuple[Span, ...]
    marks: tuple[Mark, ...]
    start_ns: int
    end_ns: int


def lanes_of(mission: MissionHistory, last_ns: int) -> Lanes:
    """The mission's lanes. What had not ended goes on to `last_ns`, the journal's last moment."""
    end_ns = last_ns if mission.ended_ns is None else mission.ended_ns
    tracks = list(tracks_of(mission))
    spans = [*_phases(mission, end_ns), *_held(mission, tracks, end_ns)]
    spans += [_flight(track, end_ns) for track in tracks if track.sent_ns >= 0]
    marks = [*_values(mission), *_refusals(mission), *_seen(tracks), *_outcome(mission)]
    robots = dict.fromkeys(t.record.call.robot for t in tracks)
    return Lanes(
        names=(MISSION, *robots),
        spans=tuple(spans),
        marks=tuple(marks),
        start_ns=mission.began_ns,
        end_ns=max(end_ns, mission.began_ns),
    )


def tracks_of(mission: MissionHistory) -> Iterator[Track]:
    """Every step and safe-state call of the mission's plan, with the times of its changes."""
    tracks: dict[str, Track] = {}
    for happening in mission.happenings:
        before = records_of(happening.before)
        for name, record in records_of(happening.after).items():
            track = tracks.setdefault(name, Track(name=name, record=record))
            old = before.get(name)
            if old is None or old.phase is not record.phase:
                _note(track, record, happening.at_ns)
            track.record = record
    return iter(tracks.values())


def records_of(state: MissionState) -> dict[str, StepRecord]:
    """Steps by name, and safe-state calls as `safe:<role>`."""
    return {**state.steps, **{SAFE + role: record for role, record in state.safe.items()}}


def _note(track: Track, record: StepRecord, at_ns: int) -> None:
    match record.phase:
        case StepPhase.SENT:
            track.sent_ns = at_ns
        case StepPhase.RUNNING:
            track.accepted_ns = at_ns
        case StepPhase.CONFIRMING:
            track.claimed_ns = at_ns
        case StepPhase.SUCCEEDED | StepPhase.FAILED | StepPhase.CANCELLED | StepPhase.UNKNOWN | StepPhase.REFUSED:
            track.ended_ns = at_ns
        case _:
            pass


def _phases(mission: MissionHistory, end_ns: int) -> Iterator[Span]:
    """The mission's own lane: one span a phase, those of no length left out."""
    phase, since_ns = Phase.RECEIVED, mission.began_ns
    changes = [(h.at_ns, h.after.phase) for h in mission.happenings if h.after.phase is not h.before.phase]
    for at_ns, following in [*changes, (end_ns, None)]:
        if phase in _SAID and at_ns > since_ns:
            kind, words = _SAID[phase]
            title = f"{words}, {(at_ns - since_ns) / 1e9:.1f} s"
            yield Span(
                lane=MISSION,
                kind=kind,
                label=words,
                start_ns=since_ns,
                end_ns=at_ns,
                title=title,
                open=following is None,
            )
        phase, since_ns = following or phase, at_ns


def _held(mission: MissionHistory, tracks: list[Track], end_ns: int) -> Iterator[Span]:
    """From when a robot was free to when its next step was decided: it waited for the steps of others."""
    instance, start_ns = mission.state.instance, mission.state.started_ns
    if instance is None or start_ns < 0:
        return
    halted_ns = next((h.at_ns for h in mission.happenings if _ends_execution(h.after)), end_ns)
    free_ns: dict[str, int] = {}
    by_name = {track.name: track for track in tracks}
    for step in instance.steps:
        track, robot = by_name.get(step.step), step.call.robot
        if track is None:
            continue
        since_ns = free_ns.get(robot, start_ns)
        decided_ns = next((t for t in (track.sent_ns, track.ended_ns) if t >= 0), halted_ns)
        if decided_ns > since_ns:
            never = "" if track.sent_ns >= 0 or track.record.phase is StepPhase.REFUSED else "; never sent"
            waits = ", ".join(f"{name} ({by_name[name].record.call.robot})" for name in step.after)
            title = (
                f"held for {(decided_ns - since_ns) / 1e9:.1f} s: {step.step} comes after {waits or 'nothing'}{never}"
            )
            yield Span(lane=robot, kind="held", label="held", start_ns=since_ns, end_ns=decided_ns, title=title)
        free_ns[robot] = max(since_ns, track.ended_ns if track.ended_ns >= 0 else end_ns)


def _ends_execution(state: MissionState) -> bool:
    return state.phase in ENDS or state.phase in (Phase.HALTING, Phase.CANCELLING)


def _flight(track: Track, end_ns: int) -> Span:
    """One skill, from its authorisation to its observed end."""
    record, ended = track.record, track.ended_ns >= 0
    kind = _BAD.get(record.phase, "safe" if track.safe else "skill")
    until_ns = track.ended_ns if ended else end_ns
    how = (
        "its effect was observed" if record.phase is StepPhase.SUCCEEDED else f"{record.phase} {record.detail}".strip()
    )
    said = f", the robot's word {(track.claimed_ns - track.sent_ns) / 1e9:.1f} s" if track.claimed_ns >= 0 else ""
    purpose = " to reach its safe state" if track.safe else f" ({track.name})"
    title = f"{record.call}{purpose}: {how}; {(until_ns - track.sent_ns) / 1e9:.1f} s{said}"
    return Span(
        lane=record.call.robot,
        kind=kind,
        label=record.call.skill,
        start_ns=track.sent_ns,
        end_ns=until_ns,
        title=title if ended else f"{title}; the journal ends here",
        open=not ended,
    )


def _refusals(mission: MissionHistory) -> Iterator[Mark]:
    for verdict in mission.verdicts:
        if verdict.refusal is None:
            continue
        call = getattr(verdict.record, "decision", None)
        lane = MISSION if call is None else call.call.robot
        refusal = verdict.refusal
        title = f"decision {verdict.number} refused: {verdict.subject}: {refusal.code}: {refusal.message}"
        yield Mark(lane=lane, kind="refused", at_ns=verdict.at_ns, title=title)


def _values(mission: MissionHistory) -> Iterator[Mark]:
    """When each run-time value was first published as it was later used; what came before the mission is left out."""
    worlds = [v.world for v in mission.verdicts] + [judgement.record.world for judgement in mission.judgements]
    seen: set[tuple[str, str]] = set()
    for stamped in (value for world in worlds for value in world.values.values()):
        reading = stamped.reading
        key = (reading.name, f"{reading.status} {reading.position}")
        if key not in seen and stamped.received_ns >= mission.began_ns:
            seen.add(key)
            where = f" at ({reading.position.x:.2f}, {reading.position.y:.2f})" if reading.position is not None else ""
            title = f"{stamped.source} published {reading.name}: {reading.status}{where}"
            yield Mark(lane=stamped.source, kind="value", at_ns=stamped.received_ns, title=title)


def _seen(tracks: list[Track]) -> Iterator[Mark]:
    for track in tracks:
        if track.record.phase is StepPhase.SUCCEEDED:
            title = f"{track.record.call.skill}: its effect was observed"
            yield Mark(lane=track.record.call.robot, kind="seen", at_ns=track.ended_ns, title=title)


def _outcome(mission: MissionHistory) -> Iterator[Mark]:
    if mission.ended_ns is not None:
        title = f"{mission.state.phase}: {mission.state.message}"
        yield Mark(lane=MISSION, kind=str(mission.state.phase), at_ns=mission.ended_ns, title=title)

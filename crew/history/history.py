"""A run's missions, verdicts and notes, in the order of its journal. Also of runs that were killed or altered."""

from collections.abc import Iterator
from pathlib import Path

import msgspec

from crew.contracts.mission.event import AnyEvent, Proposed
from crew.contracts.mission_state import ENDS, MissionState, Purpose
from crew.contracts.refusal import Refusal
from crew.contracts.site import Rules
from crew.contracts.snapshot import Snapshot
from crew.home import Home
from crew.journal_reader import Record as Row
from crew.records import (
    DecisionRecord,
    EventRecord,
    IntentRecord,
    JudgementRecord,
    MissionRecord,
    NoteRecord,
    Record,
    RunRecord,
    ValidationRecord,
)
from crew.verify import Replay, VerifyReport, verify_run


class Verdict(msgspec.Struct, frozen=True, kw_only=True):
    """One verdict of the run, numbered from 1: on a whole plan, or on one call; with the state that it was made in."""

    number: int
    seq: int
    at_ns: int
    mission: MissionState
    record: ValidationRecord | DecisionRecord

    @property
    def world(self) -> Snapshot:
        return self.record.world

    @property
    def refusal(self) -> Refusal | None:
        """Why it was refused; None if it was accepted or led to a question."""
        if isinstance(self.record, DecisionRecord):
            return self.record.decision.refusal
        return self.record.validation.refusal

    @property
    def subject(self) -> str:
        """What was judged, in a few words."""
        if isinstance(self.record, DecisionRecord):
            safe = " to reach its safe state" if self.record.decision.purpose is Purpose.SAFE else ""
            return f"{self.record.decision.call}{safe}"
        return f"the plan of {len(self.record.plan.steps)} steps for {self.record.plan.contract}"


class Happening(msgspec.Struct, frozen=True, kw_only=True):
    """One event of a mission: the state before it and the state that it led to."""

    at_ns: int
    event: AnyEvent
    before: MissionState
    after: MissionState


class Judgement(msgspec.Struct, frozen=True, kw_only=True):
    """What telemetry was found to show, with the state that it was judged in."""

    seq: int
    mission: MissionState
    record: JudgementRecord


class MissionHistory:
    """One mission from its request to its end, or to where the journal ends."""

    def __init__(self, began: MissionState, at_ns: int, wall_ns: int) -> None:
        self.state = began
        self.began_ns, self.began_wall_ns = at_ns, wall_ns
        self.ended_ns: int | None = None
        self.happenings: list[Happening] = []
        self.verdicts: list[Verdict] = []
        self.judgements: list[Judgement] = []
        self.intents: list[IntentRecord] = []

    @property
    def id(self) -> str:
        return self.state.id

    @property
    def proposals(self) -> list[Proposed]:
        """What the planner proposed, in order."""
        return [h.event for h in self.happenings if isinstance(h.event, Proposed)]

    def take(self, at_ns: int, event: AnyEvent, after: MissionState) -> None:
        """An event, and the state that it led to."""
        self.happenings.append(Happening(at_ns=at_ns, event=event, before=self.state, after=after))
        self.state = after
        if after.phase in ENDS and self.ended_ns is None:
            self.ended_ns = at_ns


class Note(msgspec.Struct, frozen=True, kw_only=True):
    """A remark of the journal."""

    at_ns: int
    what: str
    text: str


class History:
    """The fold. `take` is a listener of a replay."""

    def __init__(self) -> None:
        self.run: RunRecord | None = None
        self.rules: Rules | None = None
        """None if the journal holds no record of its run: then nothing of it can be followed."""
        self.foreign = False
        self.missions: dict[str, MissionHistory] = {}
        self.notes: list[Note] = []
        self.verdicts: list[Verdict] = []
        self.worlds: list[tuple[int, Snapshot]] = []
        """The worlds that something was judged in, with their mission time; the last one is the last that is known."""
        self.first_wall_ns = self.last_wall_ns = 0
        self.last_ns = 0

    def take(self, row: Row, record: Record, replay: Replay) -> None:
        """One record, after it was replayed."""
        self.first_wall_ns = self.first_wall_ns or row.wall_ns
        self.last_wall_ns, self.last_ns = row.wall_ns, max(self.last_ns, row.at_ns)
        self.rules, self.foreign = replay.rules, replay.foreign
        if self.rules is None and not isinstance(record, NoteRecord):
            return
        match record:
            case RunRecord():
                self.run = record
            case NoteRecord():
                self.notes.append(Note(at_ns=row.at_ns, what=record.what, text=record.text))
            case MissionRecord():
                self.missions[record.state.id] = MissionHistory(record.state, row.at_ns, row.wall_ns)
            case IntentRecord():
                if (mission := self.missions.get(record.dispatch.mission)) is not None:
                    mission.intents.append(record)
            case EventRecord():
                mission, after = self.missions.get(record.mission), replay.states.get(record.mission)
                if mission is not None and after is not None:
                    mission.take(record.event.at_ns, record.event, after)
            case ValidationRecord():
                self._judged(row, record.mission, record)
            case DecisionRecord():
                self._judged(row, record.decision.mission, record)
            case JudgementRecord():
                self.worlds.append((record.now_ns, record.world))
                if (mission := self.missions.get(record.mission)) is not None:
                    mission.judgements.append(Judgement(seq=row.seq, mission=mission.state, record=record))

    def _judged(self, row: Row, name: str, record: ValidationRecord | DecisionRecord) -> None:
        mission = self.missions.get(name)
        if mission is None:
            return
        at_ns = record.now_ns if isinstance(record, ValidationRecord) else record.decision.at_ns
        number = len(self.verdicts) + 1
        verdict = Verdict(number=number, seq=row.seq, at_ns=at_ns, mission=mission.state, record=record)
        self.worlds.append((at_ns, record.world))
        self.verdicts.append(verdict)
        mission.verdicts.append(verdict)

    @property
    def open(self) -> Iterator[MissionHistory]:
        """Missions that have no end in the journal: the run still goes on, or it was killed."""
        return (m for m in self.missions.values() if m.state.phase not in ENDS)

    def mission_of(self, verdict: Verdict) -> MissionHistory:
        return self.missions[verdict.mission.id]


def read_history(folder: Path, home: Home, *, key_file: Path | None = None) -> tuple[History, VerifyReport]:
    """A run's history, and whether chain, signatures and decisions hold. Raises UsageError if there is no run."""
    history = History()
    report = verify_run(folder, home, key_file=key_file, listener=history.take)
    return history, report

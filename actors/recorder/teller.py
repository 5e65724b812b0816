"""Tells a run from its journal: the same entries that the recorder made while it happened."""

from collections.abc import Iterator
from importlib.metadata import version
from pathlib import Path

import msgspec

from crew.actors.recorder.entry import Entry, Stamp
from crew.actors.recorder.lane import RobotLanes
from crew.actors.recorder.story import Story
from crew.actors.recorder.telemetry import Telemetry
from crew.errors import UsageError
from crew.journal_reader import Record as Row
from crew.journal_reader import read_records
from crew.packed import unpack
from crew.progress import MissionProgress
from crew.records import (
    RECORDS,
    DecisionRecord,
    EventRecord,
    JudgementRecord,
    MissionRecord,
    Record,
    RunRecord,
    ValidationRecord,
)


class Teller:
    """One journal. Raises UsageError for one of another version, JournalError for one that can't be read."""

    def __init__(self, journal: Path) -> None:
        self._journal = journal
        self._rows = read_records(journal)
        first = next(self._rows, None)
        began = None if first is None else _read(first, journal)
        if not isinstance(began, RunRecord):
            raise UsageError(f"{journal} tells of no run: its first record is {first.kind if first else 'missing'}")
        self.began = began
        self.rules = unpack(began.rules)
        lanes = RobotLanes(spec.name for spec in self.rules.crew.robots)
        self._story, self._telemetry = Story(self.rules, lanes), Telemetry(self.rules, lanes)
        self._missions: dict[str, MissionRecord] = {}
        self._numbers: dict[str, int] = {}

    def tell(self) -> Iterator[tuple[Stamp, Entry]]:
        """Everything from the first record to the last."""
        for row in self._rows:
            stamp = Stamp(row.at_ns, row.wall_ns)
            for entry in self._entries(row, _read(row, self._journal)):
                yield stamp, entry

    def _entries(self, row: Row, record: Record) -> Iterator[Entry]:
        match record:
            case MissionRecord(state=state):
                self._missions[state.id] = record
            case EventRecord():
                yield from self._story.take(self._progress(row, record))
            case ValidationRecord(world=world) | DecisionRecord(world=world) | JudgementRecord(world=world):
                yield from self._telemetry.world(world)

    def _progress(self, row: Row, record: EventRecord) -> MissionProgress:
        number = self._numbers[record.mission] = self._numbers.get(record.mission, 0) + 1
        began = self._missions.pop(record.mission, None)
        return MissionProgress(
            mission=record.mission,
            number=number,
            at_ns=row.at_ns,
            wall_ns=row.wall_ns,
            began=None if began is None else began.state,
            event=record.event,
        )


def _read(row: Row, journal: Path) -> Record:
    record = RECORDS.get(row.kind)
    try:
        if record is None:
            raise UsageError(f"no record is called {row.kind!r}")
        return msgspec.msgpack.decode(row.body, type=record)
    except (msgspec.MsgspecError, UsageError) as error:
        raise UsageError(
            f"record {row.seq} of {journal} can't be read by robot-crew {version('robot-crew')}: {error}; "
            f"install the version that the run was made with"
        ) from error

"""Draws a run from its journal, which is the authority: whole, or from where a killed recording ends."""

from collections.abc import Iterator
from importlib.metadata import version
from pathlib import Path

import msgspec

from crew.actors.recorder.entry import Entry, Stamp
from crew.actors.recorder.lane import RobotLanes
from crew.actors.recorder.page import Page
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


def rebuild(journal: Path, path: Path, *, after_ns: int = -1) -> None:
    """Draw everything that the journal tells of after `after_ns` of mission time.

    Lanes, decisions and proposals are as they were; poses are known only at the moments when something was decided.
    Raises UsageError for a journal of another version, JournalError for one that can't be read.
    """
    rows = read_records(journal)
    first = next(rows, None)
    began = None if first is None else _read(first, journal)
    if not isinstance(began, RunRecord):
        raise UsageError(f"{journal} tells of no run: its first record is {first.kind if first else 'missing'}")
    teller = _Teller(began)
    facts = {"version": began.version, "rerun": version("rerun-sdk"), "crew": teller.rules.crew.name}
    page = Page(teller.rules, began.run, path, facts={**facts, "planner": began.planner, "rebuilt": "from the journal"})
    for row in rows:
        stamp = Stamp(row.at_ns, row.wall_ns)
        for entry in teller.tell(row, _read(row, journal)):
            if row.at_ns > after_ns:
                page.write(stamp, entry)
    page.close("drawn from the journal")


class _Teller:
    """Gives a journal's records to the same folds that draw a run while it happens."""

    def __init__(self, began: RunRecord) -> None:
        self.rules = unpack(began.rules)
        lanes = RobotLanes(spec.name for spec in self.rules.crew.robots)
        self._story, self._telemetry = Story(self.rules, lanes), Telemetry(self.rules, lanes)
        self._began: dict[str, MissionRecord] = {}
        self._numbers: dict[str, int] = {}

    def tell(self, row: Row, record: Record) -> Iterator[Entry]:
        """What one record adds to the page."""
        match record:
            case MissionRecord(state=state):
                self._began[state.id] = record
            case EventRecord():
                yield from self._story.take(self._progress(row, record))
            case ValidationRecord(world=world) | DecisionRecord(world=world) | JudgementRecord(world=world):
                yield from self._telemetry.world(world)

    def _progress(self, row: Row, record: EventRecord) -> MissionProgress:
        number = self._numbers[record.mission] = self._numbers.get(record.mission, 0) + 1
        began = self._began.pop(record.mission, None)
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

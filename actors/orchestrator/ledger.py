"""The orchestrator's pen: records of the run, written to the journal in the order in which things happened."""

from collections.abc import Callable

import msgspec

from crew.clock import Clock
from crew.contracts.decision import Decision
from crew.contracts.mission.event import AnyEvent
from crew.contracts.mission.validation import Validation
from crew.contracts.mission_state import MissionState
from crew.contracts.plan import Plan, digest
from crew.contracts.snapshot import Snapshot
from crew.journal import Journal, Ticket
from crew.messages import Dispatch
from crew.records import (
    DecisionRecord,
    EventRecord,
    IntentRecord,
    JudgementRecord,
    MissionRecord,
    NoteRecord,
    Record,
    ValidationRecord,
)

_ENCODER = msgspec.msgpack.Encoder()


class Ledger:
    """Appends; never waits. `write` raises JournalError once the journal has failed."""

    def __init__(self, journal: Journal, clock: Clock, on_record: Callable[[Record], None] = lambda _: None) -> None:
        self._journal, self._clock, self._on_record = journal, clock, on_record
        self._digests: dict[str, tuple[MissionState, str]] = {}

    def write(self, record: Record) -> Ticket:
        """Append one record."""
        ticket = self._journal.append(record.kind, self._clock.now_ns(), _ENCODER.encode(record))
        self._on_record(record)
        return ticket

    def mission(self, state: MissionState) -> None:
        self.write(MissionRecord(state=state))

    def event(self, state: MissionState, event: AnyEvent) -> None:
        """An event, and the state that it led to."""
        self.write(EventRecord(mission=state.id, event=event, state_digest=self.digest(state)))

    def validation(self, state: MissionState, plan: Plan, world: Snapshot, now_ns: int, validation: Validation) -> None:
        self.write(
            ValidationRecord(
                mission=state.id,
                state_digest=self.digest(state),
                plan=plan,
                world=world,
                now_ns=now_ns,
                validation=validation,
            )
        )

    def decision(self, state: MissionState, world: Snapshot, decision: Decision) -> None:
        self.write(DecisionRecord(state_digest=self.digest(state), world=world, decision=decision))

    def judgement(self, state: MissionState, what: str, world: Snapshot, now_ns: int, missing: str) -> None:
        self.write(
            JudgementRecord(
                mission=state.id,
                what=what,
                state_digest=self.digest(state),
                world=world,
                now_ns=now_ns,
                missing=missing,
            )
        )

    def intent(self, dispatch: Dispatch) -> Ticket:
        """The dispatch may be sent once this ticket is committed."""
        return self.write(IntentRecord(dispatch=dispatch))

    def note(self, what: str, text: str) -> Ticket:
        return self.write(NoteRecord(what=what, text=text))

    def digest(self, state: MissionState) -> str:
        """The state's digest, computed once for each state."""
        known = self._digests.get(state.id)
        if known is None or known[0] is not state:
            known = self._digests[state.id] = (state, digest(state))
        return known[1]

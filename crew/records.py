"""What the journal's records hold: enough to reproduce every decision of a run without any robot."""

from typing import ClassVar

import msgspec

from crew.contracts.decision import Decision
from crew.contracts.mission.event import AnyEvent
from crew.contracts.mission.validation import Validation
from crew.contracts.mission_state import MissionState
from crew.contracts.plan import Plan
from crew.contracts.refusal import Refusal
from crew.contracts.snapshot import Snapshot
from crew.messages import Dispatch
from crew.packed import PackedRules

GATE, PASS_THROUGH = "gate", "pass-through"
"""Who authorised a run's dispatches. The second is the study's: in simulation alone."""


class Record(msgspec.Struct, frozen=True, kw_only=True):
    """Base of a record's body; `kind` is the journal's column."""

    kind: ClassVar[str]


class RunRecord(Record, frozen=True, kw_only=True):
    """The first record: what the run was decided by. Kinds are installed code, so their digests stand for them."""

    kind: ClassVar[str] = "run"
    run: str
    version: str
    epoch: int
    authorizer: str
    """`GATE` or `PASS_THROUGH`."""
    planner: str
    rules: PackedRules
    rules_digest: str


class MissionRecord(Record, frozen=True, kw_only=True):
    """A request was taken: the mission as it began, with the request as it was read."""

    kind: ClassVar[str] = "mission"
    state: MissionState


class EventRecord(Record, frozen=True, kw_only=True):
    """One event of one mission, with the digest of the state that it led to."""

    kind: ClassVar[str] = "event"
    mission: str
    event: AnyEvent
    state_digest: str


class ValidationRecord(Record, frozen=True, kw_only=True):
    """The verdict on a whole plan, with the world that it was judged in."""

    kind: ClassVar[str] = "validation"
    mission: str
    state_digest: str
    plan: Plan
    world: Snapshot
    now_ns: int
    validation: Validation


class DecisionRecord(Record, frozen=True, kw_only=True):
    """One decision of the gate, with the world that it was made in."""

    kind: ClassVar[str] = "decision"
    state_digest: str
    world: Snapshot
    decision: Decision


class JudgementRecord(Record, frozen=True, kw_only=True):
    """What telemetry was found to show: an effect, a safe state, or completion. `missing` empty means that it holds."""

    kind: ClassVar[str] = "judgement"
    mission: str
    what: str
    """`effect:<sequence>`, `safe:<role>` or `complete`."""
    state_digest: str
    world: Snapshot
    now_ns: int
    missing: str


class IntentRecord(Record, frozen=True, kw_only=True):
    """A dispatch that is about to be sent; committed before it is."""

    kind: ClassVar[str] = "intent"
    dispatch: Dispatch


class NoteRecord(Record, frozen=True, kw_only=True):
    """Something worth keeping that no decision depends on: stops, lost robots, refused messages."""

    kind: ClassVar[str] = "note"
    what: str
    text: str
    refusal: Refusal | None = None


RECORDS: dict[str, type[Record]] = {
    record.kind: record
    for record in (
        RunRecord,
        MissionRecord,
        EventRecord,
        ValidationRecord,
        DecisionRecord,
        JudgementRecord,
        IntentRecord,
        NoteRecord,
    )
}
"""Record kind to its type."""

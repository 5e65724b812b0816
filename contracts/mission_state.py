"""The state of one mission, as data: what was asked, proposed, matched, dispatched and observed so far."""

from collections.abc import Mapping
from enum import StrEnum

import msgspec

from crew.contracts.language.mention import Reading
from crew.contracts.plan import Call, Instance, Plan
from crew.contracts.refusal import Refusal
from crew.contracts.snapshot import Point


class Phase(StrEnum):
    """Where a mission stands. The last four are ends."""

    RECEIVED = "received"
    PLANNING = "planning"
    VALIDATING = "validating"
    ASKING = "asking"
    WAITING = "waiting"
    EXECUTING = "executing"
    HALTING = "halting"
    CANCELLING = "cancelling"
    COMPLETED = "completed"
    REJECTED = "rejected"
    HALTED = "halted"
    CANCELLED = "cancelled"


ENDS = frozenset({Phase.COMPLETED, Phase.REJECTED, Phase.HALTED, Phase.CANCELLED})


class StepPhase(StrEnum):
    """Where one step stands. It is consumed once authorised, and done only when its effect was seen."""

    PENDING = "pending"
    DECIDING = "deciding"
    ASKING = "asking"
    SENT = "sent"
    RUNNING = "running"
    CONFIRMING = "confirming"
    SUCCEEDED = "succeeded"
    REFUSED = "refused"
    FAILED = "failed"
    CANCELLED = "cancelled"
    UNKNOWN = "unknown"


ACTIVE = frozenset({StepPhase.SENT, StepPhase.RUNNING, StepPhase.CONFIRMING})
"""Steps whose robot may be moving because of them."""
OPEN = frozenset({StepPhase.PENDING, StepPhase.DECIDING, StepPhase.ASKING})
"""Steps that were not authorised yet."""
CONSUMED = frozenset(StepPhase) - OPEN - {StepPhase.REFUSED}
"""Steps that were authorised: they are never authorised again."""


class Purpose(StrEnum):
    """Why a call is dispatched: as a step of the plan, or to bring a robot to its safe state."""

    EXECUTE = "execute"
    SAFE = "safe"


class StepRecord(msgspec.Struct, frozen=True, kw_only=True):
    """What has happened to one step, or to one robot's safe state."""

    call: Call
    phase: StepPhase = StepPhase.PENDING
    sequence: int = 0
    """The dispatch's number within the mission; 0 before it was authorised."""
    dispatched_ns: int = 0
    places: Mapping[str, Point] = {}
    """Run-time values as they were pinned at dispatch."""
    code: str = ""
    detail: str = ""


class Approval(msgspec.Struct, frozen=True, kw_only=True):
    """A person's yes to one step. `subject` is the digest of exactly what was approved."""

    step: str
    subject: str
    at_ns: int


class Question(msgspec.Struct, frozen=True, kw_only=True):
    """What a person is asked. `token` binds the answer to the exact reading and plan, or to one call and state."""

    text: str
    token: str
    unread: tuple[str, ...] = ()
    """Words that were not understood; the question is about the whole plan."""
    step: str = ""
    """The step that waits for approval; empty for a question about the plan."""
    subject: str = ""
    """The digest of what would be approved."""
    asked_ns: int = 0


class MissionState(msgspec.Struct, frozen=True, kw_only=True):
    """Everything that the mission machine and the gate know about one mission."""

    id: str
    request: str
    request_id: str = ""
    reading: Reading
    epoch: int = 0
    phase: Phase = Phase.RECEIVED
    started_ns: int = -1
    """Mission time at which execution began, or -1; the contract's deadline counts from here."""
    plan: Plan | None = None
    planner: str = ""
    replans: int = 0
    instance: Instance | None = None
    contract: str = ""
    steps: Mapping[str, StepRecord] = {}
    safe: Mapping[str, StepRecord] = {}
    """Safe-state calls by role."""
    settled: tuple[str, ...] = ()
    """Roles whose safe state was reached or can't be commanded."""
    sequence: int = 0
    confirmed: bool = False
    approvals: tuple[Approval, ...] = ()
    question: Question | None = None
    refusal: Refusal | None = None
    message: str = ""

    @property
    def sent_any(self) -> bool:
        """Whether anything reached a robot, or may have."""
        return any(r.sequence for r in self.steps.values())

    def active(self, robot: str = "") -> tuple[str, ...]:
        """Steps in flight, of one robot or of all."""
        return tuple(n for n, r in self.steps.items() if r.phase in ACTIVE and robot in ("", r.call.robot))


def enabled(state: MissionState) -> tuple[str, ...]:
    """The next authorised transitions: pending steps whose predecessors are done and whose robot runs nothing."""
    if state.instance is None:
        return ()
    busy = {r.call.robot for r in (*state.steps.values(), *state.safe.values()) if r.phase in ACTIVE}
    busy |= {r.call.robot for r in state.steps.values() if r.phase in OPEN - {StepPhase.PENDING}}
    found: list[str] = []
    for step in state.instance.steps:
        record = state.steps[step.step]
        if record.phase is StepPhase.PENDING and step.call.robot not in busy and _ready(state, step.after):
            found.append(step.step)
            busy.add(step.call.robot)
    return tuple(found)


def _ready(state: MissionState, after: tuple[str, ...]) -> bool:
    return all(state.steps[name].phase is StepPhase.SUCCEEDED for name in after)

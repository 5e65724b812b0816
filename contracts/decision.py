"""A decision of the gate: what was asked, what it was judged by, and why."""

from collections.abc import Mapping
from typing import Protocol

import msgspec

from crew.contracts.mission_state import MissionState, Purpose
from crew.contracts.plan import Call
from crew.contracts.refusal import Refusal
from crew.contracts.site import Rules
from crew.contracts.snapshot import Point, Snapshot


class Decision(msgspec.Struct, frozen=True, kw_only=True):
    """One dispatch, allowed or refused. Replaying its inputs gives the same decision, bit for bit."""

    mission: str
    step: str
    """The contract's step, or `safe:<role>`."""
    call: Call
    purpose: Purpose
    at_ns: int
    refusal: Refusal | None = None
    places: Mapping[str, Point] = {}
    """Where each symbolic argument leads, pinned now."""

    subject: str = ""
    """What a person has to approve, or has approved, for a step that wants it (`gate.approval`)."""

    @property
    def allowed(self) -> bool:
        return self.refusal is None


class Authorizer(Protocol):
    """What the orchestrator asks before every dispatch. Deterministic; performs nothing."""

    @property
    def enforces(self) -> bool:
        """Whether plans are held to contracts and requests; if not, they run as they are listed (simulation only)."""
        ...

    def authorize(
        self, call: Call, mission: MissionState, world: Snapshot, rules: Rules, now_ns: int, purpose: Purpose
    ) -> Decision: ...

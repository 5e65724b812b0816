"""What can happen to a mission, and what the machine asks its shell to do about it. Plain data, journalled as it is."""

from collections.abc import Mapping

import msgspec

from crew.contracts.decision import Decision
from crew.contracts.mission.validation import Validation
from crew.contracts.plan import Call, Plan
from crew.contracts.refusal import Refusal
from crew.contracts.snapshot import Point


class Event(msgspec.Struct, frozen=True, kw_only=True):
    """Base of what can happen; `at_ns` is mission time."""

    at_ns: int


class Started(Event, frozen=True, kw_only=True, tag="started"):
    """The request was read; planning may begin."""


class Proposed(Event, frozen=True, kw_only=True, tag="proposed"):
    """The planner answered with a plan."""

    plan: Plan
    planner: str = ""
    remark: str = ""
    """What a person should know about the proposal, such as who stands in for whom."""


class PlannerFailed(Event, frozen=True, kw_only=True, tag="planner_failed"):
    """The planner abstained, answered unreadably, or did not answer."""

    refusal: Refusal | None = None
    reason: str


class Validated(Event, frozen=True, kw_only=True, tag="validated"):
    """The verdict on the whole plan."""

    validation: Validation


class Answered(Event, frozen=True, kw_only=True, tag="answered"):
    """A person answered the question. A token of another question does not count."""

    token: str
    yes: bool
    by: str = ""
    signature: bytes = b""
    """Of an approval: the operator's, over mission, token and answer. Kept for whoever verifies; it decides nothing."""


class Leased(Event, frozen=True, kw_only=True, tag="leased"):
    """All robots of the instance are leased to this mission."""


class Decided(Event, frozen=True, kw_only=True, tag="decided"):
    """The gate's decision on one call, as a step or for a safe state."""

    decision: Decision


class SafeHolds(Event, frozen=True, kw_only=True, tag="safe_holds"):
    """A role's safe state holds without a call, or the contract says stay."""

    role: str


class Accepted(Event, frozen=True, kw_only=True, tag="accepted"):
    """The robot took the dispatch with this sequence."""

    sequence: int


class Outcome(Event, frozen=True, kw_only=True, tag="outcome"):
    """The robot reports the end of a dispatch: `succeeded`, `failed`, `cancelled`, `refused` or `unknown`."""

    sequence: int
    result: str
    code: str = ""
    detail: str = ""


class EffectSeen(Event, frozen=True, kw_only=True, tag="effect_seen"):
    """Telemetry newer than the dispatch shows the effects of a dispatch."""

    sequence: int


class CompletionJudged(Event, frozen=True, kw_only=True, tag="completion_judged"):
    """Whether the contract's completion conditions hold, now that every step is done."""

    missing: str = ""


class CancelAsked(Event, frozen=True, kw_only=True, tag="cancel_asked"):
    """A person, or a contract that preempts, ends the mission."""

    by: str


class StoppedAll(Event, frozen=True, kw_only=True, tag="stopped_all"):
    """A stop latched robots of this mission."""

    by: str


class DeadlineHit(Event, frozen=True, kw_only=True, tag="deadline_hit"):
    """The contract's deadline passed."""


AnyEvent = (
    Started
    | Proposed
    | PlannerFailed
    | Validated
    | Answered
    | Leased
    | Decided
    | SafeHolds
    | Accepted
    | Outcome
    | EffectSeen
    | CompletionJudged
    | CancelAsked
    | StoppedAll
    | DeadlineHit
)


class Effect(msgspec.Struct, frozen=True, kw_only=True):
    """Base of what the shell is asked to do."""


class AskPlanner(Effect, frozen=True, kw_only=True, tag="ask_planner"):
    """Ask for a plan, with the refusal of the last one as feedback."""

    feedback: Refusal | None = None


class ValidatePlan(Effect, frozen=True, kw_only=True, tag="validate_plan"):
    plan: Plan


class AskPerson(Effect, frozen=True, kw_only=True, tag="ask_person"):
    """Publish the mission's question."""


class TakeLeases(Effect, frozen=True, kw_only=True, tag="take_leases"):
    robots: tuple[str, ...]
    preempts: bool = False


class Authorise(Effect, frozen=True, kw_only=True, tag="authorise"):
    """Pass one step's call through the gate now."""

    step: str


class MakeSafe(Effect, frozen=True, kw_only=True, tag="make_safe"):
    """Bring a role to its safe state: nothing if it holds, otherwise its call through the same gate."""

    role: str


class Send(Effect, frozen=True, kw_only=True, tag="send"):
    """Commit the intent, then put the dispatch on the robot's actuation key."""

    sequence: int
    call: Call
    step: str
    places: Mapping[str, Point] = {}
    approval: str = ""
    """What a person approved, for a step that wants it."""


class CancelRunning(Effect, frozen=True, kw_only=True, tag="cancel_running"):
    """Ask the robot to cancel the dispatch with this sequence."""

    robot: str
    sequence: int


class WatchEffect(Effect, frozen=True, kw_only=True, tag="watch_effect"):
    """Look for the dispatch's effect in telemetry, for a bounded time."""

    sequence: int


class JudgeCompletion(Effect, frozen=True, kw_only=True, tag="judge_completion"):
    """Evaluate the contract's completion conditions."""


class Finish(Effect, frozen=True, kw_only=True, tag="finish"):
    """The mission has ended: release its leases and say so."""


AnyEffect = (
    AskPlanner
    | ValidatePlan
    | AskPerson
    | TakeLeases
    | Authorise
    | MakeSafe
    | Send
    | CancelRunning
    | WatchEffect
    | JudgeCompletion
    | Finish
)

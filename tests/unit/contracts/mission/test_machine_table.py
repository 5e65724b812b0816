"""Every phase against every event: listed pairs lead where the table says, all others change nothing."""

from collections.abc import Iterator
from pathlib import Path
from typing import get_args

import pytest
from msgspec.structs import replace

import crew
from crew.contracts.codes import Code
from crew.contracts.decision import Decision
from crew.contracts.mission import event as ev
from crew.contracts.mission.machine import TABLE, diagram, step
from crew.contracts.mission.validation import Validation
from crew.contracts.mission_state import ENDS, MissionState, Phase, Purpose, Question, StepPhase, StepRecord
from crew.contracts.plan import Call
from crew.contracts.refusal import Refusal
from crew.contracts.site import Rules
from tests.unit.contracts import build as b

AT_NS = b.NOW_NS + 1
UNAPPROVED = Refusal(code=Code.APPROVAL_MISSING, message="it waits", observed="none")
REFUSED = Refusal(code=Code.STATE_STALE, message="state is stale")
QUESTION = Question(text="Shall I?", token="t1", unread=("twice",))
APPROVAL = Question(text="Shall I?", token="t1", step="takeoff", subject="s", asked_ns=AT_NS)
EVENTS: tuple[type[ev.Event], ...] = get_args(ev.AnyEvent)
GOLDEN = Path(__file__).parents[1] / "golden" / "mission-machine.mmd"
PAGE = Path(crew.__file__).parents[1] / "docs" / "mission-machine.md"


def decided(step_name: str, call: Call, purpose: Purpose, refusal: Refusal | None = None) -> ev.Decided:
    decision = Decision(mission=b.MISSION, step=step_name, call=call, purpose=purpose, at_ns=AT_NS, refusal=refusal)
    return ev.Decided(at_ns=AT_NS, decision=decision)


def samples(event: type[ev.Event], rules: Rules) -> Iterator[ev.AnyEvent]:
    """Events of a type that differ in what the machine may look at."""
    instance = b.matched(b.FULL, rules)
    match event:
        case ev.Proposed:
            yield ev.Proposed(at_ns=AT_NS, plan=b.FULL)
        case ev.PlannerFailed:
            yield ev.PlannerFailed(at_ns=AT_NS, reason="abstained")
            yield ev.PlannerFailed(at_ns=AT_NS, reason="unreadable", refusal=REFUSED)
        case ev.Validated:
            yield ev.Validated(at_ns=AT_NS, validation=Validation(instance=instance))
            yield ev.Validated(at_ns=AT_NS, validation=Validation(instance=instance, question=QUESTION))
            yield ev.Validated(at_ns=AT_NS, validation=Validation(refusal=REFUSED))
        case ev.Answered:
            for token, yes in (("t1", True), ("t1", False), ("t2", True), ("", True)):
                yield ev.Answered(at_ns=AT_NS, token=token, yes=yes)
        case ev.Decided:
            for refusal in (None, REFUSED, UNAPPROVED):
                yield decided("takeoff", b.TAKEOFF, Purpose.EXECUTE, refusal)
                yield decided("dispatch", b.DISPATCH, Purpose.EXECUTE, refusal)
                yield decided("safe:searcher", b.LAND, Purpose.SAFE, refusal)
                yield decided("safe:responder", b.STOP, Purpose.SAFE, refusal)
        case ev.SafeHolds:
            yield from (ev.SafeHolds(at_ns=AT_NS, role=role) for role in ("searcher", "responder"))
        case ev.Accepted | ev.EffectSeen:
            yield from (event(at_ns=AT_NS, sequence=number) for number in range(6))
        case ev.Outcome:
            for number in range(6):
                for result in ("succeeded", "failed", "unknown"):
                    yield ev.Outcome(at_ns=AT_NS, sequence=number, result=result)
        case ev.CompletionJudged:
            yield from (ev.CompletionJudged(at_ns=AT_NS, missing=missing) for missing in ("", "tb3 is elsewhere"))
        case ev.CancelAsked | ev.StoppedAll:
            yield event(at_ns=AT_NS, by="a person")
        case ev.Started | ev.Leased | ev.DeadlineHit:
            yield event(at_ns=AT_NS)


def states(phase: Phase, rules: Rules) -> Iterator[MissionState]:
    """Missions in a phase: with nothing sent, under way, in parallel, with all done, with one role settled."""
    bare = b.executing(b.SEARCH_AND_SEND, b.FULL, rules, phase=phase, question=QUESTION)
    yield replace(bare, replans=1)
    deciding = b.with_step(bare, "takeoff", StepPhase.DECIDING)
    yield deciding
    yield replace(b.with_step(bare, "takeoff", StepPhase.ASKING), question=APPROVAL)
    yield replace(b.with_step(bare, "takeoff", StepPhase.ASKING), question=replace(APPROVAL, asked_ns=0))
    yield replace(
        b.with_step(b.done(bare, "takeoff"), "search", StepPhase.ASKING), question=replace(APPROVAL, step="search")
    )
    for running in (StepPhase.SENT, StepPhase.RUNNING, StepPhase.CONFIRMING):
        yield b.with_step(bare, "takeoff", running)
    ready = b.done(bare, "takeoff", "search", "report")
    yield b.with_step(b.with_step(ready, "dispatch", StepPhase.DECIDING), "land", StepPhase.RUNNING)
    yield b.done(b.with_step(ready, "dispatch", StepPhase.CONFIRMING), "land")
    yield b.done(ready, "dispatch", "land")
    yield replace(ready, settled=("searcher",))
    for running in (StepPhase.SENT, StepPhase.CONFIRMING):
        record = StepRecord(call=b.STOP, phase=running, sequence=4, dispatched_ns=AT_NS)
        yield replace(ready, settled=("searcher",), safe={"responder": record}, sequence=4)


def outcomes(phase: Phase, event: type[ev.Event], rules: Rules) -> set[Phase]:
    """The phases that the samples reach."""
    found = set()
    for state in states(phase, rules):
        for sample in samples(event, rules):
            after, effects = step(state, sample, rules.contracts)
            if (phase, event) not in TABLE:
                assert after is state
                assert effects == ()
            found.add(after.phase)
    return found


@pytest.mark.parametrize("event", EVENTS, ids=lambda event: event.__name__)
@pytest.mark.parametrize("phase", Phase)
def test_a_phase_and_an_event_lead_where_the_table_says(phase: Phase, event: type[ev.Event], rules: Rules) -> None:
    _, targets = TABLE.get((phase, event), (None, (phase,)))
    reached = outcomes(phase, event, rules)
    assert reached - {phase} == set(targets) - {phase}


def test_every_event_type_has_a_sample(rules: Rules) -> None:
    assert all(list(samples(event, rules)) for event in EVENTS)


def test_an_end_is_left_by_nothing() -> None:
    assert not [pair for pair in TABLE if pair[0] in ENDS]


def test_every_phase_before_an_end_can_be_cancelled_or_is_ending_already() -> None:
    cancellable = {phase for phase, event in TABLE if event is ev.CancelAsked}
    assert cancellable == set(Phase) - ENDS - {Phase.HALTING, Phase.CANCELLING}


def test_the_diagram_is_the_golden_one() -> None:
    assert diagram() == GOLDEN.read_text(encoding="utf-8")


def test_the_page_shows_the_diagram_of_the_table() -> None:
    page = PAGE.read_text(encoding="utf-8")
    assert f"```mermaid\n{diagram()}```\n" in page
    assert all(f"`{phase}`" in page for phase in Phase), "the page tells what every phase means"

"""The mission machine in scenes: parallel steps, early ends, late and repeated words, questions, completion."""

import pytest
from msgspec.structs import replace

from crew.contracts.codes import Code
from crew.contracts.decision import Decision
from crew.contracts.mission import event as ev
from crew.contracts.mission.machine import step
from crew.contracts.mission.validation import Validation
from crew.contracts.mission_state import MissionState, Phase, Purpose, Question, StepPhase
from crew.contracts.plan import Call
from crew.contracts.refusal import Refusal
from crew.contracts.site import Rules
from crew.contracts.snapshot import Point
from tests.unit.contracts import build as b

AT_NS = b.NOW_NS + 5
STALE = Refusal(code=Code.STATE_STALE, message="state is stale")
Effects = tuple[ev.AnyEffect, ...]


def after(state: MissionState, rules: Rules, *events: ev.AnyEvent) -> tuple[MissionState, Effects]:
    """The state after some events, and the effects of the last one."""
    effects: Effects = ()
    for event in events:
        state, effects = step(state, event, rules.contracts)
    return state, effects


def decided(name: str, call: Call, refusal: Refusal | None = None, *, mission: str = b.MISSION) -> ev.Decided:
    purpose = Purpose.SAFE if name.startswith("safe:") else Purpose.EXECUTE
    decision = Decision(mission=mission, step=name, call=call, purpose=purpose, at_ns=AT_NS, refusal=refusal)
    return ev.Decided(at_ns=AT_NS, decision=decision)


def outcome(sequence: int, result: str, detail: str = "") -> ev.Outcome:
    return ev.Outcome(at_ns=AT_NS, sequence=sequence, result=result, detail=detail)


def seen(sequence: int) -> ev.EffectSeen:
    return ev.EffectSeen(at_ns=AT_NS, sequence=sequence)


def safe(role: str) -> ev.SafeHolds:
    return ev.SafeHolds(at_ns=AT_NS, role=role)


def waiting(rules: Rules) -> MissionState:
    return b.executing(b.SEARCH_AND_SEND, b.FULL, rules, phase=Phase.WAITING, started_ns=0)


def in_parallel(rules: Rules) -> tuple[MissionState, Effects]:
    """The report was just seen: dispatch and land are at the gate together."""
    mission = b.with_step(
        b.done(b.executing(b.SEARCH_AND_SEND, b.FULL, rules), "takeoff", "search"), "report", StepPhase.CONFIRMING
    )
    return after(mission, rules, seen(3))


CANCEL = ev.CancelAsked(at_ns=AT_NS, by="a person")
STOP = ev.StoppedAll(at_ns=AT_NS, by="a person")


# --- executing


def test_execution_begins_with_the_first_step_alone(rules: Rules) -> None:
    state, effects = after(waiting(rules), rules, ev.Leased(at_ns=AT_NS))
    assert effects == (ev.Authorise(step="takeoff"),)
    assert (state.phase, state.started_ns) == (Phase.EXECUTING, AT_NS)


def test_a_dispatch_carries_the_places_that_the_gate_pinned(rules: Rules) -> None:
    state, _ = in_parallel(rules)
    event = decided("dispatch", b.DISPATCH)
    event = replace(event, decision=replace(event.decision, places={"target": Point(5.0, 5.0)}))
    state, effects = after(state, rules, event)
    assert effects == (ev.Send(sequence=4, call=b.DISPATCH, step="dispatch", places={"target": Point(5.0, 5.0)}),)
    record = state.steps["dispatch"]
    assert (record.phase, record.dispatched_ns, record.places) == (StepPhase.SENT, AT_NS, {"target": Point(5.0, 5.0)})


def test_success_is_a_word_and_only_telemetry_makes_it_progress(rules: Rules) -> None:
    mission = b.with_step(b.executing(b.SEARCH, b.SEARCH_PLAN, rules), "takeoff", StepPhase.RUNNING)
    state, effects = after(mission, rules, outcome(1, "succeeded"))
    assert effects == (ev.WatchEffect(sequence=1),)
    assert state.steps["takeoff"].phase is StepPhase.CONFIRMING
    state, effects = after(state, rules, seen(1))
    assert effects == (ev.Authorise(step="search"),)


def test_an_effect_seen_before_the_robot_said_so_changes_nothing(rules: Rules) -> None:
    mission = b.with_step(b.executing(b.SEARCH, b.SEARCH_PLAN, rules), "takeoff", StepPhase.RUNNING)
    assert after(mission, rules, seen(1)) == (mission, ())


def test_an_effect_that_is_not_seen_halts(rules: Rules) -> None:
    mission = b.with_step(b.executing(b.SEARCH, b.SEARCH_PLAN, rules), "takeoff", StepPhase.CONFIRMING)
    state, effects = after(mission, rules, outcome(1, "failed", "iris.airborne is false"))
    assert (state.phase, state.steps["takeoff"].phase) == (Phase.HALTING, StepPhase.FAILED)
    assert "iris.airborne is false" in state.message
    assert effects == (ev.MakeSafe(role="searcher"),)


@pytest.mark.parametrize("phase", [StepPhase.SENT, StepPhase.RUNNING, StepPhase.CONFIRMING])
def test_a_repeated_word_starts_no_second_look(phase: StepPhase, rules: Rules) -> None:
    mission = b.with_step(b.executing(b.SEARCH, b.SEARCH_PLAN, rules), "takeoff", phase)
    once, _ = after(mission, rules, outcome(1, "succeeded"))
    assert after(once, rules, outcome(1, "succeeded")) == (once, ())
    assert after(once, rules, ev.Accepted(at_ns=AT_NS, sequence=1)) == (once, ())


@pytest.mark.parametrize("result", ["succeeded", "failed", "unknown"])
def test_a_word_on_a_finished_step_or_on_none_changes_nothing(result: str, rules: Rules) -> None:
    mission = b.done(b.executing(b.SEARCH, b.SEARCH_PLAN, rules), "takeoff")
    for sequence in (0, 1, 2, -1):
        assert after(mission, rules, outcome(sequence, result)) == (mission, ())


def test_a_word_that_nobody_knows_is_an_unknown_outcome(rules: Rules) -> None:
    mission = b.with_step(b.executing(b.SEARCH, b.SEARCH_PLAN, rules), "takeoff", StepPhase.RUNNING)
    state, _ = after(mission, rules, outcome(1, "paused"))
    assert (state.phase, state.steps["takeoff"].phase) == (Phase.HALTING, StepPhase.UNKNOWN)


def test_a_dispatch_that_was_never_accepted_may_end(rules: Rules) -> None:
    mission = b.with_step(b.executing(b.SEARCH, b.SEARCH_PLAN, rules), "takeoff", StepPhase.SENT)
    state, effects = after(mission, rules, outcome(1, "refused", "another epoch"))
    assert state.steps["takeoff"].phase is StepPhase.REFUSED
    assert effects == (ev.MakeSafe(role="searcher"),)


def test_a_decision_on_another_call_or_mission_sends_nothing(rules: Rules) -> None:
    mission = b.with_step(b.executing(b.SEARCH, b.SEARCH_PLAN, rules), "takeoff", StepPhase.DECIDING)
    higher = b.with_args(b.TAKEOFF, altitude=9.0)
    for event in (decided("takeoff", higher), decided("takeoff", b.TAKEOFF, mission="m2"), decided("land", b.LAND)):
        assert after(mission, rules, event) == (mission, ())


def test_completion_is_judged_when_every_step_is_done_and_not_before(rules: Rules) -> None:
    under_way = b.done(b.executing(b.SEARCH, b.SEARCH_PLAN, rules), "takeoff", "search", "report")
    judged = ev.CompletionJudged(at_ns=AT_NS)
    assert after(under_way, rules, judged) == (under_way, ())
    landing = b.with_step(under_way, "land", StepPhase.CONFIRMING)
    state, effects = after(landing, rules, seen(4))
    assert effects == (ev.JudgeCompletion(),)
    state, effects = after(state, rules, judged)
    assert (state.phase, effects) == (Phase.COMPLETED, (ev.Finish(),))


def test_an_incomplete_end_is_no_completion(rules: Rules) -> None:
    mission = b.done(b.executing(b.SEND_TO_BASE, b.BASE_PLAN, rules), "dispatch")
    state, effects = after(mission, rules, ev.CompletionJudged(at_ns=AT_NS, missing="tb3 is elsewhere"))
    assert (state.phase, effects) == (Phase.HALTING, (ev.MakeSafe(role="responder"),))
    assert "tb3 is elsewhere" in state.message


# --- parallel steps


def test_dispatch_and_landing_go_side_by_side(rules: Rules) -> None:
    _, effects = in_parallel(rules)
    assert effects == (ev.Authorise(step="dispatch"), ev.Authorise(step="land"))


def test_a_robot_takes_its_unordered_steps_one_after_the_other(rules: Rules) -> None:
    contract = rules.contracts["search_only"]
    free = replace(contract, steps=tuple(replace(s, after=()) for s in contract.steps))
    loose = replace(rules, contracts={"search_only": free})
    state = b.executing(b.SEARCH, b.SEARCH_PLAN, loose, phase=Phase.WAITING)
    for sequence, name in enumerate(("takeoff", "search", "report", "land"), start=1):
        begin = ev.Leased(at_ns=AT_NS) if sequence == 1 else seen(sequence - 1)
        state, effects = after(state, loose, begin)
        assert effects == (ev.Authorise(step=name),)
        call = state.steps[name].call
        state, effects = after(state, loose, decided(name, call), outcome(sequence, "succeeded"))
        assert effects == (ev.WatchEffect(sequence=sequence),)


def test_one_refused_and_the_other_sent_halts_and_lets_a_landing_run_on(rules: Rules) -> None:
    state, _ = in_parallel(rules)
    state, effects = after(state, rules, decided("land", b.LAND), decided("dispatch", b.DISPATCH, STALE))
    assert state.phase is Phase.HALTING
    assert effects == (ev.MakeSafe(role="responder"),)
    state, effects = after(state, rules, safe("responder"), outcome(4, "succeeded"))
    assert effects == (ev.WatchEffect(sequence=4),)
    state, effects = after(state, rules, seen(4))
    assert effects == (ev.MakeSafe(role="searcher"),)
    state, effects = after(state, rules, safe("searcher"))
    assert (state.phase, effects) == (Phase.HALTED, (ev.Finish(),))


def test_a_step_still_at_the_gate_when_the_halt_begins_is_not_sent(rules: Rules) -> None:
    state, _ = in_parallel(rules)
    halting, effects = after(state, rules, decided("dispatch", b.DISPATCH, STALE))
    assert effects == (ev.MakeSafe(role="searcher"), ev.MakeSafe(role="responder"))
    assert halting.steps["land"].phase is StepPhase.PENDING
    assert after(halting, rules, decided("land", b.LAND)) == (halting, ())


def test_a_failure_cancels_what_runs_beside_it(rules: Rules) -> None:
    state, _ = in_parallel(rules)
    state, _ = after(state, rules, decided("dispatch", b.DISPATCH), decided("land", b.LAND))
    _, effects = after(state, rules, outcome(5, "failed"))
    assert effects == (ev.MakeSafe(role="searcher"), ev.CancelRunning(robot="tb3", sequence=4))


def test_the_first_refusal_with_nothing_sent_rejects(rules: Rules) -> None:
    beside = b.executing(b.ABORT, b.ABORT_PLAN, rules, phase=Phase.WAITING)
    others = {**rules.contracts, "abort": replace(rules.contracts["abort"], preempts=False)}
    rules = replace(rules, contracts=others)
    state, effects = after(beside, rules, ev.Leased(at_ns=AT_NS))
    assert effects == (ev.Authorise(step="land"), ev.Authorise(step="stop"))
    state, effects = after(state, rules, decided("land", b.LAND, STALE))
    assert (state.phase, state.refusal, effects) == (Phase.REJECTED, STALE, (ev.Finish(),))
    assert after(state, rules, decided("stop", b.STOP)) == (state, ())


def test_an_abort_that_is_refused_makes_its_robots_safe(rules: Rules) -> None:
    state, _ = after(b.executing(b.ABORT, b.ABORT_PLAN, rules, phase=Phase.WAITING), rules, ev.Leased(at_ns=AT_NS))
    state, effects = after(state, rules, decided("land", b.LAND, STALE))
    assert (state.phase, state.refusal) == (Phase.HALTING, STALE)
    assert effects == (ev.MakeSafe(role="searcher"), ev.MakeSafe(role="responder"))
    assert after(state, rules, decided("stop", b.STOP)) == (state, ())


# --- early ends


@pytest.mark.parametrize(("event", "phase"), [(CANCEL, Phase.CANCELLING), (STOP, Phase.HALTING)])
def test_an_early_end_cancels_a_running_skill_once(event: ev.AnyEvent, phase: Phase, rules: Rules) -> None:
    mission = b.with_step(b.executing(b.SEARCH, b.SEARCH_PLAN, rules), "takeoff", StepPhase.RUNNING)
    state, effects = after(mission, rules, event)
    assert (state.phase, effects) == (phase, (ev.CancelRunning(robot="iris", sequence=1),))
    for again in (CANCEL, STOP, ev.DeadlineHit(at_ns=AT_NS)):
        assert after(state, rules, again) == (state, ())


def test_a_stop_is_told_as_the_reason(rules: Rules) -> None:
    state, _ = after(b.before_dispatch(rules), rules, STOP)
    assert state.refusal is not None
    assert (state.refusal.code, state.message) == (Code.STOPPED, "stopped by a person")


def test_the_deadline_halts_with_its_code(rules: Rules) -> None:
    state, _ = after(b.before_dispatch(rules), rules, ev.DeadlineHit(at_ns=AT_NS))
    assert state.refusal is not None
    assert (state.phase, state.refusal.code, state.refusal.allowed) == (Phase.HALTING, Code.DEADLINE_PASSED, "600 s")


def test_success_during_an_early_end_is_not_believed_without_telemetry(rules: Rules) -> None:
    mission = b.with_step(b.executing(b.SEARCH, b.SEARCH_PLAN, rules), "takeoff", StepPhase.RUNNING)
    state, effects = after(mission, rules, CANCEL, outcome(1, "succeeded"))
    assert (state.steps["takeoff"].phase, effects) == (StepPhase.CONFIRMING, (ev.WatchEffect(sequence=1),))
    state, effects = after(state, rules, outcome(1, "failed"))
    assert (state.steps["takeoff"].phase, effects) == (StepPhase.FAILED, (ev.MakeSafe(role="searcher"),))


def test_a_robot_that_still_runs_a_step_is_not_safe(rules: Rules) -> None:
    mission = b.with_step(b.executing(b.SEARCH, b.SEARCH_PLAN, rules), "takeoff", StepPhase.RUNNING)
    state, _ = after(mission, rules, CANCEL)
    early = (
        safe("searcher"),
        safe("nobody"),
        decided("safe:searcher", b.LAND),
        decided("safe:searcher", b.LAND, STALE),
    )
    for event in early:
        assert after(state, rules, event) == (state, ())
    _, effects = after(state, rules, outcome(1, "cancelled"))
    assert effects == (ev.MakeSafe(role="searcher"),)


def test_a_safe_call_is_watched_like_any_other(rules: Rules) -> None:
    mission = b.before_dispatch(rules)
    state, _ = after(mission, rules, CANCEL)
    state, effects = after(state, rules, decided("safe:searcher", b.LAND))
    assert effects == (ev.Send(sequence=4, call=b.LAND, step="safe:searcher"),)
    assert after(state, rules, decided("safe:searcher", b.LAND)) == (state, ())
    state, _ = after(state, rules, ev.Accepted(at_ns=AT_NS, sequence=4), safe("responder"))
    assert state.phase is Phase.CANCELLING
    state, effects = after(state, rules, outcome(4, "succeeded"))
    assert effects == (ev.WatchEffect(sequence=4),)
    state, effects = after(state, rules, seen(4))
    assert (state.phase, effects) == (Phase.CANCELLED, (ev.Finish(),))
    assert state.settled == ("responder", "searcher")


def test_a_refused_safe_call_is_told_and_settles_its_role(rules: Rules) -> None:
    state, _ = after(b.before_dispatch(rules), rules, STOP, decided("safe:searcher", b.LAND, STALE))
    assert (state.safe["searcher"].phase, state.safe["searcher"].code) == (StepPhase.REFUSED, "state_stale")
    state, effects = after(state, rules, safe("responder"))
    assert (state.phase, effects) == (Phase.HALTED, (ev.Finish(),))


@pytest.mark.parametrize(
    "event",
    [
        decided("safe:searcher", b.STOP),
        decided("safe:nobody", b.LAND),
        decided("", b.LAND),
        decided("safe:searcher", b.LAND, mission="m2"),
        decided("dispatch", b.DISPATCH),
    ],
)
def test_a_decision_on_anything_but_a_role_s_own_robot_sends_nothing_in_an_end(event: ev.Decided, rules: Rules) -> None:
    state, _ = after(b.before_dispatch(rules), rules, STOP)
    assert after(state, rules, event) == (state, ())


# --- before anything moves


def test_a_refused_plan_is_planned_once_more_and_then_rejected(rules: Rules) -> None:
    refused = ev.Validated(at_ns=AT_NS, validation=Validation(refusal=STALE))
    mission = b.received(b.SEARCH, rules, phase=Phase.VALIDATING)
    state, effects = after(mission, rules, refused)
    assert (state.phase, effects) == (Phase.PLANNING, (ev.AskPlanner(feedback=STALE),))
    state, effects = after(state, rules, ev.Proposed(at_ns=AT_NS, plan=b.FULL), refused)
    assert (state.phase, state.refusal, effects) == (Phase.REJECTED, STALE, (ev.Finish(),))


def test_a_verdict_without_instance_and_refusal_is_no_plan(rules: Rules) -> None:
    mission = b.received(b.SEARCH, rules, phase=Phase.VALIDATING, replans=1)
    state, _ = after(mission, rules, ev.Validated(at_ns=AT_NS, validation=Validation()))
    assert state.phase is Phase.REJECTED
    assert state.refusal is not None
    assert state.refusal.code is Code.MALFORMED_PLAN


def test_an_answer_confirms_exactly_what_was_asked(rules: Rules) -> None:
    question = Question(text="Shall I?", token="t1", unread=("twice",))
    verdict = ev.Validated(at_ns=AT_NS, validation=Validation(instance=b.matched(b.FULL, rules), question=question))
    asking, effects = after(b.received(b.SEARCH_AND_SEND, rules, phase=Phase.VALIDATING), rules, verdict)
    assert effects == (ev.AskPerson(),)
    assert after(asking, rules, ev.Answered(at_ns=AT_NS, token="t0", yes=True)) == (asking, ())
    agreed, effects = after(asking, rules, ev.Answered(at_ns=AT_NS, token="t1", yes=True))
    assert effects == (ev.TakeLeases(robots=("iris", "tb3")),)
    assert (agreed.confirmed, agreed.approvals, agreed.question) == (True, (), None)
    declined, _ = after(asking, rules, ev.Answered(at_ns=AT_NS, token="t1", yes=False))
    assert declined.phase is Phase.REJECTED
    assert declined.refusal is not None
    assert declined.refusal.code is Code.UNREAD_WORDS


def test_an_abort_asks_for_its_robots_first(rules: Rules) -> None:
    verdict = ev.Validated(at_ns=AT_NS, validation=Validation(instance=b.matched(b.ABORT_PLAN, rules)))
    _, effects = after(b.received(b.ABORT, rules, phase=Phase.VALIDATING), rules, verdict)
    assert effects == (ev.TakeLeases(robots=("iris", "tb3"), preempts=True),)


def test_a_mission_cancelled_while_it_waits_takes_no_lease_any_more(rules: Rules) -> None:
    state, effects = after(waiting(rules), rules, CANCEL)
    assert (state.phase, effects) == (Phase.CANCELLED, (ev.Finish(),))
    assert after(state, rules, ev.Leased(at_ns=AT_NS)) == (state, ())

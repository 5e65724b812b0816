"""A step that a person must approve: asked for in its turn, for exactly this call and state, once, for a short time."""

from collections.abc import Callable

import pytest
from msgspec.structs import replace

from crew.contracts.codes import Code
from crew.contracts.decision import Decision
from crew.contracts.gate.approval import APPROVAL_S, approved
from crew.contracts.gate.guard import SECOND_NS
from crew.contracts.mission import event as ev
from crew.contracts.mission.consent import QUESTION_S
from crew.contracts.mission.machine import step
from crew.contracts.mission_state import MissionState, Phase, StepPhase, enabled
from crew.contracts.plan import Plan
from crew.contracts.site import Rules
from crew.contracts.snapshot import Point, Snapshot
from tests.unit.contracts import build as b

World = Snapshot
SEEN = b.world(b.iris(airborne=True), fix=b.victim())


@pytest.fixture
def strict(rules: Rules) -> Rules:
    """The rover may be sent only once a person has approved exactly that."""
    return b.with_approval(rules, "search_and_dispatch", "dispatch")


def deciding(rules: Rules) -> MissionState:
    """The rover's dispatch is at the gate."""
    return b.with_step(b.before_dispatch(rules), "dispatch", StepPhase.DECIDING)


def decided(
    mission: MissionState, rules: Rules, world: World = SEEN, at_ns: int = b.NOW_NS
) -> tuple[Decision, MissionState, tuple[ev.AnyEffect, ...]]:
    """What the real gate says to the dispatch, and what the machine makes of it."""
    decision = b.judged(b.DISPATCH, mission, world, rules, now_ns=at_ns)
    state, effects = step(mission, ev.Decided(at_ns=at_ns, decision=decision), rules.contracts)
    return decision, state, effects


def answered(
    mission: MissionState, rules: Rules, *, yes: bool = True, at_ns: int = b.NOW_NS, token: str = ""
) -> tuple[MissionState, tuple[ev.AnyEffect, ...]]:
    assert mission.question is not None
    event = ev.Answered(at_ns=at_ns, token=token or mission.question.token, yes=yes, by="operator")
    return step(mission, event, rules.contracts)


def test_the_gate_refuses_the_step_and_the_machine_asks_instead_of_halting(strict: Rules) -> None:
    decision, state, effects = decided(deciding(strict), strict)
    assert decision.refusal is not None
    assert decision.refusal.code is Code.APPROVAL_MISSING
    assert (state.phase, state.steps["dispatch"].phase, effects) == (
        Phase.EXECUTING,
        StepPhase.ASKING,
        (ev.AskPerson(),),
    )
    assert state.question is not None
    assert "tb3.navigate_to(target=victim); target is (5.00, 5.00)" in state.question.text
    assert (state.question.step, state.question.subject) == ("dispatch", decision.subject)


def test_a_yes_leads_through_the_gate_again_and_is_spent(strict: Rules) -> None:
    _, asking, _ = decided(deciding(strict), strict)
    state, effects = answered(asking, strict)
    assert effects == (ev.Authorise(step="dispatch"),)
    decision, state, effects = decided(state, strict)
    assert decision.allowed
    (send,) = effects
    assert isinstance(send, ev.Send)
    assert send.approval == decision.subject, "what was approved goes with the dispatch"
    assert (state.approvals, state.question) == ((), None), "it serves once"


CHANGES: dict[str, Callable[[], World]] = {
    "the victim is elsewhere": lambda: b.world(b.iris(airborne=True), fix=b.victim(Point(6.0, 5.0))),
    "a word of the robot's telemetry": lambda: b.world(
        b.with_fluent(b.tb3(), "tray", "bottle", b.NOW_NS), fix=b.victim()
    ),
}


@pytest.mark.parametrize("change", CHANGES)
def test_an_approval_of_what_has_changed_since_is_refused_and_asked_for_anew(strict: Rules, change: str) -> None:
    _, asking, _ = decided(deciding(strict), strict)
    approved_state, _ = answered(asking, strict)
    assert decided(approved_state, strict)[0].allowed, "unchanged, it would go"
    decision, state, effects = decided(approved_state, strict, CHANGES[change]())
    assert decision.refusal is not None
    assert (decision.refusal.code, decision.refusal.observed) == (Code.APPROVAL_MISSING, "another state")
    assert effects == (ev.AskPerson(),)
    assert state.question is not None
    assert asking.question is not None
    assert state.question.token != asking.question.token
    assert "has changed since" in state.question.text
    assert answered(state, strict, token=asking.question.token) == (state, ()), "an answer to the old question is none"


def test_figures_that_change_from_moment_to_moment_do_not_void_an_approval(strict: Rules) -> None:
    _, asking, _ = decided(deciding(strict), strict)
    state, _ = answered(asking, strict)
    drained = b.with_fluent(b.tb3(), "battery", 89.0, b.NOW_NS)
    assert decided(state, strict, b.world(b.iris(airborne=True), drained, fix=b.victim()))[0].allowed


def test_an_approval_of_another_call_plan_or_contract_is_none(strict: Rules) -> None:
    mission = deciding(strict)
    yes = approved(b.DISPATCH, "dispatch", mission, SEEN, strict, b.NOW_NS)
    assert b.judged(b.DISPATCH, replace(mission, approvals=yes), SEEN, strict).allowed
    other_plan = replace(mission, plan=Plan(b.FULL.contract, b.FULL.steps[:4]))
    loose = b.with_approval(strict, "search_and_dispatch", "search")
    for changed, rules in ((other_plan, strict), (replace(mission, id="m2"), strict), (mission, loose)):
        given = replace(changed, approvals=yes)
        world = b.world(b.iris(airborne=True, lease=changed.id), b.tb3(lease=changed.id), fix=b.victim())
        assert b.refused(b.DISPATCH, given, world, rules).code is Code.APPROVAL_MISSING
        anew = replace(changed, approvals=approved(b.DISPATCH, "dispatch", changed, world, rules, b.NOW_NS))
        assert b.judged(b.DISPATCH, anew, world, rules).allowed


@pytest.mark.parametrize(
    ("late_s", "allowed"), [(0.0, True), (APPROVAL_S, True), (APPROVAL_S + 0.001, False), (-0.001, False)]
)
def test_an_approval_expires(strict: Rules, late_s: float, allowed: bool) -> None:
    _, asking, _ = decided(deciding(strict), strict)
    state, _ = answered(asking, strict)
    at_ns = b.NOW_NS + round(late_s * SECOND_NS)
    stamp_ns = at_ns - SECOND_NS
    world = b.world(b.iris(airborne=True, at_ns=at_ns), b.tb3(at_ns=at_ns), fix=b.victim(stamp_ns=stamp_ns))
    assert decided(state, strict, world, at_ns)[0].allowed is allowed


def test_an_answer_that_comes_too_late_leads_to_a_new_question(strict: Rules) -> None:
    _, asking, _ = decided(deciding(strict), strict)
    in_time, _ = answered(asking, strict, at_ns=b.NOW_NS + round(QUESTION_S * SECOND_NS))
    assert in_time.approvals
    late, effects = answered(asking, strict, at_ns=b.NOW_NS + round(QUESTION_S * SECOND_NS) + 1)
    assert (late.approvals, effects) == ((), (ev.Authorise(step="dispatch"),))


def test_a_no_ends_the_mission_safely(strict: Rules) -> None:
    _, asking, _ = decided(deciding(strict), strict)
    state, effects = answered(asking, strict, yes=False)
    assert (state.phase, state.steps["dispatch"].phase) == (Phase.HALTING, StepPhase.REFUSED)
    assert {type(e) for e in effects} == {ev.MakeSafe}
    assert state.refusal is not None
    assert state.refusal.code is Code.APPROVAL_MISSING


def test_a_no_before_anything_was_sent_rejects(rules: Rules) -> None:
    strict = b.with_approval(rules, "dispatch_only", "dispatch")
    mission = b.with_step(b.executing(b.SEND_TO_VICTIM, b.VICTIM_PLAN, strict), "dispatch", StepPhase.DECIDING)
    _, asking, _ = decided(mission, strict)
    assert answered(asking, strict, yes=False)[0].phase is Phase.REJECTED


@pytest.mark.parametrize(
    "event",
    [ev.CancelAsked(at_ns=b.NOW_NS, by="x"), ev.StoppedAll(at_ns=b.NOW_NS, by="x"), ev.DeadlineHit(at_ns=b.NOW_NS)],
)
def test_a_mission_that_ends_while_it_asks_forgets_its_question(strict: Rules, event: ev.AnyEvent) -> None:
    _, asking, _ = decided(deciding(strict), strict)
    assert asking.question is not None
    state, _ = step(asking, event, strict.contracts)
    assert (state.question, state.steps["dispatch"].phase) == (None, StepPhase.PENDING)
    yes = ev.Answered(at_ns=b.NOW_NS, token=asking.question.token, yes=True)
    assert step(state, yes, strict.contracts) == (state, ())


def test_of_two_steps_that_wait_one_is_asked_for_at_a_time(strict: Rules) -> None:
    both = b.with_approval(strict, "search_and_dispatch", "land")
    mission = b.with_step(deciding(both), "land", StepPhase.DECIDING)
    _, first, _ = decided(mission, both)
    landing = b.judged(b.LAND, first, SEEN, both)
    state, effects = step(first, ev.Decided(at_ns=b.NOW_NS, decision=landing), both.contracts)
    assert (effects, state.question) == ((), first.question)
    state, effects = answered(state, both)
    assert effects == (ev.Authorise(step="dispatch"), ev.Authorise(step="land"))
    _, state, (sent,) = decided(state, both)
    assert isinstance(sent, ev.Send)
    landing = b.judged(b.LAND, state, SEEN, both)
    state, effects = step(state, ev.Decided(at_ns=b.NOW_NS, decision=landing), both.contracts)
    assert effects == (ev.AskPerson(),)
    assert state.question is not None
    assert state.question.step == "land"


def test_a_robot_whose_step_is_asked_for_gets_no_other(strict: Rules) -> None:
    _, asking, _ = decided(deciding(strict), strict)
    assert enabled(asking) == ("land",), "the drone's own step goes on"


def test_where_a_contracts_file_lies_is_no_part_of_what_is_approved(strict: Rules) -> None:
    moved = {name: replace(c, source=f"/elsewhere/{name}.yaml") for name, c in strict.contracts.items()}
    here, there = (decided(deciding(rules), rules)[0].subject for rules in (strict, replace(strict, contracts=moved)))
    assert here == there

"""Unenforced plans: for simulated crews alone, as they are listed, whatever becomes of each step."""

import math
from typing import Any

import pytest
from msgspec.structs import replace

from crew.contracts.mission import event as ev
from crew.contracts.mission.listed import accept_listed, step_listed, with_listed
from crew.contracts.mission.validation import Validation
from crew.contracts.mission_state import MissionState, Phase, Purpose, StepPhase
from crew.contracts.pass_through import AS_LISTED, PassThrough, RealRobots
from crew.contracts.plan import Call, Plan
from crew.contracts.refusal import Refusal
from crew.contracts.snapshot import Point
from tests.unit.contracts import build as b

INVENTED = Call("tb3", "go_to_goal", {"x": 99.0})
ODD = Plan("no_such_contract", (INVENTED, b.TO_BASE, b.DISPATCH))


def _crew(**robot: Any) -> Any:
    crew = b.air_ground().crew
    return replace(crew, robots=(replace(crew.robots[0], **robot), *crew.robots[1:]))


@pytest.mark.parametrize(
    "crew",
    [_crew(connection="udpin:0.0.0.0:14550", sim=""), _crew(sim=""), replace(b.air_ground().crew, sim=None)],
    ids=["a real connection", "no vehicle", "no simulated site"],
)
def test_pass_through_does_not_exist_with_a_real_robot(crew: Any) -> None:
    with pytest.raises(RealRobots, match="without the gate nothing runs but a simulation"):
        PassThrough(crew)


def test_pass_through_does_not_exist_with_a_connection_beside_a_simulated_vehicle() -> None:
    with pytest.raises(RealRobots, match="iris has a real connection"):
        PassThrough(_crew(connection="udpin:0.0.0.0:14550"))


def test_pass_through_allows_whatever_is_asked_and_pins_what_was_published() -> None:
    rules, authorizer = b.air_ground(), PassThrough(b.air_ground().crew)
    mission = _executing(ODD)
    for call in (INVENTED, Call("nobody", "fly"), b.TO_BASE):
        assert authorizer.authorize(call, mission, b.world(), rules, b.NOW_NS, Purpose.EXECUTE).allowed
    seen = authorizer.authorize(b.DISPATCH, mission, b.world(fix=b.victim()), rules, b.NOW_NS, Purpose.EXECUTE)
    assert seen.places == {"target": b.SEEN}
    unseen = authorizer.authorize(b.DISPATCH, mission, b.world(), rules, b.NOW_NS, Purpose.EXECUTE)
    assert math.isnan(unseen.places["target"].x)
    corrupt = b.world(fix=b.victim(Point(math.nan, math.nan)))
    sent = authorizer.authorize(b.DISPATCH, mission, corrupt, rules, b.NOW_NS, Purpose.EXECUTE)
    assert math.isnan(sent.places["target"].x)


def _feed(state: MissionState, *events: ev.AnyEvent) -> tuple[MissionState, tuple[ev.AnyEffect, ...]]:
    effects: tuple[ev.AnyEffect, ...] = ()
    for event in events:
        state, effects = step_listed(state, event, with_listed(b.air_ground()).contracts)
    return state, effects


def _executing(plan: Plan) -> MissionState:
    rules = b.air_ground()
    state, _ = _feed(
        b.received("anything", rules),
        ev.Started(at_ns=1),
        ev.Proposed(at_ns=2, plan=plan),
        ev.Validated(at_ns=3, validation=accept_listed(plan, rules)),
        ev.Leased(at_ns=4),
    )
    return state


def _decided(state: MissionState, name: str, at_ns: int) -> ev.Decided:
    decision = PassThrough(b.air_ground().crew).authorize(
        state.steps[name].call, state, b.world(), b.air_ground(), at_ns, Purpose.EXECUTE
    )
    return ev.Decided(at_ns=at_ns, decision=decision)


def test_every_step_is_sent_in_its_turn_whatever_became_of_the_one_before() -> None:
    state = _executing(ODD)
    assert (state.phase, state.contract) == (Phase.EXECUTING, AS_LISTED.name)
    sent = []
    for number, name in enumerate(state.steps, start=1):
        state, effects = _feed(state, _decided(state, name, 10 * number))
        sent += [effect.call for effect in effects if isinstance(effect, ev.Send)]
        assert [n for n, r in state.steps.items() if r.phase is StepPhase.SENT] == [name]
        failed = ev.Outcome(at_ns=10 * number + 5, sequence=number, result="failed", code="unknown_skill")
        state, effects = _feed(state, failed)
    assert sent == list(ODD.steps)
    assert state.phase is Phase.HALTING
    assert state.message.startswith("3 of 3 steps were not done")


def test_a_plan_whose_steps_all_succeed_is_completed() -> None:
    state = _executing(Plan("dispatch_only", (b.TO_BASE,)))
    state, _ = _feed(
        state,
        _decided(state, "step_1", 10),
        ev.Outcome(at_ns=11, sequence=1, result="succeeded"),
        ev.EffectSeen(at_ns=12, sequence=1),
    )
    assert state.phase is Phase.COMPLETED


def test_the_robots_word_alone_does_not_end_a_step() -> None:
    state = _executing(Plan("dispatch_only", (b.TO_BASE, b.STOP)))
    state, effects = _feed(state, _decided(state, "step_1", 10), ev.Outcome(at_ns=11, sequence=1, result="succeeded"))
    assert effects == (ev.WatchEffect(sequence=1),)
    assert state.steps["step_2"].phase is StepPhase.PENDING


def test_an_unreadable_plan_is_not_planned_again() -> None:
    refusal = Refusal(code=b.rejected(b.SEARCH, ODD, b.air_ground()).code, message="prose")
    state, effects = _feed(
        b.received("anything", b.air_ground()),
        ev.Started(at_ns=1),
        ev.PlannerFailed(at_ns=2, reason="prose", refusal=refusal),
    )
    assert state.phase is Phase.REJECTED
    assert effects == (ev.Finish(),)


def test_a_plan_without_steps_ends_at_once() -> None:
    verdict = accept_listed(Plan("carry", ()), b.air_ground())
    assert isinstance(verdict, Validation)
    assert _executing(Plan("carry", ())).phase is Phase.REJECTED


@pytest.mark.parametrize("event", [ev.StoppedAll(at_ns=20, by="a person"), ev.DeadlineHit(at_ns=20)])
def test_a_stop_and_the_deadline_end_an_unenforced_plan_too(event: ev.AnyEvent) -> None:
    state = _executing(ODD)
    state, effects = _feed(state, _decided(state, "step_1", 10), event)
    assert state.phase is Phase.HALTING
    assert any(isinstance(effect, ev.CancelRunning) for effect in effects)

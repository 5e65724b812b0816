"""The gate is a pure function: the same inputs, also after a journey through msgpack, give the same decision bytes."""

from collections.abc import Callable
from typing import Any, NamedTuple, TypeVar

import msgspec
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from msgspec.structs import replace

from crew.contracts.decision import Decision
from crew.contracts.gate.authorize import Gate
from crew.contracts.gate.guard import SECOND_NS
from crew.contracts.mission.validation import Validation, validate
from crew.contracts.mission_state import ACTIVE, MissionState, Phase, Purpose, StepPhase
from crew.contracts.plan import Call, Plan
from crew.contracts.site import Rules
from crew.contracts.snapshot import Point, Snapshot
from crew.packed import PackedRules, pack, unpack
from tests.unit.contracts import build as b

T = TypeVar("T")
RULES = b.air_ground()


class Inputs(NamedTuple):
    call: Call
    mission: MissionState
    world: Snapshot
    now_ns: int
    purpose: Purpose


def travelled(value: T) -> T:
    """The value as the journal gives it back."""
    return msgspec.msgpack.decode(msgspec.msgpack.encode(value), type=type(value))


def bytes_of(value: Decision | Validation) -> bytes:
    return msgspec.msgpack.encode(value, order="deterministic")


def decide(inputs: Inputs, rules: Rules, gate: Gate | None = None) -> Decision:
    call, mission, world, now_ns, purpose = inputs
    return (gate or Gate()).authorize(call, mission, world, rules, now_ns, purpose)


@pytest.fixture(scope="module")
def packed_rules(rules: Rules) -> Rules:
    return unpack(msgspec.msgpack.decode(msgspec.msgpack.encode(pack(rules)), type=PackedRules))


STEPS = st.dictionaries(
    st.sampled_from(("takeoff", "search", "report", "dispatch", "land")), st.sampled_from(StepPhase), max_size=5
)
CALLS = st.sampled_from((*b.FULL.steps, b.STOP, b.TO_BASE, b.with_args(b.TAKEOFF, altitude=float("nan"))))
AGES_NS = st.integers(-SECOND_NS, 3 * SECOND_NS)
COORDINATES = st.floats(-12.0, 12.0) | st.sampled_from((float("nan"), float("inf")))


MISSIONS = [b.executing(text, b.FULL, RULES) for text in (b.SEARCH_AND_SEND, f"{b.SEARCH_AND_SEND} twice", b.SEARCH)]


@st.composite
def inputs(draw: Callable[..., Any]) -> Inputs:
    """Any dispatch in any state of a mission."""
    mission = replace(draw(st.sampled_from(MISSIONS)), confirmed=draw(st.booleans()))
    for step, phase in draw(STEPS).items():
        mission = b.with_step(mission, step, phase, dispatched_ns=b.NOW_NS - draw(AGES_NS))
    iris = b.iris(airborne=draw(st.booleans()), at_ns=b.NOW_NS - draw(AGES_NS), stopped=draw(st.booleans()))
    tb3 = b.tb3(at_ns=b.NOW_NS - draw(AGES_NS), running=draw(st.sampled_from(("", "m1/2"))))
    position = draw(st.none() | st.builds(Point, COORDINATES, COORDINATES))
    fix = draw(st.none() | st.just(b.victim(position, stamp_ns=b.NOW_NS - draw(AGES_NS))))
    return Inputs(draw(CALLS), mission, b.world(iris, tb3, fix=fix), b.NOW_NS, draw(st.sampled_from(Purpose)))


@settings(max_examples=80, deadline=None)
@given(inputs())
def test_the_same_inputs_give_the_same_bytes_after_a_journey(packed_rules: Rules, given_inputs: Inputs) -> None:
    first = bytes_of(decide(given_inputs, RULES))
    assert bytes_of(decide(given_inputs, RULES)) == first
    call, mission, world, now_ns, purpose = given_inputs
    copy = Inputs(travelled(call), travelled(mission), travelled(world), now_ns, purpose)
    assert bytes_of(decide(copy, packed_rules)) == first


@settings(max_examples=80, deadline=None)
@given(inputs())
def test_what_is_allowed_is_the_next_step_of_a_free_robot_with_fresh_state(given_inputs: Inputs) -> None:
    """The gate once more, as a handful of necessary conditions that share nothing with it."""
    decision = decide(given_inputs, RULES)
    if not decision.allowed:
        return
    call, mission, world, now_ns, purpose = given_inputs
    robot = world.robots[call.robot]
    assert not robot.stopped
    assert not robot.running
    assert robot.lease == mission.id
    others = [r for name, r in mission.steps.items() if name != decision.step]
    assert all(r.phase not in ACTIVE or r.call.robot != call.robot for r in others)
    told = robot.fluents.values() if purpose is Purpose.EXECUTE else (robot.fluents["moving"],)
    assert all(now_ns - s.source_ns <= 5 * SECOND_NS for s in told)
    if purpose is Purpose.SAFE:
        assert call in (b.LAND, b.STOP)
        return
    record = mission.steps[decision.step]
    assert record.call == call
    assert record.phase in (StepPhase.PENDING, StepPhase.DECIDING, StepPhase.ASKING, StepPhase.REFUSED)
    if call == b.DISPATCH:
        place = decision.places["target"]
        assert -6.0 <= place.x <= 10.0
        assert -6.0 <= place.y <= 10.0
        assert world.values["victim"].reading.stamp_ns >= mission.steps["search"].dispatched_ns


def test_a_gate_with_a_memory_decides_like_one_without(rules: Rules) -> None:
    gate = Gate()
    missions = [b.executing(text, b.SEARCH_PLAN, rules) for text in (b.SEARCH, "search the north half") * 60]
    for mission in [*missions, *missions]:
        asked = Inputs(b.TAKEOFF, mission, b.world(), b.NOW_NS, Purpose.EXECUTE)
        assert decide(asked, rules, gate) == decide(asked, rules)


def test_inputs_are_left_as_they_were(rules: Rules) -> None:
    mission, world = b.before_dispatch(rules), b.world(fix=b.victim())
    before = msgspec.msgpack.encode((mission, world))
    assert b.judged(b.DISPATCH, mission, world, rules).allowed
    assert msgspec.msgpack.encode((mission, world)) == before


@pytest.mark.parametrize("text", [b.SEARCH_AND_SEND, "search the area twice", "search the north half"])
def test_a_validation_is_the_same_after_a_journey(text: str, rules: Rules, packed_rules: Rules) -> None:
    mission = b.received(text, rules, phase=Phase.VALIDATING)
    plan: Plan = travelled(b.FULL)
    first = validate(b.FULL, mission, b.world(), rules, b.NOW_NS, Gate())
    again = validate(plan, travelled(mission), travelled(b.world()), packed_rules, b.NOW_NS, Gate())
    assert bytes_of(again) == bytes_of(first)
    assert travelled(first) == first

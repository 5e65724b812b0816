"""Strangers on every key that an actor listens to: dropped, counted, and nobody dies of it."""

import math
from collections.abc import AsyncIterator, Mapping
from typing import Any

import msgspec
import pytest

from crew.bus.port import Body
from crew.contracts.plan import Call, Plan
from crew.contracts.snapshot import Point, ValueReading
from crew.messages import (
    Answer,
    CancelMission,
    ClockAck,
    ClockTick,
    Dispatch,
    Heartbeat,
    Intake,
    PlannerProposal,
    Reset,
    RobotCard,
    RobotEvent,
    RobotState,
    RobotValue,
)
from crew.wire import Message, encoding_of
from tests.integration.crew.harness import Up, Watch, intents, watching

LISTENED: Mapping[str, type[Message]] = {
    "tb3/state": RobotState,
    "tb3/card": RobotCard,
    "tb3/event": RobotEvent,
    "iris/value/victim": RobotValue,
    "planner/proposal": PlannerProposal,
    "gateway/intake": Intake,
    "mission/m1/confirm": Answer,
    "mission/m1/cancel": CancelMission,
    "orchestrator/heartbeat": Heartbeat,
    "clock": ClockTick,
    "clock/ack/tb3": ClockAck,
    "@reset": Reset,
    "tb3/@act/navigate_to": Dispatch,
    "tb3/@act/cancel": Dispatch,
    "sim/fault": RobotCard,
    "planner/ask": RobotCard,
}


@pytest.fixture
async def watch(up: Up) -> AsyncIterator[Watch]:
    """A session with the crew; after each test every process lives and the crew still drives."""
    pids = up.children()
    async with watching(up.running) as watch:
        await watch.until(lambda: {"iris", "tb3"} <= watch.states.keys(), why="states")
        yield watch
        assert up.children() == pids, "everybody lives"
        for _ in range(4):
            await watch.truth()
        await watch.drives()
    assert up.children() == pids


def strange(kind: type[Message]) -> dict[str, Body]:
    """What is no message of this kind, or of another version of it."""
    name, version = kind.schema, kind.version
    return {
        "nothing": (b"", ""),
        "text": (b"hello", "text/plain"),
        "foreign": (b"\x80", "application/msgpack;somebody.else/1"),
        "older": (b"\x80", f"application/msgpack;{name}/{version - 1}"),
        "newer": (b"\x80", f"application/msgpack;{name}/{version + 1}"),
        "no version": (b"\x80", f"application/msgpack;{name}/x"),
        "empty": (b"", encoding_of(kind)),
        "truncated": (b"\x85\xa5robot", encoding_of(kind)),
        "garbage": (b"\xc1" * 64, encoding_of(kind)),
        "wrong type": (msgspec.msgpack.encode([1, "2", None]), encoding_of(kind)),
        "fields missing": (b"\x80", encoding_of(kind)),
        "bad JSON": (b"{", f"application/json;{name}/{version}"),
        "oversized": (b"\x00" * ((1 << 20) + 1), encoding_of(kind)),
        "nested": (b"\x91" * 5000, encoding_of(kind)),
    }


@pytest.mark.parametrize("key", LISTENED)
async def test_strange_messages_are_dropped(watch: Watch, up: Up, key: str) -> None:
    sent = len(intents(up.run))
    before = (await watch.status()).dropped
    for body in strange(LISTENED[key]).values():
        watch.put(f"crew/{watch.keys.crew}/{key}", body)
    if key in ("tb3/event", "iris/value/victim", "planner/proposal", "gateway/intake", "mission/m1/confirm"):
        await counted(watch, before, ("unknown_schema", "newer_version", "malformed", "wrong_type"))
    elif "@act" in key or key == "@reset":
        await counted(watch, before, ("by_tb3",))
    assert len(intents(up.run)) == sent


async def counted(watch: Watch, before: Mapping[str, int], names: tuple[str, ...]) -> None:
    """Wait until the status has counted more of each."""
    for _ in range(100):
        now = (await watch.status()).dropped
        if all(now.get(name, 0) > before.get(name, 0) for name in names):
            return
    raise AssertionError(f"not counted: {names}; {before} {now}")


# --- well-formed lies


def state(watch: Watch, **changes: Any) -> RobotState:
    """What the rover said last, changed."""
    return msgspec.structs.replace(watch.states["tb3"], **changes)


SECOND = 1_000_000_000
LIES: dict[str, Any] = {
    "a place that is no number": lambda s: {"fluents": {**s.fluents, "at": Point(math.nan, math.inf)}},
    "a battery beyond all": lambda s: {"fluents": {**s.fluents, "battery": math.inf}},
    "a fluent of another type": lambda s: {"fluents": {**s.fluents, "moving": "perhaps"}},
    "no fluents": lambda s: {"fluents": {}, "stamps_ns": {}},
    "ancient stamps": lambda s: {"stamps_ns": dict.fromkeys(s.fluents, -(2**63))},
    "stamps of the future": lambda s: {"stamps_ns": dict.fromkeys(s.fluents, 2**62)},
    "a state of the far future": lambda s: {"at_ns": 2**62},
    "a state before all time": lambda s: {"at_ns": -(2**63)},
    "another boot": lambda s: {"boot_id": "ghost"},
    "another robot's name": lambda s: {"robot": "iris"},
    "nobody's name": lambda s: {"robot": "ghost/@act"},
}


@pytest.mark.parametrize("lie", LIES)
async def test_an_absurd_state_harms_nobody_and_the_next_true_one_counts(watch: Watch, lie: str) -> None:
    for _ in range(20):
        watch.put(watch.keys.robot_state("tb3"), state(watch, **LIES[lie](watch.states["tb3"])))
    assert (await watch.status()).epoch


async def test_state_of_the_future_or_the_past_refuses_a_dispatch(watch: Watch) -> None:
    """The liar drowns out the robot: what is believed of it is stale, and so it is not sent anywhere."""
    for stamp_ns in (2**62, 0):
        request = watch.ask("send the rover to (-3, -2)")

        def lie(stamp_ns: int = stamp_ns, request: str = request) -> bool:
            true = watch.states["tb3"]
            at_ns = max(true.at_ns, 0) + 40_000_000
            for _ in range(10):
                watch.put(
                    watch.keys.robot_state("tb3"),
                    state(watch, at_ns=at_ns, stamps_ns=dict.fromkeys(true.fluents, stamp_ns)),
                )
            return any(e.final for e in watch.of(request))

        await watch.until(lie, why="it ends")
        last = watch.of(request)[-1]
        assert (last.outcome, last.code) in (("rejected", "state_stale"), ("completed", None))


async def test_a_robots_word_under_another_ones_name_is_not_heard(watch: Watch) -> None:
    before = (await watch.status()).dropped
    watch.put(watch.keys.robot_state("iris"), state(watch, unavailable="kidnapped"))
    watch.put(watch.keys.robot_event("iris"), RobotEvent(robot="tb3", boot_id="x", at_ns=1, what="dropped"))
    await counted(watch, before, ("foreign",))
    assert {r.robot: r.unavailable for r in (await watch.status()).robots}["tb3"] == ""


async def test_a_value_from_a_robot_that_cannot_see_is_not_believed(watch: Watch, up: Up) -> None:
    reading = ValueReading(name="victim", status="ok", position=Point(9.0, 9.0), stamp_ns=watch.states["tb3"].at_ns)
    value = RobotValue(robot="tb3", boot_id=watch.states["tb3"].boot_id, reading=reading)
    watch.put(watch.keys.robot_value("tb3", "victim"), value)
    ended = await watch.mission("send the rover to the victim")
    assert (ended.outcome, ended.code) == ("rejected", "no_target_fix")


async def test_faults_and_acks_that_do_not_exist_do_not_hold_the_simulation(watch: Watch) -> None:
    for name, number in (("ghost", 0), ("ghost", 2**62), ("tb3", 2**62), ("tb3", -5), ("iris", -(2**62))):
        key = watch.keys.clock_ack("tb3" if name == "ghost" else name)
        watch.put(key, ClockAck(name=name, slice=number))
    now_ns = (await watch.truth()).at_ns
    await watch.until(lambda: watch.truths[-1].at_ns > now_ns + SECOND, 10.0, "time goes on")


# --- planners


async def test_proposals_that_nobody_asked_for_are_ignored(watch: Watch, up: Up) -> None:
    plan = Plan("dispatch_only", (Call("tb3", "navigate_to", {"x": 9.0, "y": 9.0}),))
    for mission in ("m00000000", "", "../x"):
        rogue = PlannerProposal(mission=mission, attempt=0, planner="rogue", plan=plan)
        watch.put(watch.keys.planner_proposal, rogue)
    await watch.status()
    assert intents(up.run).count("tb3.navigate_to") == len(intents(up.run))


async def test_a_rogue_plan_for_a_running_request_moves_nothing_that_was_not_asked_for(watch: Watch, up: Up) -> None:
    """It races the planner; either the true plan won, or the request's own words refuse the rogue."""
    request = watch.ask("send the rover to (-3, -2)")
    await watch.until(lambda: bool(watch.of(request)), why="it began")
    mission = watch.mission_of(request)
    plan = Plan("dispatch_only", (Call("tb3", "navigate_to", {"x": 9.0, "y": 9.0}),))
    for attempt in (0, 1):
        watch.put(
            watch.keys.planner_proposal, PlannerProposal(mission=mission, attempt=attempt, planner="rogue", plan=plan)
        )
    ended = await watch.ended(request)
    assert ended.outcome in ("completed", "rejected")
    x, y, *_ = await watch.standing("tb3")
    assert math.dist((x, y), (9.0, 9.0)) > 5.0

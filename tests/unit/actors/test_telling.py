"""What people and planners are told by the orchestrator: numbered JSON events, one question, bounded waits."""

import asyncio
import math
from collections.abc import AsyncIterator, Coroutine
from typing import Any

import msgspec
import pytest

from crew.actors.gateway.request import MAX_BYTES, RequestBody, Unreadable, read_body
from crew.actors.orchestrator import planning
from crew.actors.orchestrator.announcer import Announcer, describe_value
from crew.actors.orchestrator.lease import LeaseTable
from crew.actors.orchestrator.planning import PlannerDesk
from crew.actors.orchestrator.world import WorldFold
from crew.bus.fabric import MemoryFabric
from crew.bus.memory import MemoryBus
from crew.bus.port import Qos, Sample
from crew.clock import SimClock, seconds_ns
from crew.contracts.codes import Code
from crew.contracts.language.mention import Reading
from crew.contracts.mission import event as ev
from crew.contracts.mission_state import MissionState, Phase
from crew.contracts.plan import Call, Plan
from crew.contracts.refusal import Refusal
from crew.contracts.snapshot import Point, ValueReading
from crew.keys import Keys
from crew.mailbox import Events, Letter, letters, raw
from crew.messages import MissionEvent, PlannerAsk, PlannerProposal
from tests.unit.actors.stage import air_ground

KEYS = Keys("air_ground")
PLAN = Plan("dispatch_only", (Call("tb3", "navigate_to", {"x": -3.0, "y": -3.0}),))


def mission(phase: Phase = Phase.PLANNING, **more: Any) -> MissionState:
    text = "send the rover to (-3, -3)"
    return MissionState(id="m1", request=text, request_id="r1", reading=Reading(text=text), phase=phase, **more)


class Hall:
    """An orchestrator's voice and the people and planners who listen."""

    def __init__(self, bus: MemoryBus, other: MemoryBus, fabric: MemoryFabric) -> None:
        self.fabric, self.other, self.clock = fabric, other, SimClock(seconds_ns(5.0))
        self.fed: list[ev.AnyEvent] = []
        self.notes: list[tuple[str, str]] = []
        self.tasks: list[asyncio.Task[None]] = []
        rules = air_ground()
        self.announcer = Announcer(bus, KEYS, rules, self.clock)
        self.heard: Events[Sample] = Events(raw, capacity=64, on_lost=lambda _: None)
        other.subscribe(KEYS.mission_events, self.heard)
        self.asks: Events[Letter[PlannerAsk]] = Events(letters(PlannerAsk), capacity=64, on_lost=lambda _: None)
        other.subscribe(KEYS.planner_ask, self.asks)
        self.desk = PlannerDesk(
            bus,
            KEYS,
            self.clock,
            rules,
            WorldFold(rules),
            LeaseTable(),
            lambda _, event: self.fed.append(event),
            self.spawn,
            lambda what, text: self.notes.append((what, text)),
        )
        self.spawn("", self.desk.run())

    def spawn(self, mission: str, work: Coroutine[Any, Any, None]) -> None:
        self.tasks.append(asyncio.create_task(work))

    async def settle(self) -> None:
        for _ in range(3):
            assert await asyncio.to_thread(self.fabric.settled)
            for _ in range(10):
                await asyncio.sleep(0)

    async def events(self) -> list[MissionEvent]:
        """What any client can read: plain JSON."""
        await self.settle()
        samples = self.heard.take()
        assert all(sample.encoding.startswith("application/json") for sample in samples)
        return [msgspec.json.decode(sample.payload, type=MissionEvent) for sample in samples]

    async def propose(self, **changes: Any) -> None:
        sound: dict[str, Any] = {"mission": "m1", "attempt": 0, "planner": "test", "plan": PLAN}
        self.other.put(KEYS.planner_proposal, PlannerProposal(**{**sound, **changes}), qos=Qos.EVENT)
        await self.settle()


@pytest.fixture
async def hall() -> AsyncIterator[Hall]:
    with MemoryFabric() as fabric:
        async with MemoryBus(fabric) as bus, MemoryBus(fabric) as other:
            hall = Hall(bus, other, fabric)
            yield hall
            for task in hall.tasks:
                task.cancel()
            await asyncio.gather(*hall.tasks, return_exceptions=True)


# --- announcing


async def test_events_are_numbered_json_with_the_requests_id(hall: Hall) -> None:
    received, planning_ = mission(Phase.RECEIVED), mission()
    hall.announcer.after(received, planning_, ev.Started(at_ns=hall.clock.now_ns()))
    hall.clock.advance(seconds_ns(7.5))
    hall.announcer.after(planning_, mission(Phase.VALIDATING), ev.Proposed(at_ns=1, plan=PLAN, planner="embedded"))
    first, second = await hall.events()
    assert [e.number for e in (first, second)] == [1, 2]
    assert {e.request_id for e in (first, second)} == {"r1"}
    assert (first.at_s, second.at_s) == (0.0, 2.5)
    assert "send the rover" in first.text
    assert second.text == "embedded proposes dispatch_only with 1 steps"


async def test_the_last_event_says_how_it_ended_and_why(hall: Hall) -> None:
    refusal = Refusal(code=Code.OUT_OF_BOUNDS, message="too far")
    ended = mission(Phase.REJECTED, refusal=refusal, message="too far", plan=PLAN)
    hall.announcer.after(mission(), ended, ev.PlannerFailed(at_ns=1, reason="too far"))
    *_, last = await hall.events()
    assert last.final
    assert (last.outcome, last.code, last.phase) == ("rejected", "out_of_bounds", "rejected")
    assert "too far" in last.text
    assert last.steps is not None
    assert [s.skill for s in last.steps] == ["navigate_to"]


async def test_a_cancelled_mission_carries_no_refusals_code(hall: Hall) -> None:
    refusal = Refusal(code=Code.OUT_OF_BOUNDS, message="too far")
    ended = mission(Phase.CANCELLED, refusal=refusal, message="cancelled by a person")
    hall.announcer.after(mission(), ended, ev.CancelAsked(at_ns=1, by="a person"))
    assert (await hall.events())[-1].code is None


@pytest.mark.parametrize("x", [math.nan, math.inf, 3.0])
async def test_values_that_are_no_places_are_told_in_valid_json(hall: Hall, x: float) -> None:
    reading = ValueReading(name="victim", status="ok", position=Point(x, 1.0), sigma_m=math.nan, stamp_ns=1)
    hall.announcer.value(mission(), reading, "iris")
    (event,) = await hall.events()
    assert ("not a place" in event.text) != math.isfinite(x)


async def test_a_request_of_any_length_is_told_in_a_line(hall: Hall) -> None:
    long = msgspec.structs.replace(mission(), request="x" * 10_000)
    hall.announcer.after(mission(Phase.RECEIVED), long, ev.Started(at_ns=1))
    (event,) = await hall.events()
    assert len(event.text) < 300
    assert "10000 characters" in event.text


def test_a_value_without_a_position_says_why() -> None:
    reading = ValueReading(name="victim", status="absent", stamp_ns=1)
    assert describe_value(reading, "iris") == "iris reports victim: absent"


# --- planning


async def test_a_question_to_the_planner_holds_simulated_time(hall: Hall) -> None:
    hall.desk.ask(mission(), ev.AskPlanner())
    await hall.settle()
    (letter,) = hall.asks.take()
    assert (letter.message.mission, letter.message.attempt) == ("m1", 0)
    assert hall.clock.is_busy
    await hall.propose()
    assert not hall.clock.is_busy
    (event,) = hall.fed
    assert isinstance(event, ev.Proposed)
    assert event.plan == PLAN


@pytest.mark.parametrize("changes", [{"mission": "m2"}, {"attempt": 1}, {"attempt": -1}])
async def test_a_proposal_that_was_not_asked_for_is_ignored(hall: Hall, changes: dict[str, Any]) -> None:
    hall.desk.ask(mission(), ev.AskPlanner())
    await hall.settle()
    await hall.propose(**changes)
    assert hall.fed == []


async def test_only_the_first_answer_counts(hall: Hall) -> None:
    hall.desk.ask(mission(), ev.AskPlanner())
    await hall.settle()
    await hall.propose()
    await hall.propose(plan=Plan("abort"))
    assert len(hall.fed) == 1


async def test_a_planner_that_never_answers_ends_the_wait(hall: Hall, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(planning, "BUDGET_S", 0.05)
    hall.desk.ask(mission(), ev.AskPlanner())
    await asyncio.wait(hall.tasks[1:])
    (event,) = hall.fed
    assert isinstance(event, ev.PlannerFailed)
    assert "no proposal within" in event.reason
    assert event.refusal is None, "another try would wait as long again"
    assert not hall.clock.is_busy


async def test_a_planner_that_is_gone_is_not_waited_for(hall: Hall) -> None:
    hall.desk.ask(mission(), ev.AskPlanner())
    await hall.settle()
    assert hall.fed == []
    hall.desk.planner_is_there(False)
    await hall.settle()
    hall.desk.ask(mission(), ev.AskPlanner())
    await hall.settle()
    assert [type(event) for event in hall.fed] == [ev.PlannerFailed, ev.PlannerFailed]
    hall.desk.planner_is_there(True)
    hall.desk.ask(mission(), ev.AskPlanner())
    await hall.propose()
    assert isinstance(hall.fed[-1], ev.Proposed)
    assert not hall.clock.is_busy


async def test_garbage_from_the_planner_is_not_an_answer(hall: Hall) -> None:
    hall.desk.ask(mission(), ev.AskPlanner())
    await hall.settle()
    for body in ((b"", ""), (b"\xc1", "application/msgpack;crew.planner_proposal/1"), (b"{}", "application/json")):
        hall.other.put(KEYS.planner_proposal, body, qos=Qos.EVENT)
    await hall.settle()
    assert hall.fed == []
    assert hall.desk.box.refusals.total() == 3
    await hall.propose()
    assert len(hall.fed) == 1


async def test_an_unreadable_answer_spends_the_replan_and_an_abstention_does_not(hall: Hall) -> None:
    for attempt, unreadable in ((0, True), (1, False)):
        hall.desk.ask(mission(replans=attempt), ev.AskPlanner())
        await hall.settle()
        await hall.propose(attempt=attempt, plan=None, reason="no idea", unreadable=unreadable)
        event = hall.fed[-1]
        assert isinstance(event, ev.PlannerFailed)
        assert (event.refusal is not None) == unreadable


# --- reading requests


@pytest.mark.parametrize(
    ("payload", "encoding"),
    [
        (b"go", "text/plain"),
        (b"go", ""),
        (b'{"text": "go"}', "application/json"),
        (b'{"text": "go", "more": 1}', "Application/JSON; charset=utf-8"),
        (msgspec.msgpack.encode({"text": "go"}), "application/msgpack"),
    ],
)
def test_a_request_is_read_by_its_encoding(payload: bytes, encoding: str) -> None:
    assert read_body(payload, encoding) == RequestBody("go")


def test_a_request_has_a_size_up_to_which_it_is_read() -> None:
    assert isinstance(read_body(b"x" * MAX_BYTES, "text/plain"), RequestBody)
    too_long = read_body(b"x" * (MAX_BYTES + 1), "text/plain")
    assert isinstance(too_long, Unreadable)
    assert str(MAX_BYTES) in too_long.reason


def test_an_endless_request_id_is_cut() -> None:
    body = read_body(msgspec.json.encode({"text": "go", "request_id": "r" * 9999}), "application/json")
    assert isinstance(body, RequestBody)
    assert len(body.request_id) == 200

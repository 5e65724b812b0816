"""A dispatch's life at the orchestrator: the intent is on disk first, and whatever a robot says, it ends once."""

import asyncio
from collections.abc import AsyncIterator, Coroutine
from typing import Any

import pytest

from crew.actors.orchestrator import flight as flight_module
from crew.actors.orchestrator.flight import Dispatcher
from crew.actors.orchestrator.lease import LeaseTable
from crew.actors.orchestrator.world import WorldFold
from crew.bus.fabric import MemoryFabric
from crew.bus.memory import MemoryBus
from crew.clock import SimClock, seconds_ns
from crew.contracts.language.mention import Reading
from crew.contracts.mission import event as ev
from crew.contracts.mission_state import MissionState, Phase, StepPhase, StepRecord
from crew.contracts.plan import Call, Instance, InstanceStep, Plan, digest
from crew.errors import JournalError
from crew.keys import Keys
from crew.mailbox import Events, Letter, letters
from crew.messages import CancelSkill, Dispatch, RobotCard, RobotEvent
from crew.permit import permit_problem
from crew.signing import SigningKey
from crew.wire import Message
from tests.unit.actors.stage import air_ground

KEYS = Keys("air_ground")
CALL = Call("tb3", "navigate_to", {"x": -3.0, "y": -3.0})


class FakeTicket:
    """A record whose commit the test decides about."""

    def __init__(self) -> None:
        self.done: asyncio.Future[None] = asyncio.get_running_loop().create_future()

    async def committed(self) -> None:
        await self.done


class FakeLedger:
    """Hands out tickets and remembers the intents."""

    def __init__(self) -> None:
        self.intents: list[Dispatch] = []
        self.tickets: list[FakeTicket] = []

    def intent(self, dispatch: Dispatch) -> FakeTicket:
        self.intents.append(dispatch)
        self.tickets.append(FakeTicket())
        return self.tickets[-1]


class Desk:
    """A dispatcher between a journal, a robot's key and a mission."""

    def __init__(self, robot_bus: MemoryBus, bus: MemoryBus, fabric: MemoryFabric) -> None:
        self.fabric, self.clock, self.ledger = fabric, SimClock(seconds_ns(10.0)), FakeLedger()
        self.fed: list[ev.AnyEvent] = []
        self.tasks: set[asyncio.Task[None]] = set()
        self.put: Events[Letter[Message]] = Events(letters(Dispatch, CancelSkill), capacity=16, on_lost=lambda _: None)
        robot_bus.subscribe(KEYS.acts("tb3"), self.put)
        rules = air_ground()
        world = WorldFold(rules)
        world.take_card(
            RobotCard(robot="tb3", kind="rover", kind_digest="d", boot_id="b1", adapter="mavlink", simulated=True)
        )
        ledger: Any = self.ledger
        self.key, self.leases = SigningKey(b"k" * 32), LeaseTable()
        self.dispatcher = Dispatcher(
            bus,
            KEYS,
            self.clock,
            ledger,
            world,
            self.leases,
            rules,
            3,
            self.key,
            lambda _, event: self.fed.append(event),
            self._spawn,
        )

    def _spawn(self, mission: str, work: Coroutine[Any, Any, None]) -> None:
        self.tasks.add(asyncio.create_task(work))

    def send(self) -> None:
        self.dispatcher.send(mission(), ev.Send(sequence=1, call=CALL, step="dispatch"))

    async def settle(self) -> list[Message]:
        """Let everything arrive; what was put on the robot's keys meanwhile."""
        for _ in range(3):
            assert await asyncio.to_thread(self.fabric.settled)
            for _ in range(10):
                await asyncio.sleep(0)
        return [letter.message for letter in self.put.take()]

    async def sent(self) -> Dispatch:
        """A dispatch whose intent is committed and which was put."""
        self.send()
        self.ledger.tickets[-1].done.set_result(None)
        (dispatch,) = await self.settle()
        assert isinstance(dispatch, Dispatch)
        return dispatch

    def says(self, what: str, *, robot: str = "tb3", boot_id: str = "b1", sequence: int = 1, code: str = "") -> None:
        self.dispatcher.hear(
            RobotEvent(robot=robot, boot_id=boot_id, at_ns=1, what=what, mission="m1", sequence=sequence, code=code)
        )

    @property
    def outcomes(self) -> list[tuple[str, str]]:
        return [(e.result, e.code) for e in self.fed if isinstance(e, ev.Outcome)]


def mission() -> MissionState:
    """A mission whose one step was just authorised."""
    step = InstanceStep(step="dispatch", role="responder", call=CALL, after=())
    record = StepRecord(call=CALL, phase=StepPhase.SENT, sequence=1, dispatched_ns=seconds_ns(10.0))
    return MissionState(
        id="m1",
        request="send the rover to (-3, -3)",
        reading=Reading(text="send the rover to (-3, -3)"),
        phase=Phase.EXECUTING,
        plan=Plan("dispatch_only", (CALL,)),
        instance=Instance(contract="dispatch_only", roles={"responder": "tb3"}, slots={}, steps=(step,)),
        contract="dispatch_only",
        steps={"dispatch": record},
        sequence=1,
    )


@pytest.fixture
async def desk() -> AsyncIterator[Desk]:
    with MemoryFabric() as fabric:
        async with MemoryBus(fabric) as robot_bus, MemoryBus(fabric) as bus:
            desk = Desk(robot_bus, bus, fabric)
            yield desk
            for task in desk.tasks:
                task.cancel()
            await asyncio.gather(*desk.tasks, return_exceptions=True)


async def test_nothing_is_put_before_its_intent_is_committed(desk: Desk) -> None:
    desk.send()
    assert [i.sequence for i in desk.ledger.intents] == [1]
    assert await desk.settle() == []
    assert desk.clock.is_busy, "simulated time waits for the disk"
    desk.ledger.tickets[0].done.set_result(None)
    (dispatch,) = await desk.settle()
    assert dispatch == desk.ledger.intents[0], "what was written is what is sent"


async def test_a_dispatch_carries_all_that_a_robot_checks(desk: Desk) -> None:
    dispatch = await desk.sent()
    assert (dispatch.robot, dispatch.skill, dispatch.args) == ("tb3", "navigate_to", CALL.args)
    assert (dispatch.boot_id, dispatch.epoch, dispatch.lease, dispatch.mission) == ("b1", 3, "m1", "m1")
    assert dispatch.args_digest == digest(dict(CALL.args))
    assert dispatch.expires_ns - dispatch.issued_ns == seconds_ns(flight_module.EXPIRES_S)
    assert dispatch.contract_digest
    assert dispatch.plan_digest


async def test_an_intent_that_cannot_be_committed_is_never_sent(desk: Desk) -> None:
    desk.send()
    desk.ledger.tickets[0].done.set_exception(JournalError("disk full"))
    assert await desk.settle() == []
    assert desk.outcomes == [("failed", "journal_failed")]
    assert not desk.clock.is_busy


async def test_a_dispatch_that_was_cancelled_before_its_commit_is_never_sent(desk: Desk) -> None:
    desk.send()
    desk.dispatcher.cancel(mission(), ev.CancelRunning(robot="tb3", sequence=1))
    desk.ledger.tickets[0].done.set_result(None)
    assert not any(isinstance(m, Dispatch) for m in await desk.settle())
    assert desk.outcomes == [("cancelled", "cancelled")]


async def test_silence_after_a_dispatch_is_an_unknown_outcome(desk: Desk, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(flight_module, "ANSWER_S", 0.05)
    await desk.sent()
    await asyncio.wait(desk.tasks)
    assert desk.outcomes == [("unknown", "no_answer")]
    desk.says("succeeded")
    assert desk.outcomes == [("unknown", "no_answer")], "a late word does not change it"


async def test_a_robots_word_is_passed_on_and_its_outcome_once(desk: Desk) -> None:
    await desk.sent()
    desk.says("accepted")
    desk.says("succeeded")
    desk.says("succeeded")
    desk.says("failed")
    assert [type(e).__name__ for e in desk.fed] == ["Accepted", "Outcome"]
    assert desk.outcomes == [("succeeded", "")]


async def test_a_refusal_by_the_robot_ends_the_dispatch_with_its_code(desk: Desk) -> None:
    await desk.sent()
    desk.says("refused", code="robot_busy")
    assert desk.outcomes == [("refused", "robot_busy")]


@pytest.mark.parametrize("changes", [{"robot": "iris"}, {"boot_id": "b0"}, {"sequence": 2}])
async def test_another_robots_or_another_boots_word_is_ignored(desk: Desk, changes: dict[str, Any]) -> None:
    await desk.sent()
    desk.says("succeeded", **changes)
    assert desk.fed == []


async def test_a_lost_robots_dispatch_has_an_unknown_outcome(desk: Desk) -> None:
    await desk.sent()
    desk.says("accepted")
    desk.dispatcher.lose("iris", "not this one")
    assert desk.outcomes == []
    desk.dispatcher.lose("tb3", "its token is gone")
    desk.dispatcher.lose("tb3", "its token is gone")
    assert desk.outcomes == [("unknown", "robot_lost")]


async def test_an_outcome_that_never_comes_is_unknown_after_the_skills_own_time(desk: Desk) -> None:
    await desk.sent()
    desk.says("accepted")
    await desk.settle()
    desk.clock.advance(seconds_ns(10.0 + 180.0 + flight_module.GRACE_S - 0.1))
    await desk.settle()
    assert desk.outcomes == []
    desk.clock.advance(seconds_ns(10.0 + 180.0 + flight_module.GRACE_S + 0.1))
    await desk.settle()
    assert desk.outcomes == [("unknown", "timeout")]


async def test_a_cancel_is_put_and_waits_for_the_robots_word(desk: Desk) -> None:
    await desk.sent()
    desk.says("accepted")
    desk.dispatcher.cancel(mission(), ev.CancelRunning(robot="tb3", sequence=1))
    (message,) = await desk.settle()
    assert isinstance(message, CancelSkill)
    assert (message.mission, message.sequence, message.robot, message.boot_id) == ("m1", 1, "tb3", "b1")
    assert desk.outcomes == []
    desk.says("cancelled", code="cancelled")
    assert desk.outcomes == [("cancelled", "cancelled")]


async def test_a_cancel_without_an_answer_ends_as_unknown(desk: Desk) -> None:
    await desk.sent()
    desk.says("accepted")
    desk.dispatcher.cancel(mission(), ev.CancelRunning(robot="tb3", sequence=1))
    await desk.settle()
    desk.clock.advance(seconds_ns(10.0 + flight_module.CANCEL_S + 0.1))
    await desk.settle()
    assert desk.outcomes == [("unknown", "timeout")]


async def test_an_ended_missions_flights_are_forgotten(desk: Desk) -> None:
    await desk.sent()
    desk.dispatcher.forget("m1")
    desk.says("succeeded")
    assert desk.fed == []


async def test_what_a_robot_carries_out_for_a_mission_that_is_over_is_cancelled_with_a_permit(desk: Desk) -> None:
    desk.dispatcher.end_orphan("tb3", "m7/4")
    (cancel,) = await desk.settle()
    assert isinstance(cancel, CancelSkill)
    assert (cancel.mission, cancel.sequence, cancel.robot, cancel.boot_id, cancel.epoch) == ("m7", 4, "tb3", "b1", 3)
    assert permit_problem(cancel, KEYS.crew, desk.key.public) is None
    assert desk.fed == [], "nobody waits for it"


@pytest.mark.parametrize("words", ["", "m7", "m7/", "m7/x", "m7/-1"])
async def test_a_robots_words_that_name_no_dispatch_cancel_nothing(desk: Desk, words: str) -> None:
    desk.dispatcher.end_orphan("tb3", words)
    assert await desk.settle() == []

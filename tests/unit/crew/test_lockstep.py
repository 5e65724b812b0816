"""The simulation waits for whoever works, never for whoever has not begun, and no longer than a second for the dead."""

import asyncio
import time
from collections.abc import AsyncIterator, Awaitable, Callable
from contextlib import AsyncExitStack, asynccontextmanager

import pytest

from crew import lockstep as lockstep_module
from crew.bus.fabric import MemoryFabric
from crew.bus.memory import MemoryBus
from crew.bus.port import Bus, Qos
from crew.clock import WALL, SimClock
from crew.contracts.gate.guard import FUTURE_NS
from crew.keys import Keys
from crew.lockstep import COUNT_AFTER, Participant
from crew.mailbox import Events, Letter, letters
from crew.messages import ClockAck, ClockTick
from crew.sim import pace as pace_module
from crew.sim.pace import Lockstep
from crew.sim.process import AHEAD_PACED, SLICE_NS

KEYS = Keys("lab")


class Stage:
    """A simulation's side and a participant's side, on one fabric."""

    def __init__(self, fabric: MemoryFabric, sim: Bus, robot: Bus) -> None:
        self._fabric, self.sim, self.robot = fabric, sim, robot
        acks: Events[Letter[ClockAck]] = Events(letters(ClockAck), capacity=64, on_lost=lambda _: None)
        sim.subscribe(KEYS.clock_acks, acks)
        self.lockstep = Lockstep(acks)
        self.clock = SimClock()
        self.heard: Events[Letter[ClockAck]] = Events(letters(ClockAck), capacity=64, on_lost=lambda _: None)
        sim.subscribe(KEYS.clock_acks, self.heard)

    def tick(self, number: int, datagrams: int = 0, *, paced: bool = False) -> None:
        sent = {"iris": datagrams}
        tick = ClockTick(slice=number, now_ns=number * SLICE_NS, datagrams=sent, paced=paced)
        self.sim.put(KEYS.clock, tick, qos=Qos.EVENT)

    async def ack(self, number: int, name: str = "iris", *, holding: bool = False, idle: bool = True) -> None:
        """Say so, and return when the simulation's side has it."""
        message = ClockAck(name=name, slice=number, holding=holding, idle=idle)
        self.robot.put(KEYS.clock_ack(name), message, qos=Qos.EVENT)
        assert await asyncio.to_thread(self._fabric.settled)

    async def next_ack(self) -> ClockAck:
        async with asyncio.timeout(5.0):
            return (await anext(self.heard)).message


@pytest.fixture
async def stage() -> AsyncIterator[Stage]:
    with MemoryFabric() as fabric:
        async with AsyncExitStack() as stack:
            buses = [await stack.enter_async_context(MemoryBus(fabric)) for _ in range(2)]
            yield Stage(fabric, *buses)


async def within(work: Awaitable[object], seconds: float = 5.0) -> bool:
    return await WALL.race(work, seconds)


async def ends(task: "asyncio.Future[None]") -> None:
    task.cancel()
    await asyncio.gather(task, return_exceptions=True)


@asynccontextmanager
async def following(stage: Stage, received: Callable[[], int] = lambda: 0, sent: int = 0) -> AsyncIterator[Participant]:
    """A participant that has joined, with so many datagrams on its link."""
    follower = Participant(stage.robot, KEYS, "iris", stage.clock, counts=lambda: (sent, received()))
    task = asyncio.ensure_future(follower.run())
    try:
        assert (await stage.next_ack()).slice == -1
        yield follower
    finally:
        await ends(task)


async def done_with_a_slice(stage: Stage) -> ClockAck:
    """The next word of a participant that is no sign of life."""
    while (done := await stage.next_ack()).holding:
        pass
    return done


async def test_nobody_is_waited_for_before_anybody_joined(stage: Stage) -> None:
    assert await within(stage.lockstep.wait(1, for_holders=True), 0.5)


async def test_mission_time_does_not_begin_before_every_robot_takes_part(stage: Stage) -> None:
    gathering = asyncio.ensure_future(stage.lockstep.gather({"iris", "tb3"}, 60.0))
    await stage.ack(-1)
    assert not await within(asyncio.shield(gathering), 0.05)
    await stage.ack(-1, "tb3")
    assert await within(gathering)
    waiting = asyncio.ensure_future(stage.lockstep.wait(1, for_holders=True))
    assert not await within(asyncio.shield(waiting), 0.05), "both take part from the first slice on"
    await stage.ack(1)
    await stage.ack(1, "tb3")
    assert await within(waiting)


async def test_a_robot_that_does_not_come_holds_the_beginning_up_for_a_while_only(stage: Stage) -> None:
    await stage.ack(-1)
    assert await within(stage.lockstep.gather({"iris", "tb3"}, 0.01))
    assert set(stage.lockstep.members) == {"iris"}


async def test_a_participant_that_joins_after_a_tick_went_out_does_not_hold_that_slice(stage: Stage) -> None:
    follower = Participant(stage.robot, KEYS, "iris", stage.clock)
    task = asyncio.ensure_future(follower.run())
    await stage.next_ack()
    assert await within(stage.lockstep.wait(4, for_holders=True)), "the tick of slice 4 was sent before it listened"
    waiting = asyncio.ensure_future(stage.lockstep.wait(5, for_holders=True))
    assert not await within(asyncio.shield(waiting), 0.1), "from the next slice on it takes part"
    stage.tick(5)
    assert await within(waiting)
    assert stage.clock.now_ns() == 5 * SLICE_NS
    await ends(task)


async def test_a_participant_that_starts_anew_rejoins(stage: Stage) -> None:
    await stage.ack(7)
    assert await within(stage.lockstep.wait(7, for_holders=True))
    await stage.ack(-1)
    assert await within(stage.lockstep.wait(8, for_holders=True), 0.9), "its new life never heard slice 8"


async def test_a_silent_participant_drops_out_and_comes_back_with_its_next_word(
    stage: Stage, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(pace_module, "SILENT_S", 0.2)
    await stage.ack(1)
    assert await within(stage.lockstep.wait(1, for_holders=True))
    assert await within(stage.lockstep.wait(2, for_holders=True))
    assert stage.lockstep.dropped == 1
    assert not stage.lockstep.members
    await stage.ack(2)
    assert await within(stage.lockstep.wait(2, for_holders=True))
    waiting = asyncio.ensure_future(stage.lockstep.wait(3, for_holders=True))
    assert not await within(asyncio.shield(waiting), 0.05)
    await stage.ack(3)
    assert await within(waiting)


async def test_what_was_before_the_tick_is_nobodys_silence(stage: Stage, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(pace_module, "SILENT_S", 0.4)
    await stage.ack(1)
    assert await within(stage.lockstep.wait(1, for_holders=True))
    await asyncio.sleep(0.5)  # the simulation itself is held up
    waiting = asyncio.ensure_future(stage.lockstep.wait(2, for_holders=True))
    assert not await within(asyncio.shield(waiting), 0.05)
    await stage.ack(2)
    assert await within(waiting)
    assert stage.lockstep.dropped == 0


async def test_a_pause_of_the_whole_machine_is_nobodys_silence(stage: Stage, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(pace_module, "SILENT_S", 0.4)
    await stage.ack(1)
    assert await within(stage.lockstep.wait(1, for_holders=True))
    waiting = asyncio.ensure_future(stage.lockstep.wait(2, for_holders=True))
    await asyncio.sleep(0.02)
    time.sleep(0.5)  # noqa: ASYNC251  (nobody runs)
    await asyncio.sleep(0.02)
    await stage.ack(2)
    assert await within(waiting)
    assert stage.lockstep.dropped == 0


async def test_a_participant_that_holds_is_waited_for_longer_than_a_silent_one(
    stage: Stage, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(pace_module, "SILENT_S", 0.3)
    await stage.ack(1)
    assert await within(stage.lockstep.wait(1, for_holders=True))
    waiting = asyncio.ensure_future(stage.lockstep.wait(2, for_holders=True))
    for _ in range(6):
        await stage.ack(2, holding=True)
        assert not await within(asyncio.shield(waiting), 0.1)
    await stage.ack(2)
    assert await within(waiting)
    assert stage.lockstep.dropped == 0


async def test_a_paced_simulation_waits_for_whoever_is_behind_but_not_for_whoever_holds(stage: Stage) -> None:
    await stage.ack(1)
    waiting = asyncio.ensure_future(stage.lockstep.wait(2, for_holders=False))
    assert not await within(asyncio.shield(waiting), 0.1)
    await stage.ack(2, holding=True)
    assert await within(waiting)


def test_a_world_that_is_ahead_of_its_slowest_participant_is_not_yet_the_future() -> None:
    assert (AHEAD_PACED + 1) * SLICE_NS < FUTURE_NS


async def test_the_simulation_hurries_as_long_as_one_participant_works(stage: Stage) -> None:
    await stage.ack(1, "iris", idle=True)
    await stage.ack(1, "tb3", idle=False)
    assert await within(stage.lockstep.wait(1, for_holders=True))
    assert not stage.lockstep.idle
    await stage.ack(2, "iris", idle=True)
    await stage.ack(2, "tb3", idle=True)
    assert await within(stage.lockstep.wait(2, for_holders=True))
    assert stage.lockstep.idle


async def test_a_slice_is_withheld_while_work_is_in_flight(stage: Stage) -> None:
    async with following(stage):
        with stage.clock.busy():
            stage.tick(1)
            while not (held := await stage.next_ack()).holding:
                assert held.slice == -1
            assert not held.idle, "whoever holds a slice is not idle"
        done = await done_with_a_slice(stage)
        assert done.slice == 1
        assert done.idle


async def test_in_a_paced_world_mission_time_goes_on_while_work_is_in_flight(stage: Stage) -> None:
    async with following(stage):
        with stage.clock.busy():
            for number in (1, 2, 3):
                stage.tick(number, paced=True)
                assert (await done_with_a_slice(stage)).slice == number
                assert stage.clock.now_ns() == number * SLICE_NS


async def test_time_waits_for_datagrams_that_the_simulation_has_sent(stage: Stage) -> None:
    received = 0
    async with following(stage, lambda: received, sent=9) as follower:
        stage.tick(1, datagrams=3)
        while not (await stage.next_ack()).holding:
            pass
        assert stage.clock.now_ns() == 0, "telemetry that is on its way arrives before time moves"
        received = 3
        follower.notice_traffic()
        done = await done_with_a_slice(stage)
        assert (done.slice, done.datagrams) == (1, 9)
        assert stage.clock.now_ns() == SLICE_NS


async def test_a_lost_datagram_delays_one_slice_and_no_other(stage: Stage, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(lockstep_module, "LOST_AFTER_S", 0.1)
    async with following(stage, lambda: 2):
        for number in (1, 2):
            stage.tick(number, datagrams=5)
            while (done := await stage.next_ack()).slice < number or done.holding:
                pass
            monkeypatch.setattr(lockstep_module, "LOST_AFTER_S", 60.0)
        assert stage.clock.now_ns() == 2 * SLICE_NS


async def test_a_link_that_is_down_delays_one_slice_and_is_waited_for_again_once_it_is_back(
    stage: Stage, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(lockstep_module, "LOST_AFTER_S", 0.1)
    received = 0
    async with following(stage, lambda: received) as follower:
        stage.tick(1, datagrams=3)
        assert (await stage.next_ack()).slice == 1, "three datagrams are given up"
        monkeypatch.setattr(lockstep_module, "LOST_AFTER_S", 60.0)
        stage.tick(2, datagrams=6)
        assert (await stage.next_ack()).slice == 2, "nothing came since: the link is down"
        monkeypatch.setattr(lockstep_module, "BACK_S", 60.0)
        received = 1
        stage.tick(3, datagrams=8)
        assert (await stage.next_ack()).holding, "the eighth is on its way"
        received = 2
        follower.notice_traffic()
        assert (await stage.next_ack()).slice == 3


async def test_a_datagram_that_was_only_late_does_not_stand_for_a_later_one(
    stage: Stage, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(lockstep_module, "LOST_AFTER_S", 0.1)
    received = 1
    async with following(stage, lambda: received):
        stage.tick(1, datagrams=2)
        assert (await stage.next_ack()).slice == 1, "the second is given up"
        monkeypatch.setattr(lockstep_module, "LOST_AFTER_S", 60.0)
        for number in range(2, COUNT_AFTER + 2):  # it came, and the others in step: one of them could be missing
            received = number + 1
            stage.tick(number, datagrams=number + 1)
            assert (await stage.next_ack()).slice == number
        stage.tick(COUNT_AFTER + 2, datagrams=COUNT_AFTER + 3)
        assert (await stage.next_ack()).holding, "nothing is lost any more"


async def test_what_the_next_slice_sends_early_does_not_make_up_for_what_was_lost(
    stage: Stage, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The simulation is a slice ahead: its next datagrams may be here before the tick that counts them."""
    monkeypatch.setattr(lockstep_module, "LOST_AFTER_S", 0.1)
    monkeypatch.setattr(lockstep_module, "COUNT_AFTER", 1)
    monkeypatch.setattr(lockstep_module, "COUNT_S", 1.0)
    received = 0
    async with following(stage, lambda: received) as follower:
        stage.tick(1, datagrams=2)
        await asyncio.sleep(0.3)  # two are lost; the count is on
        received = 2  # of slice 2
        stage.tick(2, datagrams=4)
        assert (await done_with_a_slice(stage)).slice == 2
        assert follower._losses.lost == 2


async def test_a_link_that_is_back_in_the_middle_of_a_slice_holds_nobody_up(
    stage: Stage, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(lockstep_module, "LOST_AFTER_S", 0.1)
    received = 0
    async with following(stage, lambda: received) as follower:
        stage.tick(1, datagrams=3)
        assert (await stage.next_ack()).slice == 1
        monkeypatch.setattr(lockstep_module, "LOST_AFTER_S", 60.0)
        received = 2
        stage.tick(2, datagrams=6)
        assert (await stage.next_ack()).slice == 2, "one of this slice's three found no socket"
        stage.tick(3, datagrams=8)
        assert (await stage.next_ack()).holding, "two of the next are on their way"
        received = 4
        follower.notice_traffic()
        assert (await done_with_a_slice(stage)).slice == 3

"""Calls over a writer: deadlines, codes with a word to each, one sequence, and no motion past the latch."""

import asyncio
import threading

import pytest

from crew.adapter import Permit, StopLatch
from crew.adapters.unitree.calls import MEANING, CallError, Calls
from crew.adapters.unitree.writer import Writer
from crew.clock import SimClock
from crew.errors import AdapterError, Latched
from tests.unit.adapters.unitree.fakes import FakeTransport, response

RESPONSE = "rt/api/sport/response"
MOVE, STOP_MOVE, STAND_UP = 1008, 1003, 1004


class Desk:
    """A writer and its calls over a fake transport."""

    def __init__(self) -> None:
        self.clock, self.latch, self.transport = SimClock(), StopLatch(), FakeTransport()
        self.writer = Writer(self.latch, self.transport, first=100)
        self.calls = Calls("go2", self.clock, self.writer, self.transport, 1.0)

    async def answered(
        self, code: int = 0, data: str = "", *, api: int = STAND_UP, as_api: int | None = None
    ) -> object:
        """Call, and let the robot answer."""
        task = asyncio.ensure_future(self.calls.call("sport", api, {}, Permit()))
        await asyncio.sleep(0)
        number, _ = self.transport.requests()[-1]
        assert self.calls.take(*response(RESPONSE, number, as_api or api, code, data))
        return await task


async def test_an_answer_is_read() -> None:
    desk = Desk()
    assert await desk.answered(data='{"id": 3}') == {"id": 3}
    assert await desk.answered(data="1.0.0.1") == "1.0.0.1"


@pytest.mark.parametrize("code", [3202, 3203, 3204, 3205, 3206, 3207, 7400])
async def test_a_code_becomes_an_error_that_says_what_it_means(code: int) -> None:
    with pytest.raises(CallError, match=f"go2: sport 1004 failed with {code}") as caught:
        await Desk().answered(code)
    assert caught.value.number == code
    assert MEANING[code] in str(caught.value)
    assert caught.value.code == f"sdk_{code}"


async def test_silence_is_3104() -> None:
    desk = Desk()
    task = asyncio.ensure_future(desk.calls.call("sport", STAND_UP, {}, Permit()))
    await asyncio.sleep(0)
    await asyncio.sleep(0)
    desk.clock.advance(1_100_000_000)
    with pytest.raises(CallError, match="3104: no answer in time"):
        await task


async def test_nobody_heard_is_3102_and_nothing_is_sent() -> None:
    desk = Desk()
    desk.transport.reachable = False
    with pytest.raises(CallError, match="3102: no server"):
        await desk.calls.call("sport", STAND_UP, {}, Permit())
    assert desk.transport.sent == []


async def test_an_answer_to_another_call_and_one_that_cannot_be_read_are_errors() -> None:
    with pytest.raises(CallError, match="3105"):
        await Desk().answered(as_api=9999)
    with pytest.raises(CallError, match="3106"):
        await Desk().answered(data="{half")


async def test_a_late_answer_is_nobodys() -> None:
    desk = Desk()
    assert desk.calls.take(*response(RESPONSE, 5, STAND_UP))
    assert not desk.calls.take("rt/lowstate", {})


def test_numbers_rise_and_carry_the_lease() -> None:
    desk = Desk()
    desk.writer.lease = 42
    for api in (MOVE, MOVE, STOP_MOVE):
        desk.writer.request("sport", api, {"x": 0.1}, Permit(), noreply=True)
    assert [number for number, _ in desk.transport.requests()] == [101, 102, 103]
    assert all(body["header"]["lease"]["id"] == 42 for _, body in desk.transport.sent)


def test_nothing_that_moves_leaves_after_the_latch_but_the_stop_does() -> None:
    desk = Desk()
    desk.latch.set()
    with pytest.raises(Latched):
        desk.writer.request("sport", MOVE, {}, Permit(), noreply=True)
    with pytest.raises(Latched):
        desk.writer.publish("rt/arm_sdk", {}, Permit())
    assert desk.transport.sent == []
    desk.writer.stop_by_call("sport", STOP_MOVE)
    desk.writer.request("sport", 1, {}, None)
    desk.writer.request("sport", STAND_UP, {}, Permit(safe=True))
    assert [api for _, api in desk.transport.requests()] == [STOP_MOVE, 1, STAND_UP]


def test_a_revoked_permit_sends_nothing() -> None:
    desk, permit = Desk(), Permit()
    permit.revoke(AdapterError("cancelled", code="cancelled"))
    with pytest.raises(AdapterError, match="cancelled"):
        desk.writer.request("sport", MOVE, {}, permit, noreply=True)
    assert desk.transport.sent == []


def test_no_move_overtakes_a_stop_from_another_thread() -> None:
    desk, permit = Desk(), Permit()
    went_on = threading.Event()

    def drive() -> None:
        for number in range(100_000):
            try:
                desk.writer.request("sport", MOVE, {}, permit, noreply=True)
            except Latched:
                return
            if number == 50:
                went_on.set()

    thread = threading.Thread(target=drive)
    thread.start()
    assert went_on.wait(5.0)
    with desk.latch.lock:
        desk.latch.set()
        desk.writer.stop_by_call("sport", STOP_MOVE)
    thread.join(5.0)
    numbers, apis = zip(*desk.transport.requests(), strict=True)
    assert apis[-1] == STOP_MOVE
    assert list(numbers) == sorted(numbers)

"""Commands: one answer each, retries with a counter, a refusal in the vehicle's own words."""

import asyncio
from typing import Any

import pytest
from pymavlink.dialects.v20 import common as mavlink

from crew.adapter import Permit, StopLatch
from crew.adapters.mavlink.command import Command, Commander, Position
from crew.adapters.mavlink.statustext import StatusLog
from crew.adapters.mavlink.writer import Writer
from crew.clock import SimClock
from crew.errors import AdapterError, Latched
from tests.unit.adapters.fake import Wire, ack, finish, text

ARM = Command(id=mavlink.MAV_CMD_COMPONENT_ARM_DISARM, params=(1.0,))
ACCEPTED, REJECTED = mavlink.MAV_RESULT_ACCEPTED, mavlink.MAV_RESULT_TEMPORARILY_REJECTED


class Rig:
    def __init__(self) -> None:
        self.clock = SimClock()
        self.wire = Wire()
        self.latch = StopLatch()
        self.texts = StatusLog()
        self.commander = Commander(self.clock, Writer(self.latch, self.wire.transmit), self.texts, 1)

    def say(self, severity: int, words: str) -> None:
        self.texts.add(text(severity, words), self.clock.now_ns())

    async def send(self, command: Command, *answers: Any) -> None:
        """Send, and answer every message that leaves with the next of `answers` (None: silence)."""
        waiting = list(answers)
        answered = 0

        async def vehicle() -> None:
            nonlocal answered
            while waiting:
                if len(self.wire.messages) > answered:
                    answered += 1
                    answer = waiting.pop(0)
                    if answer is not None:
                        self.commander.acknowledge(answer)
                await asyncio.sleep(0)

        task = asyncio.create_task(vehicle())
        try:
            await finish(self.clock, self.commander.send(command, Permit()))
        finally:
            task.cancel()
            await asyncio.gather(task, return_exceptions=True)


async def test_an_accepted_command_returns_after_one_message() -> None:
    rig = Rig()
    await rig.send(ARM, ack(ARM.id, ACCEPTED))
    assert len(rig.wire.messages) == 1


async def test_silence_is_retried_with_a_rising_confirmation() -> None:
    rig = Rig()
    await rig.send(ARM, None, None, ack(ARM.id, ACCEPTED))
    assert [m.confirmation for m in rig.wire.messages] == [0, 1, 2]


async def test_the_late_answer_to_an_earlier_try_does_not_answer_the_next_command() -> None:
    rig = Rig()
    await rig.send(ARM, None, ack(ARM.id, ACCEPTED))
    sending = asyncio.ensure_future(rig.commander.send(ARM, Permit()))
    for _ in range(3):
        await asyncio.sleep(0)
    rig.commander.acknowledge(ack(ARM.id, ACCEPTED))
    for _ in range(3):
        await asyncio.sleep(0)
    assert not sending.done()
    rig.commander.acknowledge(ack(ARM.id, REJECTED))
    with pytest.raises(AdapterError, match="refused"):
        await finish(rig.clock, sending)


async def test_an_answer_to_another_station_is_no_answer() -> None:
    rig = Rig()
    sending = asyncio.ensure_future(rig.commander.send(ARM, Permit()))
    await asyncio.sleep(0)
    rig.commander.acknowledge(mavlink.MAVLink_command_ack_message(ARM.id, REJECTED, 0, 0, 245, 190))
    rig.commander.acknowledge(ack(ARM.id, ACCEPTED))
    await finish(rig.clock, sending)


async def test_lasting_silence_is_an_error_that_names_the_command() -> None:
    rig = Rig()
    with pytest.raises(AdapterError, match="MAV_CMD_COMPONENT_ARM_DISARM: no answer") as failed:
        await rig.send(ARM)
    assert failed.value.code == "no_answer"
    assert 2.9 < rig.clock.now_ns() / 1e9 < 3.3


async def test_a_refusal_carries_the_result_and_the_texts_around_it() -> None:
    rig = Rig()
    rig.say(2, "Preflight Fail: long ago")
    rig.clock.advance(5_000_000_000)
    rig.say(3, "PreArm: compass not calibrated")
    rig.say(6, "for your information")

    async def late() -> None:
        await rig.clock.sleep(0.5)
        rig.say(2, "PreArm: GPS bad")

    task = asyncio.create_task(late())
    with pytest.raises(AdapterError) as refused:
        await rig.send(ARM, ack(ARM.id, REJECTED))
    await task
    assert refused.value.code == "refused"
    assert refused.value.reason == "PreArm: compass not calibrated; PreArm: GPS bad"
    assert "MAV_RESULT_TEMPORARILY_REJECTED" in str(refused.value)


async def test_in_progress_waits_for_the_final_answer_without_sending_again() -> None:
    rig = Rig()
    sending = asyncio.ensure_future(rig.commander.send(ARM, Permit()))
    await asyncio.sleep(0)
    await asyncio.sleep(0)
    rig.commander.acknowledge(ack(ARM.id, mavlink.MAV_RESULT_IN_PROGRESS))
    for _ in range(100):
        rig.clock.advance(rig.clock.now_ns() + 50_000_000)
        await asyncio.sleep(0)
    assert not sending.done()
    rig.commander.acknowledge(ack(ARM.id, ACCEPTED))
    await finish(rig.clock, sending)
    assert len(rig.wire.messages) == 1


async def test_one_command_of_an_id_is_in_flight_and_an_answer_to_another_id_is_left_alone() -> None:
    rig = Rig()
    both = [asyncio.ensure_future(rig.commander.send(ARM, Permit())) for _ in range(2)]
    for _ in range(4):
        await asyncio.sleep(0)
    assert len(rig.wire.messages) == 1
    rig.commander.acknowledge(ack(22, ACCEPTED))
    rig.commander.acknowledge(ack(ARM.id, ACCEPTED))
    for _ in range(6):
        await asyncio.sleep(0)
    assert [task.done() for task in both] == [True, False]
    assert len(rig.wire.messages) == 2
    rig.commander.acknowledge(ack(ARM.id, ACCEPTED))
    await finish(rig.clock, both[1])


async def test_a_retry_after_the_stop_is_latched_does_not_leave() -> None:
    rig = Rig()
    sending = asyncio.ensure_future(rig.commander.send(ARM, Permit()))
    await asyncio.sleep(0)
    rig.latch.set()
    with pytest.raises(Latched):
        await finish(rig.clock, sending)
    assert len(rig.wire.messages) == 1


def test_a_command_with_a_position_goes_as_an_integer_command_in_the_relative_frame() -> None:
    command = Command(id=192, params=(3.0, 1.0), position=Position(47.1234567, 8.7654321, 5.0))
    message = command.message(1, 0)
    assert message.get_type() == "COMMAND_INT"
    assert (message.frame, message.x, message.y, message.z) == (6, 471234567, 87654321, 5.0)

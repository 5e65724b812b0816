"""Parts that stand in for the wire: a clock that a test moves, a writer's far end, ready-made messages."""

import asyncio
from collections.abc import Awaitable
from typing import Any, TypeVar

from pymavlink.dialects.v20 import common as mavlink

from crew.clock import SimClock

T = TypeVar("T")


class Wire:
    """What was transmitted, decoded."""

    def __init__(self) -> None:
        self._parser: Any = mavlink.MAVLink(None)
        self.messages: list[Any] = []

    def transmit(self, data: bytes) -> None:
        self.messages.extend(self._parser.parse_buffer(data) or [])

    def names(self) -> list[str]:
        return [message.get_type() for message in self.messages]


async def finish(clock: SimClock, work: Awaitable[T], limit_s: float = 120.0) -> T:
    """The result of `work`, moving the clock in steps of 50 ms until it is there."""
    task = asyncio.ensure_future(work)
    end_ns = clock.now_ns() + round(limit_s * 1e9)
    while not task.done() and clock.now_ns() < end_ns:
        for _ in range(4):
            await asyncio.sleep(0)
        clock.advance(clock.now_ns() + 50_000_000)
    assert task.done(), "mission time ran out"
    return task.result()


def ack(command: int, result: int) -> Any:
    return mavlink.MAVLink_command_ack_message(command, result, 0, 0, 255, 190)


def text(severity: int, words: str) -> Any:
    return mavlink.MAVLink_statustext_message(severity, words.encode())


def arm() -> Any:
    return mavlink.MAVLink_command_long_message(1, 1, mavlink.MAV_CMD_COMPONENT_ARM_DISARM, 0, 1, 0, 0, 0, 0, 0, 0)


def heartbeat(custom_mode: int = 0, *, armed: bool = False) -> Any:
    base = mavlink.MAV_MODE_FLAG_SAFETY_ARMED if armed else 0
    return mavlink.MAVLink_heartbeat_message(2, 12, base, custom_mode, 4, 3)

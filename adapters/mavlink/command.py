"""Commands with an answer: COMMAND_LONG and COMMAND_INT, retried to a deadline, one in flight for each id."""

import asyncio
import math
from typing import Any

import msgspec
from pymavlink.dialects.v20 import common as mavlink

from crew.adapter import Permit
from crew.adapters.mavlink.statustext import StatusLog
from crew.adapters.mavlink.writer import GROUND_SYSTEM, Writer
from crew.clock import Clock, seconds_ns, within
from crew.errors import AdapterError

ANSWER_S = 1.0
TRIES = 3
IN_PROGRESS_S = 30.0
LATE_S = 5.0
"""An answer that is later than this does not come any more."""
OURS = (0, GROUND_SYSTEM)
"""Targets of an answer that is for us; older vehicles leave it 0."""
REASON_WINDOW_S = 1.0
"""A vehicle says why it refused up to this long before or after the refusal."""

UNUSED = math.nan


class Position(msgspec.Struct, frozen=True):
    """Where a command points: degrees, and metres above home."""

    lat_deg: float
    lon_deg: float
    height_m: float


class Command(msgspec.Struct, frozen=True, kw_only=True):
    """A MAVLink command. With a `position` it goes as COMMAND_INT in the relative frame, otherwise as COMMAND_LONG."""

    id: int
    params: tuple[float, ...] = ()
    """Parameters 1 to 7, or 1 to 4 with a position; missing ones are filled with `fill`."""
    fill: float = 0.0
    position: Position | None = None

    @property
    def name(self) -> str:
        return _enum_name("MAV_CMD", self.id)

    def message(self, system: int, confirmation: int) -> Any:
        """The message for the autopilot of `system`."""
        if self.position is None:
            params = self._filled(7)
            return mavlink.MAVLink_command_long_message(system, 1, self.id, confirmation, *params)
        place = self.position
        frame = mavlink.MAV_FRAME_GLOBAL_RELATIVE_ALT_INT
        lat, lon = round(place.lat_deg * 1e7), round(place.lon_deg * 1e7)
        head = (system, 1, frame, self.id, 0, 0)
        return mavlink.MAVLink_command_int_message(*head, *self._filled(4), lat, lon, place.height_m)

    def _filled(self, count: int) -> tuple[float, ...]:
        return self.params + (self.fill,) * (count - len(self.params))


class Commander:
    """Sends commands to the autopilot of one system and waits for its answers."""

    def __init__(self, clock: Clock, writer: Writer, texts: StatusLog, system: int) -> None:
        self._clock = clock
        self._writer = writer
        self._texts = texts
        self._system = system
        self._locks: dict[int, asyncio.Lock] = {}
        self._answers: dict[int, asyncio.Queue[int]] = {}
        self._late: dict[int, tuple[int, int]] = {}
        """By command: how many answers to earlier tries may still come, and until when."""

    async def send(self, command: Command, permit: Permit | None = None) -> None:
        """Return once the vehicle accepted the command; that says nothing about its completion.

        Raises AdapterError `refused` with the vehicle's reason, `no_answer`, and what `Writer.send` raises.
        """
        async with self._locks.setdefault(command.id, asyncio.Lock()):
            answers = self._answers[command.id] = asyncio.Queue()
            try:
                result = await self._ask(command, permit, answers)
            finally:
                del self._answers[command.id]
        if result != mavlink.MAV_RESULT_ACCEPTED:
            raise await self._refusal(command, result)

    def acknowledge(self, message: Any) -> None:
        """Take a COMMAND_ACK; one that nobody waits for is left alone."""
        answers = self._answers.get(message.command)
        if message.target_system not in OURS or self._is_late(message.command):
            return
        if answers is not None:
            answers.put_nowait(int(message.result))

    def _is_late(self, command: int) -> bool:
        """Whether an answer belongs to a try that was given up: it says nothing about the command of now."""
        count, until_ns = self._late.get(command, (0, 0))
        if count == 0 or self._clock.now_ns() > until_ns:
            return False
        self._late[command] = (count - 1, until_ns)
        return True

    def _owe(self, command: int, tries: int) -> None:
        """Of several tries one was answered, or none: the answers of the others may come yet."""
        self._late[command] = (tries, self._clock.now_ns() + seconds_ns(LATE_S))

    async def _ask(self, command: Command, permit: Permit | None, answers: asyncio.Queue[int]) -> int:
        for confirmation in range(TRIES):
            self._writer.send(command.message(self._system, confirmation), permit)
            try:
                result = await within(self._clock, ANSWER_S, answers.get())
            except TimeoutError:
                continue
            result = await self._final(command, result, answers)
            self._owe(command.id, confirmation)
            return result
        self._owe(command.id, TRIES)
        raise AdapterError(
            f"{command.name}: no answer to {TRIES} tries within {TRIES * ANSWER_S:g} s; is the vehicle connected?",
            code="no_answer",
        )

    async def _final(self, command: Command, result: int, answers: asyncio.Queue[int]) -> int:
        while result == mavlink.MAV_RESULT_IN_PROGRESS:
            try:
                result = await within(self._clock, IN_PROGRESS_S, answers.get())
            except TimeoutError:
                raise AdapterError(
                    f"{command.name}: still in progress after {IN_PROGRESS_S:g} s", code="no_answer"
                ) from None
        return result

    async def _refusal(self, command: Command, result: int) -> AdapterError:
        start_ns = self._clock.now_ns() - seconds_ns(REASON_WINDOW_S)
        await self._clock.sleep(REASON_WINDOW_S)
        reason = "; ".join(self._texts.since(start_ns)) or "the vehicle gave no reason"
        return AdapterError(
            f"{command.name} refused: {_enum_name('MAV_RESULT', result)}: {reason}", code="refused", reason=reason
        )


def _enum_name(enum: str, value: int) -> str:
    entry = mavlink.enums[enum].get(value)
    return str(entry.name) if entry else f"{enum}({value})"

"""Reading the vehicle's parameters. Sets none."""

import asyncio
import struct
from typing import Any

from pymavlink.dialects.v20 import common as mavlink

from crew.adapters.mavlink.writer import Writer
from crew.clock import Clock, within
from crew.errors import AdapterError

ANSWER_S = 1.0
TRIES = 3

_INTEGERS = {
    mavlink.MAV_PARAM_TYPE_INT8: "<b",
    mavlink.MAV_PARAM_TYPE_UINT8: "<B",
    mavlink.MAV_PARAM_TYPE_INT16: "<h",
    mavlink.MAV_PARAM_TYPE_UINT16: "<H",
    mavlink.MAV_PARAM_TYPE_INT32: "<i",
    mavlink.MAV_PARAM_TYPE_UINT32: "<I",
}
SMALLEST_NORMAL = 2.0**-126


class Parameters:
    """Asks one system for parameters by name."""

    def __init__(self, clock: Clock, writer: Writer, system: int) -> None:
        self._clock = clock
        self._writer = writer
        self._system = system
        self._waiting: dict[str, asyncio.Future[float]] = {}

    async def read(self, name: str) -> float:
        """The value of a parameter. Raises AdapterError `no_parameter` if the vehicle does not tell it."""
        for _ in range(TRIES):
            future = self._waiting[name] = asyncio.get_running_loop().create_future()
            self._writer.send(mavlink.MAVLink_param_request_read_message(self._system, 1, name.encode("ascii"), -1))
            try:
                return await within(self._clock, ANSWER_S, future)
            except TimeoutError:
                continue
            finally:
                self._waiting.pop(name, None)
        raise AdapterError(
            f"parameter {name}: no answer to {TRIES} tries; the failsafes cannot be checked", code="no_parameter"
        )

    def take(self, message: Any) -> None:
        """Take a PARAM_VALUE."""
        future = self._waiting.get(str(message.param_id))
        if future is not None and not future.done():
            future.set_result(decode_value(float(message.param_value), int(message.param_type)))


def decode_value(value: float, kind: int) -> float:
    """A PARAM_VALUE's number, whichever way an integer was put into its float field.

    ArduPilot casts (3 is 3.0), PX4 copies the bits (3 is a denormal). Only small copied integers look like denormals
    or NaN, and no cast integer does, so the two are told apart without knowing the autopilot.
    """
    layout = _INTEGERS.get(kind)
    cast = value == 0.0 or abs(value) >= SMALLEST_NORMAL
    if layout is None or cast:
        return value
    bits = struct.pack("<f", value)
    return float(struct.unpack(layout, bits[: struct.calcsize(layout)])[0])

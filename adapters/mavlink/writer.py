"""The only way a message leaves for the vehicle: one lock orders setpoints, commands and the stop.

No motion-causing message leaves after the latch is set: the check and the write happen under the same lock.
"""

from collections.abc import Callable
from typing import Any

from pymavlink.dialects.v20 import common as mavlink

from crew.adapter import Permit, StopLatch
from crew.errors import AdapterError, Latched

GROUND_SYSTEM = 255
GROUND_COMPONENT = mavlink.MAV_COMP_ID_MISSIONPLANNER

HARMLESS_MESSAGES = frozenset({mavlink.MAVLINK_MSG_ID_HEARTBEAT, mavlink.MAVLINK_MSG_ID_PARAM_REQUEST_READ})
HARMLESS_COMMANDS = frozenset({mavlink.MAV_CMD_SET_MESSAGE_INTERVAL, mavlink.MAV_CMD_REQUEST_MESSAGE})
COMMAND_MESSAGES = frozenset({mavlink.MAVLINK_MSG_ID_COMMAND_LONG, mavlink.MAVLINK_MSG_ID_COMMAND_INT})


class Writer:
    """Encodes and sends in sequence. Safe to call from any thread; never waits for anything but the lock."""

    def __init__(self, latch: StopLatch, transmit: Callable[[bytes], None]) -> None:
        self._latch = latch
        self._transmit = transmit
        self.encoder = mavlink.MAVLink(None, srcSystem=GROUND_SYSTEM, srcComponent=GROUND_COMPONENT)

    def send(self, message: Any, permit: Permit | None = None) -> None:
        """Send one message. Raises Latched, or the permit's reason, when it may cause motion and must not."""
        with self._latch.lock:
            if causes_motion(message):
                self._admit(message, permit)
            self._write(message)

    def send_stop(self, message: Any) -> None:
        """Send the vehicle's stop: always allowed, latched or not."""
        with self._latch.lock:
            self._write(message)

    def _admit(self, message: Any, permit: Permit | None) -> None:
        if permit is None:
            raise AdapterError(f"{message.get_type()} may cause motion and came without a permit", code="no_permit")
        permit.check()
        if self._latch.latched and not permit.safe:
            raise Latched(f"{message.get_type()} not sent: the stop is latched; reset the robot first")

    def _write(self, message: Any) -> None:
        data = bytes(message.pack(self.encoder))
        self.encoder.seq = (self.encoder.seq + 1) % 256
        self._transmit(data)


def causes_motion(message: Any) -> bool:
    """Whether a message may set the vehicle in motion or arm it: everything not known to be harmless."""
    if message.get_msgId() in COMMAND_MESSAGES:
        return message.command not in HARMLESS_COMMANDS
    return message.get_msgId() not in HARMLESS_MESSAGES

"""COMMAND_LONG and COMMAND_INT in one form, and what may be answered. Pure; must not execute anything."""

import math
from typing import Any, NamedTuple

from pymavlink.dialects.v20 import common as mavlink

ABSOLUTE = frozenset({mavlink.MAV_FRAME_GLOBAL, mavlink.MAV_FRAME_GLOBAL_INT})
RELATIVE = frozenset({mavlink.MAV_FRAME_GLOBAL_RELATIVE_ALT, mavlink.MAV_FRAME_GLOBAL_RELATIVE_ALT_INT})
INT_UNSET = 2**31 - 1  # COMMAND_INT's way to leave x or y out


class Outcome(NamedTuple):
    """A MAV_RESULT, and for a refusal the reason that follows it as STATUSTEXT."""

    result: int
    reason: str = ""


ACCEPTED = Outcome(mavlink.MAV_RESULT_ACCEPTED)
UNSUPPORTED = Outcome(mavlink.MAV_RESULT_UNSUPPORTED)


def denied(reason: str) -> Outcome:
    """The command is wrong and will not be accepted later either."""
    return Outcome(mavlink.MAV_RESULT_DENIED, reason)


def rejected(reason: str) -> Outcome:
    """The command is right but not in this state."""
    return Outcome(mavlink.MAV_RESULT_TEMPORARILY_REJECTED, reason)


class Command(NamedTuple):
    """p1..p4 and z as sent; frame is None for COMMAND_LONG.

    x, y: degrees where COMMAND_INT carries a position (NaN if left out), else param5 and param6 as sent.
    """

    id: int
    p1: float
    p2: float
    p3: float
    p4: float
    x: float
    y: float
    z: float
    frame: int | None

    @property
    def is_finite(self) -> bool:
        """False if an infinity is among the parameters; NaN means 'not given'."""
        return not any(math.isinf(value) for value in self[1:8])

    @property
    def is_pause(self) -> bool:
        """A reposition to nowhere: stop here."""
        return math.isnan(self.x) and math.isnan(self.y) and math.isnan(self.z)

    def height_m(self, home_alt_m: float, otherwise: float) -> float | None:
        """z as height above home; `otherwise` if it is NaN, None if the frame is not one of the global ones.

        COMMAND_LONG has no frame: its altitudes are above mean sea level.
        """
        if math.isnan(self.z):
            return otherwise
        if self.frame is None or self.frame in ABSOLUTE:
            return self.z - home_alt_m
        return self.z if self.frame in RELATIVE else None


def read_command(message: Any) -> Command:
    """The command in a COMMAND_LONG or COMMAND_INT message."""
    if message.get_type() == "COMMAND_LONG":
        x, y, z, frame = message.param5, message.param6, message.param7, None
    else:
        x, y, z, frame = _degrees(message.x), _degrees(message.y), message.z, message.frame
    return Command(message.command, message.param1, message.param2, message.param3, message.param4, x, y, z, frame)


def _degrees(value: int) -> float:
    return math.nan if value == INT_UNSET else value * 1e-7


def flag(value: float) -> int:
    """A parameter that carries an enum or bit mask; NaN and fractions count as 0."""
    return int(value) if math.isfinite(value) else 0

"""Where the vehicle says it was: recent positions and attitudes on its own boot clock, interpolated between samples."""

import bisect
import math
from collections import deque

import msgspec

from crew.adapters.mavlink.frame import wrap_rad

MAX_GAP_S = 0.5
"""Poses further than this from a sample are not known."""
HISTORY = 12_000
"""Samples kept: ten minutes at 20 Hz."""


class Pose(msgspec.Struct, frozen=True):
    """World east and north, height above home, metres; roll, pitch, heading of body FRD in NED, radians."""

    x_m: float
    y_m: float
    height_m: float
    roll_rad: float
    pitch_rad: float
    heading_rad: float


class Samples:
    """Triples of numbers in time order. `wrapped` says which of them are angles that wrap at +-pi."""

    def __init__(self, wrapped: tuple[bool, bool, bool]) -> None:
        self._wrapped = wrapped
        self._times_s: deque[float] = deque(maxlen=HISTORY)
        self._values: deque[tuple[float, float, float]] = deque(maxlen=HISTORY)

    def add(self, time_s: float, value: tuple[float, float, float]) -> None:
        """Append a sample; one that is not newer than the last is left out."""
        if not self._times_s or time_s > self._times_s[-1]:
            self._times_s.append(time_s)
            self._values.append(value)

    def at(self, time_s: float) -> tuple[float, float, float] | None:
        """Linear interpolation, the nearest sample just outside the ends, None where nothing is near."""
        right = bisect.bisect_left(self._times_s, time_s)
        near = [i for i in (right - 1, right) if 0 <= i < len(self._times_s)]
        if not near or min(abs(self._times_s[i] - time_s) for i in near) > MAX_GAP_S:
            return None
        if len(near) == 1:
            return self._values[near[0]]
        return self._between(near[0], near[1], time_s)

    def _between(self, left: int, right: int, time_s: float) -> tuple[float, float, float]:
        start_s, end_s = self._times_s[left], self._times_s[right]
        share = (time_s - start_s) / (end_s - start_s)
        pairs = zip(self._values[left], self._values[right], self._wrapped, strict=True)
        first, second, third = (
            wrap_rad(a + share * wrap_rad(b - a)) if angle else a + share * (b - a) for a, b, angle in pairs
        )
        return first, second, third


class PoseTrack:
    """Positions and attitudes by the vehicle's boot time, seconds."""

    def __init__(self) -> None:
        self._positions = Samples((False, False, False))
        self._attitudes = Samples((True, True, True))

    def add_position(self, boot_s: float, x_m: float, y_m: float, height_m: float) -> None:
        self._positions.add(boot_s, (x_m, y_m, height_m))

    def add_attitude(self, boot_s: float, roll_rad: float, pitch_rad: float, heading_rad: float) -> None:
        self._attitudes.add(boot_s, (roll_rad, pitch_rad, heading_rad))

    def at(self, boot_s: float) -> Pose | None:
        """The pose at a boot time, or None if the vehicle said nothing near it."""
        position, attitude = self._positions.at(boot_s), self._attitudes.at(boot_s)
        if position is None or attitude is None:
            return None
        return Pose(*position, *(math.remainder(angle, math.tau) for angle in attitude))

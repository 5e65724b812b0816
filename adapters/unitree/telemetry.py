"""What the robot and the side channel last said, each stamped with mission time of its receipt. World ENU, metres.

A message whose numbers are none, or that lacks a field, is dropped and counted.
"""

import math
from collections.abc import Callable, Mapping
from typing import Any, Generic, TypeVar

import msgspec

from crew.adapters.unitree.transport import Body
from crew.clock import SECOND_NS, Clock

T = TypeVar("T")


class Sample(msgspec.Struct, Generic[T], frozen=True):
    """A value and mission time of its receipt."""

    value: T
    stamp_ns: int


class Stamp(msgspec.Struct, frozen=True):
    sec: int
    nanosec: int


class Imu(msgspec.Struct, frozen=True):
    rpy: tuple[float, float, float]

    @property
    def tilt_rad(self) -> float:
        """How far from upright."""
        return max(abs(self.rpy[0]), abs(self.rpy[1]))


class SportState(msgspec.Struct, frozen=True):
    """`rt/sportmodestate`, as far as it is used."""

    error_code: int
    imu_state: Imu
    mode: int
    position: tuple[float, float, float]
    velocity: tuple[float, float, float]
    yaw_speed: float
    range_obstacle: tuple[float, float, float, float]

    @property
    def spot(self) -> tuple[float, float]:
        return self.position[0], self.position[1]

    @property
    def yaw_rad(self) -> float:
        return self.imu_state.rpy[2]

    @property
    def speed_mps(self) -> float:
        return math.hypot(self.velocity[0], self.velocity[1])


class Motor(msgspec.Struct, frozen=True):
    q: float
    dq: float
    tau_est: float = 0.0
    mode: int = 1


class Battery(msgspec.Struct, frozen=True):
    soc: float


class LowState(msgspec.Struct, frozen=True):
    """`rt/lowstate` of either robot, as far as it is used; the humanoid's has no battery."""

    motor_state: tuple[Motor, ...]
    imu_state: Imu
    bms_state: Battery | None = None


class HandState(msgspec.Struct, frozen=True):
    """`rt/dex1/right/state`: the gripper as one motor."""

    states: tuple[Motor, ...]


class Seen(msgspec.Struct, frozen=True):
    """A thing, place or person as it is seen; for a person: the hand, and which way they face."""

    name: str
    x: float
    y: float
    z: float
    yaw: float

    @property
    def spot(self) -> tuple[float, float]:
        return self.x, self.y


class Objects(msgspec.Struct, frozen=True):
    objects: tuple[Seen, ...]
    places: tuple[Seen, ...] = ()


class People(msgspec.Struct, frozen=True):
    people: tuple[Seen, ...]


class Tray(msgspec.Struct, frozen=True):
    object: str
    weight_n: float


class Telemetry:
    """An attribute that was never heard is None."""

    def __init__(self, clock: Clock) -> None:
        self._clock = clock
        self.sport: Sample[SportState] | None = None
        self.low: Sample[LowState] | None = None
        self.hand: Sample[HandState] | None = None
        self.battery: Sample[float] | None = None
        self.tray: Sample[Tray] | None = None
        self.objects: dict[str, Sample[Seen]] = {}
        """The newest sight of each thing; it grows old while the thing is out of sight."""
        self.places: dict[str, Sample[Seen]] = {}
        self.people: dict[str, Sample[Seen]] = {}
        self.dropped = 0
        self._takers: dict[str, Callable[[Body], None]] = {
            "rt/sportmodestate": self._take_sport,
            "rt/lowstate": self._take_low,
            "rt/lf/bmsstate": self._take_battery,
            "rt/dex1/right/state": self._take_hand,
            "rt/crew/tray": self._take_tray,
            "rt/crew/objects": self._take_objects,
            "rt/crew/people": self._take_people,
        }

    def take(self, topic: str, body: Body) -> None:
        """Fold one message in; an unknown topic is left alone."""
        taker = self._takers.get(topic)
        if taker is None:
            return
        try:
            if not _finite(body):
                raise ValueError
            taker(body)
        except (msgspec.ValidationError, ValueError):
            self.dropped += 1

    def age_s(self, sample: Sample[Any] | None) -> float:
        """Seconds of mission time since receipt; infinite for what was never heard."""
        return math.inf if sample is None else (self._clock.now_ns() - sample.stamp_ns) / SECOND_NS

    def _sample(self, value: T) -> Sample[T]:
        return Sample(value, self._clock.now_ns())

    def _take_sport(self, body: Body) -> None:
        self.sport = self._sample(msgspec.convert(body, SportState))

    def _take_low(self, body: Body) -> None:
        low = msgspec.convert(body, LowState)
        self.low = self._sample(low)
        if low.bms_state is not None:
            self.battery = self._sample(float(low.bms_state.soc))

    def _take_battery(self, body: Body) -> None:
        self.battery = self._sample(float(msgspec.convert(body, Battery).soc))

    def _take_hand(self, body: Body) -> None:
        hand = msgspec.convert(body, HandState)
        if not hand.states:
            raise ValueError
        self.hand = self._sample(hand)

    def _take_tray(self, body: Body) -> None:
        self.tray = self._sample(msgspec.convert(body, Tray))

    def _take_objects(self, body: Body) -> None:
        found = msgspec.convert(body, Objects)
        self.objects |= {seen.name: self._sample(seen) for seen in found.objects}
        self.places |= {seen.name: self._sample(seen) for seen in found.places}

    def _take_people(self, body: Body) -> None:
        self.people |= {seen.name: self._sample(seen) for seen in msgspec.convert(body, People).people}


def _finite(value: object) -> bool:
    if isinstance(value, float):
        return math.isfinite(value)
    if isinstance(value, Mapping):
        return all(map(_finite, value.values()))
    return all(map(_finite, value)) if isinstance(value, list | tuple) else True

"""The options of a robot's part of the crew file that this adapter reads."""

from collections.abc import Mapping
from typing import Annotated, Literal

import msgspec
from msgspec import Meta

Positive = Annotated[float, Meta(gt=0)]
NotNegative = Annotated[float, Meta(ge=0)]


class RobotOptions(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """What every robot has."""

    backend: Literal["mock", "sdk"] = "mock"
    """`mock` speaks datagrams on loopback, `sdk` the vendor's SDK over DDS; the connection says where."""
    side: str = ""
    """With `sdk`: where the side channel comes in, `udpin:HOST:PORT`; empty for none."""
    connect_timeout_s: Positive = 15.0
    call_timeout_s: Positive = 1.0
    min_battery_percent: Annotated[float, Meta(ge=0, le=100)] = 10.0
    silent_s: Positive = 1.0
    """Telemetry older than this is a lost link."""


class Berth(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A place that is entered sideways or backwards, with a fixed heading, from a point with room to turn."""

    enter_from: tuple[float, float]
    heading_deg: float


class WalkerOptions(RobotOptions, frozen=True, kw_only=True, forbid_unknown_fields=True):
    lease: bool = True
    """Hold the lease of the sport service, so that no other client can command."""
    cruise_mps: Positive = 0.5
    loaded_mps: Positive = 0.4
    """The same with something in the tray."""
    arrive_m: Positive = 0.12
    robot_radius_m: Positive = 0.22
    clearance_m: NotNegative = 0.16
    cell_m: Annotated[float, Meta(ge=0.05, le=0.5)] = 0.1
    stall_s: Positive = 6.0
    """A walk fails after this long without progress."""
    person_m: Positive = 0.45
    """A person who has moved this far from where the walk was sent to is not there any more."""
    berths: Mapping[str, Berth] = {}


class ManipulatorOptions(RobotOptions, frozen=True, kw_only=True, forbid_unknown_fields=True):
    stands_at: tuple[float, float, float]
    """Where the pelvis stands in the world: x, y in metres, heading in degrees."""
    surfaces: Mapping[str, float] = {}
    """Height of the surface at each named place, metres."""
    reach_m: Positive = 0.7
    """A person whose hand is within this of the pelvis, horizontally, is near."""
    hand_mps: Positive = 0.25
    lift_m: Positive = 0.12
    grip_n: Positive = 4.0
    """Force between the fingers from which on they hold something."""
    tug_nm: Positive = 2.0
    """Change of the arm's torques that means somebody pulls."""
    offer_s: Positive = 12.0
    """How long an object is held out."""

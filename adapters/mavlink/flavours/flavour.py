"""What an autopilot's flavour must say. Pure: it makes commands and reads modes, it sends and waits for nothing."""

from collections.abc import Callable, Mapping
from typing import Protocol

import msgspec

from crew.adapters.mavlink.command import Command, Position

Modes = frozenset[str]


class Failsafe(msgspec.Struct, frozen=True):
    """A parameter that must be set before the vehicle may move."""

    parameter: str
    allowed: Callable[[float], bool]
    says: str
    """What is allowed, in words."""


class Flavour(Protocol):
    """One autopilot on one kind of vehicle."""

    @property
    def title(self) -> str: ...

    @property
    def kind(self) -> str:
        """The crew's kind of robot."""
        ...

    @property
    def autopilot(self) -> int:
        """MAV_AUTOPILOT of the heartbeat."""
        ...

    @property
    def vehicle_types(self) -> frozenset[int]:
        """MAV_TYPEs of the heartbeat."""
        ...

    @property
    def sensors(self) -> Mapping[int, str]:
        """Health bits of SYS_STATUS that must be good, by name."""
        ...

    @property
    def prearm_bit(self) -> int:
        """A health bit that counts only while disarmed; 0 for none."""
        ...

    @property
    def failsafes(self) -> tuple[Failsafe, ...]: ...

    @property
    def streams(self) -> Mapping[int, float]:
        """Messages to ask for, by id, in Hz; empty if the vehicle streams by itself."""
        ...

    @property
    def fences(self) -> tuple[Failsafe, ...]:
        """The vehicle's own geofence: part of the checklist, for the adapter has one of its own."""
        ...

    @property
    def stops(self) -> tuple[Command, ...]:
        """Brake and hold, in any mode; all of them, in this order."""
        ...

    @property
    def stop_mode(self) -> str:
        """The mode that `stops` lead to."""
        ...

    @property
    def travel_modes(self) -> Modes:
        """Modes in which the vehicle is on its way by our command, or holding there."""
        ...

    def mode(self, custom_mode: int) -> str:
        """The mode's name."""
        ...

    def prepare(self) -> tuple[Command, ...]:
        """What comes before the first `go_to`: a mode, arming."""
        ...

    def go_to(self, place: Position, speed_mps: float, heading_rad: float | None) -> tuple[Command, ...]:
        """Travel to a place. Heading is clockwise from north; None leaves it to the vehicle."""
        ...


class FlightFlavour(Flavour, Protocol):
    """An autopilot that flies."""

    @property
    def takeoff_modes(self) -> Modes: ...

    @property
    def land_modes(self) -> Modes: ...

    @property
    def land(self) -> Command: ...

    @property
    def disarm(self) -> Command: ...

    def takeoff(self, height_m: float, home_amsl_m: float) -> tuple[Command, ...]:
        """Arm and climb to a height above home, given home's height above mean sea level."""
        ...

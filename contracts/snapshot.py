"""What the orchestrator knows at one moment: immutable, every fluent with its source and received stamps."""

from collections.abc import Mapping

import msgspec


class Point(msgspec.Struct, frozen=True, tag="point"):
    """World ENU, metres."""

    x: float
    y: float
    z: float = 0.0


FluentValue = bool | float | str | Point
"""A place is a Point where it was measured, and a name where it is predicted (a dry run, the prover)."""


class Stamped(msgspec.Struct, frozen=True):
    """A fluent's value with mission time at its source and when it was received, nanoseconds."""

    value: FluentValue
    source_ns: int
    received_ns: int


STATUSES = ("ok", "absent", "ambiguous", "uncertain", "outside_zone", "not_a_person")
"""What a run-time value's status may be."""


class ValueReading(msgspec.Struct, frozen=True, kw_only=True):
    """A run-time value. `status` is `ok`, or says why there is no position.

    `absent`: nobody was seen. `ambiguous`: several were, at `candidates`. `uncertain`: one was, too badly to be sent
    to. `outside_zone`: one was, but not where the search was for. `not_a_person`: something of another shape was.
    """

    name: str
    status: str
    position: Point | None = None
    near: bool | None = None
    """For a person: whether in reach of the robot that publishes it; None where that is not observed."""
    sigma_m: float | None = None
    """One-sigma horizontal uncertainty, metres."""
    covariance_m2: tuple[float, float, float] | None = None
    """Of the horizontal position: xx, xy, yy."""
    looks: int = 0
    candidates: tuple[Point, ...] = ()
    """Where somebody or something was seen if there is no position: for a person to choose from, never for a robot."""
    stamp_ns: int
    """Mission time of the observation at its source."""


class StampedValue(msgspec.Struct, frozen=True):
    """A run-time value as received, with the robot that published it."""

    reading: ValueReading
    source: str
    received_ns: int


class RobotState(msgspec.Struct, frozen=True, kw_only=True):
    """One robot as last heard. `unavailable` is empty, or the reason in a few words."""

    name: str
    kind_digest: str = ""
    boot_id: str = ""
    unavailable: str = ""
    stopped: bool = False
    running: str = ""
    """The skill that the robot itself says it is running."""
    lease: str = ""
    """The mission that holds the robot, empty if none does."""
    fluents: Mapping[str, Stamped] = {}


class Snapshot(msgspec.Struct, frozen=True, kw_only=True):
    """The world as the gate sees it."""

    robots: Mapping[str, RobotState] = {}
    values: Mapping[str, StampedValue] = {}
    stopped: bool = False
    """A stop of the whole crew is in force."""

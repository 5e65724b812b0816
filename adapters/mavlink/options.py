"""The options of a robot's part of the crew file that this adapter reads."""

from typing import Annotated

import msgspec
from msgspec import Meta

Positive = Annotated[float, Meta(gt=0)]
NotNegative = Annotated[float, Meta(ge=0)]
Degrees = Annotated[float, Meta(gt=5, lt=160)]


class VehicleOptions(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """What every vehicle has."""

    signing_key: str = ""
    """File with the 32 bytes (64 hexadecimal digits) that the link is signed with; without it the link is unsigned."""
    allow_unsigned: bool = False
    """Let the checklist pass without a signed link: for a cable, not for a radio."""
    system_id: Annotated[int, Meta(ge=1, le=254)] | None = None
    """MAVLink system; without it, the first vehicle of the right kind that is heard."""
    connect_timeout_s: Positive = 15.0
    min_battery_percent: Annotated[float, Meta(ge=0, le=100)] = 15.0
    stall_s: Positive = 8.0
    """A skill fails after this long without progress."""


class QuadcopterOptions(VehicleOptions, frozen=True, kw_only=True, forbid_unknown_fields=True):
    cruise_mps: Positive = 3.0
    ceiling_m: Positive = 10.0
    """The adapter's own limit of height above home."""
    arrive_m: Positive = 0.5
    """How far from a point, and from a height, still counts as there."""
    fov_x_deg: Degrees = 80.0
    """The camera's full field of view along the image's width, which lies along body y (to the sides)."""
    fov_y_deg: Degrees = 64.0
    """And along the image's height, which lies along body x (fore and aft)."""
    overlap: Annotated[float, Meta(ge=0, le=0.9)] = 0.7
    """Share of the footprint that neighbouring lanes of a sweep have in common."""
    target_height_m: NotNegative = 0.3
    """Height of the plane that detections are projected to, above home."""
    target_extent_m: tuple[Positive, Positive] = (0.1, 0.8)
    """The least and the largest extent of a person as seen from any side; a thing outside it is no person."""
    confirm_hover_s: NotNegative = 5.0
    """Time to hover over a fix for a better one; 0 leaves it out."""
    hover_s: NotNegative = 10.0
    """Time to hover before landing, in `hover_then_land`."""


class RoverOptions(VehicleOptions, frozen=True, kw_only=True, forbid_unknown_fields=True):
    cruise_mps: Positive = 0.5
    arrive_m: Positive = 0.3
    """How far from the last way-point still counts as there."""
    robot_radius_m: Positive = 0.2
    clearance_m: NotNegative = 0.25
    """Distance to keep from known obstacles, on top of the robot's radius."""
    front_m: NotNegative = 0.15
    """From the scanner to the front of the robot."""
    gap_m: NotNegative = 0.1
    """It comes no nearer than this to what the scanner sees ahead."""
    cell_m: Annotated[float, Meta(ge=0.05, le=1.0)] = 0.2
    """Cell of the occupancy grid."""

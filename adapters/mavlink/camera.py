"""From a detection's angles to a point on the ground. Pure.

Body FRD, x forward, y right, z down; the camera looks along +z. World ENU, metres.
"""

import math

import msgspec

from crew.adapters.mavlink.track import Pose

STEEPEST = math.cos(math.radians(75.0))
"""A ray flatter than 15 degrees above the ground plane hits it too far away to mean anything."""


class Look(msgspec.Struct, frozen=True):
    """Where one detection points to: world metres, the ray's length, and mission time.

    frame: equal for detections of one image. extent_m: the larger of its extents across the ray; NaN if not told.
    """

    x_m: float
    y_m: float
    range_m: float
    time_s: float
    frame: float = -1.0
    extent_m: float = math.nan


def ground_point(pose: Pose, forward_rad: float, right_rad: float, plane_m: float) -> tuple[float, float] | None:
    """Where the ray meets the plane at height `plane_m`; None if it does not meet it clearly."""
    body = (math.tan(forward_rad), math.tan(right_rad), 1.0)
    north, east, down = body_to_ned(body, pose.roll_rad, pose.pitch_rad, pose.heading_rad)
    drop_m = pose.height_m - plane_m
    if drop_m <= 0 or down < STEEPEST * math.hypot(north, east, down):
        return None
    scale = drop_m / down
    return pose.x_m + east * scale, pose.y_m + north * scale


def body_to_ned(
    vector: tuple[float, float, float], roll_rad: float, pitch_rad: float, heading_rad: float
) -> tuple[float, float, float]:
    """A body FRD vector in NED: roll about x, then pitch about y, then heading about z."""
    x, y, z = vector
    y, z = y * math.cos(roll_rad) - z * math.sin(roll_rad), y * math.sin(roll_rad) + z * math.cos(roll_rad)
    x, z = x * math.cos(pitch_rad) + z * math.sin(pitch_rad), z * math.cos(pitch_rad) - x * math.sin(pitch_rad)
    cos, sin = math.cos(heading_rad), math.sin(heading_rad)
    return x * cos - y * sin, x * sin + y * cos, z


def footprint_m(height_m: float, fov_deg: float) -> float:
    """Length of ground in view along one axis, from a level camera."""
    return 2.0 * height_m * math.tan(math.radians(fov_deg) / 2.0)

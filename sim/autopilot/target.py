"""Where a position command points, in the world frame (ENU, metres; heights above home). Pure."""

import math
from typing import NamedTuple

from crew.sim.autopilot.command import Command
from crew.sim.geo import GeoFrame


class Target(NamedTuple):
    x_m: float
    y_m: float
    z_m: float


def resolve(command: Command, geo: GeoFrame, here: Target, home_alt_m: float) -> Target | None:
    """The target; what the command leaves out is taken from `here`. None for a wrong frame or no place on Earth."""
    lat_here_deg, lon_here_deg = geo.to_geo(here.x_m, here.y_m)
    lat_deg = lat_here_deg if math.isnan(command.x) else command.x
    lon_deg = lon_here_deg if math.isnan(command.y) else command.y
    height_m = command.height_m(home_alt_m, here.z_m)
    if height_m is None or not on_earth(lat_deg, lon_deg):
        return None
    return Target(*geo.to_world(lat_deg, lon_deg), height_m)


def on_earth(lat_deg: float, lon_deg: float) -> bool:
    """False for NaN as well."""
    return abs(lat_deg) <= 90.0 and abs(lon_deg) <= 180.0


def inside_fence(target: Target, home: tuple[float, float], level_m: float, high_m: float) -> bool:
    """Whether the target lies within a cylinder around home; a limit of 0 is no limit."""
    away_m = math.hypot(target.x_m - home[0], target.y_m - home[1])
    return not (0.0 < level_m < away_m or 0.0 < high_m < target.z_m)

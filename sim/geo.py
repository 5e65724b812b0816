"""Flat-earth conversion between the world frame (ENU, metres) and latitude, longitude. Must not know MAVLink."""

import math

from crew.sim.map import Origin

EARTH_RADIUS_M = 6378137.0  # WGS84, semi-major axis


class GeoFrame:
    """The tangent plane at `origin`: good to a few centimetres over the hundreds of metres that a crew works in."""

    def __init__(self, origin: Origin) -> None:
        self.origin = origin
        self._deg_per_m_north = math.degrees(1.0 / EARTH_RADIUS_M)
        self._deg_per_m_east = self._deg_per_m_north / math.cos(math.radians(origin.lat_deg))

    def to_geo(self, x_m: float, y_m: float) -> tuple[float, float]:
        """World (east, north) to (latitude, longitude) in degrees."""
        lat_deg = self.origin.lat_deg + y_m * self._deg_per_m_north
        return lat_deg, self.origin.lon_deg + x_m * self._deg_per_m_east

    def to_world(self, lat_deg: float, lon_deg: float) -> tuple[float, float]:
        """Latitude and longitude in degrees to world (east, north)."""
        x_m = (lon_deg - self.origin.lon_deg) / self._deg_per_m_east
        return x_m, (lat_deg - self.origin.lat_deg) / self._deg_per_m_north


def wrap_rad(angle_rad: float) -> float:
    """The same angle within [-pi, pi]."""
    return math.remainder(angle_rad, math.tau)


def enu_yaw_to_heading_rad(yaw_rad: float) -> float:
    """Yaw counter-clockwise from east to heading clockwise from north, and, the map being its own inverse, back."""
    return wrap_rad(math.pi / 2 - yaw_rad)

"""The crew's world (ENU, metres) against latitude and longitude: flat earth at the crew's origin."""

import math

EARTH_RADIUS_M = 6_378_137.0
"""WGS 84 equatorial radius: within 0.4 % of the local radii, a few centimetres over a crew's area."""


class WorldFrame:
    """Conversion at one origin: latitude and longitude in degrees, altitude AMSL in metres."""

    def __init__(self, origin: tuple[float, float, float]) -> None:
        self._lat_deg, self._lon_deg, _ = origin
        self._north_m_per_deg = math.radians(EARTH_RADIUS_M)
        self._east_m_per_deg = self._north_m_per_deg * math.cos(math.radians(self._lat_deg))

    def to_geo(self, x_m: float, y_m: float) -> tuple[float, float]:
        """World east and north to latitude and longitude, degrees."""
        return self._lat_deg + y_m / self._north_m_per_deg, self._lon_deg + x_m / self._east_m_per_deg

    def to_world(self, lat_deg: float, lon_deg: float) -> tuple[float, float]:
        """Latitude and longitude in degrees to world east and north."""
        return (lon_deg - self._lon_deg) * self._east_m_per_deg, (lat_deg - self._lat_deg) * self._north_m_per_deg


def wrap_rad(angle_rad: float) -> float:
    """The same angle within [-pi, pi]."""
    return math.remainder(angle_rad, math.tau)

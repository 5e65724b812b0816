"""The adapter's own geofence: the operational area. Pure."""

import math

from crew.adapter import AdapterConfig
from crew.errors import AdapterError

BREACH_M = 2.0
"""How far outside the area a vehicle's own position may lie: a sweep's turn, a gust, the noise of an estimate."""


def check_inside(config: AdapterConfig, x_m: float, y_m: float, what: str) -> None:
    """Raise AdapterError `bad_argument` for what is no number, `out_of_bounds` for a point outside the area."""
    if not (math.isfinite(x_m) and math.isfinite(y_m)):
        raise AdapterError(f"{config.robot}: {what}: ({x_m}, {y_m}) is no point", code="bad_argument")
    x_min, x_max, y_min, y_max = config.area
    if config.geofence and not (x_min <= x_m <= x_max and y_min <= y_m <= y_max):
        raise AdapterError(
            f"{config.robot}: {what}: ({x_m:g}, {y_m:g}) is outside the area "
            f"x [{x_min:g}, {x_max:g}], y [{y_min:g}, {y_max:g}]",
            code="out_of_bounds",
        )


def check_breach(config: AdapterConfig, x_m: float, y_m: float) -> None:
    """Raise AdapterError `geofence_breach` if the vehicle itself is well outside the area."""
    x_min, x_max, y_min, y_max = config.area
    beyond_m = max(x_min - x_m, x_m - x_max, y_min - y_m, y_m - y_max)
    if config.geofence and not beyond_m <= BREACH_M:
        raise AdapterError(
            f"{config.robot}: it is at ({x_m:.1f}, {y_m:.1f}), {beyond_m:.1f} m outside the area "
            f"x [{x_min:g}, {x_max:g}], y [{y_min:g}, {y_max:g}]; is the crew file's origin right?",
            code="geofence_breach",
        )

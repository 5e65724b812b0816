"""The adapter's own geofence: the operational area. Pure."""

import math

from crew.adapter import AdapterConfig
from crew.errors import AdapterError


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

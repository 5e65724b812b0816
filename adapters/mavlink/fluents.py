"""The fluents that vehicles of every kind have, as telemetry shows them."""

from crew.adapter import Reading
from crew.adapters.mavlink.telemetry import Telemetry
from crew.contracts.snapshot import Point


def common_fluents(telemetry: Telemetry, moving_mps: float) -> dict[str, Reading]:
    """`at` (world ENU, z above home), `moving` and `battery`; what was never heard is absent."""
    found: dict[str, Reading] = {}
    if (motion := telemetry.motion) is not None:
        value = motion.value
        found["at"] = Reading(Point(value.x_m, value.y_m, value.height_m), motion.stamp_ns)
        found["moving"] = Reading(value.ground_speed_mps > moving_mps, motion.stamp_ns)
    if (battery := telemetry.battery_percent) is not None:
        found["battery"] = Reading(battery.value, battery.stamp_ns)
    return found

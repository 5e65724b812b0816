"""What a rover's scanner says on the way to one place. Decides nothing: the skill asks it at each poll."""

import math
from collections.abc import Sequence

from crew.adapter import Place
from crew.adapters.ground.occupancy import Disc, Spot
from crew.adapters.mavlink.options import RoverOptions
from crew.adapters.mavlink.surroundings import Scan, in_the_way, new_obstacles
from crew.adapters.mavlink.telemetry import Motion, Sample
from crew.adapters.mavlink.vehicle import Vehicle

LOOKAHEAD_M = 0.9
"""It stops for unknown things nearer than this: its way to a stop, and room to turn."""
BEFORE_M = 0.4
"""A thing right ahead counts as what it was sent to this far outside the stand-off: the errors of fix and position."""
SCAN_MAX_AGE_S = 1.0


class Watch:
    """What the scanner says on the way to one place; a vehicle without a scanner says nothing."""

    def __init__(self, vehicle: Vehicle, place: Place, met: Sequence[Disc], options: RoverOptions) -> None:
        self._vehicle = vehicle
        self._place = place
        self._known = (*vehicle.config.obstacles, *met)
        self._options = options
        self._seen_ns = 0

    def in_the_way(self, spot: Spot) -> list[Disc]:
        """Unknown obstacles, if one of them is in the way to `spot`; each scan is looked at once."""
        told, motion, heading = self._told()
        if told is None or motion is None or heading is None or told.stamp_ns == self._seen_ns:
            return []
        self._seen_ns = told.stamp_ns
        here = (motion.x_m, motion.y_m)
        target, target_m = (self._place.x, self._place.y), self._place.standoff_m
        found = new_obstacles(told.value.hits(here, heading), self._known, target, target_m)
        width_m = self._options.robot_radius_m
        return found if in_the_way(found, here, spot, width_m, LOOKAHEAD_M) else []

    def before_it(self) -> bool:
        """Whether what it was sent to stands right ahead, as near as it may come."""
        told, motion, _ = self._told()
        if told is None or motion is None or self._place.standoff_m == 0.0:
            return False
        left_m = math.dist((motion.x_m, motion.y_m), (self._place.x, self._place.y))
        touching = told.value.ahead_m() <= self._options.front_m + self._options.gap_m
        return touching and left_m < self._place.standoff_m + BEFORE_M

    def _told(self) -> tuple[Sample[Scan] | None, Motion | None, float | None]:
        told = self._vehicle.telemetry
        fresh = told.scan if told.age_s(told.scan) < SCAN_MAX_AGE_S else None
        motion = None if told.motion is None else told.motion.value
        return fresh, motion, None if told.heading is None else told.heading.value

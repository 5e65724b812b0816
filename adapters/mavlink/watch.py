"""What is in a rover's way by its scanner and by the crew's drones. Decides nothing: the skill asks it at each poll."""

import math
from collections.abc import Sequence

from crew.adapter import Place
from crew.adapters.ground.occupancy import Disc, Spot
from crew.adapters.mavlink.options import RoverOptions
from crew.adapters.mavlink.others import Others
from crew.adapters.mavlink.surroundings import HIT_RADIUS_M, Scan, in_the_way, new_obstacles
from crew.adapters.mavlink.telemetry import Motion, Sample
from crew.adapters.mavlink.vehicle import Vehicle

LOOKAHEAD_M = 0.9
"""It stops for unknown things nearer than this: its way to a stop, and room to turn."""
BEFORE_M = 0.4
"""A thing right ahead counts as what it was sent to this far outside the stand-off: the errors of fix and position."""
SCAN_MAX_AGE_S = 1.0
MOVED_M = 0.5
"""A drone that comes down this far from where it was counts anew."""


class Watch:
    """What is said on the way to one place; a vehicle without a scanner is told of drones that come down alone."""

    def __init__(
        self, vehicle: Vehicle, place: Place, met: Sequence[Disc], options: RoverOptions, others: Others
    ) -> None:
        self._others, self._met = others, met
        self._vehicle = vehicle
        self._place = place
        self._known = (*vehicle.config.obstacles, *met)
        self._options = options
        self._seen_ns = 0

    def in_the_way(self, spot: Spot) -> list[Disc]:
        """New obstacles, if one of them is in the way to `spot`; each scan is looked at once."""
        return self._below_a_drone(spot) or self._scanned(spot)

    def _below_a_drone(self, spot: Spot) -> list[Disc]:
        """Columns that are not known yet, if one of them is in the way."""
        motion = self._vehicle.telemetry.motion
        if motion is None:
            return []
        here, width_m = (motion.value.x_m, motion.value.y_m), self._options.robot_radius_m
        known = [met[:2] for met in self._met if met[2] > 2 * HIT_RADIUS_M]
        new = [c for c in self._others.columns() if all(math.dist(c[:2], spot) > MOVED_M for spot in known)]
        leaving = [c for c in new if math.dist(here, c[:2]) >= c[2] or math.dist(spot, c[:2]) < c[2]]
        return leaving if in_the_way(leaving, here, spot, width_m, LOOKAHEAD_M) else []

    def _scanned(self, spot: Spot) -> list[Disc]:
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

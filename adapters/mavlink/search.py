"""What a search saw: detections projected to the ground, and the reading made of them. Flies nothing."""

import math

from crew.adapters.mavlink.camera import Look, ground_point
from crew.adapters.mavlink.fix import Fix, combine
from crew.adapters.mavlink.telemetry import Telemetry
from crew.clock import SECOND_NS, seconds_ns
from crew.contracts.snapshot import Point, ValueReading

VICTIM = "victim"


class Search:
    """The detections of one search, from its construction on. `plane_m`: height of what is detected."""

    def __init__(self, telemetry: Telemetry, plane_m: float) -> None:
        self._telemetry = telemetry
        self._plane_m = plane_m
        telemetry.sightings.clear()

    @property
    def damaged_ns(self) -> int | None:
        """When a detection came whose angles are no numbers: after that no position may be given."""
        return next((s.stamp_ns for s in reversed(self._telemetry.sightings) if not s.finite), None)

    def fix(self) -> Fix | None:
        """The combined position, or None if nobody was seen."""
        return combine(self._looks())

    def reading(self, now_ns: int) -> ValueReading:
        """What is published: a position, NaN for a damaged detection, or why there is no position."""
        if (damaged_ns := self.damaged_ns) is not None:
            nowhere = Point(math.nan, math.nan, math.nan)
            return ValueReading(name=VICTIM, status="ok", position=nowhere, stamp_ns=damaged_ns)
        fix = self.fix()
        if fix is None:
            return ValueReading(name=VICTIM, status="absent", stamp_ns=now_ns)
        stamp_ns = seconds_ns(fix.last_s)
        if fix.ambiguous:
            return ValueReading(name=VICTIM, status="ambiguous", looks=fix.looks, stamp_ns=stamp_ns)
        position = Point(fix.x_m, fix.y_m, 0.0)
        return ValueReading(
            name=VICTIM, status="ok", position=position, sigma_m=fix.sigma_m, looks=fix.looks, stamp_ns=stamp_ns
        )

    def _looks(self) -> list[Look]:
        looks = []
        for sighting in self._telemetry.sightings:
            pose = self._telemetry.track.at(sighting.boot_s)
            if pose is None or not sighting.finite:
                continue
            point = ground_point(pose, sighting.forward_rad, sighting.right_rad, self._plane_m)
            if point is not None:
                range_m = math.dist((pose.x_m, pose.y_m, pose.height_m), (*point, self._plane_m))
                looks.append(Look(*point, range_m, sighting.stamp_ns / SECOND_NS))
        return looks

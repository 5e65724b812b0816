"""What a search saw: detections projected to the ground, and the reading made of them. Flies nothing."""

import math

from crew.adapters.mavlink.camera import Look, ground_point
from crew.adapters.mavlink.crowd import Crowd, tell_apart
from crew.adapters.mavlink.fix import Fix
from crew.adapters.mavlink.sweep import Zone
from crew.adapters.mavlink.telemetry import Sighting, Telemetry
from crew.clock import SECOND_NS, seconds_ns
from crew.contracts.snapshot import Point, ValueReading

VICTIM = "victim"
TRUSTED_LOOKS = 3
TRUSTED_SIGMA_M = 0.35


class Search:
    """The detections of one search, from its construction on. `plane_m`: height of what is detected.

    `extent_m`: the least and the largest extent of a person. `zone`: where the person is looked for.
    """

    def __init__(self, telemetry: Telemetry, plane_m: float, extent_m: tuple[float, float], zone: Zone) -> None:
        self._telemetry = telemetry
        self._plane_m = plane_m
        self._extent_m = extent_m
        self._zone = zone
        self._hovered_s: float | None = None
        telemetry.sightings.clear()

    @property
    def damaged_ns(self) -> int | None:
        """When a detection came whose angles are no numbers: after that no position may be given."""
        return next((s.stamp_ns for s in reversed(self._telemetry.sightings) if not s.finite), None)

    def crowd(self) -> Crowd:
        """Who and what was seen so far."""
        return tell_apart(self._looks(), self._extent_m)

    def fix(self) -> Fix | None:
        """The one person in the zone; None if there is nobody, or more than one."""
        people = self._inside(self.crowd())
        return people[0] if len(people) == 1 else None

    def hovering(self, now_ns: int) -> None:
        """From now on the camera looks straight down on the fix."""
        self._hovered_s = now_ns / SECOND_NS

    def reading(self, now_ns: int) -> ValueReading:
        """What is published: a position, NaN for a damaged detection, or why there is no position."""
        if (damaged_ns := self.damaged_ns) is not None:
            nowhere = Point(math.nan, math.nan, math.nan)
            return ValueReading(name=VICTIM, status="ok", position=nowhere, stamp_ns=damaged_ns)
        crowd = self.crowd()
        people = self._inside(crowd)
        if len(people) > 1:
            return _no_position("ambiguous", people)
        if people:
            return _position(people[0]) if self._trusted(people[0]) else _no_position("uncertain", people)
        if crowd.people:
            return _no_position("outside_zone", list(crowd.people))
        if crowd.others:
            return _no_position("not_a_person", list(crowd.others))
        return ValueReading(name=VICTIM, status="absent", stamp_ns=now_ns)

    def _trusted(self, fix: Fix) -> bool:
        """Seen often, well enough, and from above too if the vehicle hovered there."""
        if self._hovered_s is not None and fix.last_s <= self._hovered_s:
            return False
        return fix.looks >= TRUSTED_LOOKS and fix.sigma_m <= TRUSTED_SIGMA_M

    def _inside(self, crowd: Crowd) -> list[Fix]:
        """People who may be inside the zone, by two sigma."""
        return [fix for fix in crowd.people if self._zone.beyond_m(fix.x_m, fix.y_m) <= 2.0 * fix.sigma_m]

    def _looks(self) -> list[Look]:
        return [look for sighting in self._telemetry.sightings if (look := self._look(sighting)) is not None]

    def _look(self, sighting: Sighting) -> Look | None:
        pose = self._telemetry.track.at(sighting.boot_s)
        if pose is None or not sighting.finite:
            return None
        point = ground_point(pose, sighting.forward_rad, sighting.right_rad, self._plane_m)
        if point is None:
            return None
        range_m = math.dist((pose.x_m, pose.y_m, pose.height_m), (*point, self._plane_m))
        extent_m = range_m * sighting.extent_rad
        return Look(*point, range_m, sighting.stamp_ns / SECOND_NS, sighting.boot_s, extent_m)


def _position(fix: Fix) -> ValueReading:
    return ValueReading(
        name=VICTIM,
        status="ok",
        position=Point(fix.x_m, fix.y_m, 0.0),
        sigma_m=fix.sigma_m,
        covariance_m2=fix.covariance_m2,
        looks=fix.looks,
        stamp_ns=seconds_ns(fix.last_s),
    )


def _no_position(status: str, fixes: list[Fix]) -> ValueReading:
    """Somebody or something was seen and no position may be given; the places are for a person to judge."""
    return ValueReading(
        name=VICTIM,
        status=status,
        looks=sum(fix.looks for fix in fixes),
        candidates=tuple(Point(fix.x_m, fix.y_m) for fix in fixes),
        stamp_ns=seconds_ns(max(fix.last_s for fix in fixes)),
    )

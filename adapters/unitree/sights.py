"""What the side channel shows, in the robot's frame and as the values that the kind publishes."""

import math

import mink

from crew.adapters.unitree.robot import Robot
from crew.adapters.unitree.telemetry import Sample, Seen
from crew.contracts.snapshot import Point, ValueReading

OUT_OF_SIGHT_S = 1.0
RENEW_S = 0.5
"""A value that has not changed its status is published again after this long."""
SIGMA_M = 0.01


class Sights:
    """The robot stands at a fixed place: x, y in metres and heading in degrees, world ENU."""

    def __init__(self, robot: Robot, stands_at: tuple[float, float, float], reach_m: float) -> None:
        self._robot = robot
        self._x, self._y, heading_deg = stands_at
        self.heading_rad = math.radians(heading_deg)
        self._cos, self._sin = math.cos(self.heading_rad), math.sin(self.heading_rad)
        self._reach_m = reach_m
        self._told: dict[str, ValueReading] = {}
        self._renewed_ns: dict[str, int] = {}

    def to_base(self, x: float, y: float, z: float) -> tuple[float, float, float]:
        """A point of the world in the robot's frame."""
        dx, dy = x - self._x, y - self._y
        return self._cos * dx + self._sin * dy, -self._sin * dx + self._cos * dy, z

    def to_world(self, pose: mink.SE3) -> tuple[float, float, float]:
        """A hand's place in the world."""
        x, y, z = pose.translation().tolist()
        return self._x + self._cos * x - self._sin * y, self._y + self._sin * x + self._cos * y, z

    def values(self) -> dict[str, ValueReading]:
        """Things and people; each reading is renewed twice a second, or when its status changes."""
        told = self._robot.telemetry
        for name, sample in told.objects.items():
            self._renew(name, sample, None)
        for name, sample in told.people.items():
            self._renew(name, sample, self._near(sample.value))
        return self._told

    def nearest_person(self) -> Seen | None:
        """The person in sight whose hand is nearest and within reach."""
        told = self._robot.telemetry
        near = [s.value for s in told.people.values() if told.age_s(s) <= OUT_OF_SIGHT_S and self._near(s.value)]
        return min(near, key=self._away_m, default=None)

    def object_at(self, point: tuple[float, float, float], within_m: float) -> str:
        """The object that is seen nearest to a point, if any is near enough; else empty."""
        told = self._robot.telemetry
        seen = [s.value for s in told.objects.values() if told.age_s(s) <= OUT_OF_SIGHT_S]
        found = min(seen, key=lambda s: math.dist((s.x, s.y, s.z), point), default=None)
        return found.name if found is not None and math.dist((found.x, found.y, found.z), point) < within_m else ""

    def _near(self, seen: Seen) -> bool:
        return self._away_m(seen) <= self._reach_m

    def _away_m(self, seen: Seen) -> float:
        return math.dist((self._x, self._y), seen.spot)

    def _renew(self, name: str, sample: Sample[Seen], near: bool | None) -> None:
        told = self._robot.telemetry
        status = "ok" if told.age_s(sample) <= OUT_OF_SIGHT_S else "absent"
        now_ns, last = self._robot.clock.now_ns(), self._told.get(name)
        unchanged = last is not None and last.status == status and last.near == (near if status == "ok" else None)
        if unchanged and now_ns - self._renewed_ns[name] < RENEW_S * 1e9:
            return
        self._renewed_ns[name] = now_ns
        seen = sample.value
        self._told[name] = ValueReading(
            name=name,
            status=status,
            position=Point(seen.x, seen.y, seen.z) if status == "ok" else None,
            near=near if status == "ok" else None,
            sigma_m=SIGMA_M if status == "ok" else None,
            stamp_ns=sample.stamp_ns if status == "ok" else now_ns,
        )

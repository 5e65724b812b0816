"""What stands around a ground vehicle, by its scanner: points on the ground, new obstacles, what is right ahead. Pure.

World ENU, metres; beams go clockwise from straight ahead, as OBSTACLE_DISTANCE counts them.
"""

import math
from collections.abc import Iterable, Iterator, Sequence

import msgspec

from crew.adapters.ground.occupancy import Disc, Spot, distance_to_segment_m

HIT_RADIUS_M = 0.12
"""What a beam has met is at least this large."""
KNOWN_M = 0.35
"""A hit this near to a known obstacle, or to the target, is that."""
NEAR_M = 2.0
AHEAD_RAD = math.radians(20.0)


class Scan(msgspec.Struct, frozen=True):
    """Distances in metres, infinite where nothing is; the first beam's bearing and the step, radians clockwise."""

    ranges_m: tuple[float, ...]
    first_rad: float
    step_rad: float

    def beams(self) -> Iterator[tuple[float, float]]:
        """Bearing and distance of what was met."""
        for index, range_m in enumerate(self.ranges_m):
            if math.isfinite(range_m):
                yield math.remainder(self.first_rad + index * self.step_rad, math.tau), range_m

    def ahead_m(self) -> float:
        """Distance to the nearest thing ahead; infinite if there is none."""
        return min((r for bearing, r in self.beams() if abs(bearing) <= AHEAD_RAD), default=math.inf)

    def hits(self, here: Spot, heading_rad: float) -> list[Spot]:
        """Where the near beams end, for a vehicle at `here` that heads there (clockwise from north)."""
        return [
            (here[0] + r * math.sin(heading_rad + bearing), here[1] + r * math.cos(heading_rad + bearing))
            for bearing, r in self.beams()
            if r <= NEAR_M
        ]


def new_obstacles(hits: Iterable[Spot], known: Sequence[Disc], target: Spot, target_m: float) -> list[Disc]:
    """Discs for hits that no known obstacle explains, nor the target, which is `target_m` around its place."""
    found: list[Disc] = []
    for spot in hits:
        explained = math.dist(spot, target) <= target_m + KNOWN_M
        explained = explained or any(math.dist(spot, (x, y)) <= r + KNOWN_M for x, y, r in known)
        if not explained and all(math.dist(spot, (x, y)) > HIT_RADIUS_M / 2 for x, y, _ in found):
            found.append((*spot, HIT_RADIUS_M))
    return found


def in_the_way(obstacles: Iterable[Disc], here: Spot, end: Spot, width_m: float, reach_m: float) -> Disc | None:
    """The first obstacle that a vehicle of half `width_m` would meet within `reach_m` on the straight way to `end`."""
    length_m = math.dist(here, end)
    if length_m == 0.0:
        return None
    share = min(1.0, reach_m / length_m)
    near = (here[0] + share * (end[0] - here[0]), here[1] + share * (end[1] - here[1]))
    return next((d for d in obstacles if distance_to_segment_m(d[:2], here, near) < d[2] + width_m), None)

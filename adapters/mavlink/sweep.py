"""A lawn-mower path that shows every point of a rectangle to a downward camera. Pure. World ENU, metres."""

import itertools
import math

import msgspec

EDGE_M = 0.5
"""The footprint reaches this far over the zone's edge, for the vehicle's tilt and its pose error."""


class Zone(msgspec.Struct, frozen=True):
    x_min: float
    x_max: float
    y_min: float
    y_max: float

    def beyond_m(self, x_m: float, y_m: float) -> float:
        """How far outside a point lies; 0 inside."""
        return math.hypot(max(self.x_min - x_m, 0.0, x_m - self.x_max), max(self.y_min - y_m, 0.0, y_m - self.y_max))


class Sweep(msgspec.Struct, frozen=True):
    """Way-points in order, and the heading (radians clockwise from north) that the camera keeps: along the lanes."""

    points: tuple[tuple[float, float], ...]
    heading_rad: float


def plan_sweep(zone: Zone, along_m: float, across_m: float, overlap: float, start: tuple[float, float]) -> Sweep:
    """The shorter of the sweeps along x and along y, from the corner nearest to `start`.

    `along_m` and `across_m` are the footprint's lengths along the camera's forward axis and across it; neighbouring
    lanes share `overlap` of it. All way-points lie within the zone.
    """
    xs, ys = (zone.x_min, zone.x_max), (zone.y_min, zone.y_max)
    east = tuple(_lanes(xs, ys, along_m, across_m, overlap, start))
    north = tuple((x, y) for y, x in _lanes(ys, xs, along_m, across_m, overlap, start[::-1]))
    options = (Sweep(east, math.pi / 2), Sweep(north, 0.0))
    return min(options, key=lambda sweep: path_length_m((start, *sweep.points)))


def path_length_m(points: tuple[tuple[float, float], ...]) -> float:
    """Length of a polyline."""
    return sum(math.dist(a, b) for a, b in itertools.pairwise(points))


def _lanes(
    along: tuple[float, float],
    across: tuple[float, float],
    along_m: float,
    across_m: float,
    overlap: float,
    start: tuple[float, float],
) -> list[tuple[float, float]]:
    """Lane ends as (along, across), the first near `start`."""
    near, far = sorted(_inset(*along, along_m), key=lambda end: abs(end - start[0]))
    first, last = sorted(_inset(*across, across_m), key=lambda side: abs(side - start[1]))
    usable_m = max(across_m - 2 * EDGE_M, across_m / 2) * (1.0 - overlap)
    gaps = math.ceil(abs(last - first) / usable_m)
    sides = [first + (last - first) * i / gaps for i in range(gaps + 1)] if gaps else [first]
    ends = [(near, far) if i % 2 == 0 else (far, near) for i in range(len(sides))]
    return [(end, side) for side, pair in zip(sides, ends, strict=True) for end in dict.fromkeys(pair)]


def _inset(low: float, high: float, footprint_m: float) -> tuple[float, float]:
    """The interval from which a footprint still reaches over both ends; its middle if it is longer than that."""
    reach_m = max(footprint_m / 2 - EDGE_M, footprint_m / 4)
    if high - low <= 2 * reach_m:
        middle = (low + high) / 2
        return middle, middle
    return low + reach_m, high - reach_m

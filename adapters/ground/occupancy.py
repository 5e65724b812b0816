"""Where a rover may be: discs grown by its own size, and a grid over them. Pure. World ENU, metres."""

import math
from collections import defaultdict
from collections.abc import Iterator, Sequence

Spot = tuple[float, float]
Disc = tuple[float, float, float]
"""An obstacle: x, y, radius."""
Cell = tuple[int, int]

SLACK_M = 0.02
"""A spot that clearance was given up for lies this far outside."""
STEPS = ((1, 0), (-1, 0), (0, 1), (0, -1), (1, 1), (1, -1), (-1, 1), (-1, -1))


class Ground:
    """Where a point robot may be: inside the area and outside every disc, the robot's radius and a clearance added.

    Clearance is given up where `start` or `target` needs it; a start that lies closer still may be left.
    """

    def __init__(
        self,
        area: tuple[float, float, float, float],
        obstacles: Sequence[Disc],
        *,
        radius_m: float,
        clearance_m: float,
        start: Spot,
        target: Spot,
    ) -> None:
        self.area = area
        self._discs: list[Disc] = []
        for x, y, r in obstacles:
            grown_m = r + radius_m + clearance_m
            grown_m = min(grown_m, max(r + radius_m, math.dist(target, (x, y)) - SLACK_M))
            grown_m = min(grown_m, max(r, math.dist(start, (x, y)) - SLACK_M))
            self._discs.append((x, y, grown_m))

    def free(self, spot: Spot) -> bool:
        """Whether the robot may stand at `spot`."""
        return self.within(spot) and all(math.dist(spot, (x, y)) >= r for x, y, r in self._discs)

    def within(self, spot: Spot) -> bool:
        """Whether `spot` lies inside the area."""
        x_min, x_max, y_min, y_max = self.area
        return x_min <= spot[0] <= x_max and y_min <= spot[1] <= y_max

    def clear(self, start: Spot, end: Spot) -> bool:
        """Whether the straight way between two free spots is free."""
        return all(distance_to_segment_m((x, y), start, end) >= r for x, y, r in self._discs)

    @property
    def discs(self) -> Sequence[Disc]:
        """The obstacles as grown."""
        return self._discs


class Grid:
    """Square cells over a ground; each knows the discs near it, so that most steps need no check at all."""

    def __init__(self, ground: Ground, cell_m: float) -> None:
        self._ground = ground
        self._cell_m = cell_m
        self._near: defaultdict[Cell, list[Disc]] = defaultdict(list)
        for disc in ground.discs:
            for cell in self._cells_around(disc):
                self._near[cell].append(disc)

    def cell(self, spot: Spot) -> Cell:
        """The cell whose centre is nearest."""
        x_min, _, y_min, _ = self._ground.area
        return round((spot[0] - x_min) / self._cell_m), round((spot[1] - y_min) / self._cell_m)

    def centre(self, cell: Cell) -> Spot:
        """A cell's centre in the world."""
        x_min, _, y_min, _ = self._ground.area
        return x_min + cell[0] * self._cell_m, y_min + cell[1] * self._cell_m

    def steps(self, cell: Cell) -> Iterator[tuple[Cell, float]]:
        """Neighbouring cells to which the straight way is free, and its length."""
        here, near = self.centre(cell), self._near.get(cell, [])
        for dx, dy in STEPS:
            neighbour = (cell[0] + dx, cell[1] + dy)
            there = self.centre(neighbour)
            if self._ground.within(there) and all(distance_to_segment_m(d[:2], here, there) >= d[2] for d in near):
                yield neighbour, math.hypot(dx, dy) * self._cell_m

    def _cells_around(self, disc: Disc) -> Iterator[Cell]:
        """Cells from which a step may touch a disc."""
        x, y, radius_m = disc
        reach_m = radius_m + 1.5 * self._cell_m
        left, low = self.cell((x - reach_m, y - reach_m))
        right, high = self.cell((x + reach_m, y + reach_m))
        for i in range(left, right + 1):
            for j in range(low, high + 1):
                if math.dist(self.centre((i, j)), (x, y)) <= reach_m:
                    yield i, j


def distance_to_segment_m(point: Spot, start: Spot, end: Spot) -> float:
    """Distance of a point from a segment."""
    dx, dy = end[0] - start[0], end[1] - start[1]
    length2 = dx * dx + dy * dy
    along = ((point[0] - start[0]) * dx + (point[1] - start[1]) * dy) / length2 if length2 else 0.0
    along = min(1.0, max(0.0, along))
    return math.hypot(point[0] - start[0] - along * dx, point[1] - start[1] - along * dy)

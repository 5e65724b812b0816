"""A way around known obstacles: A* on an occupancy grid, then the few way-points that matter. Pure.

World ENU, metres. Obstacles are discs (x, y, radius); the robot is a point among discs grown by its own size.
"""

import heapq
import math
from collections.abc import Iterator, Sequence

from crew.errors import AdapterError

Spot = tuple[float, float]
Disc = tuple[float, float, float]
Cell = tuple[int, int]

RING_M = 0.3
"""A cell this far outside the stand-off circle still counts as beside the target."""
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
        x_min, x_max, y_min, y_max = self.area
        if not (x_min <= spot[0] <= x_max and y_min <= spot[1] <= y_max):
            return False
        return all(math.dist(spot, (x, y)) >= r for x, y, r in self._discs)

    def clear(self, start: Spot, end: Spot) -> bool:
        """Whether the straight way between two free spots is free."""
        return all(distance_to_segment_m((x, y), start, end) >= r for x, y, r in self._discs)


def plan_route(ground: Ground, start: Spot, target: Spot, standoff_m: float, cell_m: float) -> list[Spot]:
    """Way-points from `start` (left out) to a spot `standoff_m` from `target`, or to the target itself for 0.

    Raises AdapterError `no_path`.
    """
    cells = _search(ground, start, target, standoff_m, cell_m)
    if cells is None:
        raise AdapterError(
            f"no way from ({start[0]:.1f}, {start[1]:.1f}) to within {standoff_m:g} m of "
            f"({target[0]:.1f}, {target[1]:.1f}) around the known obstacles",
            code="no_path",
        )
    spots = [start, *(_centre(ground, cell, cell_m) for cell in cells)]
    end = _end_spot(ground, spots[-1], target, standoff_m)
    if end != spots[-1]:
        spots.append(end)
    return _shortcut(ground, spots)[1:]


def distance_to_segment_m(point: Spot, start: Spot, end: Spot) -> float:
    """Distance of a point from a segment."""
    dx, dy = end[0] - start[0], end[1] - start[1]
    length2 = dx * dx + dy * dy
    along = ((point[0] - start[0]) * dx + (point[1] - start[1]) * dy) / length2 if length2 else 0.0
    along = min(1.0, max(0.0, along))
    return math.hypot(point[0] - start[0] - along * dx, point[1] - start[1] - along * dy)


def _search(ground: Ground, start: Spot, target: Spot, standoff_m: float, cell_m: float) -> list[Cell] | None:
    """Cells from the one of `start` to one beside the target, cheapest first."""
    first = _cell(ground, start, cell_m)
    came: dict[Cell, Cell | None] = {first: None}
    cost = {first: 0.0}
    queue = [(0.0, first)]
    closed: set[Cell] = set()
    while queue:
        _, cell = heapq.heappop(queue)
        if cell in closed:
            continue
        closed.add(cell)
        here = _centre(ground, cell, cell_m)
        if _beside(ground, here, target, standoff_m, cell_m):
            return list(_back(came, cell))[::-1]
        for neighbour, step in _neighbours(ground, cell, cell_m):
            price = cost[cell] + step
            if price < cost.get(neighbour, math.inf):
                came[neighbour], cost[neighbour] = cell, price
                there = _centre(ground, neighbour, cell_m)
                left_m = max(0.0, abs(math.dist(there, target) - standoff_m) - RING_M)
                heapq.heappush(queue, (price + left_m, neighbour))
    return None


def _neighbours(ground: Ground, cell: Cell, cell_m: float) -> Iterator[tuple[Cell, float]]:
    here = _centre(ground, cell, cell_m)
    for dx, dy in STEPS:
        neighbour = (cell[0] + dx, cell[1] + dy)
        there = _centre(ground, neighbour, cell_m)
        if ground.free(there) and ground.clear(here, there):
            yield neighbour, math.hypot(dx, dy) * cell_m


def _beside(ground: Ground, here: Spot, target: Spot, standoff_m: float, cell_m: float) -> bool:
    """Whether the end spot can be reached straight from a cell's centre."""
    distance_m = math.dist(here, target)
    reach_m = RING_M if standoff_m > 0 else cell_m
    if not -cell_m <= distance_m - standoff_m <= reach_m or not ground.free(here):
        return False
    end = _end_spot(ground, here, target, standoff_m)
    return ground.free(end) and ground.clear(here, end)


def _end_spot(ground: Ground, here: Spot, target: Spot, standoff_m: float) -> Spot:
    """The spot on the stand-off circle in the direction of `here`, or `here` itself if that is not free."""
    distance_m = math.dist(here, target)
    if standoff_m == 0 or distance_m == 0:
        return target
    scale = standoff_m / distance_m
    end = (target[0] + (here[0] - target[0]) * scale, target[1] + (here[1] - target[1]) * scale)
    return end if ground.free(end) or distance_m < standoff_m else here


def _shortcut(ground: Ground, spots: list[Spot]) -> list[Spot]:
    """The same way with every spot left out that a straight line can skip."""
    kept, index = [spots[0]], 0
    while index < len(spots) - 1:
        ahead = range(len(spots) - 1, index, -1)
        index = next((i for i in ahead if ground.clear(spots[index], spots[i])), index + 1)
        kept.append(spots[index])
    return kept


def _back(came: dict[Cell, Cell | None], cell: Cell | None) -> Iterator[Cell]:
    while cell is not None:
        yield cell
        cell = came[cell]


def _cell(ground: Ground, spot: Spot, cell_m: float) -> Cell:
    return round((spot[0] - ground.area[0]) / cell_m), round((spot[1] - ground.area[2]) / cell_m)


def _centre(ground: Ground, cell: Cell, cell_m: float) -> Spot:
    return ground.area[0] + cell[0] * cell_m, ground.area[2] + cell[1] * cell_m

"""A way around known obstacles: A* on a grid, then the few way-points that matter. Pure. World ENU, metres."""

import heapq
import math
from collections.abc import Iterator

from crew.adapters.ground.occupancy import Cell, Grid, Ground, Spot
from crew.errors import AdapterError

RING_M = 0.3
"""A cell this far outside the stand-off circle still counts as beside the target."""


def plan_route(ground: Ground, start: Spot, target: Spot, standoff_m: float, cell_m: float) -> list[Spot]:
    """Way-points from `start` (left out) to a spot `standoff_m` from `target`, or to the target itself for 0.

    Raises AdapterError `no_path`.
    """
    grid = Grid(ground, cell_m)
    cells = _search(ground, grid, start, target, standoff_m, cell_m)
    if cells is None:
        raise AdapterError(
            f"no way from ({start[0]:.1f}, {start[1]:.1f}) to within {standoff_m:g} m of "
            f"({target[0]:.1f}, {target[1]:.1f}) around the known obstacles",
            code="no_path",
        )
    spots = [start, *(grid.centre(cell) for cell in cells)]
    end = _end_spot(ground, spots[-1], target, standoff_m)
    if end != spots[-1]:
        spots.append(end)
    return _shortcut(ground, spots)[1:]


def _search(
    ground: Ground, grid: Grid, start: Spot, target: Spot, standoff_m: float, cell_m: float
) -> list[Cell] | None:
    """Cells from one beside `start` to one beside the target, cheapest first."""
    first = _first_cell(ground, grid, start)
    came: dict[Cell, Cell | None] = {first: None}
    cost = {first: 0.0}
    queue = [(0.0, first)]
    closed: set[Cell] = set()
    while queue:
        _, cell = heapq.heappop(queue)
        if cell in closed:
            continue
        closed.add(cell)
        here = grid.centre(cell)
        if _beside(ground, here, target, standoff_m, cell_m):
            return list(_back(came, cell))[::-1]
        for neighbour, step in grid.steps(cell):
            price = cost[cell] + step
            if price < cost.get(neighbour, math.inf):
                came[neighbour], cost[neighbour] = cell, price
                there = grid.centre(neighbour)
                left_m = max(0.0, abs(math.dist(there, target) - standoff_m) - RING_M)
                heapq.heappush(queue, (price + left_m, neighbour))
    return None


def _first_cell(ground: Ground, grid: Grid, start: Spot) -> Cell:
    """The nearest cell that can be reached straight from `start`; its own one if there is none."""
    column, row = grid.cell(start)
    around = [(column + i, row + j) for i in range(-2, 3) for j in range(-2, 3)]
    around.sort(key=lambda cell: math.dist(grid.centre(cell), start))
    reachable = (c for c in around if ground.free(grid.centre(c)) and ground.clear(start, grid.centre(c)))
    return next(reachable, (column, row))


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

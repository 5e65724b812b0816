"""The crew's other robots, as far as a vehicle keeps clear of them. World ENU, metres. Decides nothing."""

import math

from crew.adapter import Neighbour
from crew.adapters.ground.occupancy import Disc


class Others:
    """Each one's last word, which counts until the next; and how far to keep from those on the ground or above."""

    def __init__(self, separation_m: float) -> None:
        self._separation_m = separation_m
        self._known: dict[str, Neighbour] = {}

    def meet(self, neighbour: Neighbour) -> None:
        """Take one's last word; a place that is no number is left out, and what was known before stays."""
        if math.isfinite(neighbour.x) and math.isfinite(neighbour.y):
            self._known[neighbour.robot] = neighbour

    def below(self, x_m: float, y_m: float) -> str:
        """Who may stand or drive too near below a point; empty if nobody."""
        near = (o for o in self._known.values() if o.standing and self._gap_m(o, x_m, y_m) < self._separation_m)
        return next((other.robot for other in near), "")

    def standing(self) -> list[Disc]:
        """Where nobody may come down."""
        return [(o.x, o.y, self._separation_m) for o in self._known.values() if o.standing]

    def columns(self) -> list[Disc]:
        """Where somebody may be coming down: no place to drive to or through."""
        return [(o.x, o.y, self._separation_m) for o in self._known.values() if o.coming_down]

    @staticmethod
    def _gap_m(other: Neighbour, x_m: float, y_m: float) -> float:
        return math.hypot(other.x - x_m, other.y - y_m)

"""How far a run has come along its way, for people to look at. It steers nothing."""

from collections.abc import Callable, Sequence

from crew.adapter import Course
from crew.adapters.mavlink.sweep import path_length_m
from crew.errors import AdapterError


class Way:
    """The legs of a run, and how much of the present one is left. World ENU, metres."""

    def __init__(self) -> None:
        self._points: tuple[tuple[float, float], ...] = ()
        self._leg = 0
        self._whole_m = 0.0
        self._gap_m: Callable[[], float] | None = None

    def plan(self, here: tuple[float, float], points: Sequence[tuple[float, float]]) -> None:
        """The whole way, from here on; its first leg leads to the first point."""
        self._points, self._leg = tuple(points), -1
        self._whole_m = path_length_m((here, *points))

    def leg(self, gap_m: Callable[[], float]) -> None:
        """Another leg begins; `gap_m` is what is left of it. Without a plan it is the whole way."""
        self._gap_m = gap_m
        if self._points:
            self._leg += 1
        else:
            self._whole_m = max(self._whole_m, gap_m())

    def course(self) -> Course | None:
        """Where the run is on its way; None before its first leg, or without a position."""
        if self._gap_m is None:
            return None
        try:
            left_m = self._gap_m() + path_length_m(self._points[self._leg :])
        except AdapterError:
            return None
        if self._whole_m <= 0.0:
            return None
        return Course(share=min(max(1.0 - left_m / self._whole_m, 0.0), 1.0), left_m=left_m)

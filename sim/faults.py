"""The registry of faults: their names and which are on. Must not act on anything; vehicles and camera ask it."""

import difflib
from collections.abc import Iterable

SHARED = ("battery_low", "gps_loss", "link_loss", "missed_detection", "nan_transmission")


class Faults:
    """Which faults are on. `<robot>_unavailable` exists for each robot of the scene."""

    def __init__(self, robots: Iterable[str], on: Iterable[str] = (), shared: tuple[str, ...] = SHARED) -> None:
        self.names = tuple(sorted((*shared, *(unavailable(robot) for robot in robots))))
        self._on: set[str] = set()
        for name in on:
            self.set(name, True)

    def set(self, name: str, on: bool) -> None:
        """Switch a fault. Raises ValueError with the valid names and the nearest for an unknown one."""
        if name not in self.names:
            near = difflib.get_close_matches(name, self.names, n=1, cutoff=0.0)
            raise ValueError(f"unknown fault {name!r}; valid: {', '.join(self.names)}; nearest: {near[0]}")
        (self._on.add if on else self._on.discard)(name)

    def is_on(self, name: str) -> bool:
        return name in self._on


def unavailable(robot: str) -> str:
    return f"{robot}_unavailable"

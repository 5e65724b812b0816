"""The registry of faults: their names, which are on and from when. Must not act on anything; others ask it.

Written `NAME`, or `NAME@SECONDS` for one that begins in mid-mission, at that mission time.
"""

import difflib
from collections.abc import Iterable

SHARED = (
    "battery_low", "blocked_path", "gps_loss", "link_loss", "missed_detection", "nan_transmission", "unmapped_obstacle",
    "wind_gusts",
)  # fmt: skip
NS = 1_000_000_000


class Faults:
    """Which faults are on. `<robot>_unavailable` exists for each robot of the scene."""

    def __init__(self, robots: Iterable[str], on: Iterable[str] = (), shared: tuple[str, ...] = SHARED) -> None:
        self.names = tuple(sorted((*shared, *(unavailable(robot) for robot in robots))))
        self._on: set[str] = set()
        self._later: list[tuple[int, str]] = []
        for text in on:
            self.schedule(text)

    def schedule(self, text: str) -> None:
        """Switch a fault on, now or at the time that its text gives. Raises ValueError."""
        name, timed, seconds = text.partition("@")
        self._check(name)
        if not timed:
            self._on.add(name)
            return
        try:
            at_ns = round(float(seconds) * NS)
        except (ValueError, OverflowError):
            at_ns = -1
        if at_ns < 0:
            raise ValueError(f"fault {text!r}: {seconds!r} is no mission time; write {name}@40 for 40 s")
        self._later.append((at_ns, name))

    def switch(self, text: str, on: bool) -> None:
        """Switch a fault by its text; one with a time is switched on then. Raises ValueError."""
        if on and "@" in text:
            self.schedule(text)
        else:
            self.set(text, on)

    def set(self, name: str, on: bool) -> None:
        """Switch a fault. Raises ValueError with the valid names and the nearest for an unknown one."""
        self._check(name)
        (self._on.add if on else self._on.discard)(name)

    def is_on(self, name: str) -> bool:
        return name in self._on

    def advance(self, now_ns: int) -> None:
        """Switch on what has become due."""
        for at_ns, name in [later for later in self._later if later[0] <= now_ns]:
            self._later.remove((at_ns, name))
            self._on.add(name)

    def _check(self, name: str) -> None:
        if name not in self.names:
            near = difflib.get_close_matches(name, self.names, n=1, cutoff=0.0)
            raise ValueError(f"unknown fault {name!r}; valid: {', '.join(self.names)}; nearest: {near[0]}")


def unavailable(robot: str) -> str:
    return f"{robot}_unavailable"

"""Who holds which robot. A mission gets all of its robots at once, in the order of asking, or waits."""

from collections.abc import Mapping, Sequence


class LeaseTable:
    """Robot to mission; waiting missions in order."""

    def __init__(self) -> None:
        self._held: dict[str, str] = {}
        self._waiting: dict[str, tuple[str, ...]] = {}
        self._granted = 0
        self._numbers: dict[str, int] = {}

    @property
    def held(self) -> Mapping[str, str]:
        """Robot to the mission that holds it."""
        return self._held

    def ask(self, mission: str, robots: Sequence[str], *, first: bool = False) -> None:
        """Queue a mission for its robots; `first` puts one that preempts ahead of the others."""
        entry = {mission: tuple(robots)}
        self._waiting = {**entry, **self._waiting} if first else {**self._waiting, **entry}

    def grant(self) -> list[str]:
        """Give robots to every waiting mission that can have all of its own; nobody overtakes for a robot in demand."""
        granted: list[str] = []
        wanted: set[str] = set()
        for mission, robots in list(self._waiting.items()):
            free = not any(r in self._held or r in wanted for r in robots)
            if free:
                self._held.update(dict.fromkeys(robots, mission))
                del self._waiting[mission]
                self._granted += 1
                self._numbers[mission] = self._granted
                granted.append(mission)
            else:
                wanted.update(robots)
        return granted

    def number(self, mission: str) -> int:
        """The number of a mission's lease, greater than that of every lease granted before; 0 if it has none."""
        return self._numbers.get(mission, 0)

    def holders(self, robots: Sequence[str]) -> list[str]:
        """Missions that hold any of these robots."""
        return sorted({self._held[r] for r in robots if r in self._held})

    def release(self, mission: str) -> None:
        """Give back everything that a mission holds or waits for."""
        self._waiting.pop(mission, None)
        self._numbers.pop(mission, None)
        self._held = {robot: holder for robot, holder in self._held.items() if holder != mission}

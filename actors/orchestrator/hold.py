"""The stop as the orchestrator holds it up: numbered, kept on disk, in force until every robot was released."""

import time
from collections.abc import Iterable
from pathlib import Path

import msgspec

from crew.clock import WALL, seconds_ns
from crew.home import replace_file
from crew.messages import RobotState, StopStatus

ADOPT_S = 1.0
"""Wall time for which a robot may be latched before a stop that did not come here is held up for all."""


class KeptStop(msgspec.Struct, frozen=True, kw_only=True):
    """What is on disk: the newest stop's number, who asked for it, and whom it holds."""

    number: int = 0
    by: str = ""
    reason: str = ""
    at_wall_ns: int = 0
    held: tuple[str, ...] = ()


class StopHold:
    """Which robots a stop holds. A robot confirms it by telling its number, and leaves it when it is unlatched then.

    What a robot says before it was told of this stop, in this epoch, is about an earlier one.
    """

    def __init__(self, robots: Iterable[str], path: Path | None = None, *, epoch: int = 0) -> None:
        self._robots, self._path, self._epoch = tuple(robots), path, epoch
        self._kept = _read(path, self._robots)
        self._unconfirmed = set(self._kept.held)
        self._latched_ns: dict[str, int] = {}

    @property
    def number(self) -> int:
        return self._kept.number

    @property
    def held(self) -> tuple[str, ...]:
        return self._kept.held

    @property
    def holds_all(self) -> bool:
        return set(self.held) == set(self._robots)

    @property
    def unconfirmed(self) -> list[str]:
        """Held robots that have not said since the stop that they are latched."""
        return sorted(self._unconfirmed)

    def stop(self, by: str, reason: str = "") -> None:
        """A new stop holds every robot. It is on disk when this returns."""
        self._unconfirmed = set(self._robots)
        self._keep(
            KeptStop(number=self.number + 1, by=by, reason=reason, at_wall_ns=time.time_ns(), held=tuple(self._robots))
        )

    def hear_state(self, state: RobotState) -> None:
        """A robot's own word. Who was told of the stop has latched for it; unlatched, it was released from it."""
        if state.stopped:
            self._latched_ns.setdefault(state.robot, WALL.now_ns())
        else:
            self._latched_ns.pop(state.robot, None)
        if state.robot not in self.held or state.told < (self._epoch, self.number):
            return
        self._unconfirmed.discard(state.robot)
        if not state.stopped:
            held = tuple(name for name in self.held if name != state.robot)
            self._keep(msgspec.structs.replace(self._kept, held=held))

    def rebooted(self, robot: str) -> None:
        """A robot that starts anew has to confirm anew."""
        self._latched_ns.pop(robot, None)
        if robot in self.held:
            self._unconfirmed.add(robot)

    def stray(self) -> str:
        """A robot that has been latched for a while though no stop holds it: that stop did not come here."""
        now_ns = WALL.now_ns()
        late = (n for n, since_ns in self._latched_ns.items() if now_ns - since_ns > seconds_ns(ADOPT_S))
        return next((name for name in late if name not in self.held), "")

    def status(self, still: Iterable[str]) -> StopStatus:
        """Who is latched, who has confirmed standing still, and who is to be treated as still moving."""
        confirmed = sorted(set(self.held) & set(still) - self._unconfirmed)
        return StopStatus(
            number=self.number,
            by=self._kept.by,
            reason=self._kept.reason,
            at_wall_ns=self._kept.at_wall_ns,
            latched=tuple(sorted(set(self.held) - self._unconfirmed)),
            still=tuple(confirmed),
            treat_as_moving=tuple(sorted(set(self.held) - set(confirmed))),
        )

    def _keep(self, kept: KeptStop) -> None:
        self._kept = kept
        if self._path is not None:
            replace_file(self._path, msgspec.json.encode(kept), durable=True)


def _read(path: Path | None, robots: tuple[str, ...]) -> KeptStop:
    """What was kept. A file that can't be read holds every robot: nobody knows what it held."""
    if path is None or not path.exists():
        return KeptStop()
    try:
        kept = msgspec.json.decode(path.read_bytes(), type=KeptStop)
    except (OSError, msgspec.MsgspecError):
        return KeptStop(number=1, by=f"an unreadable {path}", at_wall_ns=time.time_ns(), held=robots)
    return msgspec.structs.replace(kept, held=tuple(name for name in robots if name in kept.held))

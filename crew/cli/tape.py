"""What each lane has been doing lately, one character a stretch of time: drawn from what was seen while watching."""

from collections.abc import Mapping
from typing import NamedTuple

from crew.contracts.mission_state import ACTIVE, ENDS, Phase, StepPhase
from crew.messages import CrewStatus, MissionStatus, RobotStatus, StepStatus

SHORTEST_S = 30.0
LONGEST_S = 300.0
_ACTIVE = frozenset(str(phase) for phase in ACTIVE)
_PENDING = frozenset({str(StepPhase.PENDING), str(StepPhase.DECIDING)})


class Look(NamedTuple):
    """How a stretch looks, and what it means; meaning never rests on the colour alone."""

    char: str
    colour: str
    meaning: str


PLANNING = Look("~", "violet", "planning")
ASKING = Look("?", "amber", "a person is asked")
WAITING = Look(":", "amber", "waits for robots")
EXECUTING = Look("=", "dim", "executing")
SKILL = Look("█", "blue", "a skill")
HELD = Look("░", "amber", "held")
SAFE = Look("▒", "teal", "reaching a safe state")
STOPPED = Look("S", "red", "stopped")
LOST = Look("x", "red", "not available")
IDLE = Look(" ", "", "")
LOOKS = (PLANNING, ASKING, WAITING, EXECUTING, SKILL, HELD, SAFE, STOPPED, LOST)

_BY_PHASE: Mapping[str, Look] = {
    Phase.RECEIVED: PLANNING,
    Phase.PLANNING: PLANNING,
    Phase.VALIDATING: PLANNING,
    Phase.ASKING: ASKING,
    Phase.WAITING: WAITING,
    Phase.EXECUTING: EXECUTING,
    Phase.HALTING: SAFE,
    Phase.CANCELLING: SAFE,
}


def look_of_robot(robot: RobotStatus, missions: tuple[MissionStatus, ...]) -> Look:
    """What a robot is doing now."""
    if robot.unavailable:
        return LOST
    if robot.stopped:
        return STOPPED
    steps = [s for m in missions if m.phase not in ENDS for s in m.steps if s.robot == robot.robot]
    active = next((s for s in steps if s.phase in _ACTIVE), None)
    if active is not None:
        return SAFE if is_safe(active) else SKILL
    if any(s.phase == StepPhase.ASKING for s in steps):
        return ASKING
    return HELD if any(s.phase in _PENDING for s in steps) and robot.lease else IDLE


def is_safe(step: StepStatus) -> bool:
    """Whether it brings a role to its safe state."""
    return step.step.startswith("safe:")


def is_active(step: StepStatus) -> bool:
    """Whether its robot may be moving because of it."""
    return step.phase in _ACTIVE


def is_pending(step: StepStatus) -> bool:
    return step.phase in _PENDING


class Tape:
    """Samples of every lane over mission time."""

    def __init__(self) -> None:
        self._samples: dict[str, list[tuple[float, Look]]] = {}
        self._first_s: float | None = None

    def take(self, status: CrewStatus) -> None:
        """One moment of everybody."""
        at_s = status.at_ns / 1e9
        self._first_s = at_s if self._first_s is None else self._first_s
        for mission in status.missions:
            self._put(mission.mission, at_s, _BY_PHASE.get(mission.phase, IDLE))
        for robot in status.robots:
            self._put(robot.robot, at_s, look_of_robot(robot, status.missions))

    def _put(self, lane: str, at_s: float, look: Look) -> None:
        samples = self._samples.setdefault(lane, [])
        if not samples or samples[-1][1] is not look:
            samples.append((at_s, look))
        while len(samples) > 1 and samples[1][0] < at_s - LONGEST_S:
            samples.pop(0)

    def window_s(self, now_s: float) -> float:
        """How much time a strip spans."""
        seen_s = now_s - (now_s if self._first_s is None else self._first_s)
        return min(max(seen_s, SHORTEST_S), LONGEST_S)

    def strip(self, lane: str, width: int, now_s: float) -> list[Look]:
        """The lane's last stretch, one look a column; the right end is now."""
        samples, span_s = self._samples.get(lane, []), self.window_s(now_s)
        found = []
        for column in range(width):
            until_s = now_s - span_s * (width - 1 - column) / max(width, 1)
            known = [look for at_s, look in samples if at_s <= until_s]
            found.append(known[-1] if known else IDLE)
        return found

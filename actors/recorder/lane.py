"""The lanes of the timeline: which states each may show, and which of them a robot is in."""

from collections.abc import Iterable
from typing import NamedTuple

from crew.actors.recorder.entry import LaneChange
from crew.contracts.mission.record import SAFE
from crew.contracts.mission_state import ACTIVE, ENDS, OPEN, MissionState, Phase, StepPhase
from crew.contracts.site import Rules

MISSION_LANE = "mission"
PHASE_TONES = {
    Phase.RECEIVED: "idle",
    Phase.PLANNING: "plan",
    Phase.VALIDATING: "plan",
    Phase.ASKING: "ask",
    Phase.WAITING: "hold",
    Phase.EXECUTING: "run",
    Phase.HALTING: "safe",
    Phase.CANCELLING: "safe",
    Phase.COMPLETED: "good",
    Phase.REJECTED: "bad",
    Phase.HALTED: "bad",
    Phase.CANCELLED: "idle",
}
HELD = "held at the gate"
LEASED = "waits for its lease"
REFUSED = "refused"
FAILED = "failed"
UNKNOWN = "outcome unknown"
STOPPED = "stopped"
LOST = "not available"
_ALWAYS = {HELD: "hold", LEASED: "hold", REFUSED: "bad", FAILED: "bad", UNKNOWN: "bad", STOPPED: "stop", LOST: "idle"}
_ENDED = {
    StepPhase.REFUSED: REFUSED,
    StepPhase.FAILED: FAILED,
    StepPhase.UNKNOWN: UNKNOWN,
}
SKILL_TONES = 8
"""Tones `skill0`, `skill1`... tell skills apart."""


def robot_lane(robot: str) -> str:
    """The lane of one robot."""
    return f"robot/{robot}"


def lanes(rules: Rules) -> dict[str, dict[str, str]]:
    """Every lane with its states, each with its tone, in the order in which they are shown."""
    found = {MISSION_LANE: {str(phase): tone for phase, tone in PHASE_TONES.items()}}
    number = 0
    for spec in rules.crew.robots:
        skills = [skill.name for skill in rules.kinds[spec.kind].skills]
        states = {name: f"skill{(number + i) % SKILL_TONES}" for i, name in enumerate(skills)}
        states |= {f"{SAFE} {name}": "safe" for name in skills}
        found[robot_lane(spec.name)] = states | _ALWAYS
        number += len(skills)
    return found


class RobotLanes:
    """The present state of each robot's lane, from its missions and from what it tells of itself."""

    def __init__(self, robots: Iterable[str]) -> None:
        self._shown = dict.fromkeys(robots, "")
        self._of_itself = dict.fromkeys(self._shown, "")
        self._wanted: dict[str, dict[str, _Wish]] = {robot: {} for robot in self._shown}

    def mission(self, mission: MissionState) -> list[LaneChange]:
        """A mission has changed: its robots may be doing something else."""
        if mission.instance is not None:
            for robot in mission.instance.roles.values():
                self._want(robot, mission)
        return self._changes()

    def itself(self, robot: str, *, unavailable: bool, stopped: bool) -> list[LaneChange]:
        """What a robot tells of itself outranks what a mission wants of it."""
        self._of_itself[robot] = LOST if unavailable else STOPPED if stopped else ""
        return self._changes()

    def _want(self, robot: str, mission: MissionState) -> None:
        """Of missions that have ended only the last one is remembered: how it went stays on show."""
        wanted = self._wanted[robot]
        if mission.phase in ENDS:
            self._wanted[robot] = wanted = {m: wish for m, wish in wanted.items() if not wish.over and m != mission.id}
        wanted[mission.id] = doing(robot, mission)

    def _changes(self) -> list[LaneChange]:
        changes = []
        for robot, before in self._shown.items():
            wishes = self._wanted[robot].values()
            now = self._of_itself[robot] or max(wishes, key=lambda wish: wish.rank, default=_NOTHING).state
            if now != before:
                self._shown[robot] = now
                changes.append(LaneChange(robot_lane(robot), now))
        return changes


class _Wish(NamedTuple):
    """What one mission does with a robot; of several missions the highest rank is shown."""

    rank: int
    state: str
    over: bool = False


_NOTHING = _Wish(0, "")


def doing(robot: str, mission: MissionState) -> _Wish:
    """What one robot does for one mission, as a state of its lane."""
    assert mission.instance is not None
    over = mission.phase in ENDS
    own = [r for r in mission.steps.values() if r.call.robot == robot]
    role = next((role for role, r in mission.instance.roles.items() if r == robot), "")
    if (safe := mission.safe.get(role)) is not None and safe.phase in ACTIVE:
        return _Wish(5, f"{SAFE} {safe.call.skill}")
    if running := next((r for r in own if r.phase in ACTIVE), None):
        return _Wish(5, running.call.skill)
    if ended := next((_ENDED[r.phase] for r in own if r.phase in _ENDED), ""):
        return _Wish(1 if over else 4, ended, over)
    if not over and mission.phase is Phase.WAITING:
        return _Wish(2, LEASED)
    if mission.phase is Phase.EXECUTING and any(r.phase in OPEN for r in own):
        return _Wish(3, HELD)
    return _Wish(0, "", over)

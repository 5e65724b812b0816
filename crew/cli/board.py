"""The watch's page as lines: missions with their steps, lanes, robots, the last words. Pure: it reads no terminal."""

import textwrap
from collections import deque
from collections.abc import Iterator

from crew.cli.screen import Line, Piece, fitted, line
from crew.cli.tape import LOOKS, Look, Tape, is_active, is_pending, is_safe
from crew.contracts.mission_state import ENDS
from crew.contracts.snapshot import FluentValue, Point
from crew.messages import CrewStatus, MissionEvent, MissionStatus, Progress, RobotStatus, StepStatus
from crew.visible import one_line

LATEST = 8
ENDED_SHOWN = 2
"""Of the missions that have ended, the last ones are still shown."""
FRESH_S, OLD_S = 1.0, 3.0
BAR = 14
_SIGNS = {
    "succeeded": ("✓", "green"),
    "refused": ("✗", "red"),
    "failed": ("✗", "red"),
    "cancelled": ("–", "amber"),
    "unknown": ("?", "amber"),
    "deciding": ("·", "blue"),
    "pending": ("·", "dim"),
    "asking": ("?", "amber"),
}
_NEXT = {"asking": "once it is confirmed", "waiting": "once its robots are free"}
_PHASES = {"completed": "green", "rejected": "red", "halted": "red", "cancelled": "amber", "asking": "amber"}


class Board:
    """What is known of a crew, and how it is shown."""

    def __init__(self, crew: str, run: str) -> None:
        self._crew, self._run = crew, run
        self._status: CrewStatus | None = None
        self._tape = Tape()
        self._events: deque[MissionEvent] = deque(maxlen=64)
        self.silent_s = 0.0
        """How long the orchestrator has not answered."""

    def take(self, status: CrewStatus) -> None:
        """The crew's newest status."""
        self._status, self.silent_s = status, 0.0
        self._tape.take(status)

    def hear(self, event: MissionEvent) -> None:
        self._events.append(event)

    def lines(self, width: int, height: int) -> list[Line]:
        """The page; what does not fit is cut from the last words first."""
        status = self._status
        if status is None:
            waiting = "the orchestrator has not answered yet; who lives of the crew: crew status"
            return [line(Piece(self._crew, "bold"), f"  {waiting}")]
        head = [*self._head(status), *self._missions(status, width), *self._lanes(status, width)]
        head += self._robots(status, width)
        room = min(LATEST, height - len(head) - 3)
        return [*head, *self._latest(room), line(), line(Piece("Ctrl-C ends the watch, not the crew", "dim"))]

    # --- the crew

    def _head(self, status: CrewStatus) -> Iterator[Line]:
        clock = Piece(f"{_clock(status.at_ns / 1e9)} of mission time", "dim")
        yield line(Piece(status.crew, "bold"), "   ", clock, Piece(f"   run {self._run}", "dim"))
        if self.silent_s > FRESH_S:
            yield line(
                Piece(f" the orchestrator has not answered for {self.silent_s:.0f} s: nothing is dispatched ", "alarm")
            )
        if status.stopped:
            moving = [r.robot for r in status.robots if not r.still]
            doubt = f"; treat as moving: {', '.join(moving)}" if moving else "; everybody stands still"
            yield line(Piece(f" STOPPED{doubt} ", "alarm"), "   release: crew reset")
        yield line()

    # --- missions

    def _missions(self, status: CrewStatus, width: int) -> Iterator[Line]:
        open_ = [m for m in status.missions if m.phase not in ENDS]
        ended = [m for m in status.missions if m.phase in ENDS][-ENDED_SHOWN:]
        if not open_ and not ended:
            yield line(Piece('no mission yet; ask for something: crew request "..."', "dim"))
            yield line()
        for mission in [*ended, *open_]:
            yield from _mission(mission, status, width)
            yield line()

    # --- lanes

    def _lanes(self, status: CrewStatus, width: int) -> Iterator[Line]:
        names = [m.mission for m in status.missions if m.phase not in ENDS] + [r.robot for r in status.robots]
        label = min(max((len(name) for name in names), default=0), 14) + 2
        room = max(width - label - 2, 10)
        now_s, seen = status.at_ns / 1e9, set[Look]()
        for name in names:
            strip = self._tape.strip(name, room, now_s)
            seen |= set(strip)
            yield line(fitted(name, label), *_runs(strip), Piece("▏", "dim"))
        left = fitted(f"{'':{label}}{self._tape.window_s(now_s):.0f} s ago", label + room - 3)
        yield line(Piece(f"{left}now", "dim"))
        keys = [
            p for look in LOOKS if look in seen for p in (Piece(look.char, look.colour), Piece(f" {look.meaning}   "))
        ]
        yield line(f"{'':{label}}", *keys)
        yield line()

    # --- robots

    def _robots(self, status: CrewStatus, width: int) -> Iterator[Line]:
        wide = max((len(r.robot) for r in status.robots), default=0)
        for robot in status.robots:
            yield line(Piece(fitted(robot.robot, wide), "bold"), "  ", *_robot(robot, self.silent_s))
        yield line()

    # --- the last words

    def _latest(self, room: int) -> Iterator[Line]:
        for event in list(self._events)[-room:] if room > 0 else ():
            colour = "red" if event.code else "green" if event.outcome == "completed" else "dim"
            yield line(
                Piece(f"{event.at_s:8.2f} s  {event.mission}  ", "dim"), Piece(one_line(event.text, 300), colour)
            )


def _mission(mission: MissionStatus, status: CrewStatus, width: int) -> Iterator[Line]:
    spent = f"   {mission.spent_s:.0f} of {mission.deadline_s:g} s" if mission.spent_s else ""
    contract = f"   {mission.contract}" if mission.contract else ""
    phase = Piece(mission.phase, _PHASES.get(mission.phase, "blue"))
    yield line(Piece(mission.mission, "bold"), "  ", phase, Piece(f"{contract}{spent}", "dim"))
    yield line(f'  "{one_line(mission.request, 200)}"')
    if mission.phase in ENDS:
        yield line("  ", Piece(one_line(mission.message, 300), _PHASES.get(mission.phase, "")))
        return
    if mission.waits_for:
        holders = ", ".join(mission.waits_for)
        yield line(
            "  ", Piece(f"waits for robots that {holders} holds", "amber"), f"   free them: crew cancel {holders}"
        )
    if mission.question:
        yield from _question(mission, width)
    wide = max((len(s.step) for s in mission.steps), default=0)
    named = max((len(s.robot) for s in mission.steps), default=0)
    for step in mission.steps:
        yield line("  ", *_step(step, mission, status, wide, named))


def _question(mission: MissionStatus, width: int) -> Iterator[Line]:
    """The question whole, and the commands that answer it."""
    for text in textwrap.wrap(one_line(mission.question, 1000), max(width - 6, 20)):
        yield line("  ", Piece(f"? {text}", "amber"))
    command = f"crew {'approve' if mission.step else 'confirm'} {mission.mission}"
    yes, no = command, f"{command} --no"
    yield line("    yes: ", Piece(yes, "bold"), "    no: ", Piece(no, "bold"))


def _step(step: StepStatus, mission: MissionStatus, status: CrewStatus, wide: int, named: int) -> Iterator[Piece]:
    sign, colour = ("▶", "blue") if is_active(step) else _SIGNS.get(step.phase, ("·", ""))
    plain = "bold" if is_active(step) else "dim" if is_pending(step) else ""
    yield Piece(f"{sign} ", colour)
    yield Piece(f"{fitted(step.step, wide)}  {fitted(step.robot, named)}  {fitted(step.skill, 18)}", plain)
    if is_active(step):
        yield from _running(step, status)
    elif is_pending(step):
        yield _waiting(step, mission)
    elif step.phase == "asking":
        yield Piece("  waits for a person's approval", "amber")
    elif step.phase != "succeeded":
        yield Piece(f"  {step.phase}{f' ({step.code})' if step.code else ''}", colour)


def _running(step: StepStatus, status: CrewStatus) -> Iterator[Piece]:
    """How long it runs already, and how far it has come."""
    robot = next((r for r in status.robots if r.robot == step.robot), None)
    told = None if robot is None else robot.progress
    if told is not None:
        yield from _progress(told)
    since = "" if step.since_s is None else f"  {step.since_s:.0f} s"
    looking = "  its effect is looked for" if step.phase == "confirming" else ""
    safe = "  to reach its safe state" if is_safe(step) else ""
    yield Piece(f"{since}{looking}{safe}", "dim")


def _progress(told: Progress) -> Iterator[Piece]:
    if told.share is not None:
        full = round(told.share * BAR)
        yield Piece("  " + "█" * full, "blue")
        yield Piece("░" * (BAR - full), "dim")
        yield Piece(f" {told.share * 100:3.0f}%")
    if told.left_m is not None:
        yield Piece(f"  {told.left_m:.0f} m to go")


def _waiting(step: StepStatus, mission: MissionStatus) -> Piece:
    """What a pending step waits for: steps that are not done, or its own robot."""
    steps = {s.step: s for s in mission.steps}
    open_ = [steps[n] for n in step.after if n in steps and steps[n].phase != "succeeded"]
    if not open_:
        return Piece(f"  {_NEXT.get(mission.phase, 'next') if step.phase == 'pending' else 'being decided'}", "dim")
    held = any(s.robot != step.robot for s in open_) and not _is_busy(step.robot, mission)
    names = ", ".join(f"{s.step} ({s.robot})" if s.robot != step.robot else s.step for s in open_)
    return Piece(f"  held: waits for {names}", "amber") if held else Piece(f"  after {names}", "dim")


def _is_busy(robot: str, mission: MissionStatus) -> bool:
    return any(is_active(s) for s in mission.steps if s.robot == robot)


def _robot(robot: RobotStatus, silent_s: float) -> Iterator[Piece]:
    yield Piece(fitted(robot.kind, 11), "dim")
    if robot.unavailable:
        yield Piece(f"  {one_line(robot.unavailable, 60)}", "red")
    elif robot.stopped:
        yield Piece(f"  stopped, {'standing still' if robot.still else 'not yet still'}", "red")
    else:
        yield Piece("  available", "green")
    if robot.age_s is None:
        yield Piece("  never heard", "red")
    else:
        age_s = robot.age_s + silent_s
        yield Piece(f"  state {age_s:.1f} s old", "dim" if age_s <= FRESH_S else "amber" if age_s <= OLD_S else "red")
    if robot.lease:
        yield Piece(f"  in {robot.lease}", "dim")
    yield from _fluents(robot)


def _fluents(robot: RobotStatus) -> Iterator[Piece]:
    """The battery first, with a colour; then what else telemetry shows."""
    battery = robot.fluents.get("battery")
    if isinstance(battery, float):
        yield Piece(f"  battery {battery:.0f}%", "red" if battery < 20 else "amber" if battery < 35 else "")
    for name, value in robot.fluents.items():
        if name != "battery" and (shown := _fluent(name, value)):
            yield Piece(f"  {shown}", "dim")


def _fluent(name: str, value: FluentValue) -> str:
    """A fluent in a few characters; what is false goes without saying."""
    if isinstance(value, bool):
        return name if value else ""
    if isinstance(value, Point):
        return f"{name} ({value.x:.1f}, {value.y:.1f})"
    return f"{name} {value:.1f}" if isinstance(value, float) else f"{name} {one_line(value, 24)}"


def _runs(strip: list[Look]) -> Iterator[Piece]:
    """Neighbouring columns of one look as one piece."""
    at = 0
    while at < len(strip):
        end = at
        while end < len(strip) and strip[end] is strip[at]:
            end += 1
        yield Piece(strip[at].char * (end - at), strip[at].colour)
        at = end


def _clock(seconds: float) -> str:
    minutes, rest = divmod(int(seconds), 60)
    return f"{minutes}:{rest:02d}"

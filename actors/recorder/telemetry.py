"""Folds what robots tell of themselves into what a page shows. Pure."""

from collections.abc import Iterator, Mapping

from crew.actors.recorder.entry import Entry, LogLine, Mark, Measure, Whereabouts
from crew.actors.recorder.lane import RobotLanes
from crew.actors.recorder.text import one_line
from crew.contracts.site import Rules
from crew.contracts.snapshot import FluentValue, Point, Snapshot, ValueReading
from crew.messages import RobotEvent, RobotState, RobotValue

PLACE_EVERY_NS = 200_000_000
CURVE_EVERY_NS = 1_000_000_000
PLACE_FLUENT = "at"
ALERTS = {"stopped": "stop", "orchestrator_lost": "bad", "dropped": "bad"}


class Telemetry:
    """All robots of a crew. What comes more often than it can be seen is thinned out."""

    def __init__(self, rules: Rules, lanes: RobotLanes) -> None:
        self._rules, self._lanes = rules, lanes
        self._due: dict[tuple[str, str], int] = {}
        self._heard_ns: dict[str, int] = {}
        self._told: dict[str, ValueReading] = {}

    def state(self, state: RobotState) -> Iterator[Entry]:
        """A robot's state."""
        if self._rules.crew.robot(state.robot) is None:
            return
        robot = state.robot
        self._heard_ns[robot] = state.at_ns
        yield from self._lanes.itself(robot, unavailable=bool(state.unavailable), stopped=state.stopped)
        if self._is_due(robot, "place", state.at_ns, PLACE_EVERY_NS):
            yield from _whereabouts(robot, state.fluents)
        if self._is_due(robot, "curve", state.at_ns, CURVE_EVERY_NS):
            yield from self._curves(robot, state)

    def ages(self, now_ns: int) -> Iterator[Entry]:
        """Robots that have fallen silent: the age of their last word grows."""
        for robot, heard_ns in self._heard_ns.items():
            silent_ns = now_ns - heard_ns
            if silent_ns > CURVE_EVERY_NS and self._is_due(robot, "silence", now_ns, CURVE_EVERY_NS):
                yield Measure(f"age/{robot}", silent_ns / 1e9)

    def value(self, value: RobotValue) -> Iterator[Entry]:
        """A value that a robot publishes."""
        yield from self._reading(value.reading, value.robot)

    def event(self, event: RobotEvent) -> Iterator[Entry]:
        """What happened to a robot itself; what happened to a dispatch is told by its mission."""
        if not event.mission:
            text = f"{one_line(event.robot, 60)}: {one_line(event.what, 60).replace('_', ' ')} {one_line(event.detail)}"
            yield LogLine(text.strip(), ALERTS.get(event.what, "idle"), one_line(event.code or event.what, 40))

    def gone(self, robot: str) -> Iterator[Entry]:
        """A robot's process is gone; its next state says that it is back."""
        if self._rules.crew.robot(robot) is not None:
            yield LogLine(f"{robot}: its process or its link is gone", "bad", "lost")
            yield from self._lanes.itself(robot, unavailable=True, stopped=False)

    def world(self, world: Snapshot) -> Iterator[Entry]:
        """The world as the orchestrator saw it when it decided: all that a journal knows of poses and values."""
        for robot, known in world.robots.items():
            if self._rules.crew.robot(robot) is None:
                continue
            yield from self._lanes.itself(robot, unavailable=bool(known.unavailable), stopped=known.stopped)
            yield from _whereabouts(robot, {name: stamped.value for name, stamped in known.fluents.items()})
            battery = known.fluents.get("battery")
            if battery is not None and isinstance(battery.value, int | float):
                yield Measure(f"battery/{robot}", float(battery.value))
        for stamped in world.values.values():
            yield from self._reading(stamped.reading, stamped.source)

    def _curves(self, robot: str, state: RobotState) -> Iterator[Entry]:
        battery = state.fluents.get("battery")
        if isinstance(battery, int | float):
            yield Measure(f"battery/{robot}", float(battery))
        if state.stamps_ns:
            yield Measure(f"age/{robot}", max(0, state.at_ns - min(state.stamps_ns.values())) / 1e9)

    def _reading(self, reading: ValueReading, source: str) -> Iterator[Entry]:
        if self._told.get(reading.name) == reading:
            return
        self._told[reading.name] = reading
        name, at = one_line(reading.name, 60), reading.position
        if reading.status != "ok" or at is None or not _finite(at):
            yield Mark(f"value/{name}", "value", None)
            yield LogLine(f"{source} reports {name}: {one_line(reading.status, 60)}", "value", name)
            return
        sigma = f" +- {reading.sigma_m:.2f} m" if reading.sigma_m is not None else ""
        yield Mark(f"value/{name}", "value", at, f"{name}{sigma}", reading.sigma_m)
        yield LogLine(f"{source} reports {name} at ({at.x:.2f}, {at.y:.2f}){sigma}", "value", name)

    def _is_due(self, robot: str, what: str, at_ns: int, every_ns: int) -> bool:
        if at_ns < self._due.get((robot, what), at_ns):
            return False
        self._due[robot, what] = at_ns + every_ns
        return True


def _whereabouts(robot: str, fluents: Mapping[str, FluentValue]) -> Iterator[Entry]:
    at = fluents.get(PLACE_FLUENT)
    if isinstance(at, Point) and _finite(at):
        yield Whereabouts(robot, at)


def _finite(at: Point) -> bool:
    return all(abs(part) < 1e6 for part in (at.x, at.y, at.z))

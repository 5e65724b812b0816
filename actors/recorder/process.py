"""The recorder's process: hears everything public, and draws it. Nobody waits for it, and it may die at any time.

What it hears waits in bounded mailboxes: of a camera only the newest frame, of poses and states the first so many, of
missions' events all. Rerun is imported once the crew is up, so that nobody's start has to share the machine with it.
"""

import asyncio
import time
from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

from crew.actors.recorder.disk import DiskGuard
from crew.actors.recorder.entry import Entry, Stamp
from crew.actors.recorder.lane import RobotLanes
from crew.actors.recorder.rrd import FILE, compact
from crew.actors.recorder.story import Story
from crew.actors.recorder.telemetry import Telemetry
from crew.actors.specs import RecorderSpec
from crew.bus.port import Bus
from crew.bus.zenoh import ZenohBus
from crew.clock import WALL, seconds_ns
from crew.contracts.site import Rules
from crew.errors import CrewError
from crew.keys import Keys
from crew.mailbox import Events, KeepLatest, Letter, Mailbox, letters
from crew.messages import RobotEvent, RobotState, RobotValue, SimImage, SimScene, SimTruth
from crew.packed import unpack
from crew.process import ChildContext, run_child
from crew.progress import MissionProgress
from crew.wire import Message, decode

if TYPE_CHECKING:
    from crew.actors.recorder.page import Page

T = TypeVar("T")
COMPACT_S = 6.0
"""More than there may be: who is ended before leaves a whole file all the same, only a larger one."""
DRAW_EVERY_S = 0.1
UP_S = 10.0
"""After this long a crew whose robots were not all heard counts as up all the same."""
GONE_NS = seconds_ns(1.0)
"""Wall time after which a robot whose process is gone counts as lost: before that it may be the end of all."""
SCENE_LIMIT = 64 << 20
"""Bytes: a scene with meshes."""


class Ears:
    """What the recorder hears, each kind in a mailbox of its own."""

    def __init__(self, bus: Bus, keys: Keys) -> None:
        self.missions: Events[Letter[MissionProgress]] = _events(MissionProgress, 1 << 16)
        self.robots: Events[Letter[Any]] = Events(letters(RobotValue, RobotEvent), capacity=1 << 14, on_lost=_ignore)
        self.states: Events[Letter[RobotState]] = _events(RobotState, 1 << 12)
        self.truths: Events[Letter[SimTruth]] = _events(SimTruth, 1 << 12)
        self.images: KeepLatest[Letter[SimImage]] = KeepLatest(letters(SimImage))
        self._heard: dict[str, Mailbox[Any]] = {
            keys.mission_progresses: self.missions,
            keys.robot_values: self.robots,
            keys.robot_events: self.robots,
            keys.robot_states: self.states,
            keys.sim_truth: self.truths,
            keys.sim_cameras: self.images,
        }
        for key, box in self._heard.items():
            bus.subscribe(key, box)

    @property
    def missed(self) -> int:
        """Events of missions and robots that did not fit: the journal has them."""
        return self.missions.lost + self.robots.lost


class Recorder:
    """Draws what its ears have heard, a little at a time."""

    def __init__(self, rules: Rules, ears: Ears) -> None:
        self._ears = ears
        lanes = RobotLanes(spec.name for spec in rules.crew.robots)
        self._story, self._telemetry = Story(rules, lanes), Telemetry(rules, lanes)
        self._now_ns = 0
        self._gone: dict[str, int] = {}

    def notice(self, robot: str, alive: bool) -> None:
        """A process came or went."""
        if alive:
            self._gone.pop(robot, None)
        else:
            self._gone[robot] = WALL.now_ns()

    def draw(self, page: "Page") -> bool:
        """Draw all that waits, in the order in which it happened; whether anything was there."""
        told = [*_all(self._ears.missions), *_all(self._ears.robots), *_all(self._ears.states)]
        truths, images = _all(self._ears.truths), _all(self._ears.images)
        for stamp, message in sorted(map(_stamped, told), key=lambda item: item[0].at_ns):
            self._write(page, stamp, self._entries(message))
        for truth in truths:
            page.truth(truth.message)
        for image in images:
            page.image(image.message)
        self._now_ns = max(self._now_ns, *(truth.message.at_ns for truth in truths), 0)
        if told or truths or images:
            return True
        self._draw_absence(page)
        return False

    def _entries(self, message: Message) -> Iterable[Entry]:
        match message:
            case MissionProgress():
                return self._story.take(message)
            case RobotState():
                return self._telemetry.state(message)
            case RobotValue():
                return self._telemetry.value(message)
            case RobotEvent():
                return self._telemetry.event(message)
        return ()

    def _draw_absence(self, page: "Page") -> None:
        """What nobody tells: who has fallen silent, who is gone. Only who is not behind can know."""
        now = Stamp(self._now_ns, time.time_ns())
        self._write(page, now, self._telemetry.ages(self._now_ns))
        lost = [robot for robot, since_ns in self._gone.items() if WALL.now_ns() - since_ns > GONE_NS]
        for robot in lost:
            del self._gone[robot]
            self._write(page, now, self._telemetry.gone(robot))

    def _write(self, page: "Page", stamp: Stamp, entries: Iterable[Entry]) -> None:
        self._now_ns = max(self._now_ns, stamp.at_ns)
        for entry in entries:
            page.write(stamp, entry)


async def main(context: ChildContext) -> None:
    """Record until asked to stop, then close the file."""
    spec = context.spec(RecorderSpec)
    rules = unpack(spec.rules)
    async with ZenohBus(spec.link) as bus:
        await serve(spec, rules, bus, context)


async def serve(spec: RecorderSpec, rules: Rules, bus: Bus, context: ChildContext) -> None:
    """Record on a bus that is already there."""
    keys = Keys(rules.crew.name)
    ears = Ears(bus, keys)
    recorder = Recorder(rules, ears)
    bus.watch_liveliness(keys.all_alive, lambda key, alive: recorder.notice(keys.name_in(key), alive))
    token = bus.token(keys.alive("recorder"))
    context.ready()
    opening: asyncio.Future[Page] | None = None
    scene: SimScene | None = None
    try:
        scene = await _ask_scene(bus, keys) if spec.simulated else None
        await _crew_is_up(bus, keys, rules, ears)
        opening = asyncio.ensure_future(asyncio.to_thread(_open_page, spec, rules, scene))
        await _record(spec, recorder, await asyncio.shield(opening))
    finally:
        page = _open_page(spec, rules, scene) if opening is None else await opening
        _end(spec, recorder, page, ears)
        token.close()


async def _crew_is_up(bus: Bus, keys: Keys, rules: Rules, ears: Ears) -> None:
    """Return once every robot is there, or somebody has asked for something, or that has taken too long."""
    states: KeepLatest[Letter[RobotState]] = KeepLatest(letters(RobotState))
    subscription = bus.subscribe(keys.robot_states, states)
    waiting = [asyncio.create_task(_all_there(states, rules)), asyncio.create_task(ears.missions.changed())]
    try:
        await asyncio.wait(waiting, timeout=UP_S, return_when=asyncio.FIRST_COMPLETED)
    finally:
        subscription.close()
        for task in waiting:
            task.cancel()


async def _all_there(states: KeepLatest[Letter[RobotState]], rules: Rules) -> None:
    missing = {spec.name for spec in rules.crew.robots}
    async for letter in states:
        if not letter.message.unavailable:
            missing.discard(letter.message.robot)
        if not missing:
            return


def _open_page(spec: RecorderSpec, rules: Rules, scene: SimScene | None) -> "Page":
    from importlib.metadata import version

    from crew.actors.recorder.page import Page

    folder = Path(spec.run_folder)
    facts = {"version": version("robot-crew"), "rerun": version("rerun-sdk"), "crew": rules.crew.name}
    facts |= {"planner": spec.planner, "began": time.strftime("%Y-%m-%dT%H:%M:%SZ", time.gmtime())}
    return Page(rules, folder.name, folder / FILE, scene=scene, port=spec.port, facts=facts)


async def _ask_scene(bus: Bus, keys: Keys) -> SimScene | None:
    """What the simulated world looks like, as soon as the simulation is there to say it."""
    deadline_ns = WALL.now_ns() + seconds_ns(UP_S)
    while WALL.now_ns() < deadline_ns:
        for reply in await bus.query(keys.sim_scene, (b"", "text/plain"), timeout_s=2.0):
            if reply.ok:
                return decode(SimScene, reply.payload, reply.encoding, limit_bytes=SCENE_LIMIT)
        await WALL.sleep(DRAW_EVERY_S)
    return None


async def _record(spec: RecorderSpec, recorder: Recorder, page: "Page") -> None:
    guard = DiskGuard(Path(spec.run_folder) / FILE)
    while True:
        if recorder.draw(page):
            page.flush()
        if problem := guard.problem():
            raise CrewError(f"{problem}; the run's journal goes on (crew replay draws the rest from it)")
        await WALL.sleep(DRAW_EVERY_S)


def _end(spec: RecorderSpec, recorder: Recorder, page: "Page", ears: Ears) -> None:
    """Draw what was heard to the end, and leave a whole file. What is not done within the grace is done by a replay."""
    while recorder.draw(page):
        pass
    page.close(f"{ears.missed} events were missed" if ears.missed else "")
    path = Path(spec.run_folder) / FILE
    compact([path], path, timeout_s=COMPACT_S)


def _all(box: Mailbox[T]) -> list[T]:
    """Everything that waits now."""
    found: list[T] = []
    while batch := box.take():
        found += batch
    return found


def _stamped(letter: Letter[Any]) -> tuple[Stamp, Message]:
    """A message with its mission time, and the wall's: its own, or when it arrived."""
    message = letter.message
    if isinstance(message, MissionProgress):
        return Stamp(message.at_ns, message.wall_ns), message
    at_ns = message.reading.stamp_ns if isinstance(message, RobotValue) else message.at_ns
    return Stamp(at_ns, time.time_ns() - time.monotonic_ns() + letter.received_ns), message


def _events(kind: type[Any], capacity: int) -> Events[Any]:
    return Events(letters(kind), capacity=capacity, on_lost=_ignore)


def _ignore(count: int) -> None:
    """What was lost is counted where it is held."""


if __name__ == "__main__":
    run_child(main)

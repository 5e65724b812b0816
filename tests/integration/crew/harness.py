"""A person's terminal and an operator's bus: crews are brought up as a user does, and watched from outside."""

import asyncio
import json
import math
import os
import signal
import subprocess
import sys
import time
from collections.abc import AsyncIterator, Callable, Iterator, Mapping
from contextlib import asynccontextmanager, contextmanager
from pathlib import Path
from typing import Any, Self

import msgspec
import zenoh

from crew.access import ROBOT_PREFIX, Identity, Role, Way
from crew.bus.port import Body, Bus, Qos, packed
from crew.bus.session import open_session
from crew.bus.zenoh import _QOS, ZenohBus
from crew.home import Home, Running
from crew.journal_reader import read_records
from crew.keys import Keys
from crew.launch.ready import query_status
from crew.mailbox import Events, KeepLatest, Letter, letters
from crew.messages import CrewStatus, MissionEvent, RobotEvent, RobotState, SimTruth
from crew.records import RECORDS, IntentRecord, Record

CREW = Path(sys.executable).with_name("crew")
NAME, OTHER = "air_ground", "humanoid_quadruped"
UP_S = 90.0
MISSION_S = 120.0
SHORT_DRIVE = "send the rover to (-3, -3)"
FAR_DRIVE = "send the rover to (9, -5.5)"
SHORT_SEARCH = "search x from -6 to -3 and y from -6 to -3"
SEARCH = "search the area"


class Desk:
    """A folder with a state folder and runs of its own, and a terminal in it."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.home = Home(folder / "home")
        self.runs = folder / "runs"
        self._spawned: list[Up] = []
        self.env = {**os.environ, "CREW_HOME": str(self.home.path), "PYTHONUNBUFFERED": "1", "PYTHONFAULTHANDLER": "1"}

    def crew(self, *args: str, timeout_s: float = MISSION_S) -> "subprocess.CompletedProcess[str]":
        """Run a command to its end."""
        return subprocess.run(
            [CREW, *args], cwd=self.folder, env=self.env, capture_output=True, text=True, timeout=timeout_s, check=False
        )

    def demo(self, *args: str) -> "Demo":
        """`crew demo --json` and what it printed."""
        done = self.crew("demo", "--json", *args)
        assert done.stdout.count("\n") == 1, f"one line of JSON, not {done.stdout!r}; {done.stderr}"
        return Demo(json.loads(done.stdout), done.returncode, done.stderr)

    @contextmanager
    def up(self, *args: str, speed: str = "max") -> Iterator["Up"]:
        """`crew up` until the block ends."""
        up = self.spawn("up", "--port", "0", "--speed", speed, *args)
        try:
            up.await_said("end: Ctrl-C", UP_S)
            yield up
        finally:
            up.end()

    def spawn(self, *args: str) -> "Up":
        """A command that goes on in the background."""
        self._spawned.append(Up(self, args))
        return self._spawned[-1]

    def end_all(self) -> None:
        """Kill what a failed test has left running; its crew dies with it."""
        for up in self._spawned:
            if up.process.poll() is None:
                up.process.kill()
                up.process.wait()


class Demo(msgspec.Struct, frozen=True):
    """What a demo printed and how it ended."""

    result: dict[str, Any]
    code: int
    stderr: str

    @property
    def run(self) -> Path:
        return Path(self.result["run"])

    def outcomes(self) -> dict[str, str]:
        """Each step's outcome, by robot and skill."""
        return {f"{s['robot']}.{s['skill']}": s["outcome"] for s in self.result["steps"]}


class Up:
    """A command in the background, with its terminal in a file."""

    def __init__(self, desk: Desk, args: tuple[str, ...]) -> None:
        self.desk = desk
        self._crew = OTHER if OTHER in args else NAME
        self._terminal = desk.folder / f"terminal-{time.monotonic_ns()}"
        with self._terminal.open("wb") as output:
            self.process = subprocess.Popen(
                [CREW, *args],
                cwd=desk.folder,
                env=desk.env,
                stdin=subprocess.DEVNULL,
                stdout=output,
                stderr=subprocess.STDOUT,
                start_new_session=True,
            )

    @property
    def said(self) -> str:
        return self._terminal.read_text(errors="replace")

    def await_said(self, text: str, seconds: float) -> None:
        """Wait until the terminal shows the text."""
        wait_until(lambda: text in self.said or self.process.poll() is not None, seconds)
        assert text in self.said, self.said

    @property
    def running(self) -> Running:
        running = self.desk.home.running(self._crew)
        assert running is not None, self.said
        return running

    @property
    def run(self) -> Path:
        return Path(self.running.run_folder)

    def children(self) -> dict[str, int]:
        """Process ids of the crew's processes that live, by name."""
        return children_of(self.process.pid)

    def kill(self, name: str, number: int = signal.SIGKILL) -> None:
        """Send one of the crew's processes a signal."""
        os.kill(self.children()[name], number)

    def signal(self, number: int) -> None:
        """Signal the command alone, as a terminal's Ctrl-C or a service manager does."""
        self.process.send_signal(number)

    def end(self, seconds: float = 10.0) -> int:
        """End as Ctrl-C does; the exit code. AssertionError with where it stands if it does not."""
        if self.process.poll() is None:
            self.process.send_signal(signal.SIGINT)
        try:
            return self.process.wait(seconds)
        except subprocess.TimeoutExpired:
            self.process.send_signal(signal.SIGABRT)
            self.process.wait()
        raise AssertionError(f"not down after {seconds} s: {self.said[-6000:]}")


def children_of(pid: int) -> dict[str, int]:
    """The crew's processes of one supervisor, by the name of the specification that they were started with."""
    found = {}
    for stat in Path("/proc").glob("[0-9]*/stat"):
        try:
            fields = stat.read_text().rpartition(")")[2].split()
            words = (stat.parent / "cmdline").read_bytes().split(b"\0")
        except OSError:
            continue
        if int(fields[1]) == pid and fields[0] != "Z" and len(words) > 2:
            found[Path(words[-2].decode()).stem] = int(stat.parent.name)
    return found


def alive(pid: int) -> bool:
    """Whether a process is there and is more than a zombie."""
    try:
        return Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0] != "Z"
    except OSError:
        return False


def wait_until(done: Callable[[], bool], seconds: float) -> bool:
    """Wait for a condition; whether it came true in time."""
    deadline = time.monotonic() + seconds
    while time.monotonic() < deadline:
        if done():
            return True
        time.sleep(0.02)
    return done()


class Voices:
    """Sessions with the certificates of a crew's roles, for saying what an operator may not say."""

    def __init__(self, running: Running) -> None:
        self._running = running
        self._sessions: dict[str, zenoh.Session] = {}

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        for session in self._sessions.values():
            session.close()  # type: ignore[no-untyped-call]

    def put(self, key: str, body: Body, qos: Qos) -> None:
        """Put as the first in the table who may: the operator where he may."""
        payload, encoding = packed(body)
        self.of(self.rightful(key)).put(key, payload, encoding=encoding, **_QOS[qos])

    def of(self, role: str) -> zenoh.Session:
        """A role's session."""
        if role not in self._sessions:
            self._sessions[role] = open_session(self._running.link(role))
        return self._sessions[role]

    def rightful(self, key: str) -> str:
        """Who may put on a key."""
        robots = (key.split("/")[2], key.split("/")[-1])
        known = [f"{ROBOT_PREFIX}{r}" for r in robots if (Path(self._running.certificates) / f"robot-{r}.crt").exists()]
        names = ["operator", *(str(role) for role in Role if role not in (Role.ROBOT, Role.GUEST)), *known]
        return next(name for name in names if _may_put(Identity.of(self._running.crew, name), key))


def _may_put(identity: Identity, key: str) -> bool:
    return any(zenoh.KeyExpr(allowed).includes(zenoh.KeyExpr(key)) for allowed in identity.may(Way.PUT))


class Watch:
    """An operator's session with a running crew: what was heard, and ways to speak."""

    def __init__(self, bus: Bus, keys: Keys, voices: "Voices") -> None:
        self.bus, self.keys, self._voices = bus, keys, voices
        self.states: dict[str, RobotState] = {}
        self.events: list[MissionEvent] = []
        self.robot_events: list[RobotEvent] = []
        self.truths: list[SimTruth] = []
        self._mission_box: Events[Letter[MissionEvent]] = _events(MissionEvent)
        self._robot_box: Events[Letter[RobotEvent]] = _events(RobotEvent)
        self._truth_box: Events[Letter[SimTruth]] = _events(SimTruth)
        self._state_box: KeepLatest[Letter[RobotState]] = KeepLatest(letters(RobotState))
        bus.subscribe(keys.mission_events, self._mission_box)
        bus.subscribe(keys.robot_events, self._robot_box)
        bus.subscribe(keys.sim_truth, self._truth_box)
        bus.subscribe(keys.robot_states, self._state_box)

    def hear(self) -> None:
        """Take in what has arrived."""
        self.events += [letter.message for letter in _all(self._mission_box)]
        self.robot_events += [letter.message for letter in _all(self._robot_box)]
        self.truths += [letter.message for letter in _all(self._truth_box)]
        self.states.update({s.message.robot: s.message for s in self._state_box.take()})

    async def until(self, done: Callable[[], Any], seconds: float = 30.0, why: str = "") -> None:
        """Listen until a condition holds; AssertionError with the last events otherwise."""
        deadline = time.monotonic() + seconds
        while True:
            self.hear()
            if done():
                return
            told = [f"{e.mission} {e.text}" for e in self.events[-6:]] + [repr(e) for e in self.robot_events[-4:]]
            assert time.monotonic() < deadline, f"not within {seconds} s: {why}; last heard: {told}; {self.states}"
            await asyncio.sleep(0.02)

    # Speaking.

    def put(self, key: str, body: Body, qos: Qos = Qos.EVENT) -> None:
        """Put as the operator, or with the certificate of somebody who may put there."""
        self._voices.put(key, body, qos)

    def ask(self, text: str) -> str:
        """Publish a request; the id that its events will echo."""
        request_id = f"r{time.monotonic_ns()}"
        body = msgspec.json.encode({"text": text, "request_id": request_id})
        self.put(self.keys.request, (body, "application/json"))
        return request_id

    def of(self, request_id: str) -> list[MissionEvent]:
        """What was heard of one request."""
        return [event for event in self.events if event.request_id == request_id]

    def mission_of(self, request_id: str) -> str:
        return next((e.mission for e in self.of(request_id)), "")

    async def ended(self, request_id: str, seconds: float = MISSION_S) -> MissionEvent:
        """The last event of a request."""
        await self.until(lambda: any(e.final for e in self.of(request_id)), seconds, f"{request_id} has ended")
        return self.of(request_id)[-1]

    async def mission(self, text: str, seconds: float = MISSION_S) -> MissionEvent:
        """Ask, and wait for the end."""
        return await self.ended(self.ask(text), seconds)

    async def drives(self) -> None:
        """A short mission completes: the crew works."""
        ended = await self.mission(SHORT_DRIVE)
        assert ended.outcome == "completed", ended.text

    async def status(self) -> CrewStatus:
        status = await query_status(self.bus, self.keys, timeout_s=5.0)
        assert status is not None, "the orchestrator does not answer"
        return status

    # Looking at the truth.

    async def truth(self) -> SimTruth:
        """The newest truth, published after now."""
        self.hear()
        count = len(self.truths)
        await self.until(lambda: len(self.truths) > count, why="the simulation publishes")
        return self.truths[-1]

    async def moving(self, robot: str, seconds: float = 60.0, mps: float = 0.2) -> None:
        """Wait until a robot truly moves."""
        await self.until(lambda: self._speed(robot) > mps, seconds, f"{robot} moves")

    async def standing(self, robot: str, seconds: float = 60.0, mps: float = 0.05) -> tuple[float, float, float, float]:
        """Wait until a robot truly stands (a hovering drone sways a little); its pose."""
        await self.until(lambda: 0.0 <= self._speed(robot) < mps, seconds, f"{robot} stands")
        return self.truths[-1].poses[robot]

    async def landed(self, robot: str = "iris", seconds: float = 90.0) -> None:
        """Wait until a robot is truly on the ground."""
        await self.until(lambda: self.height(robot) < 0.15, seconds, f"{robot} is down")

    async def airborne(self, robot: str = "iris", seconds: float = 60.0) -> None:
        await self.until(lambda: self.height(robot) > 1.5, seconds, f"{robot} flies")

    def height(self, robot: str = "iris") -> float:
        return self.truths[-1].poses[robot][2] if self.truths else math.nan

    def apart_m(self, robot: str, other: str) -> float:
        """How far apart two robots truly are over the ground."""
        poses = self.truths[-1].poses
        return math.dist(poses[robot][:2], poses[other][:2])

    def _speed(self, robot: str) -> float:
        """Over the last half second or so of mission time; negative if that is not known yet."""
        if len(self.truths) < 6:
            return -1.0
        old, new = self.truths[-6], self.truths[-1]
        return math.dist(old.poses[robot][:3], new.poses[robot][:3]) / ((new.at_ns - old.at_ns) / 1e9)


@asynccontextmanager
async def watching(running: Running) -> AsyncIterator[Watch]:
    """An operator's session with a crew, and the certificates of everybody else in it."""
    with Voices(running) as voices:
        async with ZenohBus(running.link("operator")) as bus:
            yield Watch(bus, Keys(running.crew), voices)


def journal(run: Path) -> list[tuple[int, Record]]:
    """A run's records with their numbers."""
    return [
        (row.seq, msgspec.msgpack.decode(row.body, type=RECORDS[row.kind])) for row in read_records(run / "journal.db")
    ]


def intents(run: Path) -> list[str]:
    """What was dispatched, in order, as robot and skill."""
    found = [r.dispatch for _, r in journal(run) if isinstance(r, IntentRecord)]
    return [f"{d.robot}.{d.skill}" for d in found]


def latches(status: CrewStatus) -> dict[str, str]:
    """What a reset of every robot has to name."""
    return {robot.robot: robot.latch for robot in status.robots}


def spawn_of(robot: str) -> tuple[float, float]:
    """Where map A puts a robot."""
    spawns: Mapping[str, tuple[float, float]] = {"iris": (-4.0, -4.0), "tb3": (-4.0, -2.5)}
    return spawns[robot]


def _events(kind: type[Any]) -> Events[Any]:
    return Events(letters(kind), capacity=8192, on_lost=lambda _: None)


def _all(box: Events[Any]) -> list[Any]:
    found: list[Any] = []
    while letters_ := box.take():
        found += letters_
    return found

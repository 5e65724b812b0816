"""From a dispatch's put to the robot's accepted event with a recorder that draws, and without, in turns in one run."""

import asyncio
import os
import signal
import tempfile
import time
from pathlib import Path

import uvloop

from crew.access import ROBOT_PREFIX, ROUTER, Role
from crew.actors.recorder.rrd import FILE
from crew.actors.specs import RecorderSpec
from crew.authority import establish
from crew.bus.link import Link
from crew.bus.port import Qos
from crew.bus.zenoh import ZenohBus
from crew.contracts.language.lexicon import build_lexicon
from crew.contracts.language.reading import read_request
from crew.contracts.mission import event as ev
from crew.contracts.mission_state import MissionState
from crew.launch.table import free_tcp_port
from crew.library import load_rules
from crew.packed import pack
from crew.progress import MissionProgress
from crew.router import RouterSpec
from crew.supervisor import Child, Supervisor
from tests.bench.robot_child import ROBOT, IdleSpec
from tests.bench.roundtrip import KEY, KEYS, ORCHESTRATOR, WARM_UP, Trips

TURNS = 6
RECORDER = str(Role.RECORDER)
REQUEST = "send the rover to (-3, -3)"
DRAWS_S = 30.0


def measure(rounds: int) -> tuple[list[float], list[float]]:
    """Round trips in microseconds: without a recorder, and with one."""
    os.environ["PYTHONPATH"] = str(Path(__file__).parents[2])
    with asyncio.Runner(loop_factory=uvloop.new_event_loop) as runner:
        return runner.run(_measure(rounds // (2 * TURNS)))


async def _measure(rounds: int) -> tuple[list[float], list[float]]:
    rules = load_rules("air_ground")
    times: tuple[list[float], list[float]] = ([], [])
    with tempfile.TemporaryDirectory() as name:
        folder, endpoint = Path(name), f"tls/127.0.0.1:{free_tcp_port()}"
        establish(folder / "certificates", [ROUTER, ORCHESTRATOR, RECORDER, f"{ROBOT_PREFIX}{ROBOT}"])

        def link(role: str) -> Link:
            return Link(role=role, endpoint=endpoint, crew=KEYS.crew, certificates=str(folder / "certificates"))

        robot = IdleSpec(link(f"{ROBOT_PREFIX}{ROBOT}"), KEY.public)
        children = [
            Child(name="router", module="crew.router", spec=RouterSpec(link=link(ROUTER), robots=(ROBOT,)), last=True),
            Child(name="robot", module="tests.bench.robot_child", spec=robot),
        ]
        spec = RecorderSpec(
            rules=pack(rules), link=link(RECORDER), run_folder=name, planner="", simulated=False, port=free_tcp_port()
        )
        recorder = Child(name=RECORDER, module="crew.actors.recorder.process", spec=spec)
        async with Supervisor(folder, on_exit=lambda _: None) as supervisor:
            await supervisor.start(children, ready_timeout_s=20.0)
            async with ZenohBus(link(ORCHESTRATOR)) as bus:
                teller, trips = _Teller(bus), Trips(bus)
                await trips.ready()
                beating = asyncio.create_task(_beat(trips))
                for turn in range(2 * TURNS):
                    records = turn % 2 == 1
                    if records:
                        await supervisor.start([recorder], ready_timeout_s=20.0)
                        await _draws(folder / FILE, teller)
                    for number in range(rounds + WARM_UP):
                        teller.tell()
                        taken, _ = await trips.trip()
                        if number >= WARM_UP:
                            times[records].append(taken)
                    if records:
                        os.kill(supervisor.pids[RECORDER], signal.SIGKILL)
                        (folder / FILE).unlink()
                        await asyncio.sleep(0.2)
                beating.cancel()
    return times


async def _beat(trips: Trips) -> None:
    """Between two turns the robot must not take the orchestrator for lost."""
    while True:
        trips.beat()
        await asyncio.sleep(0.2)


async def _draws(path: Path, teller: "_Teller") -> None:
    """Wait until the recorder has begun to write."""
    deadline = time.monotonic() + DRAWS_S
    while not _has_begun(path):
        assert time.monotonic() < deadline, f"the recorder writes nothing to {path}"
        teller.tell()
        await asyncio.sleep(0.1)


def _has_begun(path: Path) -> bool:
    return path.is_file() and path.stat().st_size >= 10_000


class _Teller:
    """Tells of a mission's beginning over and over: something to draw for each dispatch."""

    def __init__(self, bus: ZenohBus) -> None:
        self._bus = bus
        self._reading = read_request(REQUEST, build_lexicon(load_rules("air_ground")))
        self._count = 0

    def tell(self) -> None:
        self._count += 1
        name, now_ns = f"m{self._count}", time.monotonic_ns()
        began = MissionState(id=name, request=REQUEST, reading=self._reading)
        events: tuple[ev.AnyEvent, ...] = (ev.Started(at_ns=now_ns), ev.CancelAsked(at_ns=now_ns, by="bench"))
        for number, event in enumerate(events, start=1):
            progress = MissionProgress(
                mission=name,
                number=number,
                at_ns=now_ns,
                wall_ns=time.time_ns(),
                began=began if number == 1 else None,
                event=event,
            )
            self._bus.put(KEYS.mission_progress(name), progress, qos=Qos.EVENT)

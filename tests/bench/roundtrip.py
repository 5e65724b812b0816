"""From a dispatch's put to the robot's accepted event through the locked router, beside raw Zenoh.

Raw Zenoh goes through the same router, with a robot's certificate, and through an open one. All in turns, in one run.
"""

import asyncio
import os
import tempfile
import threading
import time
from pathlib import Path
from typing import NamedTuple

import uvloop
import zenoh

from crew.access import ROBOT_PREFIX, ROUTER, Role
from crew.authority import establish
from crew.bus.link import Link
from crew.bus.port import Qos
from crew.bus.session import open_session
from crew.bus.zenoh import ZenohBus
from crew.contracts.plan import digest
from crew.keys import Keys
from crew.launch.table import free_tcp_port
from crew.library import load_rules
from crew.mailbox import Events, KeepLatest, Letter, letters
from crew.messages import Dispatch, Heartbeat, RobotCard, RobotEvent
from crew.permit import permit
from crew.router import RouterSpec
from crew.signing import SigningKey
from crew.supervisor import Child, Supervisor
from crew.wire import encode
from tests.bench.raw_echo import EchoSpec
from tests.bench.robot_child import ROBOT, IdleSpec
from tests.open_router import OpenRouterSpec

KEYS = Keys("air_ground")
KEY = SigningKey(bytes(32))
ORCHESTRATOR = str(Role.ORCHESTRATOR)
ECHO = "echo"
"""A robot that is none: it answers raw samples through the locked router."""
OPEN_KEYS = ("bench/raw/ask", "bench/raw/answer")
LOCKED_KEYS = (KEYS.act(ECHO, "echo"), KEYS.robot_value(ECHO, "echo"))
WARM_UP = 50
BEAT_EVERY_NS = 500_000_000
"""Well within the time after which a robot takes its orchestrator for lost, on a machine that is busy as well."""


class Times(NamedTuple):
    """Microseconds, round by round."""

    raw: list[float]
    """Through the open router."""
    same: list[float]
    """Raw Zenoh through the router that the dispatches go through."""
    dispatch: list[float]
    """From the put of a signed dispatch to its accepted event."""
    signature: list[float]


def measure(rounds: int) -> Times:
    """Raw Zenoh, twice, and dispatches, in turns."""
    os.environ["PYTHONPATH"] = str(Path(__file__).parents[2])
    with asyncio.Runner(loop_factory=uvloop.new_event_loop) as runner:
        return runner.run(_measure(rounds))


async def _measure(rounds: int) -> Times:
    floor = Link(role="bench", endpoint=f"tcp/127.0.0.1:{free_tcp_port()}")
    with tempfile.TemporaryDirectory() as folder:
        certificates = Path(folder) / "certificates"
        establish(certificates, [ROUTER, ORCHESTRATOR, f"{ROBOT_PREFIX}{ROBOT}", f"{ROBOT_PREFIX}{ECHO}"])
        endpoint = f"tls/127.0.0.1:{free_tcp_port()}"

        def link(role: str) -> Link:
            return Link(role=role, endpoint=endpoint, crew=KEYS.crew, certificates=str(certificates))

        router = RouterSpec(link=link(ROUTER), robots=(ROBOT, ECHO))
        locked_echo = EchoSpec(link(f"{ROBOT_PREFIX}{ECHO}"), *LOCKED_KEYS)
        children = [
            Child(name="open router", module="tests.open_router", spec=OpenRouterSpec(floor.endpoint), last=True),
            Child(name="router", module="crew.router", spec=router, last=True),
            Child(name="echo", module="tests.bench.raw_echo", spec=EchoSpec(floor, *OPEN_KEYS)),
            Child(name="locked echo", module="tests.bench.raw_echo", spec=locked_echo),
            Child(
                name="robot",
                module="tests.bench.robot_child",
                spec=IdleSpec(link(f"{ROBOT_PREFIX}{ROBOT}"), KEY.public),
            ),
        ]
        async with Supervisor(Path(folder), on_exit=print) as supervisor:
            await supervisor.start(children, ready_timeout_s=20.0)
            async with ZenohBus(link(ORCHESTRATOR)) as bus:
                sessions = [await asyncio.to_thread(open_session, way) for way in (floor, link(ORCHESTRATOR))]
                raw, same = RawPing(sessions[0], *OPEN_KEYS), RawPing(sessions[1], *LOCKED_KEYS)
                try:
                    return await _interleave(bus, raw, same, rounds)
                finally:
                    for session in sessions:
                        await asyncio.to_thread(session.close)


class RawPing:
    """One raw sample there and back; the clock stops in Zenoh's own callback."""

    def __init__(self, session: zenoh.Session, ask: str, answer: str) -> None:
        self._publisher = session.declare_publisher(
            ask, congestion_control=zenoh.CongestionControl.BLOCK, priority=zenoh.Priority.REAL_TIME, express=True
        )
        self._back = threading.Event()
        self._ended_ns = 0
        session.declare_subscriber(answer, self._answered)

    def ping(self, payload: bytes) -> float:
        """Microseconds."""
        self._back.clear()
        began_ns = time.perf_counter_ns()
        self._publisher.put(payload)
        if not self._back.wait(2.0):
            raise RuntimeError("the raw echo did not answer within 2 s")
        return (self._ended_ns - began_ns) / 1000

    def _answered(self, sample: zenoh.Sample) -> None:
        self._ended_ns = time.perf_counter_ns()
        self._back.set()


class Trips:
    """Dispatches to the robot, one after the other, as the orchestrator sends them."""

    def __init__(self, bus: ZenohBus) -> None:
        self._bus = bus
        self._cards: KeepLatest[Letter[RobotCard]] = KeepLatest(letters(RobotCard))
        self._events: Events[Letter[RobotEvent]] = Events(letters(RobotEvent), capacity=1024, on_lost=print)
        bus.subscribe(KEYS.robot_cards, self._cards)
        bus.subscribe(KEYS.robot_events, self._events)
        self._hearing = asyncio.ensure_future(self._events.each(self._hear))
        self._ended: asyncio.Future[None] = asyncio.get_running_loop().create_future()
        self._accepted_ns = 0
        self._publisher = bus.publisher(KEYS.act(ROBOT, "stop"), qos=Qos.ACTUATION)
        self._contract = load_rules("air_ground").contracts["dispatch_only"].digest
        self._number = self._beats = 0
        self._beat_due_ns = 0
        self._boot = ""

    async def ready(self) -> bytes:
        """Wait for the robot; the bytes of a dispatch to it."""
        await self._cards.changed()
        self._boot = self._cards.take()[0].message.boot_id
        self.beat()
        await asyncio.sleep(0.5)  # the robot looks for heartbeats every 0.1 s
        return encode(permit(_dispatch(1, self._boot, self._contract), KEYS.crew, KEY))[0]

    def beat(self) -> None:
        """Show that the orchestrator lives."""
        self._bus.put(KEYS.heartbeat(), permit(_beat(self._beats), KEYS.crew, KEY), qos=Qos.EVENT)
        self._beats += 1
        self._beat_due_ns = time.monotonic_ns() + BEAT_EVERY_NS

    async def trip(self) -> tuple[float, float]:
        """Microseconds from the put to the accepted event, and for the signature before.

        The orchestrator signs a dispatch before it commits the intent, and puts it once that is on disk.
        """
        self._number += 1
        dispatch = _dispatch(self._number, self._boot, self._contract)
        if time.monotonic_ns() >= self._beat_due_ns:
            self.beat()
            await asyncio.sleep(0.01)  # on its way before the clock starts
        began_ns = time.perf_counter_ns()
        signed = permit(dispatch, KEYS.crew, KEY)
        put_ns = time.perf_counter_ns()
        self._ended = asyncio.get_running_loop().create_future()
        self._publisher.put(signed)
        await self._ended
        return (self._accepted_ns - put_ns) / 1000, (put_ns - began_ns) / 1000

    def _hear(self, letter: Letter[RobotEvent]) -> None:
        """The robot's word, as the orchestrator hears it: within the wakeup that brings it."""
        event = letter.message
        if event.sequence == self._number and event.what == "accepted":
            self._accepted_ns = time.perf_counter_ns()
        elif event.sequence == self._number and event.what == "succeeded":
            self._ended.set_result(None)
        elif event.mission and not self._ended.done():
            self._ended.set_exception(RuntimeError(f"the robot answered {event.what}: {event.detail}"))


async def _interleave(bus: ZenohBus, raw: RawPing, same: RawPing, rounds: int) -> Times:
    dispatches = Trips(bus)
    payload = await dispatches.ready()
    times = Times([], [], [], [])
    for number in range(rounds + WARM_UP):
        raw_us = await asyncio.to_thread(raw.ping, payload)
        same_us = await asyncio.to_thread(same.ping, payload)
        dispatch_us, signature_us = await dispatches.trip()
        if number >= WARM_UP:
            times.raw.append(raw_us)
            times.same.append(same_us)
            times.dispatch.append(dispatch_us)
            times.signature.append(signature_us)
    return times


def _beat(number: int) -> Heartbeat:
    return Heartbeat(name="orchestrator", epoch=1, count=number)


def _dispatch(number: int, boot: str, contract: str) -> Dispatch:
    now_ns = time.time_ns()
    return Dispatch(
        mission="bench",
        step="safe:responder",
        purpose="safe",
        sequence=number,
        robot=ROBOT,
        skill="stop",
        epoch=1,
        lease="bench",
        boot_id=boot,
        issued_ns=now_ns,
        expires_ns=now_ns + 2_000_000_000,
        args_digest=digest({}),
        plan_digest="0" * 64,
        contract_digest=contract,
    )

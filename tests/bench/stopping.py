"""From a stop's put to its command at the vehicle's socket: both locks, a flood, a blocked loop, a burning core."""

import asyncio
import os
import socket
import tempfile
import time
from pathlib import Path

from crew.access import ROBOT_PREFIX, ROUTER, Role
from crew.authority import establish
from crew.bus.link import Link
from crew.bus.port import Qos
from crew.bus.zenoh import ZenohBus
from crew.keys import Keys
from crew.launch.table import free_tcp_port
from crew.mailbox import Events, KeepLatest, Letter, letters
from crew.messages import Heartbeat, RobotEvent, RobotState, Stop
from crew.permit import permit
from crew.release import signed_reset
from crew.router import RouterSpec
from crew.signing import SigningKey
from crew.supervisor import Child, Supervisor
from tests.bench.flood_child import FloodSpec
from tests.bench.robot_child import ROBOT
from tests.bench.roundtrip import _dispatch
from tests.bench.stop_child import StopSpec

KEYS = Keys("air_ground")
KEY, OPERATOR_KEY = SigningKey(bytes(32)), SigningKey(bytes(range(32)))
ORCHESTRATOR, OPERATOR = str(Role.ORCHESTRATOR), str(Role.OPERATOR)


def measure(rounds: int) -> list[float]:
    """Milliseconds of wall time, one for each stop."""
    os.environ["PYTHONPATH"] = str(Path(__file__).parents[2])
    return asyncio.run(_measure(rounds))


async def _measure(rounds: int) -> list[float]:
    with tempfile.TemporaryDirectory() as folder, socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as vehicle:
        vehicle.bind(("127.0.0.1", 0))
        vehicle.settimeout(5.0)
        certificates, robot = Path(folder) / "certificates", f"{ROBOT_PREFIX}{ROBOT}"
        establish(certificates, [ROUTER, ORCHESTRATOR, OPERATOR, robot])
        endpoint = f"tls/127.0.0.1:{free_tcp_port()}"

        def link(role: str) -> Link:
            return Link(role=role, endpoint=endpoint, crew=KEYS.crew, certificates=str(certificates))

        flood = FloodSpec(link(ORCHESTRATOR), KEYS.act(ROBOT, "stop"), _dispatch(1, "none", "none"))
        spec = StopSpec(link(robot), KEY.public, OPERATOR_KEY.public, vehicle.getsockname()[1])
        children = [
            Child(name="router", module="crew.router", spec=RouterSpec(link=link(ROUTER), robots=(ROBOT,)), last=True),
            Child(name="robot", module="tests.bench.stop_child", spec=spec),
            Child(name="flood", module="tests.bench.flood_child", spec=flood),
            Child(name="burner", module="tests.bench.flood_child", spec=FloodSpec()),
        ]
        async with Supervisor(Path(folder), on_exit=print) as supervisor:
            await supervisor.start(children, ready_timeout_s=20.0)
            async with ZenohBus(link(OPERATOR)) as operator, ZenohBus(link(ORCHESTRATOR)) as orchestrator:
                beating = asyncio.create_task(_beat(orchestrator))
                try:
                    return await _stops(operator, vehicle, rounds)
                finally:
                    beating.cancel()


async def _stops(operator: ZenohBus, vehicle: socket.socket, rounds: int) -> list[float]:
    events: Events[Letter[RobotEvent]] = Events(letters(RobotEvent), capacity=8192, on_lost=lambda _: None)
    operator.subscribe(KEYS.robot_events, events)
    states: KeepLatest[Letter[RobotState]] = KeepLatest(letters(RobotState))
    operator.subscribe(KEYS.robot_states, states)
    await asyncio.sleep(1.0)
    found = []
    for _ in range(rounds):
        began_ns = time.monotonic_ns()
        operator.put(KEYS.stop, Stop(by="bench"), qos=Qos.STOP)
        written_ns = await asyncio.to_thread(_arrival, vehicle)
        found.append((written_ns - began_ns) / 1e6)
        await _release(operator, events, states)
    return found


def _arrival(vehicle: socket.socket) -> int:
    """When the stop's datagram was in hand; TimeoutError if none comes."""
    vehicle.recv(512)
    return time.monotonic_ns()


async def _release(
    operator: ZenohBus, events: Events[Letter[RobotEvent]], states: KeepLatest[Letter[RobotState]]
) -> None:
    """Reset, again while the robot still carries out its stop."""
    latch = ""
    for _ in range(50):
        latch = next((letter.message.latch for letter in states.take()), latch)
        reset = signed_reset(KEYS.crew, {ROBOT: latch}, OPERATOR_KEY, by="bench", epoch=1)
        operator.put(KEYS.reset, reset, qos=Qos.STOP)
        deadline = time.monotonic() + 2.0
        while time.monotonic() < deadline:
            whats = {letter.message.what for letter in events.take()}
            if "released" in whats:
                return
            if "reset_refused" in whats:
                break
            await asyncio.sleep(0.005)
    raise RuntimeError("the robot was not released")


async def _beat(bus: ZenohBus) -> None:
    count = 0
    while True:
        count += 1
        beat = Heartbeat(name="orchestrator", epoch=1, count=count)
        bus.put(KEYS.heartbeat(), permit(beat, KEYS.crew, KEY), qos=Qos.EVENT)
        await asyncio.sleep(0.2)

"""A robot whose loop is blocked half of the time; latch, lock and stop are those of the MAVLink writer, on UDP."""

import socket
import time
from collections.abc import Mapping

import msgspec

from crew.actors.robot.actor import RobotActor
from crew.adapter import AdapterConfig, Reading, StopLatch
from crew.adapters.mavlink.flavours.ardupilot_rover import ArduPilotRover
from crew.adapters.mavlink.writer import Writer
from crew.bus.link import Link
from crew.bus.zenoh import ZenohBus
from crew.clock import WallClock
from crew.keys import Keys
from crew.library import load_rules
from crew.process import ChildContext, run_child
from tests.bench.robot_child import ROBOT, IdleAdapter

BLOCKED_S = 0.05
"""How long the loop spins in each of its states, ten times a second, holding the interpreter."""


class StopSpec(msgspec.Struct, frozen=True):
    """Its way to the router, and where its vehicle listens."""

    link: Link
    orchestrator_key: bytes
    operator_key: bytes
    vehicle_port: int


class StopAdapter(IdleAdapter):
    """Latches and writes as the MAVLink adapter does; everything else is idle, and slow on purpose."""

    def __init__(self, config: AdapterConfig, clock: WallClock, port: int) -> None:
        super().__init__(config, clock)
        self._latch = StopLatch()
        self._socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self._writer = Writer(self._latch, lambda data: self._send(data, port))

    def _send(self, data: bytes, port: int) -> None:
        self._socket.sendto(data, ("127.0.0.1", port))

    @property
    def latched(self) -> bool:  # type: ignore[override]
        return self._latch.latched

    def halt(self) -> None:
        with self._latch.lock:
            if not self._latch.latched:
                self._latch.set()
                self._writer.send_stop(ArduPilotRover.stops[0].message(1, 0))

    def release(self) -> None:
        self._latch.clear()

    def fluents(self) -> Mapping[str, Reading]:
        until = time.monotonic() + BLOCKED_S / 2  # asked for twice in each state
        while time.monotonic() < until:
            pass
        return super().fluents()


async def main(context: ChildContext) -> None:
    """Serve until asked to stop."""
    spec = context.spec(StopSpec)
    rules = load_rules("air_ground")
    robot = rules.crew.robot(ROBOT)
    assert robot is not None
    clock = WallClock()
    config = AdapterConfig(robot=ROBOT, kind=robot.kind, connection="", area=(-6, 10, -6, 10), origin=(0, 0, 0))
    adapter = StopAdapter(config, clock, spec.vehicle_port)
    async with ZenohBus(spec.link) as bus:
        keys = Keys("air_ground")
        actor = RobotActor(bus, keys, robot, rules, adapter, clock, spec.operator_key, spec.orchestrator_key)
        context.ready()
        await actor.run()


if __name__ == "__main__":
    run_child(main)

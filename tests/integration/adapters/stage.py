"""What the inherited adapter suite runs on: one adapter behind a relay, over a simulated or a real vehicle."""

import asyncio
import os
from collections.abc import Awaitable, Callable
from typing import Any, Protocol, TypeVar

from crew.adapter import AdapterConfig
from crew.adapters.mavlink.adapter import MavlinkAdapter
from crew.clock import Clock, WallClock
from crew.sim.config import WorldConfig
from crew.sim.world import World
from tests.integration.adapters.lockstep import AREA, discs
from tests.integration.adapters.relay import Relay
from tests.integration.paced import SLICE_NS, PacedStage, free_port

T = TypeVar("T")

SITL = os.environ.get("CREW_SITL", "")
"""`udp:PORT` that a real autopilot sends to; then the suite runs on it, in real time."""
VEHICLES = {"quadcopter": "iris", "rover": "tb3"}


class Stage(Protocol):
    """One vehicle, its adapter, and the wire between them."""

    adapter: MavlinkAdapter
    relay: Relay

    @property
    def clock(self) -> Clock: ...

    async def run(self, work: Awaitable[T], limit_s: float = 120.0) -> T: ...

    async def advance(self, seconds: float) -> None: ...

    async def until(self, done: Callable[[], bool], limit_s: float = 60.0) -> None: ...

    async def close(self) -> None: ...


def _config(kind: str, port: int, origin: tuple[float, float, float], obstacles: Any, options: Any) -> AdapterConfig:
    return AdapterConfig(
        robot=VEHICLES[kind],
        kind=kind,
        connection=f"udpin:127.0.0.1:{port}",
        options=options,
        area=AREA,
        origin=origin,
        obstacles=obstacles,
    )


class SimulatedStage(PacedStage):
    """A vehicle of the simulation in lockstep: time moves once everything sent was passed on and handled."""

    def __init__(self, kind: str, autopilot: str, signing_keys: dict[str, bytes] | None = None, **options: Any) -> None:
        super().__init__()
        self._name = VEHICLES[kind]
        self.relay = Relay(lambda: self.clock.now_ns() / 1e9)
        links = {name: f"udp:127.0.0.1:{free_port()}" for name in VEHICLES.values()}
        links[self._name] = f"udp:127.0.0.1:{self.relay.port}"
        self.world = World(
            WorldConfig(links=links, autopilots={self._name: autopilot}, signing_keys=signing_keys or {})
        )
        origin = self.world.map.origin
        port = free_port()
        place = (origin.lat_deg, origin.lon_deg, origin.alt_m)
        self.adapter = MavlinkAdapter(_config(kind, port, place, discs(self.world), options), self.clock)
        self.relay.adapter = ("127.0.0.1", port)

    def simulate(self) -> int:
        self.relay.pump()
        self.world.advance(self.world.time_ns + SLICE_NS)
        self.relay.pump()
        return self.world.time_ns

    def heard(self) -> bool:
        return self.adapter.link_counts()[1] >= self.relay.forwarded

    async def close(self) -> None:
        await self.adapter.close()
        self.relay.close()
        self.world.close()


class RealStage:
    """A real autopilot (or its makers' simulation of one) that sends to a UDP port, in real time."""

    def __init__(self, kind: str, **options: Any) -> None:
        self.clock = WallClock()
        self.relay = Relay(lambda: self.clock.now_ns() / 1e9, port=int(SITL.rpartition(":")[2]))
        lat, lon, alt = (float(part) for part in os.environ["CREW_SITL_HOME"].split(","))
        port = free_port()
        options = {"connect_timeout_s": 60.0, "stall_s": 30.0, **options}
        self.adapter = MavlinkAdapter(_config(kind, port, (lat, lon, alt), (), options), self.clock)
        self.relay.adapter = ("127.0.0.1", port)
        self._pump = asyncio.create_task(self._keep_pumping())

    async def run(self, work: Awaitable[T], limit_s: float = 120.0) -> T:
        return await asyncio.wait_for(work, limit_s)

    async def advance(self, seconds: float) -> None:
        await asyncio.sleep(seconds)

    async def until(self, done: Callable[[], bool], limit_s: float = 60.0) -> None:
        async with asyncio.timeout(limit_s):
            while not done():  # noqa: ASYNC110  (telemetry has no event to wait for)
                await asyncio.sleep(0.02)

    async def _keep_pumping(self) -> None:
        while True:
            self.relay.pump()
            await asyncio.sleep(0.002)

    async def close(self) -> None:
        await self.adapter.close()
        self._pump.cancel()
        await asyncio.gather(self._pump, return_exceptions=True)
        self.relay.close()

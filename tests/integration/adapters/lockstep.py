"""Adapters against the simulated world in lockstep: time moves only when no datagram is on its way."""

import asyncio
import contextlib
import socket
from collections.abc import AsyncIterator, Awaitable, Callable
from typing import Any, TypeVar

from crew.actors.robot.neighbours import neighbour_of
from crew.adapter import AdapterConfig
from crew.adapters.mavlink.adapter import MavlinkAdapter
from crew.adapters.mavlink.writer import Permit
from crew.clock import SimClock
from crew.contracts.site import Separation
from crew.library import load_kind
from crew.sim.config import WorldConfig
from crew.sim.world import World

T = TypeVar("T")

SLICE_NS = 50_000_000
AREA = (-6.0, 10.0, -6.0, 10.0)
KINDS = {"iris": "quadcopter", "tb3": "rover"}


def free_port() -> int:
    """A UDP port that nobody listens on."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as sock:
        sock.bind(("127.0.0.1", 0))
        return int(sock.getsockname()[1])


def discs(world: World) -> tuple[tuple[float, float, float], ...]:
    """The map's obstacles as a surveyor of the site writes them down."""
    return tuple(disc for obstacle in world.map.obstacles for disc in obstacle.discs)


class Lockstep:
    """One world, one clock, an adapter for each robot. `hears`: who is told where the others are, as on the bus."""

    def __init__(
        self,
        *,
        seed: int = 0,
        faults: tuple[str, ...] = (),
        options: dict[str, Any] | None = None,
        hears: tuple[str, ...] = (),
    ) -> None:
        self._hears = hears
        ports = {name: free_port() for name in KINDS}
        links = {name: f"udp:127.0.0.1:{port}" for name, port in ports.items()}
        self.world = World(WorldConfig(seed=seed, faults=faults, links=links))
        self.clock = SimClock()
        origin = self.world.map.origin
        self.adapters = {
            name: MavlinkAdapter(
                AdapterConfig(
                    robot=name,
                    kind=kind,
                    connection=f"udpin:127.0.0.1:{ports[name]}",
                    options=(options or {}).get(name, {}),
                    area=AREA,
                    origin=(origin.lat_deg, origin.lon_deg, origin.alt_m),
                    obstacles=discs(self.world),
                    separation_m=Separation().told_m,
                ),
                self.clock,
            )
            for name, kind in KINDS.items()
        }
        self.connected: list[str] = []

    @property
    def iris(self) -> MavlinkAdapter:
        return self.adapters["iris"]

    @property
    def tb3(self) -> MavlinkAdapter:
        return self.adapters["tb3"]

    async def run(self, work: Awaitable[T], limit_s: float = 400.0) -> T:
        """Advance the world until `work` is done."""
        task = asyncio.ensure_future(work)
        end_ns = self.clock.now_ns() + round(limit_s * 1e9)
        try:
            await self._turns()
            while not task.done():
                assert self.clock.now_ns() < end_ns, "simulated time ran out"
                await self.step()
        finally:
            task.cancel()
            await asyncio.gather(task, return_exceptions=True)
        return task.result()

    async def advance(self, seconds: float) -> None:
        end_ns = self.clock.now_ns() + round(seconds * 1e9)
        while self.clock.now_ns() < end_ns:
            await self.step()

    async def until(self, done: Callable[[], bool], limit_s: float = 60.0) -> None:
        end_ns = self.clock.now_ns() + round(limit_s * 1e9)
        while not done():
            assert self.clock.now_ns() < end_ns, "simulated time ran out"
            await self.step()

    async def step(self) -> None:
        self.world.advance(self.world.time_ns + SLICE_NS)
        await self._arrived()
        self._meet()
        self.clock.advance(self.world.time_ns)
        await self._turns()

    def _meet(self) -> None:
        """What each robot tells of itself, to those that hear it."""
        for name, adapter in self.adapters.items():
            told = {fluent: reading.value for fluent, reading in adapter.fluents().items()}
            neighbour = neighbour_of(name, load_kind(KINDS[name]), told)
            for other in self._hears:
                if other != name and neighbour is not None:
                    self.adapters[other].meet(neighbour)

    async def _arrived(self) -> None:
        """Wait until everything that the world sent was received and handled."""
        for _ in range(10_000):
            counts = self.world.counts()
            heard = all(self.adapters[name].link_counts()[1] >= counts[name].sent for name in self.connected)
            if heard and not self.clock.is_busy:
                return
            await asyncio.sleep(0)
        raise AssertionError(f"datagrams lost: {self.world.counts()}")

    async def _turns(self) -> None:
        for _ in range(8):
            await asyncio.sleep(0)

    def tell(self, name: str, message: Any) -> None:
        """Send the vehicle a message over the adapter's link as somebody else would: a pilot, a second station."""
        self.adapters[name]._vehicle.link.writer.send(message, Permit())

    def utter(self, name: str, message: Any) -> None:
        """Let the vehicle say something."""
        self.world._autopilots[name].link.send(message)

    async def close(self) -> None:
        for adapter in self.adapters.values():
            await adapter.close()
        self.world.close()


@contextlib.asynccontextmanager
async def lockstep(*robots: str, **how: Any) -> AsyncIterator[Lockstep]:
    """A world with the named robots' adapters connected."""
    stage = Lockstep(**how)
    try:
        connecting = [asyncio.ensure_future(stage.adapters[name].connect()) for name in robots]
        await asyncio.sleep(0)
        stage.connected.extend(robots)
        await stage.run(asyncio.gather(*connecting))
        yield stage
    finally:
        await stage.close()

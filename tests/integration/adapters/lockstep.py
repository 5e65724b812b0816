"""Adapters against the simulated world in lockstep: time moves only when no datagram is on its way."""

from contextlib import AbstractAsyncContextManager
from typing import Any

from crew.actors.robot.neighbours import neighbour_of
from crew.adapter import AdapterConfig, Permit
from crew.adapters.mavlink.adapter import MavlinkAdapter
from crew.contracts.site import Separation
from crew.library import load_kind
from crew.sim.config import WorldConfig
from crew.sim.world import World
from tests.integration.paced import SLICE_NS, AdapterStage, connected, free_port

AREA = (-6.0, 10.0, -6.0, 10.0)
KINDS = {"iris": "quadcopter", "tb3": "rover"}


def discs(world: World) -> tuple[tuple[float, float, float], ...]:
    """The map's obstacles as a surveyor of the site writes them down."""
    return tuple(disc for obstacle in world.map.obstacles for disc in obstacle.discs)


class Lockstep(AdapterStage[MavlinkAdapter]):
    """One world, one clock, an adapter for each robot. `hears`: who is told where the others are, as on the bus."""

    def __init__(
        self,
        *,
        seed: int = 0,
        faults: tuple[str, ...] = (),
        options: dict[str, Any] | None = None,
        hears: tuple[str, ...] = (),
    ) -> None:
        super().__init__()
        self._hears = hears
        ports = {name: free_port() for name in KINDS}
        links = {name: f"udp:127.0.0.1:{port}" for name, port in ports.items()}
        self.world = World(WorldConfig(seed=seed, faults=faults, links=links))
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

    @property
    def iris(self) -> MavlinkAdapter:
        return self.adapters["iris"]

    @property
    def tb3(self) -> MavlinkAdapter:
        return self.adapters["tb3"]

    def simulate(self) -> int:
        self._meet()
        self.world.advance(self.world.time_ns + SLICE_NS)
        return self.world.time_ns

    def heard(self) -> bool:
        counts = self.world.counts()
        return all(self.adapters[name].link_counts()[1] >= counts[name].sent for name in self.connected)

    def _meet(self) -> None:
        """What each robot tells of itself, to those that hear it."""
        for name, adapter in self.adapters.items():
            told = {fluent: reading.value for fluent, reading in adapter.fluents().items()}
            neighbour = neighbour_of(name, load_kind(KINDS[name]), told)
            for other in self._hears:
                if other != name and neighbour is not None:
                    self.adapters[other].meet(neighbour)

    def tell(self, name: str, message: Any) -> None:
        """Send the vehicle a message over the adapter's link as somebody else would: a pilot, a second station."""
        self.adapters[name]._vehicle.link.writer.send(message, Permit())

    def utter(self, name: str, message: Any) -> None:
        """Let the vehicle say something."""
        self.world._autopilots[name].link.send(message)

    def end(self) -> None:
        self.world.close()


def lockstep(*robots: str, **how: Any) -> AbstractAsyncContextManager[Lockstep]:
    """A world with the named robots' adapters connected."""
    return connected(Lockstep(**how), robots)

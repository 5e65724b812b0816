"""Faults that somebody publishes on `sim/fault` while the world runs: each one acts, and ends where it can."""

from collections.abc import AsyncIterator, Callable
from contextlib import asynccontextmanager
from typing import NamedTuple

import pytest

from crew.adapters.mavlink.telemetry import Sighting
from crew.bus.fabric import MemoryFabric
from crew.bus.memory import MemoryBus
from crew.bus.port import Bus, Qos
from crew.contracts.kinds.quadcopter import FlyTo, Takeoff
from crew.keys import Keys
from crew.messages import SimFault
from crew.sim.faults import Faults
from crew.sim.process import Simulation
from tests.integration.adapters.lockstep import KINDS, Lockstep, lockstep

KEYS = Keys("demo")
NAMES = Faults(KINDS).names
LOOKS = ("missed_detection", "nan_transmission")
"""Faults of what the camera tells: the drone must look at somebody."""


class Live(NamedTuple):
    """A world in lockstep, and the simulation's side of the bus on it."""

    stage: Lockstep
    bus: Bus
    fabric: MemoryFabric
    simulation: Simulation

    async def switch(self, name: str, on: bool) -> None:
        """Publish as an operator does, and let the world live with it for a while."""
        self.bus.put(KEYS.sim_fault, SimFault(name=name, on=on), qos=Qos.EVENT)
        assert self.fabric.settled()
        self.simulation._take_faults()
        self.stage.iris._vehicle.telemetry.sightings.clear()
        await self.stage.advance(4.0)

    @property
    def sightings(self) -> list[Sighting]:
        return self.stage.iris._vehicle.telemetry.sightings

    def raised(self, *bodies: str) -> bool:
        model, data = self.stage.world._model, self.stage.world._data
        return all(data.body(f"surprise/{name}").xpos[2] > -0.5 for name in bodies) and model.nmocap > 0


@asynccontextmanager
async def live() -> AsyncIterator[Live]:
    async with lockstep(*KINDS) as stage:
        with MemoryFabric() as fabric:
            async with MemoryBus(fabric) as simulated, MemoryBus(fabric) as bus:
                simulation = Simulation(simulated, KEYS, stage.world, {name: name for name in KINDS}, 0.0)
                yield Live(stage, bus, fabric, simulation)


ACTS: dict[str, Callable[[Live], bool]] = {
    "battery_low": lambda it: it.stage.world.truth().robots["iris"].battery < 0.13,
    "blocked_path": lambda it: it.raised("fence_north", "fence_west"),
    "gps_loss": lambda it: "GPS" in it.stage.iris.health() or "position" in it.stage.iris.health(),
    "iris_unavailable": lambda it: "pre-arm" in it.stage.iris.health(),
    "link_loss": lambda it: "link" in it.stage.iris.health() and "link" in it.stage.tb3.health(),
    "missed_detection": lambda it: not it.sightings,
    "nan_transmission": lambda it: bool(it.sightings) and not any(s.finite for s in it.sightings),
    "tb3_unavailable": lambda it: "critical" in it.stage.tb3.health(),
    "unmapped_obstacle": lambda it: it.raised("fallen_crate"),
    "wind_gusts": lambda it: bool(it.stage.world._wind._force[:2].any()),
}
"""How each shows in the world, or in what an adapter was told."""
LASTING = ("battery_low",)


@pytest.mark.parametrize("name", NAMES)
async def test_a_fault_that_is_published_acts_and_ends(name: str) -> None:
    acts = ACTS[name]
    async with live() as it:
        if name in LOOKS:
            victim = it.stage.world.map.victim
            await it.stage.run(it.stage.iris.execute("takeoff", Takeoff(altitude=4), {}))
            above = FlyTo(x=victim.x_m, y=victim.y_m, altitude=4)
            await it.stage.run(it.stage.iris.execute("fly_to", above, {}))
        assert not acts(it), "it does not act before it is published"
        await it.switch(name, on=True)
        assert acts(it), (it.stage.iris.health(), it.stage.tb3.health())
        await it.switch(name, on=False)
        assert acts(it) is (name in LASTING)


def test_every_fault_is_tried() -> None:
    assert set(ACTS) == set(NAMES)


async def test_an_unknown_fault_is_refused_with_the_valid_names_and_the_nearest(
    capsys: pytest.CaptureFixture[str],
) -> None:
    async with live() as it:
        await it.switch("gps_los", on=True)
        told = capsys.readouterr().out
        assert told == f"fault refused: unknown fault 'gps_los'; valid: {', '.join(NAMES)}; nearest: gps_loss\n"
        assert it.stage.iris.health() == ""
        await it.switch("gps_loss", on=True)
        assert ACTS["gps_loss"](it), "the next one is taken"

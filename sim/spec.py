"""What the simulation's process is started with. Must not import the world."""

from collections.abc import Mapping

import msgspec

from crew.bus.link import Link
from crew.sim.config import WorldConfig


class SimulationSpec(msgspec.Struct, frozen=True, kw_only=True):
    """What the simulation process is started with. `speed` 0 is lockstep: as fast as everybody can follow."""

    crew: str
    link: Link
    world: WorldConfig
    vehicles: Mapping[str, str]
    """Robot to the vehicle of the scene that it is."""
    speed: float

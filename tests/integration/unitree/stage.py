"""The unitree adapters against the simulated apartment in lockstep: time moves only when no datagram is on its way."""

import math
from collections.abc import Mapping
from contextlib import AbstractAsyncContextManager
from typing import Any

import msgspec

from crew.adapter import AdapterConfig, Place
from crew.adapters.unitree.adapter import UnitreeAdapter
from crew.contracts.kinds.humanoid import HUMANOID
from crew.contracts.kinds.quadruped import QUADRUPED
from crew.contracts.site import Crew
from crew.library import load_rules
from crew.sim.apartment.world import Apartment
from crew.sim.config import WorldConfig
from tests.integration.paced import SLICE_NS, AdapterStage, connected, free_port

KINDS = {"humanoid": HUMANOID, "quadruped": QUADRUPED}


class Stage(AdapterStage[UnitreeAdapter]):
    """One apartment, one clock, an adapter for each robot of the shipped crew."""

    def __init__(
        self,
        *,
        map_: str = "far",
        seed: int = 0,
        faults: tuple[str, ...] = (),
        noise: bool = True,
        models: str = "",
    ) -> None:
        super().__init__()
        self.crew: Crew = load_rules("humanoid_quadruped").crew
        ports = {robot.name: free_port() for robot in self.crew.robots}
        links = {name: f"udp:127.0.0.1:{port}" for name, port in ports.items()}
        self.world = Apartment(
            WorldConfig(scene="apartment", map=map_, seed=seed, faults=faults, noise=noise, links=links, models=models)
        )
        area = self.crew.area
        self.adapters = {
            robot.name: UnitreeAdapter(
                AdapterConfig(
                    robot=robot.name,
                    kind=robot.kind,
                    connection=f"udpin:127.0.0.1:{ports[robot.name]}",
                    options=dict(robot.options),
                    area=(area.x_min, area.x_max, area.y_min, area.y_max),
                    origin=(0.0, 0.0, 0.0),
                    obstacles=self.world.site.obstacles,
                    locations={place.name: (place.x, place.y) for place in self.crew.locations},
                    models=models,
                ),
                self.clock,
            )
            for robot in self.crew.robots
        }

    @property
    def g1(self) -> UnitreeAdapter:
        return self.adapters["g1"]

    @property
    def go2(self) -> UnitreeAdapter:
        return self.adapters["go2"]

    async def do(self, robot: str, skill: str, **args: str) -> None:
        """Carry out a skill, as a dispatch would."""
        kind = KINDS[next(r.kind for r in self.crew.robots if r.name == robot)]
        declared = kind.skill(skill)
        assert declared is not None
        given = msgspec.convert(args, declared.args)
        await self.run(self.adapters[robot].execute(skill, given, self.places(args)))

    def places(self, args: Mapping[str, Any]) -> dict[str, Place]:
        """A navigation's place: where a location is, or where a person was last seen."""
        name = str(args.get("location"))
        if name in self.adapters["g1"].values():
            point = self.adapters["g1"].values()[name].position
            assert point is not None
            return {"location": Place(point.x, point.y)}
        place = self.crew.location(name)
        return {} if place is None else {"location": Place(place.x, place.y)}

    def simulate(self) -> int:
        self.world.poll()
        self.world.advance(self.world.time_ns + SLICE_NS)
        return self.world.time_ns

    def heard(self) -> bool:
        sent = self.world.sent()
        return all(self.adapters[name].link_counts()[1] >= sent[name] for name in self.connected)

    # The truth.

    def thing(self, name: str) -> tuple[float, float, float]:
        return self.world.scene_truth().targets[name]

    def dog(self) -> tuple[float, float, float, float]:
        return self.world.scene_truth().poses["go2"]

    def away_m(self, name: str, x: float, y: float) -> float:
        """How far a thing truly is from a point, horizontally."""
        return math.dist(self.thing(name)[:2], (x, y))

    def end(self) -> None:
        self.world.close()


def stage(*robots: str, **how: Any) -> AbstractAsyncContextManager[Stage]:
    """An apartment with the named robots' adapters connected; both if none is named."""
    found = Stage(**how)
    return connected(found, robots or tuple(found.adapters))

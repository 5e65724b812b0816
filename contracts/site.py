"""A crew and the site it works on, as data; and the rules that the gate reads."""

from collections.abc import Iterable, Mapping
from functools import cached_property
from typing import Any

import msgspec
from msgspec.structs import replace

from crew.contracts.contract import Contract
from crew.contracts.plan import Zone, digest
from crew.contracts.skill import Fluent, Kind, Part, Published, Skill


class RobotSpec(msgspec.Struct, frozen=True, kw_only=True):
    """One robot of a crew: its kind, its adapter, and either a simulated vehicle or a real connection."""

    name: str
    kind: str
    adapter: str
    aliases: tuple[str, ...] = ()
    reach: tuple[str, ...] = ()
    """The places that the robot reaches from where it stands, for skills that place things."""
    sim: str = ""
    """The simulated vehicle's name in the scene, or empty for a real robot."""
    connection: str = ""
    """The real robot's connection, or empty for a simulated one."""
    options: Mapping[str, Any] = {}


class Location(msgspec.Struct, frozen=True, kw_only=True):
    """A named place, world ENU, metres."""

    name: str
    x: float
    y: float
    aliases: tuple[str, ...] = ()


class NamedZone(msgspec.Struct, frozen=True, kw_only=True):
    """A named part of the operational area."""

    name: str
    zone: Zone
    aliases: tuple[str, ...] = ()


class NamedObject(msgspec.Struct, frozen=True, kw_only=True):
    """An object that robots can handle."""

    name: str
    aliases: tuple[str, ...] = ()


class RuntimeValue(msgspec.Struct, frozen=True, kw_only=True):
    """A value that exists only at run time, with the words that people use for it."""

    name: str
    aliases: tuple[str, ...] = ()
    standoff_m: float = 0.0
    """How far from it a robot stops."""


class Separation(msgspec.Struct, frozen=True, kw_only=True):
    """How far a drone that comes down and robots on the ground keep from each other, horizontally, in metres."""

    column_m: float = 0.8
    """Between their true centres."""
    pose_m: float = 0.25
    """How far each robot's own estimate of its position may be off."""

    @property
    def told_m(self) -> float:
        """Between the positions that two robots tell."""
        return self.column_m + 2.0 * self.pose_m


class SimSpec(msgspec.Struct, frozen=True, kw_only=True):
    """Which simulated scene the crew lives in."""

    scene: str
    map: str = "A"
    seed: int = 0
    faults: tuple[str, ...] = ()
    autopilots: Mapping[str, str] = {}
    """Vehicle to the autopilot that it flies or drives with, where that is not the scene's own."""


class Crew(msgspec.Struct, frozen=True, kw_only=True):
    """A crew file, resolved. The zone `operational_area` is always among `zones`."""

    name: str
    area: Zone
    origin: tuple[float, float, float] = (0.0, 0.0, 0.0)
    """Latitude and longitude in degrees, altitude AMSL in metres of the world's (0, 0, 0)."""
    robots: tuple[RobotSpec, ...] = ()
    locations: tuple[Location, ...] = ()
    zones: tuple[NamedZone, ...] = ()
    objects: tuple[NamedObject, ...] = ()
    values: tuple[RuntimeValue, ...] = ()
    contracts: tuple[str, ...] = ()
    obstacles: tuple[tuple[float, float, float], ...] = ()
    """Known obstacles as discs x, y, radius: world ENU, metres."""
    separation: Separation = Separation()
    sim: SimSpec | None = None
    source: str = ""

    def robot(self, name: str) -> RobotSpec | None:
        return next((r for r in self.robots if r.name == name), None)

    def location(self, name: str) -> Location | None:
        return next((p for p in self.locations if p.name == name), None)

    def value(self, name: str) -> RuntimeValue | None:
        return next((v for v in self.values if v.name == name), None)


class Rules(msgspec.Struct, frozen=True, kw_only=True, dict=True):
    """Everything that a decision depends on beside the mission, the world and the call."""

    crew: Crew
    kinds: Mapping[str, Kind]
    """By kind's name."""
    contracts: Mapping[str, Contract]

    @cached_property
    def _kind_by_robot(self) -> dict[str, Kind]:
        return {r.name: self.kinds[r.kind] for r in self.crew.robots if r.kind in self.kinds}

    def kind_of(self, robot: str) -> Kind | None:
        return self._kind_by_robot.get(robot)

    def skill_of(self, robot: str, name: str) -> Skill | None:
        """A robot's skill; None for a robot that the crew does not have, and for a skill that its kind does not."""
        kind = self._kind_by_robot.get(robot)
        return None if kind is None else kind.skill(name)

    def fluent_of(self, robot: str, name: str) -> Fluent | None:
        kind = self._kind_by_robot.get(robot)
        return None if kind is None else kind.fluent(name)

    def publication(self, robot: str, value: str) -> Published | None:
        """How a robot's kind declares a run-time value; None if it publishes no such value."""
        kind = self._kind_by_robot.get(robot)
        thing = value in self._objects
        published = () if kind is None else kind.publishes
        return next((p for p in published if (thing if p.each_object else p.name == value)), None)

    def publishers_of(self, value: str) -> frozenset[str]:
        """Robots of this crew whose kind publishes the value."""
        return frozenset(spec.name for spec in self.crew.robots if self.publication(spec.name, value))

    @cached_property
    def _objects(self) -> frozenset[str]:
        return frozenset(thing.name for thing in self.crew.objects)

    @cached_property
    def parts(self) -> Mapping[str, Part]:
        """The places that are parts of the crew's robots, by name."""
        return {part.name: part for kind in self._kind_by_robot.values() for part in kind.parts}

    def host_of(self, place: str, robots: Iterable[str]) -> str:
        """Which of these robots a place is part of; empty if it is part of none."""
        return next((r for r in robots if (kind := self.kind_of(r)) is not None and kind.part(place)), "")

    def digest(self) -> str:
        """SHA-256 over crew, kinds and contracts, wherever their files lie."""
        kinds = {name: kind.digest for name, kind in self.kinds.items()}
        contracts = {name: replace(contract, source="") for name, contract in self.contracts.items()}
        return digest({"crew": replace(self.crew, source=""), "kinds": kinds, "contracts": contracts})

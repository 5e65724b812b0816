"""Maps as data: where things stand, read from YAML and checked. Must not know MuJoCo or any robot's dynamics.

World frame: ENU, metres, z up, ground at z = 0; yaw in radians, counter-clockwise from east.
"""

import math
from collections.abc import Iterator
from pathlib import Path
from typing import Annotated, Any

import msgspec
from msgspec import Meta
from ruamel.yaml import YAML
from ruamel.yaml.error import YAMLError

from crew.errors import nearest

MAPS = Path(__file__).parent / "maps"

Length = Annotated[float, Meta(gt=0.0, le=100.0)]
Disc = tuple[float, float, float]
"""x, y, radius: world ENU, metres."""


class MapError(ValueError):
    """A map that cannot be used; the message names the file and the field."""


class Origin(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """Where the world's (0, 0, 0) lies on the Earth; alt_m is above mean sea level."""

    lat_deg: Annotated[float, Meta(ge=-80.0, le=80.0)]
    lon_deg: Annotated[float, Meta(ge=-180.0, le=180.0)]
    alt_m: float


class Area(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """The operational area, an upright rectangle."""

    x_min_m: float
    x_max_m: float
    y_min_m: float
    y_max_m: float

    def contains(self, x_m: float, y_m: float) -> bool:
        return self.x_min_m <= x_m <= self.x_max_m and self.y_min_m <= y_m <= self.y_max_m


class Spot(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    x_m: float
    y_m: float


class Spawn(Spot, frozen=True, kw_only=True):
    yaw_rad: float = 0.0


class Box(Spot, tag_field="shape", tag="box", frozen=True, kw_only=True):
    """A box on the ground; size_m is its full length, width and height."""

    name: str
    size_m: tuple[Length, Length, Length]
    yaw_rad: float = 0.0

    @property
    def reach_m(self) -> float:
        return math.hypot(self.size_m[0], self.size_m[1]) / 2

    @property
    def discs(self) -> tuple[Disc, ...]:
        """A row of discs along the longer side: one disc around a long box would close the way past it."""
        length_m, width_m, _ = self.size_m
        along = self.yaw_rad if length_m >= width_m else self.yaw_rad + math.pi / 2
        long_m, short_m = max(length_m, width_m), min(length_m, width_m)
        count = math.ceil(long_m / short_m)
        piece_m = long_m / count
        offsets = [(i + 0.5) * piece_m - long_m / 2 for i in range(count)]
        radius_m = math.hypot(piece_m, short_m) / 2
        return tuple((self.x_m + o * math.cos(along), self.y_m + o * math.sin(along), radius_m) for o in offsets)


class Cylinder(Spot, tag_field="shape", tag="cylinder", frozen=True, kw_only=True):
    name: str
    radius_m: Length
    height_m: Length

    @property
    def reach_m(self) -> float:
        return self.radius_m

    @property
    def discs(self) -> tuple[Disc, ...]:
        return ((self.x_m, self.y_m, self.radius_m),)


class Tree(Spot, tag_field="shape", tag="tree", frozen=True, kw_only=True):
    """A trunk under a round canopy, which hides from above what stands beneath it; height_m is the canopy's top."""

    name: str
    trunk_radius_m: Length
    height_m: Length
    canopy_radius_m: Length

    @property
    def reach_m(self) -> float:
        return self.trunk_radius_m

    @property
    def discs(self) -> tuple[Disc, ...]:
        return ((self.x_m, self.y_m, self.trunk_radius_m),)


Obstacle = Box | Cylinder | Tree


class Map(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """obstacles are what a surveyor knows, surprises what a fault of that name puts there and nobody knows.

    people: others than the victim. decoys: what a detector takes for a person's colours, in another shape.
    """

    name: str
    scene: str
    origin: Origin
    area: Area
    victim: Spot
    robots: dict[str, Spawn]
    obstacles: tuple[Obstacle, ...] = ()
    people: tuple[Spot, ...] = ()
    decoys: tuple[Box | Cylinder, ...] = ()
    surprises: dict[str, tuple[Box | Cylinder, ...]] = {}


def load_map(scene: str, name: str, folder: Path = MAPS) -> Map:
    """Read the map `name` of `scene`. Raises MapError; an unknown name lists the maps that exist."""
    path = map_file(scene, name, folder)
    return parse_map(path.read_text(encoding="utf-8"), source=path.name)


def map_file(scene: str, name: str, folder: Path = MAPS) -> Path:
    """The file of a scene's map; upper and lower case are one. Raises MapError with those that the scene has."""
    path = folder / f"{scene}_{name.lower()}.yaml"
    if path.is_file():
        return path
    known = sorted(p.stem.removeprefix(f"{scene}_") for p in folder.glob(f"{scene}_*.yaml"))
    raise MapError(f"no map {name!r} of the scene {scene}{nearest(name.lower(), known)}")


def survey(scene: str, name: str) -> tuple[tuple[float, float, float], tuple[tuple[float, float, float], ...]]:
    """Origin, and a disc x, y, radius for each obstacle."""
    found = load_map(scene, name)
    origin = (found.origin.lat_deg, found.origin.lon_deg, found.origin.alt_m)
    return origin, tuple(disc for obstacle in found.obstacles for disc in obstacle.discs)


def parse_map(text: str, source: str = "map") -> Map:
    """Read a map from YAML 1.2 text. Raises MapError naming `source` and the field."""
    try:
        data: Any = YAML(typ="safe", pure=True).load(text)
    except YAMLError as error:
        raise MapError(f"{source}: not YAML: {error}") from error
    try:
        found = msgspec.convert(data, Map)
    except msgspec.ValidationError as error:
        raise MapError(f"{source}: {error}") from error
    _check(found, source)
    return found


def _check(found: Map, source: str) -> None:
    area = found.area
    if area.x_min_m >= area.x_max_m or area.y_min_m >= area.y_max_m:
        raise MapError(f"{source}: $.area: a minimum is not below its maximum")
    spots: dict[str, Spot] = {f"$.robots.{name}": spawn for name, spawn in found.robots.items()}
    spots["$.victim"] = found.victim
    spots |= {f"$.people[{index}]": person for index, person in enumerate(found.people)}
    for field, spot in spots.items():
        if not area.contains(spot.x_m, spot.y_m):
            raise MapError(f"{source}: {field}: ({spot.x_m}, {spot.y_m}) lies outside $.area")
        for obstacle in found.obstacles:
            if math.hypot(spot.x_m - obstacle.x_m, spot.y_m - obstacle.y_m) < obstacle.reach_m:
                raise MapError(f"{source}: {field}: ({spot.x_m}, {spot.y_m}) lies within obstacle {obstacle.name}")
    names: set[str] = set()
    for field, thing in _named(found):
        if thing.name in names:
            raise MapError(f"{source}: {field}.name: {thing.name} is used twice")
        names.add(thing.name)


def _named(found: Map) -> Iterator[tuple[str, Obstacle]]:
    groups: dict[str, tuple[Obstacle, ...]] = {"$.obstacles": found.obstacles, "$.decoys": found.decoys}
    groups |= {f"$.surprises.{fault}": things for fault, things in found.surprises.items()}
    for group, things in groups.items():
        yield from ((f"{group}[{index}]", thing) for index, thing in enumerate(things))

"""Maps as data: where things stand, read from YAML and checked. Must not know MuJoCo or any robot's dynamics.

World frame: ENU, metres, z up, ground at z = 0; yaw in radians, counter-clockwise from east.
"""

import difflib
import math
from pathlib import Path
from typing import Annotated, Any

import msgspec
from msgspec import Meta
from ruamel.yaml import YAML
from ruamel.yaml.error import YAMLError

MAPS = Path(__file__).parent / "maps"

Length = Annotated[float, Meta(gt=0.0, le=100.0)]


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


class Cylinder(Spot, tag_field="shape", tag="cylinder", frozen=True, kw_only=True):
    name: str
    radius_m: Length
    height_m: Length

    @property
    def reach_m(self) -> float:
        return self.radius_m


class Tree(Spot, tag_field="shape", tag="tree", frozen=True, kw_only=True):
    """A trunk under a round canopy, which hides from above what stands beneath it; height_m is the canopy's top."""

    name: str
    trunk_radius_m: Length
    height_m: Length
    canopy_radius_m: Length

    @property
    def reach_m(self) -> float:
        return self.trunk_radius_m


Obstacle = Box | Cylinder | Tree


class Map(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    name: str
    scene: str
    origin: Origin
    area: Area
    victim: Spot
    robots: dict[str, Spawn]
    obstacles: tuple[Obstacle, ...] = ()


def load_map(scene: str, name: str, folder: Path = MAPS) -> Map:
    """Read the map `name` of `scene`. Raises MapError; an unknown name lists the maps that exist."""
    path = folder / f"{scene}_{name.lower()}.yaml"
    if not path.is_file():
        known = sorted(p.stem for p in folder.glob("*.yaml"))
        near = difflib.get_close_matches(path.stem, known, n=1)
        hint = f"; did you mean {near[0]}?" if near else ""
        raise MapError(f"no map {path.stem}; there are: {', '.join(known)}{hint}")
    return parse_map(path.read_text(encoding="utf-8"), source=path.name)


def survey(scene: str, name: str) -> tuple[tuple[float, float, float], tuple[tuple[float, float, float], ...]]:
    """Origin, and a disc x, y, radius for each obstacle."""
    found = load_map(scene, name)
    origin = (found.origin.lat_deg, found.origin.lon_deg, found.origin.alt_m)
    return origin, tuple((o.x_m, o.y_m, o.reach_m) for o in found.obstacles)


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
    for field, spot in spots.items():
        if not area.contains(spot.x_m, spot.y_m):
            raise MapError(f"{source}: {field}: ({spot.x_m}, {spot.y_m}) lies outside $.area")
        for obstacle in found.obstacles:
            if math.hypot(spot.x_m - obstacle.x_m, spot.y_m - obstacle.y_m) < obstacle.reach_m:
                raise MapError(f"{source}: {field}: ({spot.x_m}, {spot.y_m}) lies within obstacle {obstacle.name}")
    names = [obstacle.name for obstacle in found.obstacles]
    for index, obstacle_name in enumerate(names):
        if obstacle_name in names[:index]:
            raise MapError(f"{source}: $.obstacles[{index}].name: {obstacle_name} is used twice")

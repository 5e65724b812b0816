"""Maps of the apartment as data, read from YAML and checked. Must not know MuJoCo or any robot's dynamics.

World frame: ENU, metres, z up, floor at z = 0; yaw in radians, counter-clockwise from east.
"""

import math
from collections.abc import Iterator
from pathlib import Path
from typing import Annotated, Any, Literal

import msgspec
from msgspec import Meta
from ruamel.yaml import YAML
from ruamel.yaml.error import YAMLError

from crew.sim.map import MAPS, Area, MapError, Origin, Spot, map_file

SCENE = "apartment"
WALL_M = 0.1
"""Thickness of every wall."""
BODY_BEHIND_M = 0.6
"""How far a person's body stands behind the hand that they hold out."""
BODY_RADIUS_M = 0.18

Length = Annotated[float, Meta(gt=0.0, le=100.0)]
Disc = tuple[float, float, float]


class Pose(Spot, frozen=True, kw_only=True):
    yaw_rad: float = 0.0


class Person(Pose, frozen=True, kw_only=True):
    """Where a person holds out a hand, which way they face, and where they go if they walk away."""

    z_m: Annotated[float, Meta(ge=0.5, le=1.6)] = 0.95
    leaves_to: Spot


class Wall(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """From one point to another along an axis."""

    start: tuple[float, float]
    end: tuple[float, float]


class Table(Spot, frozen=True, kw_only=True):
    name: str
    size_m: tuple[Length, Length]
    height_m: Length


class Thing(Spot, frozen=True, kw_only=True):
    """An object on a table. A box has its edge, a cylinder its radius and height."""

    name: str
    on: str
    edge_m: Length | None = None
    radius_m: Length | None = None
    height_m: Length | None = None
    mass_kg: Length


class Doorway(Spot, frozen=True, kw_only=True):
    """The middle of a doorway, which a crate can block."""

    name: str
    width_m: Length
    along: Literal["x", "y"]
    """The axis of the wall that it is in."""


class Site(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """One map. `jitter_m` is how far the seed moves things and people."""

    name: str
    scene: str
    origin: Origin
    area: Area
    robots: dict[str, Pose]
    requester: Person
    things: tuple[Thing, ...]
    tables: tuple[Table, ...]
    walls: tuple[Wall, ...]
    doorways: tuple[Doorway, ...]
    jitter_m: float = 0.0
    person_jitter_m: float = 0.0

    @property
    def obstacles(self) -> tuple[Disc, ...]:
        """Walls and tables as a surveyor would note them: discs x, y, radius."""
        return (*_wall_discs(self.walls), *(d for table in self.tables for d in _table_discs(table)))


def load_site(name: str, folder: Path = MAPS) -> Site:
    """Read one map. Raises MapError; an unknown name lists the maps that exist."""
    path = map_file(SCENE, name, folder)
    return parse_site(path.read_text(encoding="utf-8"), source=path.name)


def survey(scene: str, name: str) -> tuple[tuple[float, float, float], tuple[Disc, ...]]:
    """Origin, and discs x, y, radius for walls and tables."""
    site = load_site(name)
    return (site.origin.lat_deg, site.origin.lon_deg, site.origin.alt_m), site.obstacles


def parse_site(text: str, source: str = "map") -> Site:
    """Read a map from YAML 1.2 text. Raises MapError naming `source` and the field."""
    try:
        data: Any = YAML(typ="safe", pure=True).load(text)
        found = msgspec.convert(data, Site)
    except YAMLError as error:
        raise MapError(f"{source}: not YAML: {error}") from error
    except msgspec.ValidationError as error:
        raise MapError(f"{source}: {error}") from error
    _check(found, source)
    return found


def _check(site: Site, source: str) -> None:
    spots: dict[str, Spot] = {f"$.robots.{name}": pose for name, pose in site.robots.items()}
    spots |= {"$.requester": site.requester} | {f"$.things.{thing.name}": thing for thing in site.things}
    for field, spot in spots.items():
        if not site.area.contains(spot.x_m, spot.y_m):
            raise MapError(f"{source}: {field}: ({spot.x_m}, {spot.y_m}) lies outside $.area")
    tables = {table.name: table for table in site.tables}
    for thing in site.things:
        if thing.on not in tables:
            raise MapError(f"{source}: $.things.{thing.name}.on: no table {thing.on!r}; there are {', '.join(tables)}")
        if (thing.edge_m is None) == (thing.radius_m is None or thing.height_m is None):
            raise MapError(f"{source}: $.things.{thing.name}: give edge_m, or radius_m and height_m")


def _wall_discs(walls: tuple[Wall, ...]) -> Iterator[Disc]:
    for wall in walls:
        (x0, y0), (x1, y1) = wall.start, wall.end
        length_m = math.dist(wall.start, wall.end)
        count = max(1, math.ceil(length_m / 0.2))
        for i in range(count + 1):
            yield x0 + (x1 - x0) * i / count, y0 + (y1 - y0) * i / count, 0.1


def _table_discs(table: Table) -> Iterator[Disc]:
    """A square grid of discs that covers the table's top, and little more."""
    length, width = table.size_m
    columns, rows = max(1, round(length / 0.2)), max(1, round(width / 0.2))
    radius_m = math.hypot(length / columns, width / rows) / 2
    for i in range(columns):
        for j in range(rows):
            x = table.x_m - length / 2 + (i + 0.5) * length / columns
            y = table.y_m - width / 2 + (j + 0.5) * width / rows
            yield x, y, radius_m

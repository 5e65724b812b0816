"""Builds the physical scene of a map: ground, obstacles, victim and robots. Must not step it or command anything."""

import math
from pathlib import Path
from typing import Any

import mujoco

from crew.sim.map import Box, Cylinder, Map, MapError, Obstacle, Spot, Tree

MODELS = Path(__file__).parent / "models"
ROBOTS: dict[str, dict[str, float]] = {"air_ground": {"iris": 0.10, "tb3": 0.0}}  # spawn height of the body's origin
TIMESTEP_NS = 4_000_000
GROUND_GROUP = 1  # geoms that the camera need not see; all others are in group 0
HIDDEN_M = -20.0
AIR_DENSITY, AIR_VISCOSITY = 1.2, 1.8e-5  # kg/m^3, Pa s: drag


def build(found: Map) -> Any:
    """The compiled MjModel. Names of a robot's parts begin with `<robot>/`, the victim's with `victim/`."""
    spec = mujoco.MjSpec()
    spec.compiler.degree = False
    spec.option.timestep = TIMESTEP_NS * 1e-9
    spec.option.integrator = mujoco.mjtIntegrator.mjINT_EULER
    spec.option.disableflags |= mujoco.mjtDisableBit.mjDSBL_ISLAND  # too few bodies for islands to pay off
    spec.option.density, spec.option.viscosity = AIR_DENSITY, AIR_VISCOSITY
    _add_ground(spec)
    for obstacle in found.obstacles:
        _add_obstacle(spec, obstacle, "obstacle")
    for decoy in found.decoys:
        _add_obstacle(spec, decoy, "decoy")
    for surprise in (thing for things in found.surprises.values() for thing in things):
        _add_obstacle(spec, surprise, "surprise", hidden=True)
    for name, person in people(found).items():
        _attach(spec, "victim", (person.x_m, person.y_m, 0.0), 0.0, prefix=name)
    for name, height_m in robots(found).items():
        spawn = found.robots[name]
        _attach(spec, name, (spawn.x_m, spawn.y_m, height_m), spawn.yaw_rad)
    return spec.compile()


def people(found: Map) -> dict[str, Spot]:
    """Everybody on the map, by the prefix of their bodies' names; `victim` is the one that is looked for."""
    return {"victim": found.victim, **{f"person_{index}": spot for index, spot in enumerate(found.people)}}


def seen_bodies(found: Map) -> tuple[str, ...]:
    """The bodies that the camera's detector answers to: people, and what has their colours."""
    return (*(f"{name}/person" for name in people(found)), *(f"decoy/{decoy.name}" for decoy in found.decoys))


class Surprises:
    """What a fault puts on the ground: bodies that wait below it until they are raised."""

    def __init__(self, found: Map, model: Any, data: Any) -> None:
        self._heights = data.mocap_pos[:, 2]
        self._ids = {
            fault: [int(model.body_mocapid[model.body(f"surprise/{thing.name}").id]) for thing in things]
            for fault, things in found.surprises.items()
        }

    def show(self, fault: str, on: bool) -> None:
        """Raise or sink what belongs to a fault; a map need not have anything for it."""
        for body in self._ids.get(fault, ()):
            self._heights[body] = 0.0 if on else HIDDEN_M


def robots(found: Map) -> dict[str, float]:
    """The robots of the map's scene, with their spawn heights in metres. Raises MapError if one has no spawn."""
    if found.scene not in ROBOTS:
        raise MapError(f"map {found.name}: $.scene: {found.scene!r} is not one of {', '.join(sorted(ROBOTS))}")
    wanted = ROBOTS[found.scene]
    if set(found.robots) != set(wanted):
        raise MapError(f"map {found.name}: $.robots: has {sorted(found.robots)}, the scene needs {sorted(wanted)}")
    return wanted


def _add_ground(spec: Any) -> None:
    spec.worldbody.add_light(pos=[0, 0, 20], dir=[0, 0, -1], type=mujoco.mjtLightType.mjLIGHT_DIRECTIONAL)
    spec.worldbody.add_geom(
        name="ground",
        type=mujoco.mjtGeom.mjGEOM_PLANE,
        size=[30, 30, 1],
        rgba=[0.45, 0.5, 0.4, 1],
        friction=[0.9, 0.005, 0.0001],
        group=GROUND_GROUP,
    )


def _add_obstacle(spec: Any, obstacle: Obstacle, group: str, *, hidden: bool = False) -> None:
    pos = [obstacle.x_m, obstacle.y_m, HIDDEN_M if hidden else 0.0]
    body = spec.worldbody.add_body(name=f"{group}/{obstacle.name}", pos=pos, mocap=hidden)
    match obstacle:
        case Box(size_m=(length, width, height), yaw_rad=yaw):
            body.quat = _yaw_quaternion(yaw)
            body.add_geom(
                type=mujoco.mjtGeom.mjGEOM_BOX, size=[length / 2, width / 2, height / 2], pos=[0, 0, height / 2]
            )
        case Cylinder(radius_m=radius, height_m=height):
            body.add_geom(type=mujoco.mjtGeom.mjGEOM_CYLINDER, size=[radius, height / 2, 0], pos=[0, 0, height / 2])
        case Tree():
            _add_tree(body, obstacle)


def _add_tree(body: Any, tree: Tree) -> None:
    crown = min(tree.canopy_radius_m, tree.height_m / 3)  # half the canopy's thickness
    trunk = tree.height_m - crown
    body.add_geom(type=mujoco.mjtGeom.mjGEOM_CYLINDER, size=[tree.trunk_radius_m, trunk / 2, 0], pos=[0, 0, trunk / 2])
    body.add_geom(
        type=mujoco.mjtGeom.mjGEOM_ELLIPSOID,
        size=[tree.canopy_radius_m, tree.canopy_radius_m, crown],
        pos=[0, 0, tree.height_m - crown],
        rgba=[0.15, 0.45, 0.15, 1],
    )


def _attach(spec: Any, name: str, pos: tuple[float, float, float], yaw_rad: float, prefix: str = "") -> None:
    child = mujoco.MjSpec.from_file(str(MODELS / f"{name}.xml"))
    frame = spec.worldbody.add_frame(pos=list(pos), quat=_yaw_quaternion(yaw_rad))
    spec.attach(child, prefix=f"{prefix or name}/", frame=frame)


def _yaw_quaternion(yaw_rad: float) -> list[float]:
    return [math.cos(yaw_rad / 2), 0.0, 0.0, math.sin(yaw_rad / 2)]

"""Builds the apartment of a map: floor, walls, tables, things, the person and the robots. Must not step it."""

import math
from pathlib import Path
from typing import Any

import mujoco

from crew.sim.apartment.site import BODY_BEHIND_M, BODY_RADIUS_M, WALL_M, Doorway, Site, Table, Thing, Wall
from crew.sim.unitree import menagerie

MODELS = Path(__file__).parents[1] / "models"
ROBOTS = {"g1": 0.0, "go2": 0.335}
"""Spawn height of each robot's origin."""
TIMESTEP_NS = 2_500_000
CRATE_AWAY = (0.0, 0.0, -3.0)
"""Where a doorway's crate is while nothing is blocked: below the floor."""
FRICTION = [0.9, 0.005, 0.0001]


def build(site: Site, models: str = "") -> Any:
    """The compiled MjModel. Names begin with the robot's, `requester/`, `thing/`, `crate/` or `obstacle/`.

    `models`: MuJoCo Menagerie's folder, whose robots then take the place of this project's own. Raises ModelsError.
    """
    spec = mujoco.MjSpec()
    spec.compiler.degree = False
    spec.option.timestep = TIMESTEP_NS * 1e-9
    spec.option.integrator = mujoco.mjtIntegrator.mjINT_IMPLICITFAST
    spec.option.disableflags |= mujoco.mjtDisableBit.mjDSBL_ISLAND
    spec.option.cone = mujoco.mjtCone.mjCONE_ELLIPTIC
    spec.worldbody.add_light(pos=[2.5, 0, 6], dir=[0, 0, -1], type=mujoco.mjtLightType.mjLIGHT_DIRECTIONAL)
    spec.worldbody.add_geom(
        name="floor", type=mujoco.mjtGeom.mjGEOM_PLANE, size=[30, 30, 1], rgba=[0.5, 0.48, 0.45, 1], friction=FRICTION
    )
    for number, wall in enumerate(site.walls):
        _add_wall(spec, number, wall)
    for table in site.tables:
        _add_table(spec, table)
    for name, height_m in ROBOTS.items():
        pose = site.robots[name]
        child = menagerie.robot(name, models) if models else mujoco.MjSpec.from_file(str(MODELS / f"{name}.xml"))
        if models:
            menagerie.agree(child, spec)
        frame = spec.worldbody.add_frame(pos=[pose.x_m, pose.y_m, height_m], quat=_yaw_quaternion(pose.yaw_rad))
        spec.attach(child, prefix=f"{name}/", frame=frame)
    for doorway in site.doorways:
        _add_crate(spec, doorway)
    _add_requester(spec, site)
    heights = {table.name: table.height_m for table in site.tables}
    for thing in site.things:
        _add_thing(spec, thing, heights[thing.on])
    return spec.compile()


def _add_wall(spec: Any, number: int, wall: Wall) -> None:
    (x0, y0), (x1, y1) = wall.start, wall.end
    size = [(abs(x1 - x0) + WALL_M) / 2, (abs(y1 - y0) + WALL_M) / 2, 0.6]
    body = spec.worldbody.add_body(name=f"obstacle/wall_{number}", pos=[(x0 + x1) / 2, (y0 + y1) / 2, 0.6])
    body.add_geom(type=mujoco.mjtGeom.mjGEOM_BOX, size=size, rgba=[0.85, 0.85, 0.8, 1])


def _add_table(spec: Any, table: Table) -> None:
    length, width = table.size_m
    body = spec.worldbody.add_body(name=f"obstacle/{table.name}", pos=[table.x_m, table.y_m, 0.0])
    body.add_geom(
        type=mujoco.mjtGeom.mjGEOM_BOX,
        size=[length / 2, width / 2, 0.02],
        pos=[0, 0, table.height_m - 0.02],
        friction=FRICTION,
        rgba=[0.6, 0.45, 0.3, 1],
    )
    for x in (-1, 1):
        for y in (-1, 1):
            leg = [x * (length / 2 - 0.03), y * (width / 2 - 0.03), table.height_m / 2]
            body.add_geom(type=mujoco.mjtGeom.mjGEOM_CYLINDER, size=[0.02, table.height_m / 2 - 0.04, 0], pos=leg)


def _add_thing(spec: Any, thing: Thing, height_m: float) -> None:
    half_m = (thing.edge_m or thing.height_m or 0.0) / 2
    body = spec.worldbody.add_body(name=f"thing/{thing.name}", pos=[thing.x_m, thing.y_m, height_m + half_m + 0.001])
    body.add_freejoint(name=f"thing/{thing.name}")
    common = {"mass": thing.mass_kg, "friction": FRICTION, "name": f"thing/{thing.name}"}
    if thing.edge_m is not None:
        body.add_geom(type=mujoco.mjtGeom.mjGEOM_BOX, size=[half_m] * 3, rgba=[0.85, 0.15, 0.1, 1], **common)
    else:
        body.add_geom(
            type=mujoco.mjtGeom.mjGEOM_CYLINDER, size=[thing.radius_m, half_m, 0], rgba=[0.1, 0.4, 0.8, 1], **common
        )


def _add_crate(spec: Any, doorway: Doorway) -> None:
    body = spec.worldbody.add_body(name=f"crate/{doorway.name}", pos=list(CRATE_AWAY), mocap=True)
    size = [0.2, 0.2, 0.3]
    size["xy".index(doorway.along)] = doorway.width_m / 2 - 0.02
    body.add_geom(type=mujoco.mjtGeom.mjGEOM_BOX, size=size, rgba=[0.5, 0.35, 0.2, 1])


def _add_requester(spec: Any, site: Site) -> None:
    """A person: a body, and the hand that they hold out. Its origin is the hand."""
    person = site.requester
    body = spec.worldbody.add_body(
        name="requester/hand",
        pos=[person.x_m, person.y_m, person.z_m],
        quat=_yaw_quaternion(person.yaw_rad),
        mocap=True,
    )
    body.add_geom(
        name="requester/palm", type=mujoco.mjtGeom.mjGEOM_SPHERE, size=[0.03, 0, 0], contype=0, conaffinity=0,
        rgba=[0.9, 0.7, 0.6, 1],
    )  # fmt: skip
    body.add_geom(
        type=mujoco.mjtGeom.mjGEOM_CAPSULE, size=[0.035, 0, 0], fromto=[-0.06, 0, 0, -BODY_BEHIND_M, 0, 0.35],
        contype=0, conaffinity=0, rgba=[0.2, 0.3, 0.6, 1],
    )  # fmt: skip
    standing = spec.worldbody.add_body(
        name="requester/body",
        pos=[
            person.x_m - BODY_BEHIND_M * math.cos(person.yaw_rad),
            person.y_m - BODY_BEHIND_M * math.sin(person.yaw_rad),
            0.75,
        ],
        mocap=True,
    )
    standing.add_geom(
        type=mujoco.mjtGeom.mjGEOM_CYLINDER, size=[BODY_RADIUS_M - 0.03, 0.75, 0], rgba=[0.2, 0.3, 0.6, 1]
    )
    for thing in site.things:
        grip = spec.add_equality(
            name=f"requester/{thing.name}",
            type=mujoco.mjtEq.mjEQ_WELD,
            objtype=mujoco.mjtObj.mjOBJ_BODY,
            name1="requester/hand",
            name2=f"thing/{thing.name}",
            active=False,
        )
        grip.solref = [0.02, 1.0]


def _yaw_quaternion(yaw_rad: float) -> list[float]:
    return [math.cos(yaw_rad / 2), 0.0, 0.0, math.sin(yaw_rad / 2)]

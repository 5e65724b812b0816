"""MuJoCo Menagerie's Go2 and G1 as robots of the scene: this project's names, tray and gripper on their bodies.

Reads the folder that the user has, and carries nothing of it. Their masses, joints, limits and meshes stay as they are.
"""

import math
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import mujoco
import numpy as np

from crew.errors import nearest
from crew.sim.unitree.gait import LEGS
from crew.sim.unitree.leg import THIGH_M

SOURCE = "https://github.com/google-deepmind/mujoco_menagerie"
FILES = {"g1": "unitree_g1/g1.xml", "go2": "unitree_go2/go2.xml"}
OWN = Path(__file__).parents[1] / "models"
LEG_JOINTS = tuple(f"{leg}_{part}" for leg in ("FR", "FL", "RR", "RL") for part in ("hip", "thigh", "calf"))
WAIST = ("waist_yaw", "waist_roll", "waist_pitch")
ARM = ("shoulder_pitch", "shoulder_roll", "shoulder_yaw", "elbow", "wrist_roll", "wrist_pitch", "wrist_yaw")
ARM_JOINTS = {**{f"{joint}_joint": joint for joint in WAIST}, **{f"right_{joint}_joint": joint for joint in ARM}}
"""The joints that are commanded, and what they are called here."""
HELD = {"left_shoulder_pitch_joint": 0.3, "left_shoulder_roll_joint": 0.15, "left_elbow_joint": 1.3}
"""Every other joint is held: these at an angle, radians, the rest at zero."""
WRIST, RUBBER_HAND = "right_wrist_yaw_link", "right_rubber_hand"
LEG_TOLERANCE_M = 0.002
MOUNT_M = 0.0215
"""The gripper's origin ahead of the wrist's yaw axis: its palm begins at the flange."""


class ModelsError(ValueError):
    """The folder has not the models that the scene needs."""


def check(folder: str) -> None:
    """Whether the folder has both robots, with every joint and part that is used. Raises ModelsError."""
    for name in FILES:
        robot(name, folder)


def robot(name: str, folder: str) -> Any:
    """The MjSpec of a robot, with its origin on the ground or in its trunk as the scene's own. Raises ModelsError."""
    path = Path(folder).expanduser() / FILES[name]
    if not path.is_file():
        raise ModelsError(
            f"there is no {FILES[name]} in {folder!r}; fetch MuJoCo Menagerie (git clone {SOURCE}) and give "
            f"the path of its folder"
        )
    try:
        spec = mujoco.MjSpec.from_file(str(path))
    except ValueError as error:
        raise ModelsError(f"{path} can't be read: {error}") from error
    for mesh in spec.meshes:
        if mesh.file and not (path.parent / spec.meshdir / mesh.file).is_file():
            raise ModelsError(f"{path}: its mesh {spec.meshdir}/{mesh.file} is not there; fetch the whole folder")
    (_quadruped if name == "go2" else _humanoid)(spec, path)
    for key in list(spec.keys):
        spec.delete(key)
    return spec


def agree(child: Any, parent: Any) -> None:
    """Give a robot the scene's solver: a model that is attached brings none of its own."""
    for option in ("cone", "impratio", "integrator", "timestep"):
        setattr(child.option, option, getattr(parent.option, option))


def _quadruped(spec: Any, path: Path) -> None:
    trunk = _body(spec, "base", path)
    _rename(spec, {f"{motor}_joint": motor for motor in LEG_JOINTS}, path)
    _measure(spec, path)
    trunk.name, trunk.pos = "trunk", [0.0, 0.0, 0.0]
    _adopt(spec, trunk.add_frame(), "go2", "tray")


def _measure(spec: Any, path: Path) -> None:
    """Whether its legs are those that the gait knows."""
    for number, leg in enumerate(LEGS):
        joints = LEG_JOINTS[3 * number : 3 * number + 3]
        known = ((leg.hip_x_m, leg.hip_y_m, 0.0), (0.0, leg.offset_m, 0.0), (0.0, 0.0, -THIGH_M))
        for joint, place in zip(joints, known, strict=True):
            found = spec.joint(joint).parent.pos.tolist()
            if math.dist(found, place) > LEG_TOLERANCE_M:
                seen = ", ".join(f"{part:.4f}" for part in found)
                raise ModelsError(
                    f"{path}: {joint} lies at ({seen}) m in its parent; the gait knows legs with {place}, within "
                    f"{LEG_TOLERANCE_M} m"
                )


def _humanoid(spec: Any, path: Path) -> None:
    """The pelvis, the legs and the left arm are held; the right hand gives way to the gripper."""
    _body(spec, "pelvis", path)
    wrist = _body(spec, WRIST, path)
    _rename(spec, ARM_JOINTS, path)
    for joint in list(spec.joints):
        if joint.name not in ARM_JOINTS.values():
            _hold(spec, joint)
    for body in spec.bodies:
        body.gravcomp = 1.0
    for geom in spec.geoms:
        geom.contype = 0  # touches whatever is not its own: hulls of neighbouring links overlap within their range
    for geom in list(wrist.geoms):
        if geom.meshname == RUBBER_HAND:
            spec.delete(geom)
    _grip(spec, wrist)


def _grip(spec: Any, wrist: Any) -> None:
    """This project's two fingers and their palm, whose mass the wrist's link already has."""
    hand = mujoco.MjSpec.from_file(str(OWN / "g1.xml")).body("hand")
    gripper = wrist.add_body(name="gripper", pos=[MOUNT_M, 0.0, 0.0], gravcomp=1.0)
    palm, site = hand.geoms[0], hand.sites[0]
    gripper.add_geom(
        type=palm.type, size=palm.size, pos=palm.pos, contype=0, conaffinity=0, group=2, mass=0.0, rgba=palm.rgba
    )
    gripper.add_site(name=site.name, pos=site.pos)
    for finger in ("finger_left", "finger_right"):
        _adopt(spec, gripper.add_frame(), "g1", finger)


def _adopt(spec: Any, frame: Any, model: str, body: str) -> None:
    """Put a body of one of this project's own models into a frame, with its motors and under its own names."""
    own = mujoco.MjSpec.from_file(str(OWN / f"{model}.xml"))
    frame.attach_body(own.body(body), "own/", "")
    for part in (*spec.bodies, *spec.geoms, *spec.sites, *spec.joints, *spec.actuators):
        part.name = part.name.removeprefix("own/")
    for actuator in spec.actuators:
        actuator.target = actuator.target.removeprefix("own/")


def _rename(spec: Any, names: Mapping[str, str], path: Path) -> None:
    """Call joints and their actuators as this project does. Raises ModelsError before anything has another name."""
    joints = {joint.name: joint for joint in spec.joints}
    motors: dict[str, list[Any]] = {name: [a for a in spec.actuators if a.target == name] for name in names}
    for name in names:
        if name not in joints:
            raise ModelsError(f"{path} has no joint {name!r}{nearest(name, _named(spec.joints))}")
        if len(motors[name]) != 1:
            raise ModelsError(f"{path}: joint {name!r} has {len(motors[name])} actuators, 1 is needed")
    for theirs, ours in names.items():
        joints[theirs].name = motors[theirs][0].name = motors[theirs][0].target = ours


def _hold(spec: Any, joint: Any) -> None:
    """Take a joint out, its body turned as far as the joint stood."""
    body, angle = joint.parent, HELD.get(joint.name, 0.0)
    if angle:
        turn, found = np.zeros(4), np.zeros(4)
        mujoco.mju_axisAngle2Quat(turn, joint.axis, angle)
        mujoco.mju_mulQuat(found, body.quat, turn)
        body.quat = found
    for actuator in list(spec.actuators):
        if actuator.target == joint.name:
            spec.delete(actuator)
    spec.delete(joint)


def _body(spec: Any, name: str, path: Path) -> Any:
    body = spec.body(name)
    if body is None:
        raise ModelsError(f"{path} has no body {name!r}{nearest(name, _named(spec.bodies))}")
    return body


def _named(parts: Any) -> list[str]:
    return [part.name for part in parts if part.name]

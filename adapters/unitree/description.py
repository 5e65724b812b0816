"""The robot's description: kinematics of the waist and the right arm, from this project's own or MuJoCo Menagerie's.

Joints have the same names in both. Frame FLU, origin on the ground below the pelvis.
"""

from pathlib import Path
from typing import Any

import mujoco

from crew.errors import AdapterError, nearest

OWN = Path(__file__).parent / "models" / "arm.xml"
SITE = "grasp"
MENAGERIE = "unitree_g1/g1.xml"
WRIST, GRASP_M = "right_wrist_yaw_link", 0.1515
"""The gripper's middle is this far ahead of the wrist's yaw axis: its palm sits on the flange."""
WAIST = ("waist_yaw", "waist_roll", "waist_pitch")
ARM = ("shoulder_pitch", "shoulder_roll", "shoulder_yaw", "elbow", "wrist_roll", "wrist_pitch", "wrist_yaw")
JOINTS = {**{f"{joint}_joint": joint for joint in WAIST}, **{f"right_{joint}_joint": joint for joint in ARM}}


def describe(models: str = "") -> Any:
    """The compiled MjModel. `models`: MuJoCo Menagerie's folder, or empty. Raises AdapterError `bad_option`."""
    if not models:
        return mujoco.MjModel.from_xml_path(str(OWN))
    path = Path(models).expanduser() / MENAGERIE
    if not path.is_file():
        raise AdapterError(
            f"models: there is no {MENAGERIE} in {models!r}, MuJoCo Menagerie's folder", code="bad_option"
        )
    try:
        return _arm(mujoco.MjSpec.from_file(str(path)), path)
    except ValueError as error:
        raise AdapterError(f"models: {path} can't be used: {error}", code="bad_option") from error


def _arm(spec: Any, path: Path) -> Any:
    """The commanded joints alone, without shapes, motors and sensors."""
    found, wrist = {joint.name: joint for joint in spec.joints}, spec.body(WRIST)
    for joint in JOINTS:
        if joint not in found:
            known = [name for name in found if name]
            raise AdapterError(f"models: {path} has no joint {joint!r}{nearest(joint, known)}", code="bad_option")
    if wrist is None:
        known = [body.name for body in spec.bodies if body.name]
        raise AdapterError(f"models: {path} has no body {WRIST!r}{nearest(WRIST, known)}", code="bad_option")
    for parts in (spec.keys, spec.sensors, spec.actuators, spec.geoms, spec.meshes):
        for part in list(parts):
            spec.delete(part)
    for name, joint in found.items():
        if name in JOINTS:
            joint.name = JOINTS[name]
        else:
            spec.delete(joint)
    wrist.add_site(name=SITE, pos=[GRASP_M, 0.0, 0.0])
    return spec.compile()

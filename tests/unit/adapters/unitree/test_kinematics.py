"""The arm's kinematics: the description agrees with the simulated arm, and the solver reaches what is in reach."""

import math
from pathlib import Path
from typing import Any

import mujoco
import pytest

from crew.adapters.unitree.description import describe
from crew.adapters.unitree.kinematics import READY, REST, TUCKED, Arm, between, distance_m, hand_pose, withdrawn
from crew.errors import AdapterError
from crew.sim.apartment.scene import MODELS
from crew.sim.unitree.menagerie import robot
from tests import menagerie

CUBE, TRAY, HAND, TABLE_B = (0.37, -0.08, 0.745), (0.08, -0.47, 0.63), (0.33, -0.42, 0.95), (0.12, 0.52, 0.77)


BENT = (0.5, 0.2, 0.3, -1.0, -0.4, 0.6, 1.0, 0.5, -0.7, 0.4)


@pytest.fixture(scope="module")
def arm() -> Arm:
    return Arm()


def has_the_hand_there(arm: Arm, model: Any, posture: tuple[float, ...]) -> None:
    """The description's hand is where the simulated robot's is, in one posture."""
    data = mujoco.MjData(model)
    for name, angle in zip(arm.names, posture, strict=True):
        data.joint(name).qpos[0] = angle
    mujoco.mj_kinematics(model, data)
    pose = arm.pose(posture)
    assert pose.translation().tolist() == pytest.approx(data.site("grasp").xpos.tolist(), abs=1e-9)
    assert pose.rotation().as_matrix().ravel().tolist() == pytest.approx(data.site("grasp").xmat.tolist(), abs=1e-9)


@pytest.mark.parametrize("posture", [REST, TUCKED, READY, BENT])
def test_it_has_the_hand_where_the_simulated_robot_has_it(arm: Arm, posture: tuple[float, ...]) -> None:
    has_the_hand_there(arm, mujoco.MjModel.from_xml_path(str(MODELS / "g1.xml")), posture)


@pytest.mark.parametrize("point", [CUBE, TRAY, HAND, TABLE_B])
def test_every_place_of_the_scene_is_in_reach(arm: Arm, point: tuple[float, float, float]) -> None:
    assert arm.shortfall_m(READY, hand_pose(point, math.atan2(point[1], point[0]), 0.4)) < 0.015


def test_what_is_too_far_falls_short(arm: Arm) -> None:
    assert arm.shortfall_m(READY, hand_pose((1.2, 0.0, 0.8), 0.0, 0.4)) > 0.2


def test_a_way_begins_and_ends_where_it_shall(arm: Arm) -> None:
    start, goal = arm.pose(READY), hand_pose(CUBE, 0.0, 0.4)
    assert distance_m(between(start, goal, 0.0), start) < 1e-9
    assert distance_m(between(start, goal, 1.0), goal) < 1e-6
    drawn = withdrawn(goal, 0.1).translation()
    assert drawn[2] == pytest.approx(CUBE[2] + 0.1 * math.cos(0.4))
    assert drawn[0] == pytest.approx(CUBE[0] - 0.1 * math.sin(0.4))


def test_another_description_has_the_hand_where_the_robot_built_from_it_has_it(tmp_path: Path) -> None:
    folder = str(menagerie.make(tmp_path))
    has_the_hand_there(Arm(folder), robot("g1", folder).compile(), BENT)


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ("right_elbow_joint", "right_knee2_joint", "g1.xml has no joint 'right_elbow_joint'; did you mean"),
        ("right_wrist_yaw_link", "right_hand", "g1.xml has no body 'right_wrist_yaw_link'"),
        ("<mujoco>", "<urdf>", "g1.xml can't be used"),
    ],
)
def test_a_description_that_lacks_something_is_refused(tmp_path: Path, old: str, new: str, words: str) -> None:
    path = menagerie.make(tmp_path) / "unitree_g1/g1.xml"
    path.write_text(path.read_text(encoding="utf-8").replace(old, new), encoding="utf-8")
    with pytest.raises(AdapterError, match=words):
        describe(str(tmp_path))


def test_a_folder_without_the_description_is_refused() -> None:
    with pytest.raises(AdapterError, match=r"no unitree_g1/g1.xml in '/nowhere'"):
        describe("/nowhere")

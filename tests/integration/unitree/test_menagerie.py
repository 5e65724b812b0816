"""The testbed with MuJoCo Menagerie's Go2 and G1: the same skills, the same crew, other bodies.

Their files are in no package of this project: `CREW_MENAGERIE` is the folder of a clone (docs/decisions/0087).
"""

import os
from pathlib import Path

import mujoco
import pytest

from crew.adapters.unitree.kinematics import READY, REST, TUCKED, Arm
from crew.sim.unitree.menagerie import check, robot
from tests.integration.crew.harness import Desk
from tests.integration.unitree.stage import stage
from tests.integration.unitree.test_mishaps import failed
from tests.study.humanoid_quadruped import DELIVERED_M, trial

FOLDER = os.environ.get("CREW_MENAGERIE", "mujoco_menagerie")

pytestmark = pytest.mark.menagerie


def test_the_folder_has_what_is_needed() -> None:
    check(FOLDER)


@pytest.mark.parametrize("posture", [REST, TUCKED, READY])
def test_the_description_has_the_hand_where_the_simulated_robot_has_it(posture: tuple[float, ...]) -> None:
    arm, model = Arm(FOLDER), robot("g1", FOLDER).compile()
    data = mujoco.MjData(model)
    for name, angle in zip(arm.names, posture, strict=True):
        data.joint(name).qpos[0] = angle
    mujoco.mj_forward(model, data)
    assert arm.pose(posture).translation().tolist() == pytest.approx(data.site("grasp").xpos.tolist(), abs=1e-9)
    assert data.ncon == 0, "no posture has the arm in its own body"


@pytest.mark.parametrize("mission", ["handover", "carry"])
async def test_the_cube_is_brought(mission: str) -> None:
    found = await trial(mission, 0, FOLDER)
    assert found.delivered, found


async def test_things_are_placed_on_tables_and_the_arm_waves() -> None:
    async with stage("g1", models=FOLDER) as scene:
        await scene.do("g1", "wave")
        assert scene.g1.fluents()["waved"].value is True
        for name, place in (("bottle", "table_b"), ("red_cube", "table_a")):
            await scene.do("g1", "pick_place", object=name, location=place)
            spot = scene.crew.location(place)
            assert spot is not None
            assert scene.away_m(name, spot.x, spot.y) < 0.05
            assert scene.thing(name)[2] > 0.72


@pytest.mark.parametrize(
    ("fault", "robot_", "skill", "args", "code"),
    [
        ("grasp_failed", "g1", "pick_hold", {"object": "red_cube"}, "grasp_failed"),
        ("go2_falls", "go2", "navigate", {"location": "room_b"}, "fallen"),
        ("move_ignored", "go2", "navigate", {"location": "room_b"}, "no_progress"),
    ],
)
async def test_a_mishap_is_a_physical_outcome(
    fault: str, robot_: str, skill: str, args: dict[str, str], code: str
) -> None:
    async with stage(robot_, models=FOLDER, faults=(fault,)) as scene:
        error = await failed(scene, robot_, skill, **args)
        assert error.code == code, error


def test_a_whole_crew_brings_the_cube(tmp_path: Path) -> None:
    demo = Desk(tmp_path).demo("humanoid_quadruped", "--map", "far", "--models", str(Path(FOLDER).absolute()))
    assert (demo.code, demo.result["outcome"], demo.result["contract"]) == (0, "completed", "carry"), demo
    assert demo.result["goal_error_m"] < DELIVERED_M
    assert demo.result["objects"]["red_cube"][2] > 0.5, "in the tray"

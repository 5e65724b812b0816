"""Another's models as robots of the scene: what is found in them, what is put on them, and what is refused."""

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import mujoco
import pytest

from crew.sim.apartment.scene import build
from crew.sim.apartment.site import load_site
from crew.sim.unitree.build import MENAGERIE
from crew.sim.unitree.g1 import ARM_MOTORS, G1
from crew.sim.unitree.go2 import MOTORS, STANDING, Go2
from crew.sim.unitree.menagerie import HELD, ModelsError, check, robot
from tests import menagerie

DAMP = 1001


class Unheard:
    """A link without a socket: what was told over it, and what waits to be heard."""

    def __init__(self) -> None:
        self.told: dict[str, dict[str, Any]] = {}
        self.waiting: list[tuple[str, dict[str, Any]]] = []

    def publish(self, topic: str, body: dict[str, Any]) -> None:
        self.told[topic] = body

    def messages(self) -> Iterator[tuple[str, dict[str, Any]]]:
        while self.waiting:
            yield self.waiting.pop(0)

    def call(self, api: int) -> None:
        """A call of the sport service without parameters."""
        header = {"identity": {"id": 1, "api_id": api}, "lease": {"id": 0}, "policy": {"noreply": True}}
        self.waiting.append(("rt/api/sport/request", {"header": header, "parameter": "{}"}))


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return menagerie.make(tmp_path_factory.mktemp("menagerie"))


@pytest.fixture(scope="module")
def model(folder: Path) -> Any:
    return build(load_site("far"), str(folder))


def test_the_scene_has_the_other_robots_with_our_tray_and_gripper(model: Any) -> None:
    assert {model.geom(f"go2/{leg}").name for leg in menagerie.LEGS} == {"go2/FL", "go2/FR", "go2/RL", "go2/RR"}
    for part in ("go2/mat", "go2/riser", "g1/pad_left", "g1/pad_right"):
        assert model.geom(part).id > 0
    assert int(model.site_bodyid[model.site("go2/tray").id]) == model.body("go2/tray").id
    assert int(model.body_parentid[model.body("go2/tray").id]) == model.body("go2/trunk").id
    assert int(model.body_parentid[model.body("g1/gripper").id]) == model.body("g1/right_wrist_yaw_link").id
    assert model.nkey == 0
    assert model.opt.impratio == 1.0, "the scene's solver is its own"


def test_what_their_joints_resist_is_left_as_it_is(model: Any) -> None:
    for motor in MOTORS:
        dof = int(model.joint(f"go2/{motor}").dofadr[0])
        assert (model.dof_damping[dof], model.dof_frictionloss[dof]) == (2.0, 0.2)


def test_only_the_waist_and_the_right_arm_move_and_the_pelvis_is_held(model: Any) -> None:
    joints = [model.joint(number).name for number in range(model.njnt)]
    mine = {name.removeprefix("g1/") for name in joints if name.startswith("g1/")}
    assert mine == {*ARM_MOTORS.values(), "finger_left", "finger_right"}
    motors = {model.actuator(number).name for number in range(model.nu)}
    assert {f"g1/{joint}" for joint in mine} == {name for name in motors if name.startswith("g1/")}
    wrist = int(model.body("g1/right_wrist_yaw_link").id)
    on_wrist = {int(model.geom_type[geom]) for geom, body in enumerate(model.geom_bodyid) if body == wrist}
    assert on_wrist == {int(mujoco.mjtGeom.mjGEOM_SPHERE)}, "the rubber hand is gone"


def test_the_arm_bears_its_weight_and_touches_all_but_itself(model: Any) -> None:
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    bodies = [model.body(int(body)).name for body in model.geom_bodyid]
    assert not [pair for pair in data.contact.geom.tolist() if all(bodies[geom].startswith("g1/") for geom in pair)]
    for body in ("g1/right_elbow_link", "g1/gripper", "g1/finger_left"):
        assert model.body_gravcomp[model.body(body).id] == 1.0
    for geom, body in enumerate(bodies):
        if body == "g1/right_elbow_link":
            assert model.geom_conaffinity[geom] == 1, "what comes near it is met"


def test_a_joint_that_is_held_keeps_its_angle(folder: Path, tmp_path: Path) -> None:
    held, free = robot("g1", str(folder)).compile(), mujoco.MjModel.from_xml_path(str(folder / "unitree_g1/g1.xml"))
    places = []
    for model in (held, free):
        data = mujoco.MjData(model)
        for joint, angle in HELD.items():
            if model is free:
                data.joint(joint).qpos[0] = angle
            else:
                assert mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_JOINT, joint) == -1
        if model is free:
            data.qpos[2] = 0.793
        mujoco.mj_kinematics(model, data)
        places.append(data.body("left_wrist_yaw_link").xpos.tolist())
    assert places[0] == pytest.approx(places[1], abs=1e-9)


def test_motors_are_told_and_moved_by_name_whatever_the_models_order(model: Any) -> None:
    data, link = mujoco.MjData(model), Unheard()
    go2 = Go2(
        model, data, "go2", link=link, seed=0, noise=False, step_s=0.005, tick_s=0.05, build=MENAGERIE  # type: ignore[arg-type]
    )  # fmt: skip
    legs = [model.joint(number).name for number in range(model.njnt) if model.joint(number).name.endswith("_calf")]
    assert legs.index("go2/FL_calf") < legs.index("go2/FR_calf"), "another order than the SDK's"
    data.joint("go2/RL_calf").qpos[0] = -1.7
    data.joint("go2/FR_hip").qpos[0] = 0.2
    go2.tick(0)
    told = [motor["q"] for motor in link.told["rt/lowstate"]["motor_state"]]
    assert told[MOTORS.index("RL_calf")] == -1.7
    assert told[MOTORS.index("FR_hip")] == 0.2
    assert told[MOTORS.index("FL_thigh")] == STANDING[1]
    link.call(DAMP)
    go2.poll(0)
    data.joint("go2/RL_calf").qvel[0] = 1.0
    go2.control()
    pushed = {name: data.actuator(f"go2/{name}").ctrl[0] for name in MOTORS}
    assert {name for name, torque in pushed.items() if torque} == {"RL_calf"}


def test_the_arm_begins_at_rest(model: Any) -> None:
    data = mujoco.MjData(model)
    G1(model, data, "g1", link=Unheard(), step_s=0.005)  # type: ignore[arg-type]
    assert data.actuator("g1/elbow").ctrl[0] == data.joint("g1/elbow").qpos[0] == 1.4


@pytest.mark.parametrize(
    ("name", "old", "new", "words"),
    [
        ("go2", "FL_calf_joint", "FL_shin_joint", r"no joint 'FL_calf_joint'; did you mean '.._calf_joint'"),
        ("go2", 'body name="base"', 'body name="trunc"', r"has no body 'base'"),
        ("g1", "right_wrist_yaw_link", "right_hand", r"has no body 'right_wrist_yaw_link'"),
        ("g1", '<position name="waist_yaw_joint" joint="waist_yaw_joint" kp="500" inheritrange="1"/>', "",
         r"joint 'waist_yaw_joint' has 0 actuators, 1 is needed"),
        ("go2", 'body name="RR_calf" pos="0 0 -0.213"', 'body name="RR_calf" pos="0 0 -0.25"',
         r"RR_calf lies at \(0.0000, 0.0000, -0.2500\) m in its parent"),
        ("g1", 'vertex="0 0 0 0.05 0 0 0 0.05 0 0 0 0.05"', 'file="right_rubber_hand.STL"',
         r"g1.xml: its mesh /right_rubber_hand.STL is not there; fetch the whole folder"),
        ("g1", "<mujoco>", "<urdf>", r"g1.xml can't be read"),
    ],
)  # fmt: skip
def test_a_model_of_another_shape_is_refused_with_what_is_missing(
    folder: Path, tmp_path: Path, name: str, old: str, new: str, words: str
) -> None:
    menagerie.make(tmp_path)
    path = tmp_path / {"go2": "unitree_go2/go2.xml", "g1": "unitree_g1/g1.xml"}[name]
    text = path.read_text(encoding="utf-8")
    assert old in text
    path.write_text(text.replace(old, new), encoding="utf-8")
    with pytest.raises(ModelsError, match=words):
        check(str(tmp_path))


def test_a_folder_that_is_not_there_says_what_to_fetch() -> None:
    with pytest.raises(
        ModelsError, match=r"no unitree_g1/g1.xml in '/nowhere'; fetch MuJoCo Menagerie \(git clone https"
    ):
        check("/nowhere")

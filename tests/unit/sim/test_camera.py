"""The camera's geometry: angles lead back to the victim, obstacles hide it, the skipping never changes a result."""

import math
from typing import Any

import mujoco
import numpy as np
import pytest

from crew.sim.camera import HEIGHT_PX, WIDTH_PX, Camera, Detection
from crew.sim.map import Map, Spot, Tree, load_map
from crew.sim.scene import build, seen_bodies

MAP_A = load_map("air_ground", "A")


class Rig:
    """The scene with the drone put where a test wants it; poses are world frame, metres and radians."""

    def __init__(self, found: Map = MAP_A, **options: Any) -> None:
        self.model: Any = build(found)
        self.data: Any = mujoco.MjData(self.model)
        mujoco.mj_forward(self.model, self.data)
        self.camera = Camera(self.model, self.data, "iris/camera", seen_bodies(found), seed=0, **options)

    def put(self, x: float, y: float, z: float, roll: float = 0.0, pitch: float = 0.0, yaw: float = 0.0) -> None:
        quat = np.zeros(4)
        mujoco.mju_euler2Quat(quat, np.array([yaw, pitch, roll]), "zyx")
        start = int(self.model.jnt_qposadr[self.model.body("iris/base").jntadr[0]])
        self.data.qpos[start : start + 7] = [x, y, z, *quat]
        mujoco.mj_forward(self.model, self.data)

    def see(self) -> Detection | None:
        """The only detection, if there is one."""
        seen = self.camera.detect()
        assert len(seen) <= 1
        return seen[0] if seen else None

    def fix(self) -> tuple[float, float] | None:
        """Where the detected ray meets the height of the victim's chest."""
        found = self.see()
        if found is None:
            return None
        ray = np.array([math.tan(found.angle_x_rad), -math.tan(found.angle_y_rad), -1.0])
        ray = self.data.site("iris/camera").xmat.reshape(3, 3) @ ray
        eye = self.data.site("iris/camera").xpos
        hit = eye + ray * (0.25 - eye[2]) / ray[2]
        return float(hit[0]), float(hit[1])


@pytest.mark.parametrize(
    "pose",
    [
        (5.0, 5.0, 5.0),
        (3.0, 4.0, 5.0),
        (7.5, 5.0, 5.0),
        (5.0, 3.0, 4.0),
        (4.0, 4.0, 6.0, 0.15, -0.1, 1.0),
        (6.0, 4.5, 5.0, -0.1, 0.2, -2.5),
    ],
)
def test_angles_lead_back_to_the_victim(pose: tuple[float, ...]) -> None:
    rig = Rig(noise=False)
    rig.put(*pose)
    fix = rig.fix()
    assert fix is not None
    assert math.dist(fix, (5.0, 5.0)) < 0.12


def test_forward_is_positive_x_and_right_is_positive_y() -> None:
    rig = Rig(noise=False)
    rig.put(3.5, 6.0, 5.0)  # facing east: the victim is ahead and to the right
    found = rig.see()
    assert found is not None
    assert found.angle_x_rad > 0.2
    assert found.angle_y_rad > 0.1


def test_canopy_hides_the_victim_from_above_but_not_from_the_side() -> None:
    tree = next(obstacle for obstacle in MAP_A.obstacles if isinstance(obstacle, Tree))
    under = Spot(x_m=tree.x_m - 0.9, y_m=tree.y_m)
    rig = Rig(Map(**{name: getattr(MAP_A, name) for name in MAP_A.__struct_fields__} | {"victim": under}))
    rig.put(tree.x_m, tree.y_m, 6.0)
    assert rig.see() is None
    rig.put(tree.x_m - 2.2, tree.y_m, 3.0)
    assert rig.see() is not None


def test_field_of_view_is_bounded() -> None:
    rig = Rig()
    for x, y in ((5.0 - 4.5, 5.0), (5.0, 5.0 - 5.0), (-3.0, -3.0)):
        rig.put(x, y, 5.0)
        assert rig.see() is None


def test_pixel_noise_moves_the_centre_by_about_a_pixel() -> None:
    rig, still = Rig(), Rig(noise=False)
    for one in (rig, still):
        one.put(5.0, 5.0, 5.0)
    centre = still.see()
    assert centre is not None
    shifts = [math.tan(found.angle_x_rad) * 47.67 for _ in range(300) if (found := rig.see()) is not None]
    assert np.std(shifts) == pytest.approx(1.0, rel=0.15)
    assert np.mean(shifts) == pytest.approx(math.tan(centre.angle_x_rad) * 47.67, abs=0.2)


def test_skipping_frames_never_loses_a_detection() -> None:
    quick, full = Rig(noise=False), Rig(noise=False, every_frame=True)
    random = np.random.default_rng(0)
    seen = 0
    for _ in range(120):
        pose = [*random.uniform([0, 0, 1], [10, 10, 7]), *random.uniform(-0.3, 0.3, 2), random.uniform(-3, 3)]
        quick.put(*pose)
        full.put(*pose)
        found = full.camera.detect()
        seen += bool(found)
        assert quick.camera.detect() == found
    assert seen > 10


def test_image_shows_the_ground_as_nothing() -> None:
    rig = Rig()
    rig.put(-4.0, 0.5, 3.0)
    image = rig.camera.image()
    assert image.shape == (HEIGHT_PX, WIDTH_PX)
    assert (image == -1).mean() > 0.5

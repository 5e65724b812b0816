"""Where the hand is for given joints, and joints that bring it somewhere: the robot's description and a QP solver.

Frame of the robot: FLU, origin on the ground below the pelvis. The hand's x axis points out of it, y along its fingers'
travel. Poses are mink's SE3. Sends nothing and knows no time.
"""

import math

import mink
import numpy as np

from crew.adapters.unitree.description import SITE, describe

SOLVER = "daqp"
STEP_S = 0.05
DAMPING = 1e-3
ORIENTATION_COST = 0.2
POSTURE_COSTS = (0.01, 0.05, 0.03, 0.002, 0.002, 0.002, 0.002, 0.002, 0.002, 0.002)
"""How dear it is to leave the rest posture, joint by joint: the waist helps when it must."""
REST = (0.0, 0.0, 0.0, 0.3, -0.15, 0.0, 1.4, 0.0, 0.0, 0.0)
TUCKED = (0.0, 0.0, 0.0, 0.7, -0.15, 0.0, -0.9, 0.0, 0.6, 0.0)
READY = (0.0, 0.0, 0.0, -0.6, -0.1, 0.0, 0.2, 0.0, 1.5, 0.0)
"""Postures: arm at the side; hand drawn in beside the chest, above any table; hand before the body, pointing down."""
TRIES = 80

Joints = tuple[float, ...]


class Arm:
    """Kinematics of the waist and one arm. `step` moves joints a little towards a goal. `models` as in `describe`."""

    def __init__(self, models: str = "") -> None:
        self._model = describe(models)
        self._configuration = mink.Configuration(self._model)
        self._hand = mink.FrameTask(SITE, "site", position_cost=1.0, orientation_cost=ORIENTATION_COST, lm_damping=1e-4)
        self._posture = mink.PostureTask(self._model, cost=np.array(POSTURE_COSTS))
        self._posture.set_target(np.array(READY))
        self._limits = [mink.ConfigurationLimit(self._model)]
        self.names = [self._model.joint(i).name for i in range(self._model.njnt)]

    def pose(self, joints: Joints) -> mink.SE3:
        """Where the hand's grasp point is."""
        self._configuration.update(np.array(joints))
        return self._configuration.get_transform_frame_to_world(SITE, "site")

    def step(self, joints: Joints, goal: mink.SE3) -> Joints:
        """One step of inverse kinematics from `joints` towards a goal."""
        self._configuration.update(np.array(joints))
        self._hand.set_target(goal)
        speeds = mink.solve_ik(
            self._configuration, [self._hand, self._posture], STEP_S, SOLVER, damping=DAMPING, limits=self._limits
        )
        return tuple(self._configuration.integrate(speeds, STEP_S).tolist())

    def shortfall_m(self, joints: Joints, goal: mink.SE3) -> float:
        """How far from a goal the hand would end: near zero for what is in reach."""
        for _ in range(TRIES):
            joints = self.step(joints, goal)
        return math.dist(self.pose(joints).translation().tolist(), goal.translation().tolist())


def hand_pose(point: tuple[float, float, float], yaw_rad: float, tilt_rad: float) -> mink.SE3:
    """A hand at a point that points down, tilted outward by `tilt_rad` towards the heading `yaw_rad`."""
    c, s = math.cos(yaw_rad), math.sin(yaw_rad)
    ct, st = math.cos(tilt_rad), math.sin(tilt_rad)
    matrix = np.array([[c * st, -s, c * ct], [s * st, c, s * ct], [-ct, 0.0, st]])
    return mink.SE3.from_rotation_and_translation(mink.SO3.from_matrix(matrix), np.array(point))


def between(start: mink.SE3, goal: mink.SE3, share: float) -> mink.SE3:
    """A pose on the straight way, `share` from 0 to 1; the turn follows the shortest arc."""
    turn = start.rotation().inverse() @ goal.rotation()
    rotation = start.rotation() @ mink.SO3.exp(turn.log() * share)
    point = start.translation() + (goal.translation() - start.translation()) * share
    return mink.SE3.from_rotation_and_translation(rotation, point)


def withdrawn(pose: mink.SE3, distance_m: float) -> mink.SE3:
    """The same hand, drawn back along its own x axis."""
    back = pose.rotation().as_matrix()[:, 0] * -distance_m
    return mink.SE3.from_rotation_and_translation(pose.rotation(), pose.translation() + back)


def distance_m(start: mink.SE3, goal: mink.SE3) -> float:
    """The straight way between two poses; a radian of turn counts as 0.2 m."""
    turn = start.rotation().inverse() @ goal.rotation()
    straight = math.dist(start.translation().tolist(), goal.translation().tolist())
    return max(straight, 0.2 * float(np.linalg.norm(turn.log())))

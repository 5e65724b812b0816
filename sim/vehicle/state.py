"""A vehicle's kinematic state, true or estimated, and how it is read from MuJoCo. Must not change MjData."""

import math
from typing import Any


class State:
    """Position and velocity in the world frame (ENU, metres); attitude of the FLU body (radians); body rates (rad/s).

    Angles follow the z-y-x convention: yaw counter-clockwise from east, positive pitch nose down, positive roll right
    side down.
    """

    __slots__ = ("p", "pitch", "q", "r", "roll", "vx", "vy", "vz", "x", "y", "yaw", "z")

    def __init__(self) -> None:
        self.x = self.y = self.z = 0.0
        self.vx = self.vy = self.vz = 0.0
        self.roll = self.pitch = self.yaw = 0.0
        self.p = self.q = self.r = 0.0

    @property
    def ground_speed(self) -> float:
        return math.hypot(self.vx, self.vy)

    @property
    def speed(self) -> float:
        return math.hypot(self.vx, self.vy, self.vz)


class FreeBody:
    """Reads the true state of a body with a free joint. height_m: of the body's origin when it stands on the ground."""

    def __init__(self, model: Any, data: Any, body: str, height_m: float) -> None:
        joint = model.body(body).jntadr[0]
        start, speed = int(model.jnt_qposadr[joint]), int(model.jnt_dofadr[joint])
        self.id = int(model.body(body).id)
        self._qpos = data.qpos[start : start + 7]
        self._qvel = data.qvel[speed : speed + 6]
        self._height_m = height_m
        self.state = State()

    def read(self) -> State:
        """Refresh `state` (the same object each time); z is the height of the vehicle's sole above z = 0."""
        s = self.state
        s.x, s.y, z, w, i, j, k = self._qpos.tolist()
        s.z = z - self._height_m
        s.vx, s.vy, s.vz, s.p, s.q, s.r = self._qvel.tolist()
        s.roll = math.atan2(2.0 * (w * i + j * k), 1.0 - 2.0 * (i * i + j * j))
        s.pitch = math.asin(max(-1.0, min(1.0, 2.0 * (w * j - k * i))))
        s.yaw = math.atan2(2.0 * (w * k + i * j), 1.0 - 2.0 * (j * j + k * k))
        return s

"""What a vehicle believes about itself: the true state plus seeded errors. Must not be told what the vehicle wants.

Velocities and body rates are taken as known: their errors are small beside those of pose and attitude.
"""

import math

from crew.sim.noise import (
    ALTITUDE_SIGMA_M,
    ALTITUDE_TAU_S,
    ATTITUDE_SIGMA_RAD,
    ATTITUDE_TAU_S,
    ODOMETRY_SIGMA,
    ODOMETRY_TAU_S,
    POSE_REFERENCE_PERIOD_S,
    POSE_REFERENCE_SIGMA_M,
    POSE_SIGMA_M,
    POSE_TAU_S,
    GaussMarkov,
    stream,
)
from crew.sim.vehicle.state import State

REFERENCE_GAIN = 0.2  # of the pose reference in the rover's filter; leaves 0.033 m of its 0.1 m


class DroneEstimator:
    """Pose and attitude with correlated errors. Position is refreshed at the slow rate, attitude at the fast one."""

    def __init__(self, seed: int, name: str, fast_step_s: float, slow_step_s: float, noise: bool = True) -> None:
        on = 1.0 if noise else 0.0
        self._position = [
            GaussMarkov(stream(seed, f"{name}/{axis}"), on * sigma, tau, slow_step_s)
            for axis, sigma, tau in (
                ("x", POSE_SIGMA_M, POSE_TAU_S),
                ("y", POSE_SIGMA_M, POSE_TAU_S),
                ("z", ALTITUDE_SIGMA_M, ALTITUDE_TAU_S),
            )
        ]
        self._attitude = [
            GaussMarkov(stream(seed, f"{name}/{axis}"), on * ATTITUDE_SIGMA_RAD, ATTITUDE_TAU_S, fast_step_s)
            for axis in ("roll", "pitch", "yaw")
        ]
        self.state = State()

    def update_attitude(self, true: State) -> None:
        roll, pitch, yaw = self._attitude
        s = self.state
        s.roll = true.roll + roll.step()
        s.pitch = true.pitch + pitch.step()
        s.yaw = true.yaw + yaw.step()
        s.p, s.q, s.r = true.p, true.q, true.r

    def update_position(self, true: State) -> None:
        x, y, z = self._position
        s = self.state
        s.x, s.y, s.z = true.x + x.step(), true.y + y.step(), true.z + z.step()
        s.vx, s.vy, s.vz = true.vx, true.vy, true.vz


class RoverEstimator:
    """Odometry that drifts by 1 % of the distance, along and across, pulled to an absolute pose reference at 1 Hz.

    The error across the track is an error of heading, which the estimate's yaw has as well.
    """

    def __init__(self, seed: int, name: str, step_s: float, noise: bool = True) -> None:
        on = 1.0 if noise else 0.0
        self._along = GaussMarkov(stream(seed, f"{name}/along"), on * ODOMETRY_SIGMA, ODOMETRY_TAU_S, step_s)
        self._heading = GaussMarkov(stream(seed, f"{name}/heading"), on * ODOMETRY_SIGMA, ODOMETRY_TAU_S, step_s)
        self._reference = stream(seed, f"{name}/reference")
        self._sigma_m = on * POSE_REFERENCE_SIGMA_M
        self._period = round(POSE_REFERENCE_PERIOD_S / step_s)
        self._count = 0
        self._last: tuple[float, float] | None = None
        self.state = State()

    def update(self, true: State) -> None:
        heading_error = self._heading.step()
        self._integrate(true, 1.0 + self._along.step(), heading_error)
        if self._count % self._period == 0:
            self._fuse(true)
        self._count += 1
        s = self.state
        s.z, s.vx, s.vy, s.vz = true.z, true.vx, true.vy, true.vz
        s.roll, s.pitch, s.yaw = true.roll, true.pitch, true.yaw + heading_error
        s.p, s.q, s.r = true.p, true.q, true.r

    def _integrate(self, true: State, scale: float, turn_rad: float) -> None:
        s = self.state
        if self._last is None:
            s.x, s.y = true.x, true.y
        else:
            dx, dy = true.x - self._last[0], true.y - self._last[1]
            cos, sin = scale * math.cos(turn_rad), scale * math.sin(turn_rad)
            s.x += cos * dx - sin * dy
            s.y += sin * dx + cos * dy
        self._last = (true.x, true.y)

    def _fuse(self, true: State) -> None:
        s, gauss = self.state, self._reference.gauss
        s.x += REFERENCE_GAIN * (true.x + gauss(0.0, 1.0) * self._sigma_m - s.x)
        s.y += REFERENCE_GAIN * (true.y + gauss(0.0, 1.0) * self._sigma_m - s.y)

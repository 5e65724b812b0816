"""The quadcopter's slow loop: from a target to a wanted acceleration. Pure; knows no modes and plans no path.

World frame: ENU, metres.
"""

import math

from crew.sim.vehicle.attitude import GRAVITY
from crew.sim.vehicle.profile import approach_rate, approach_speed, clamp
from crew.sim.vehicle.state import State

POSITION_GAIN = 0.9  # 1/s
BRAKE = 1.2  # m/s^2
ACCELERATION_MAX = 2.0  # m/s^2: how fast the wanted velocity may change
VELOCITY_GAIN = 2.8  # 1/s
INTEGRAL_GAIN = 0.6  # 1/s^2
INTEGRAL_MAX = 1.5  # m/s^2
CLIMB_MAX, DESCENT_MAX = 1.5, 1.2  # m/s
TILT_MAX = math.radians(28.0)
LAND_SPEED, LAND_SPEED_HIGH, LAND_SLOW_BELOW_M = 0.35, 1.0, 1.5


class PositionLoop:
    """Flies straight to `target` with smooth braking, or descends over it while `landing`."""

    def __init__(self, step_s: float) -> None:
        self._step_s = step_s
        self.target = (0.0, 0.0, 0.0)
        self.speed_max = 3.0
        self.landing = False
        self.acceleration = (0.0, 0.0, 0.0)
        self._velocity = [0.0, 0.0, 0.0]
        self._integral = [0.0, 0.0, 0.0]

    def reset(self) -> None:
        """Forget what was learnt in the last flight."""
        self._velocity = [0.0, 0.0, 0.0]
        self._integral = [0.0, 0.0, 0.0]

    def stop_point(self, s: State) -> tuple[float, float, float]:
        """Where braking at once brings the craft to rest."""
        reach = s.ground_speed / (2.0 * BRAKE)
        return s.x + reach * s.vx, s.y + reach * s.vy, s.z + 0.3 * s.vz

    def step(self, s: State) -> None:
        wanted = self._wanted_velocity(s)
        speeds = (s.vx, s.vy, s.vz)
        limit = ACCELERATION_MAX * self._step_s
        out = []
        for axis in range(3):
            self._velocity[axis] += clamp(wanted[axis] - self._velocity[axis], -limit, limit)
            error = self._velocity[axis] - speeds[axis]
            total = self._integral[axis] + INTEGRAL_GAIN * error * self._step_s
            self._integral[axis] = clamp(total, -INTEGRAL_MAX, INTEGRAL_MAX)
            out.append(VELOCITY_GAIN * error + self._integral[axis])
        self.acceleration = _limited(out[0], out[1], out[2])

    def _wanted_velocity(self, s: State) -> tuple[float, float, float]:
        ex, ey = self.target[0] - s.x, self.target[1] - s.y
        distance = math.hypot(ex, ey)
        ratio = approach_speed(distance, POSITION_GAIN, BRAKE, self.speed_max) / distance if distance > 1e-6 else 0.0
        if self.landing:
            vz = -LAND_SPEED if s.z < LAND_SLOW_BELOW_M else -LAND_SPEED_HIGH
        else:
            vz = approach_rate(self.target[2] - s.z, 1.2, BRAKE, CLIMB_MAX, DESCENT_MAX)
        return ex * ratio, ey * ratio, vz


def _limited(ax: float, ay: float, az: float) -> tuple[float, float, float]:
    az = clamp(az, -0.6 * GRAVITY, 0.6 * GRAVITY)
    level = math.hypot(ax, ay)
    level_max = (GRAVITY + az) * math.tan(TILT_MAX)
    if level > level_max:
        ax, ay = ax * level_max / level, ay * level_max / level
    return ax, ay, az

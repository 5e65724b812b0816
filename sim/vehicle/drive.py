"""The rover's guidance: turn in place, then drive straight at the target. Pure; plans no path.

World frame: ENU, metres.
"""

import math

from crew.sim.geo import wrap_rad
from crew.sim.vehicle.profile import approach_speed, clamp
from crew.sim.vehicle.state import State

PIVOT_ABOVE_RAD, PIVOT_UNTIL_RAD = 0.5, 0.08
TURN_GAIN, TURN_MAX, TURN_ACCELERATION = 2.5, 1.4, 4.0  # 1/s, rad/s, rad/s^2
APPROACH_GAIN, BRAKE, ACCELERATION = 1.5, 0.5, 0.7  # 1/s, m/s^2, m/s^2
HALT_BRAKE = 1.5  # m/s^2, when told to stop at once
ARRIVED_M, LEFT_M = 0.05, 0.15  # stop within the first, start again beyond the second


class DriveLoop:
    """Wanted forward speed (m/s) and turn rate (rad/s) from an estimate and a target; without a target it stands."""

    def __init__(self, step_s: float) -> None:
        self._step_s = step_s
        self.target: tuple[float, float] | None = None
        self.speed_max = 0.6
        self.forward = 0.0
        self.turn = 0.0
        self.arrived = False
        self._pivoting = False

    def go(self, x_m: float, y_m: float, speed_max: float) -> None:
        self.target, self.speed_max, self.arrived = (x_m, y_m), speed_max, False

    def halt(self) -> None:
        self.target, self.arrived, self._pivoting = None, False, False

    def step(self, s: State) -> None:
        forward, turn = (0.0, 0.0) if self.target is None else self._wanted(s, *self.target)
        rise, fall = ACCELERATION * self._step_s, HALT_BRAKE * self._step_s
        self.forward += clamp(forward - self.forward, -fall, rise)
        bend = TURN_ACCELERATION * self._step_s
        self.turn += clamp(turn - self.turn, -bend, bend)

    def _wanted(self, s: State, x_m: float, y_m: float) -> tuple[float, float]:
        dx, dy = x_m - s.x, y_m - s.y
        distance = math.hypot(dx, dy)
        error = wrap_rad(math.atan2(dy, dx) - s.yaw)
        passed = distance < LEFT_M and abs(error) > math.pi / 2
        if self.arrived:
            self.arrived = distance < LEFT_M
        elif distance < ARRIVED_M or passed:
            self.arrived = True
        if self.arrived:
            return 0.0, 0.0
        self._pivoting = abs(error) > (PIVOT_UNTIL_RAD if self._pivoting else PIVOT_ABOVE_RAD)
        turn = clamp(TURN_GAIN * error, -TURN_MAX, TURN_MAX)
        if self._pivoting:
            return 0.0, turn
        return approach_speed(distance, APPROACH_GAIN, BRAKE, self.speed_max) * math.cos(error), turn

"""The quadcopter: body, estimate and inner loops. Knows no MAVLink and no flight modes, and plans no path."""

import math
from typing import Any

from crew.sim.vehicle.attitude import GRAVITY, MASS_KG, STILL, Thrusts, attitude_step
from crew.sim.vehicle.battery import Battery
from crew.sim.vehicle.estimator import DroneEstimator
from crew.sim.vehicle.position import PositionLoop
from crew.sim.vehicle.state import FreeBody, State

SOLE_M = 0.10  # the body's origin above the skids' soles
ROTORS = ("fl", "fr", "bl", "br")
HOVER_W, IDLE_W = 180.0, 5.0
BATTERY_J = HOVER_W * 1200.0  # twenty minutes of hover
IDLE_THRUST: Thrusts = (0.2, 0.2, 0.2, 0.2)
TOUCH_SPEED, TOUCH_S = 0.1, 0.4  # a descent that does not happen for this long has met the ground


class Quadcopter:
    """Inner loops over one MuJoCo body. All targets are in the world frame and refer to the *estimate*."""

    def __init__(self, model: Any, data: Any, name: str, estimator: DroneEstimator, slow_step_s: float) -> None:
        self.name = name
        self.body = FreeBody(model, data, f"{name}/base", SOLE_M)
        first = int(model.actuator(f"{name}/thrust_{ROTORS[0]}").id)
        self._controls = data.ctrl[first : first + len(ROTORS)]
        self._estimator = estimator
        self._loop = PositionLoop(slow_step_s)
        self._slow_step_s = slow_step_s
        self._yaw_rad = 0.0
        self._thrusts = STILL
        self._still_s = 0.0
        self.battery = Battery(BATTERY_J, cells=4)
        self.spinning = False
        self.flying = False
        self.slow_sense()
        self.fast_step()

    @property
    def state(self) -> State:
        """The estimate, which the loops fly on and telemetry carries."""
        return self._estimator.state

    @property
    def touched_down(self) -> bool:
        """True while a commanded descent meets the ground."""
        return self._still_s >= TOUCH_S

    def spin_up(self) -> None:
        self.spinning, self.flying = True, False
        self._loop.reset()

    def spin_down(self) -> None:
        self.spinning = self.flying = False

    def settle(self) -> None:
        """Idle on the ground, rotors turning."""
        self.flying = False

    def fly_to(self, x_m: float, y_m: float, z_m: float, speed_max: float, yaw_rad: float | None = None) -> None:
        """Go straight to a point; yaw stays as it is unless given."""
        if not self.flying:
            self._yaw_rad = self.state.yaw
            self._loop.reset()
        self.flying, self._loop.landing = True, False
        self._loop.target, self._loop.speed_max = (x_m, y_m, z_m), speed_max
        if yaw_rad is not None:
            self._yaw_rad = yaw_rad

    def turn_to(self, yaw_rad: float) -> None:
        """Turn on the spot, or on the way."""
        self._yaw_rad = yaw_rad

    def limit_speed(self, speed_max: float) -> None:
        """Another speed for what is left of the way."""
        self._loop.speed_max = speed_max

    @property
    def target(self) -> tuple[float, float, float]:
        """Where it flies or hovers."""
        return self._loop.target

    def brake(self, speed_max: float) -> None:
        """Stop as soon as smooth braking allows and stay there."""
        self.fly_to(*self._loop.stop_point(self.state), speed_max=speed_max)

    def descend(self, speed_max: float) -> None:
        """Brake and go down until the ground is met."""
        self.brake(speed_max)
        self._loop.landing, self._still_s = True, 0.0

    def distance_to_target(self) -> float:
        s, (x, y, z) = self.state, self._loop.target
        return math.hypot(x - s.x, y - s.y, z - s.z)

    def fast_step(self) -> None:
        """Read the body and run the attitude loop: once each physics step."""
        self._estimator.update_attitude(self.body.read())
        if self.flying:
            self._thrusts = attitude_step(self.state, *self._loop.acceleration, self._yaw_rad)
        else:
            self._thrusts = IDLE_THRUST if self.spinning else STILL
        self._controls[:] = self._thrusts

    def slow_step(self) -> None:
        """Refresh the position estimate, run the position loop and drain the battery."""
        self.slow_sense()
        if self.flying:
            self._loop.step(self.state)
            self._watch_touchdown()
        self._drain()

    def slow_sense(self) -> None:
        self._estimator.update_position(self.body.read())

    def _watch_touchdown(self) -> None:
        lift = sum(self._thrusts)
        blocked = self._loop.landing and abs(self.state.vz) < TOUCH_SPEED and lift < 0.9 * MASS_KG * GRAVITY
        self._still_s = self._still_s + self._slow_step_s if blocked else 0.0

    def _drain(self) -> None:
        ratio = sum(self._thrusts) / (MASS_KG * GRAVITY)
        self.battery.drain(IDLE_W + (HOVER_W - IDLE_W) * ratio**1.5, self._slow_step_s)

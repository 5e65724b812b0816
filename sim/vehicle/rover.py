"""The differential-drive rover: body, estimate and inner loops. Knows no MAVLink and no modes, and plans no path.

The wheels' velocity servos, its fastest loop, are part of the MuJoCo model.
"""

from typing import Any

from crew.sim.vehicle.battery import Battery
from crew.sim.vehicle.drive import DriveLoop
from crew.sim.vehicle.estimator import RoverEstimator
from crew.sim.vehicle.profile import clamp
from crew.sim.vehicle.state import FreeBody, State

WHEEL_RADIUS_M = 0.033
TRACK_M = 0.287
SPEED_MAX = 0.7  # m/s
IDLE_W, DRIVE_W_PER_MPS = 6.0, 15.0
BATTERY_J = 70_000.0  # about two hours of driving


class Rover:
    """Inner loops over one MuJoCo body. All targets are in the world frame and refer to the *estimate*."""

    def __init__(self, model: Any, data: Any, name: str, estimator: RoverEstimator, step_s: float) -> None:
        self.name = name
        self.body = FreeBody(model, data, f"{name}/base", 0.0)
        first = int(model.actuator(f"{name}/drive_left").id)
        self._controls = data.ctrl[first : first + 2]
        self._estimator = estimator
        self._loop = DriveLoop(step_s)
        self._step_s = step_s
        self.battery = Battery(BATTERY_J, cells=3)
        self._estimator.update(self.body.read())

    @property
    def state(self) -> State:
        """The estimate, which the loops drive on and telemetry carries."""
        return self._estimator.state

    @property
    def arrived(self) -> bool:
        return self._loop.arrived

    @property
    def target(self) -> tuple[float, float] | None:
        """Where it drives; None if nowhere."""
        return self._loop.target

    def drive_to(self, x_m: float, y_m: float, speed_max: float) -> None:
        """Turn towards a point, drive straight to it and stop."""
        self._loop.go(x_m, y_m, min(speed_max, SPEED_MAX))

    def halt(self) -> None:
        """Stop where it stands and forget the target."""
        self._loop.halt()

    def slow_step(self) -> None:
        """Refresh the estimate, set the wheels' speeds and drain the battery."""
        self._estimator.update(self.body.read())
        self._loop.step(self.state)
        forward = clamp(self._loop.forward, -SPEED_MAX, SPEED_MAX)
        bend = self._loop.turn * TRACK_M / 2.0
        self._controls[:] = ((forward - bend) / WHEEL_RADIUS_M, (forward + bend) / WHEEL_RADIUS_M)
        self.battery.drain(IDLE_W + DRIVE_W_PER_MPS * (abs(forward) + abs(bend)), self._step_s)

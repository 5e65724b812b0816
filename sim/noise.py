"""Seeded noise: the fixed error model of estimators and camera. Must not read clocks or global random state."""

import math
from random import Random

POSE_SIGMA_M = 0.15  # drone, each horizontal axis
POSE_TAU_S = 4.0
ALTITUDE_SIGMA_M = 0.05
ALTITUDE_TAU_S = 4.0
ATTITUDE_SIGMA_RAD = math.radians(1.5)  # drone: roll, pitch, yaw, each
ATTITUDE_TAU_S = 1.0
ODOMETRY_SIGMA = 0.01  # rover: metres of error for each metre driven, along and across the track
ODOMETRY_TAU_S = 20.0
POSE_REFERENCE_SIGMA_M = 0.1  # rover: the absolute reference, each axis
POSE_REFERENCE_PERIOD_S = 1.0
PIXEL_SIGMA = 1.0  # detection, each image axis
LIDAR_SIGMA_M = 0.01
GUST_SIGMA_N = 1.2  # wind gusts, each horizontal axis: enough to tilt the drone by 5 deg
GUST_TAU_S = 2.0
GUST_MEAN_N = 1.0  # and a steady wind, whose direction depends on the seed


def stream(seed: int, name: str) -> Random:
    """An independent generator for one source of noise, the same on every machine."""
    return Random(f"{seed}/{name}")


class GaussMarkov:
    """A first-order Gauss-Markov process: zero mean, stationary from the first sample.

    sigma: standard deviation, in the unit of the value. tau_s: correlation falls to 1/e after this time. step_s: the
    time between two calls of `step`.
    """

    def __init__(self, random: Random, sigma: float, tau_s: float, step_s: float) -> None:
        self._gauss = random.gauss
        self._keep = math.exp(-step_s / tau_s)
        self._kick = sigma * math.sqrt(1.0 - self._keep**2)
        self.value = random.gauss(0.0, sigma) if sigma > 0.0 else 0.0

    def step(self) -> float:
        if self._kick > 0.0:
            self.value = self.value * self._keep + self._gauss(0.0, self._kick)
        return self.value

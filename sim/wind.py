"""Wind on one body: a steady push and gusts around it, from the seed. Must not know what the body does about it."""

import math
from typing import Any

from crew.sim.noise import GUST_MEAN_N, GUST_SIGMA_N, GUST_TAU_S, GaussMarkov, stream


class Wind:
    """A horizontal force on `body`, world frame, N, while it blows."""

    def __init__(self, data: Any, body: int, seed: int, name: str, step_s: float) -> None:
        self._force = data.xfrc_applied[body]
        bearing_rad = stream(seed, f"{name}/wind").uniform(0.0, math.tau)
        self._mean = (GUST_MEAN_N * math.cos(bearing_rad), GUST_MEAN_N * math.sin(bearing_rad))
        self._gusts = [GaussMarkov(stream(seed, f"{name}/gust_{a}"), GUST_SIGMA_N, GUST_TAU_S, step_s) for a in "xy"]

    def step(self, blows: bool) -> None:
        for axis, (mean, gust) in enumerate(zip(self._mean, self._gusts, strict=True)):
            force_n = mean + gust.step()
            self._force[axis] = force_n if blows else 0.0

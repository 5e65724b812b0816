"""The rover's scanner: distances all around at its own height, from rays cast into the scene. Sees what a scanner sees.

Low things lie under it. Must not report what it has hit, only how far away that is.
"""

import math
from typing import Any

import mujoco
import numpy as np

from crew.sim.noise import LIDAR_SIGMA_M, stream

BEAMS = 72
STEP_DEG = 5
NEAREST_M, FURTHEST_M = 0.12, 3.5


class Lidar:
    """Scans from `site`; the first beam points forward, the others follow clockwise, seen from above."""

    def __init__(self, model: Any, data: Any, site: str, *, seed: int, noise: bool = True) -> None:
        self._model, self._data = model, data
        self._site = int(model.site(site).id)
        self._carrier = int(model.site_bodyid[self._site])
        self._random = stream(seed, "lidar/range")
        self._sigma_m = LIDAR_SIGMA_M if noise else 0.0
        turns = np.deg2rad(np.arange(BEAMS) * STEP_DEG)
        self._rays = np.stack([np.cos(turns), -np.sin(turns), np.zeros(BEAMS)], axis=-1)

    def scan(self) -> list[float]:
        """Metres to what each beam meets; infinity where nothing is within reach."""
        rotation = self._data.site_xmat[self._site].reshape(3, 3)
        directions = np.ascontiguousarray(self._rays @ rotation.T).reshape(-1)
        hits, ranges = np.zeros(BEAMS, dtype=np.int32), np.zeros(BEAMS)
        mujoco.mj_multiRay(
            self._model, self._data, self._data.site_xpos[self._site], directions, None, True, self._carrier,
            hits, ranges, None, BEAMS, FURTHEST_M,
        )  # fmt: skip
        return [self._told(r) if h >= 0 else math.inf for h, r in zip(hits.tolist(), ranges.tolist(), strict=True)]

    def _told(self, range_m: float) -> float:
        return max(NEAREST_M, range_m + self._random.gauss(0.0, 1.0) * self._sigma_m)

"""The drone's downward camera: rays cast into the scene give a segmentation image; the victim's centroid is detected.

Needs no OpenGL. Sees only what a camera would: obstacles hide what is behind them. Must not report the victim's place,
only angles from the optical axis, as the landing-target message has them.
"""

import math
from typing import Any, NamedTuple

import mujoco
import numpy as np
from numpy.typing import NDArray

from crew.sim.noise import PIXEL_SIGMA, stream
from crew.sim.scene import GROUND_GROUP

WIDTH_PX, HEIGHT_PX = 80, 60
FOCAL_PX = (WIDTH_PX / 2) / math.tan(math.radians(80.0) / 2)  # 80 deg to the sides, 64 deg fore and aft
HALF_WIDTH_RAD = math.atan2(WIDTH_PX / 2, FOCAL_PX)
HALF_HEIGHT_RAD = math.atan2(HEIGHT_PX / 2, FOCAL_PX)
RANGE_M = 60.0


class Detection(NamedTuple):
    """The target's centre and extent in the image, radians; x forward, y right, from the optical axis (body's down)."""

    angle_x_rad: float
    angle_y_rad: float
    size_x_rad: float
    size_y_rad: float


class Camera:
    """Looks along -z of `site` and sees `target`, a body. Image rows run aft, columns right."""

    def __init__(
        self, model: Any, data: Any, site: str, target: str, *, seed: int, noise: bool = True, every_frame: bool = False
    ) -> None:
        self._model, self._data = model, data
        self._site = int(model.site(site).id)
        self._carrier = int(model.site_bodyid[self._site])
        self._target = int(model.body(target).id)
        self._random = stream(seed, "camera/pixels")
        self._sigma_px = PIXEL_SIGMA if noise else 0.0
        self._every_frame = every_frame
        self._rays = _pixel_rays()
        self._geomgroup = np.ones(6, dtype=np.uint8)
        self._geomgroup[GROUND_GROUP] = 0  # what lies under all else need not be hit
        self._hits = np.zeros(WIDTH_PX * HEIGHT_PX, dtype=np.int32)
        self._ranges = np.zeros(WIDTH_PX * HEIGHT_PX)
        self._centre, self._radius_m = _bounding_sphere(model, data, self._target)

    def detect(self) -> Detection | None:
        """Take a frame; None if the target is not in it."""
        if not self._every_frame and self._certainly_outside():
            return None
        return self._centroid(self.image() == self._target)

    def image(self) -> NDArray[np.int32]:
        """The body seen by each pixel, (HEIGHT_PX, WIDTH_PX); -1 where nothing but ground or sky is."""
        rotation = self._data.site_xmat[self._site].reshape(3, 3)
        directions = np.ascontiguousarray(self._rays @ rotation.T).reshape(-1)
        origin = self._data.site_xpos[self._site]
        mujoco.mj_multiRay(
            self._model, self._data, origin, directions, self._geomgroup, True, self._carrier,
            self._hits, self._ranges, None, len(self._hits), RANGE_M,
        )  # fmt: skip
        bodies = np.where(self._hits >= 0, self._model.geom_bodyid[self._hits], -1)
        return np.asarray(bodies, dtype=np.int32).reshape(HEIGHT_PX, WIDTH_PX)

    def _certainly_outside(self) -> bool:
        """True if the target's bounding sphere does not touch the view's pyramid."""
        rotation = self._data.site_xmat[self._site].reshape(3, 3)
        x, y, z = (rotation.T @ (self._centre - self._data.site_xpos[self._site])).tolist()
        aside = abs(y) * math.cos(HALF_WIDTH_RAD) + z * math.sin(HALF_WIDTH_RAD)
        ahead = abs(x) * math.cos(HALF_HEIGHT_RAD) + z * math.sin(HALF_HEIGHT_RAD)
        return bool(max(aside, ahead, z) > self._radius_m)

    def _centroid(self, mask: NDArray[np.bool_]) -> Detection | None:
        rows, columns = np.nonzero(mask)
        if len(rows) == 0:
            return None
        row = float(rows.mean()) + self._random.gauss(0.0, 1.0) * self._sigma_px
        column = float(columns.mean()) + self._random.gauss(0.0, 1.0) * self._sigma_px
        return Detection(
            math.atan2(HEIGHT_PX / 2 - 0.5 - row, FOCAL_PX),
            math.atan2(column + 0.5 - WIDTH_PX / 2, FOCAL_PX),
            float(rows.max() - rows.min() + 1) / FOCAL_PX,
            float(columns.max() - columns.min() + 1) / FOCAL_PX,
        )


def _pixel_rays() -> NDArray[np.float64]:
    """One unit vector for each pixel, row by row, in the site's frame (x forward, y left, z up), (n, 3)."""
    rows, columns = np.mgrid[0:HEIGHT_PX, 0:WIDTH_PX]
    forward = (HEIGHT_PX / 2 - 0.5 - rows) / FOCAL_PX
    right = (columns + 0.5 - WIDTH_PX / 2) / FOCAL_PX
    rays = np.stack([forward, -right, -np.ones_like(forward)], axis=-1).reshape(-1, 3)
    return np.asarray(rays / np.linalg.norm(rays, axis=1, keepdims=True), dtype=np.float64)


def _bounding_sphere(model: Any, data: Any, body: int) -> tuple[NDArray[np.float64], float]:
    """A sphere (world frame) that holds all geoms of a body that does not move."""
    geoms = range(int(model.body_geomadr[body]), int(model.body_geomadr[body] + model.body_geomnum[body]))
    centre = np.mean([data.geom_xpos[geom] for geom in geoms], axis=0)
    radius = max(float(np.linalg.norm(data.geom_xpos[geom] - centre) + model.geom_rbound[geom]) for geom in geoms)
    return centre, radius

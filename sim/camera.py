"""The drone's downward camera: rays cast into the scene segment the image; what looks like a person is detected.

Needs no OpenGL. Sees only what a camera would: obstacles hide what is behind them. Must not report anybody's place or
who it is, only angles from the optical axis and the extent in the image, as the landing-target message has them.
"""

import math
from collections.abc import Iterable
from typing import Any, NamedTuple

import mujoco
import numpy as np
from numpy.typing import NDArray

from crew.sim.noise import PIXEL_SIGMA, stream
from crew.sim.scene import GROUND_GROUP

WIDTH_PX, HEIGHT_PX = 80, 60
FOCAL_PX = (WIDTH_PX / 2) / math.tan(math.radians(80.0) / 2)  # 80 deg to the sides, 64 deg fore and aft
RANGE_M = 60.0
FLATTEST = 0.6  # cosine between the optical axis and the ray of a corner pixel, and less


class Detection(NamedTuple):
    """A target's centre and extent in the image, radians; x forward, y right, from the optical axis (body's down)."""

    angle_x_rad: float
    angle_y_rad: float
    size_x_rad: float
    size_y_rad: float


class Camera:
    """Looks along -z of `site` and detects `targets`, bodies that stand still. Image rows run aft, columns right.

    Unless `every_frame`, only those rays are cast that could meet a target; the result is the same.
    """

    def __init__(
        self,
        model: Any,
        data: Any,
        site: str,
        targets: Iterable[str],
        *,
        seed: int,
        noise: bool = True,
        every_frame: bool = False,
    ) -> None:
        self._model, self._data = model, data
        self._site = int(model.site(site).id)
        self._carrier = int(model.site_bodyid[self._site])
        self._targets = [int(model.body(target).id) for target in targets]
        self._random = stream(seed, "camera/pixels")
        self._sigma_px = PIXEL_SIGMA if noise else 0.0
        self._every_frame = every_frame
        self._rays = _pixel_rays()
        self._geomgroup = np.ones(6, dtype=np.uint8)
        self._geomgroup[GROUND_GROUP] = 0  # what lies under all else need not be hit
        self._all = np.arange(WIDTH_PX * HEIGHT_PX)
        self._spheres = [_bounding_sphere(model, data, target) for target in self._targets]

    def detect(self) -> list[Detection]:
        """Take a frame; what is in it, from the front of the image to its back."""
        pixels = self._all if self._every_frame else self._pixels_near_targets()
        if len(pixels) == 0:
            return []
        hits = self._cast(pixels)
        blobs = [pixels[hits == target] for target in self._targets]
        found = [self._centroid(blob) for blob in blobs if len(blob)]
        return sorted(found, key=lambda detection: -detection.angle_x_rad)

    def image(self) -> NDArray[np.int32]:
        """The body seen by each pixel, (HEIGHT_PX, WIDTH_PX); -1 where nothing but ground or sky is."""
        return self._cast(self._all).reshape(HEIGHT_PX, WIDTH_PX)

    def _cast(self, pixels: NDArray[np.intp]) -> NDArray[np.int32]:
        """The body seen by each of some pixels, given by their index in the image, row by row."""
        directions = np.ascontiguousarray(self._rays[pixels] @ self._rotation().T).reshape(-1)
        hits, ranges = np.zeros(len(pixels), dtype=np.int32), np.zeros(len(pixels))
        mujoco.mj_multiRay(
            self._model, self._data, self._data.site_xpos[self._site], directions, self._geomgroup, True, self._carrier,
            hits, ranges, None, len(pixels), RANGE_M,
        )  # fmt: skip
        return np.where(hits >= 0, self._model.geom_bodyid[hits], -1).astype(np.int32)

    def _pixels_near_targets(self) -> NDArray[np.intp]:
        """Those whose rays meet a target's bounding sphere: no other can show a target."""
        near: NDArray[np.bool_] | None = None
        for centre, radius_m in self._spheres:
            offset = self._rotation().T @ (centre - self._data.site_xpos[self._site])
            distance = float(np.linalg.norm(offset))
            if distance <= radius_m:
                return self._all
            cosine = math.sqrt(1.0 - (radius_m / distance) ** 2)
            if -offset[2] < distance * FLATTEST - radius_m:
                continue
            meets = self._rays @ (offset / distance) >= cosine
            near = meets if near is None else near | meets
        return self._all[:0] if near is None else np.flatnonzero(near)

    def _rotation(self) -> NDArray[np.float64]:
        """Camera to world, from the true attitude."""
        return np.asarray(self._data.site_xmat[self._site].reshape(3, 3))

    def _centroid(self, pixels: NDArray[np.intp]) -> Detection:
        rows, columns = np.divmod(pixels, WIDTH_PX)
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

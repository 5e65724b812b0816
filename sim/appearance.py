"""What a simulated world looks like, as data for whoever draws it: shapes once, poses of moving bodies as they go.

Knows no robot and no scene: everything is read off the compiled model.
"""

from collections.abc import Iterator
from typing import Any

import mujoco
import numpy as np

from crew.messages import Pose, SimScene, SimShape

_KINDS = {
    int(mujoco.mjtGeom.mjGEOM_BOX): "box",
    int(mujoco.mjtGeom.mjGEOM_SPHERE): "sphere",
    int(mujoco.mjtGeom.mjGEOM_ELLIPSOID): "ellipsoid",
    int(mujoco.mjtGeom.mjGEOM_CYLINDER): "cylinder",
    int(mujoco.mjtGeom.mjGEOM_CAPSULE): "capsule",
    int(mujoco.mjtGeom.mjGEOM_MESH): "mesh",
}
"""What is drawn. The ground is a plane, which has no end and is left to whoever draws."""
DRAWN_GROUPS = 3
"""MuJoCo's convention: groups from this on hold what only touches, beside the shapes that are seen."""

FINE = 500
"""Vertices from which on a mesh is drawn coarser: a robot of a million triangles would not reach who draws in time."""
GRAIN_M = 0.008


class Appearance:
    """Reads a model and its data; the caller sees to it that nobody steps them meanwhile."""

    def __init__(self, model: Any, data: Any) -> None:
        self._model, self._data = model, data
        self._names = [model.body(number).name or f"body_{number}" for number in range(model.nbody)]
        moves = (np.asarray(model.body_weldid) != 0) | (np.asarray(model.body_mocapid) >= 0)
        self._moving = np.flatnonzero(moves)
        self._fixed = np.flatnonzero(~moves)

    def scene(self) -> SimScene:
        """Every shape, and the poses of what never moves."""
        return SimScene(shapes=tuple(self._shapes()), fixed=self._poses(self._fixed), bodies=tuple(self._names))

    def moving(self) -> dict[str, Pose]:
        """Where every body is that can move."""
        return self._poses(self._moving)

    def _poses(self, bodies: Any) -> dict[str, Pose]:
        places, turns = self._data.xpos[bodies].tolist(), self._data.xquat[bodies].tolist()
        return {
            self._names[body]: (x, y, z, qx, qy, qz, qw)
            for body, (x, y, z), (qw, qx, qy, qz) in zip(bodies.tolist(), places, turns, strict=True)
        }

    def _shapes(self) -> Iterator[SimShape]:
        for geom in range(self._model.ngeom):
            kind = _KINDS.get(int(self._model.geom_type[geom]))
            if kind and int(self._model.geom_group[geom]) < DRAWN_GROUPS:
                yield self._shape(geom, kind)

    def _shape(self, geom: int, kind: str) -> SimShape:
        model = self._model
        x, y, z = model.geom_pos[geom].tolist()
        qw, qx, qy, qz = model.geom_quat[geom].tolist()
        vertices, triangles = self._mesh(geom) if kind == "mesh" else (b"", b"")
        return SimShape(
            body=self._names[int(model.geom_bodyid[geom])],
            kind=kind,
            half=_half(kind, *model.geom_size[geom].tolist()),
            pose=(x, y, z, qx, qy, qz, qw),
            rgba=self._colour(geom),
            vertices=vertices,
            triangles=triangles,
        )

    def _mesh(self, geom: int) -> tuple[bytes, bytes]:
        model, mesh = self._model, int(self._model.geom_dataid[geom])
        first, count = int(model.mesh_vertadr[mesh]), int(model.mesh_vertnum[mesh])
        face, faces = int(model.mesh_faceadr[mesh]), int(model.mesh_facenum[mesh])
        vertices, triangles = model.mesh_vert[first : first + count], model.mesh_face[face : face + faces]
        if count > FINE:
            vertices, triangles = coarse(vertices, triangles, GRAIN_M)
        return vertices.astype("<f4").tobytes(), triangles.astype("<u4").tobytes()

    def _colour(self, geom: int) -> tuple[float, float, float, float]:
        material = int(self._model.geom_matid[geom])
        rgba = self._model.mat_rgba[material] if material >= 0 else self._model.geom_rgba[geom]
        red, green, blue, alpha = rgba.tolist()
        return red, green, blue, alpha


def coarse(vertices: Any, triangles: Any, grain_m: float) -> tuple[Any, Any]:
    """A mesh of one vertex for each cell of a grid: the first that lies in it; triangles without an area are left out.

    Vertices (n, 3) in metres, triangles (m, 3) of their numbers; both of the same kind again.
    """
    cells = np.rint(vertices / grain_m).astype(np.int64)
    low = cells.min(axis=0)
    x, y, z = (cells - low).T
    _, first, number = np.unique((x << 40) | (y << 20) | z, return_index=True, return_inverse=True)
    a, b, c = number[triangles].T
    whole = (a != b) & (b != c) & (a != c)
    return vertices[first], np.unique(np.stack([a, b, c], axis=1)[whole], axis=0)


def _half(kind: str, first: float, second: float, third: float) -> tuple[float, float, float]:
    """MuJoCo's sizes as half sizes along the shape's own axes."""
    if kind == "sphere":
        return first, first, first
    return (first, first, second) if kind in ("cylinder", "capsule") else (first, second, third)

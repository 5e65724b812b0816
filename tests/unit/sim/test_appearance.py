"""What is drawn of a compiled model: the shapes that are seen, not those that only touch."""

import math

import mujoco
import numpy as np
import pytest

from crew.sim.appearance import Appearance, coarse

MODEL = """<mujoco><worldbody><body name="b"><freejoint/>
  <geom type="sphere" size="0.1" group="2"/><geom type="box" size="0.1 0.1 0.1" group="3"/>
  <geom type="box" size="0.2 0.2 0.2"/></body><geom type="plane" size="1 1 1"/></worldbody></mujoco>"""


def test_what_only_touches_is_not_drawn() -> None:
    model = mujoco.MjModel.from_xml_string(MODEL)
    shapes = Appearance(model, mujoco.MjData(model)).scene().shapes
    assert [(shape.kind, round(shape.half[0], 3)) for shape in shapes] == [("sphere", 0.1), ("box", 0.2)]


def test_a_coarser_mesh_keeps_its_size_and_its_triangles_an_area() -> None:
    """A ball of 12,000 triangles on a grid of a tenth of its radius."""
    turns, rings = 120, 50
    around, up = np.meshgrid(np.linspace(0, math.tau, turns, endpoint=False), np.linspace(0.05, math.pi - 0.05, rings))
    ball = np.stack([np.sin(up) * np.cos(around), np.sin(up) * np.sin(around), np.cos(up)], axis=-1).reshape(-1, 3)
    here = [
        (ring * turns + turn, ring * turns + (turn + 1) % turns) for ring in range(rings - 1) for turn in range(turns)
    ]
    faces = np.array([t for a, b in here for t in ((a, b, a + turns), (b, b + turns, a + turns))])
    vertices, triangles = coarse(ball, faces, 0.1)
    assert len(vertices) < len(ball) / 2
    assert np.abs(np.linalg.norm(vertices, axis=1) - 1.0).max() < 1e-9
    corners = vertices[triangles]
    sides = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    assert triangles.max() < len(vertices)
    assert np.linalg.norm(sides, axis=1).sum() / 2 == pytest.approx(4 * math.pi, rel=0.1)

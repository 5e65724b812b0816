"""Robots without hardware: worlds, vehicles and faults."""

import os

os.environ.setdefault("MUJOCO_GL", "disable")
"""The camera casts rays. Without this, importing mujoco loads a window library and takes 0.2 s longer."""

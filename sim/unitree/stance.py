"""Ground forces for the standing feet: the least-squares answer to a wanted force and moment on the trunk. Pure."""

from collections.abc import Sequence

from crew.sim.unitree.leg import Vector

FRICTION = 0.6
"""Sideways force is kept below this share of the load: less than the feet's own friction."""
DAMPING = 1e-3
"""Keeps the system solvable with two feet on the ground, about whose line no moment can be made."""
LOAD_MAX_N = 220.0


def stance_forces(feet: Sequence[Vector], force: Vector, moment: Vector) -> list[Vector]:
    """A force for each foot. `feet` relative to the centre of mass; all in one frame whose z is up."""
    n = float(len(feet))
    sx = sy = sz = sxx = syy = szz = sxy = sxz = syz = 0.0
    for x, y, z in feet:
        sx, sy, sz = sx + x, sy + y, sz + z
        sxx, syy, szz = sxx + x * x, syy + y * y, szz + z * z
        sxy, sxz, syz = sxy + x * y, sxz + x * z, syz + y * z
    d = DAMPING
    rows = [
        [n + d, 0.0, 0.0, 0.0, sz, -sy, force[0]],
        [0.0, n + d, 0.0, -sz, 0.0, sx, force[1]],
        [0.0, 0.0, n + d, sy, -sx, 0.0, force[2]],
        [0.0, -sz, sy, syy + szz + d, -sxy, -sxz, moment[0]],
        [sz, 0.0, -sx, -sxy, sxx + szz + d, -syz, moment[1]],
        [-sy, sx, 0.0, -sxz, -syz, sxx + syy + d, moment[2]],
    ]
    a, b, c, p, q, r = _solve(rows)
    return [_held((a + q * z - r * y, b + r * x - p * z, c + p * y - q * x)) for x, y, z in feet]


def _held(force: Vector) -> Vector:
    """The force within what a foot can press and what friction can hold."""
    fx, fy, fz = force
    fz = 5.0 if fz < 5.0 else LOAD_MAX_N if fz > LOAD_MAX_N else fz
    limit = FRICTION * fz
    fx = -limit if fx < -limit else limit if fx > limit else fx
    fy = -limit if fy < -limit else limit if fy > limit else fy
    return fx, fy, fz


def _solve(rows: list[list[float]]) -> list[float]:
    """Elimination without pivoting, which a positive definite system does not need. `rows` is used up."""
    size = len(rows)
    for i in range(size):
        pivot = rows[i]
        inverse = 1.0 / pivot[i]
        for j in range(i + 1, size):
            row = rows[j]
            factor = row[i] * inverse
            if factor:
                for k in range(i, size + 1):
                    row[k] -= factor * pivot[k]
    found = [0.0] * size
    for i in range(size - 1, -1, -1):
        row = rows[i]
        total = row[size]
        for k in range(i + 1, size):
            total -= row[k] * found[k]
        found[i] = total / row[i]
    return found

"""One leg's kinematics in scalars: hip roll, thigh pitch, calf pitch. Body frame FLU, metres, radians. Pure.

Numbers this few are faster in plain Python than in arrays, and every leg passes here at each control step.
"""

from math import cos, sin

THIGH_M = 0.213
CALF_M = 0.213

Vector = tuple[float, float, float]
Columns = tuple[Vector, Vector, Vector]


class Leg:
    """The geometry of one leg: where its hip sits in the trunk, and how far the thigh lies outside the hip's axis."""

    def __init__(self, hip_x_m: float, hip_y_m: float, offset_m: float) -> None:
        self.hip_x_m, self.hip_y_m, self.offset_m = hip_x_m, hip_y_m, offset_m
        self.home_y_m = hip_y_m + offset_m
        """Sideways place of a foot straight below its thigh."""

    def foot(self, hip: float, thigh: float, calf: float) -> tuple[Vector, Columns]:
        """The foot in the trunk's frame, and the columns of its Jacobian by joint."""
        c1, s1, c2, s2 = cos(hip), sin(hip), cos(thigh), sin(thigh)
        c23, s23 = CALF_M * cos(thigh + calf), CALF_M * sin(thigh + calf)
        reach, drop = -THIGH_M * s2 - s23, -THIGH_M * c2 - c23
        y, z = c1 * self.offset_m - s1 * drop, s1 * self.offset_m + c1 * drop
        columns = ((0.0, -z, y), (drop, s1 * reach, -c1 * reach), (-c23, -s1 * s23, c1 * s23))
        return (self.hip_x_m + reach, self.hip_y_m + y, z), columns


def torques(columns: Columns, force: Vector) -> Vector:
    """Joint torques that make the foot push with a force given in the trunk's frame."""
    fx, fy, fz = force
    (a, b, c), (d, e, f), (g, h, i) = columns
    return a * fx + b * fy + c * fz, d * fx + e * fy + f * fz, g * fx + h * fy + i * fz


def velocity(columns: Columns, rates: Vector) -> Vector:
    """The foot's velocity relative to the trunk, in its frame."""
    u, v, w = rates
    (a, b, c), (d, e, f), (g, h, i) = columns
    return a * u + d * v + g * w, b * u + e * v + h * w, c * u + f * v + i * w

"""What the inner loop knows of a quadruped's body: one table, a row a model. Newtons, metres, seconds, radians."""

import msgspec


class Build(msgspec.Struct, frozen=True, kw_only=True):
    """A body with the legs' common geometry (crew.sim.unitree.leg), as its joints answer to torques."""

    mass_kg: float
    """All of it, with an empty tray."""
    damping_nms: float = 0.0
    """Torque for each rad/s that the motors add while walking, since the joints' bearings take it away."""


OWN = Build(mass_kg=16.6)
MENAGERIE = Build(mass_kg=15.9, damping_nms=1.5)
"""Menagerie's Go2 has 2 N m s: the rest damps its legs. With 1.9 it tilted twice as far and crept ahead."""

"""The side channel: what cameras, a locator and a tray's sensor tell beside the SDK, with noise. Never the truth.

docs/unitree-link.md describes it; a real installation can fill it as well.
"""

import math
from collections.abc import Callable
from typing import Any

from crew.sim.noise import stream

SEES_M = 1.6
"""How far the humanoid's camera recognises things and the tray."""
THING_SIGMA_M, TRAY_SIGMA_M, PERSON_SIGMA_M = 0.003, 0.004, 0.01
YAW_SIGMA_RAD = math.radians(1.5)
TRAY_TICKS = 3
"""Ticks for which the tray's sensor must agree with itself."""

Place = tuple[float, float, float, float]
"""x, y, z, yaw: world ENU."""


class Senses:
    """Noisy views of true places. One generator for each thing that is seen, so that a seed means the same always."""

    def __init__(self, seed: int, noise: bool) -> None:
        self._seed, self._scale = seed, 1.0 if noise else 0.0
        self._streams: dict[str, Callable[[float, float], float]] = {}

    def see(self, name: str, place: Place, sigma_m: float) -> dict[str, Any]:
        """A place as it is seen now."""
        gauss = self._streams.get(name)
        if gauss is None:
            gauss = self._streams[name] = stream(self._seed, f"sense/{name}").gauss
        x, y, z, yaw = place
        sigma_m *= self._scale
        return {
            "name": name,
            "x": x + gauss(0.0, sigma_m),
            "y": y + gauss(0.0, sigma_m),
            "z": z + gauss(0.0, sigma_m),
            "yaw": yaw + gauss(0.0, self._scale * YAW_SIGMA_RAD),
        }


class TraySensor:
    """A tag reader and a weight switch, debounced."""

    def __init__(self, model: Any, data: Any, mat: str, things: dict[str, float]) -> None:
        self._data = data
        self._mat = int(model.geom(mat).id)
        self._things = {int(model.geom(f"thing/{name}").id): (name, 9.81 * kg) for name, kg in things.items()}
        self._lying, self._ticks = "", 0
        self.reading: tuple[str, float] = ("", 0.0)

    def tick(self) -> None:
        """Look for contact with the mat."""
        now = ""
        weight_n = 0.0
        for one, other in self._data.contact.geom.tolist():
            if self._mat in (one, other):
                name, newtons = self._things.get(other if one == self._mat else one, ("", 0.0))
                if name:
                    now, weight_n = name, newtons
        self._ticks = self._ticks + 1 if now == self._lying else 0
        self._lying = now
        if self._ticks >= TRAY_TICKS:
            self.reading = (now, weight_n)


def yaw_of(matrix: list[float]) -> float:
    """The heading of a rotation matrix given row by row."""
    return math.atan2(matrix[3], matrix[0])

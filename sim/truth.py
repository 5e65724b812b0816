"""What really is, for the recorder and the study. Must never reach an adapter or an autopilot."""

from typing import Any

import msgspec


class RobotTruth(msgspec.Struct, frozen=True, kw_only=True):
    """World frame: ENU, metres; z of the sole above the ground; yaw in radians, counter-clockwise from east.

    contacts: how often the robot has begun to touch an obstacle, a person or another robot since the start.
    """

    x_m: float
    y_m: float
    z_m: float
    yaw_rad: float
    speed_mps: float
    battery: float  # fraction of full
    armed: bool
    contacts: int


class Truth(msgspec.Struct, frozen=True, kw_only=True):
    time_ns: int
    robots: dict[str, RobotTruth]
    victim_x_m: float
    victim_y_m: float
    people: dict[str, tuple[float, float]]


class SceneTruth(msgspec.Struct, frozen=True, kw_only=True):
    """What every scene can tell: robots' poses x, y, z, yaw and other places x, y, z, by name. ENU, metres, radians."""

    time_ns: int
    poses: dict[str, tuple[float, float, float, float]]
    targets: dict[str, tuple[float, float, float]]


class ContactCounter:
    """Counts the beginnings of contact between one robot and what stands on the ground."""

    def __init__(self, model: Any, robot: str) -> None:
        self._own = _geoms(model, f"{robot}/")
        ground = {geom for geom in range(model.ngeom) if int(model.geom_bodyid[geom]) == 0}
        self._others = set(range(model.ngeom)) - ground - self._own
        self._touching: set[int] = set()
        self.count = 0

    def update(self, pairs: list[list[int]]) -> None:
        """pairs: the geoms of every contact now."""
        now = set()
        for one, other in pairs:
            if one in self._own and other in self._others:
                now.add(other)
            elif other in self._own and one in self._others:
                now.add(one)
        self.count += len(now - self._touching)
        self._touching = now


def _geoms(model: Any, prefix: str) -> set[int]:
    return {geom for geom in range(model.ngeom) if model.body(int(model.geom_bodyid[geom])).name.startswith(prefix)}

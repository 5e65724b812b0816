"""The person who asks: holds out a hand, takes what is put there, tugs, may walk away. Must not know the robots."""

import math
from typing import Any

from crew.sim.apartment.site import BODY_BEHIND_M, Person

TAKE_M = 0.07
"""A thing so near to the palm is taken."""
TAKE_S = 0.4
TUG_M, TUG_S = 0.05, 0.8
"""Having taken hold, the person draws the thing up by so much."""
WALK_MPS = 1.0
SETTLE_S = 0.5


class Requester:
    """A person made of two mocap bodies and a weld for each thing. `tick` at a fixed period."""

    def __init__(self, model: Any, data: Any, person: Person, things: tuple[str, ...], step_s: float) -> None:
        self._model, self._data = model, data
        self._step_s = step_s
        self._hand = int(model.body("requester/hand").mocapid[0])
        self._body = int(model.body("requester/body").mocapid[0])
        self._things = {name: int(model.body(f"thing/{name}").id) for name in things}
        self._grips = {name: int(model.equality(f"requester/{name}").id) for name in things}
        self._near_s = dict.fromkeys(things, 0.0)
        self._tugged_s = 0.0
        self._yaw = person.yaw_rad
        self._leaves_to = (person.leaves_to.x_m, person.leaves_to.y_m)
        self.leaving = False
        self.held = ""
        """What the person holds."""

    @property
    def position(self) -> tuple[float, float, float]:
        """The hand: world ENU, metres."""
        x, y, z = self._data.mocap_pos[self._hand].tolist()
        return x, y, z

    @property
    def yaw_rad(self) -> float:
        """Which way the person faces."""
        return self._yaw

    def place(self, x_m: float, y_m: float) -> None:
        """Stand so that the hand is at a point."""
        z = self._data.mocap_pos[self._hand][2]
        self._data.mocap_pos[self._hand] = (x_m, y_m, z)
        body = (x_m - BODY_BEHIND_M * math.cos(self._yaw), y_m - BODY_BEHIND_M * math.sin(self._yaw), 0.75)
        self._data.mocap_pos[self._body] = body

    def tick(self) -> None:
        """Walk, take, tug."""
        if self.leaving:
            self._walk()
        elif self.held:
            self._tug()
        else:
            self._feel()

    def _walk(self) -> None:
        x, y, _ = self.position
        away_m = math.dist((x, y), self._leaves_to)
        if away_m > 1e-6:
            share = min(1.0, WALK_MPS * self._step_s / away_m)
            self.place(x + (self._leaves_to[0] - x) * share, y + (self._leaves_to[1] - y) * share)

    def _feel(self) -> None:
        for name, body in self._things.items():
            near = math.dist(self._data.xpos[body].tolist(), self.position) < TAKE_M
            self._near_s[name] = self._near_s[name] + self._step_s if near else 0.0
            if self._near_s[name] >= TAKE_S:
                self._take(name, body)
                return

    def _take(self, name: str, body: int) -> None:
        """Close the hand around a thing as it is: the weld keeps the pose of this moment."""
        data = self._data
        apart = [a - b for a, b in zip(data.xpos[body].tolist(), self.position, strict=True)]
        turn, away = _relative(data.mocap_quat[self._hand].tolist(), data.xquat[body].tolist(), apart)
        grip = self._grips[name]
        self._model.eq_data[grip, 0:3] = 0.0
        self._model.eq_data[grip, 3:6] = away
        self._model.eq_data[grip, 6:10] = turn
        self._model.eq_data[grip, 10] = 1.0
        self._data.eq_active[grip] = 1
        self.held = name

    def _tug(self) -> None:
        if self._tugged_s < TUG_S + SETTLE_S:
            self._tugged_s += self._step_s
            if self._tugged_s > SETTLE_S:
                self._data.mocap_pos[self._hand][2] += TUG_M * self._step_s / TUG_S


def _relative(hand: list[float], thing: list[float], away: list[float]) -> tuple[list[float], list[float]]:
    """A thing's turn and place in the hand's frame, for a hand that is turned about z alone."""
    w, _, _, k = hand
    a, b, c, d = thing
    turn = [w * a + k * d, w * b + k * c, w * c - k * b, w * d - k * a]
    cos, sin = w * w - k * k, 2.0 * w * k
    x, y, z = away
    return turn, [cos * x + sin * y, -sin * x + cos * y, z]

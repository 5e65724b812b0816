"""Mishaps that a fault brings about, physically, when their moment comes. Must not tell anybody."""

import math
from collections.abc import Callable
from typing import Any

from crew.sim.apartment.requester import Requester
from crew.sim.apartment.site import Site
from crew.sim.faults import Faults
from crew.sim.unitree.g1 import G1
from crew.sim.unitree.go2 import Go2
from crew.sim.unitree.rpc import NOT_IMPLEMENTED, Service

NAMES = (
    "grasp_failed",
    "object_dropped",
    "tray_slip",
    "doorway_blocked",
    "go2_falls",
    "requester_leaves",
    "move_ignored",
    "link_loss",
    "lease_held",
    "sdk_timeout",
    "sdk_not_implemented",
)
LIFTED_M = 0.06
BESIDE_M = 1.0
WALKED_S = 3.0
SHOVE_NS, SHOVE_AT_M = 55.0, 0.2
SLIPPERY = (0.02, 0.0001, 0.0001)
HOP_MPS = (0.3, 1.3, 1.2)
"""What throws a load out of its tray: ahead, sideways, up."""
INTRUDER = "another client"
GUARDED = (1001, 1002, 1003, 1004, 1005, 1006, 1008)


class Mishaps:
    """Looks at the world at each tick and does what the faults that are on ask for."""

    def __init__(
        self, model: Any, data: Any, site: Site, faults: Faults, g1: G1, go2: Go2, requester: Requester
    ) -> None:
        self._model, self._data, self._site, self._faults = model, data, site, faults
        self._g1, self._go2, self._requester = g1, go2, requester
        self._pads = [int(model.geom(f"g1/{pad}").id) for pad in ("pad_left", "pad_right")]
        self._grippy = model.geom_friction[self._pads[0]].tolist()
        self._heights = {t.name: self._height_m(t.name) for t in site.things}
        self._walked_s = 0.0
        self._done: set[str] = set()

    def tick(self, now_ns: int, step_s: float, loaded: str) -> None:
        """`loaded`: what lies in the tray."""
        self._walked_s = self._walked_s + step_s if self._go2.walking else 0.0
        walked = self._walked_s > WALKED_S
        on = self._faults.is_on
        self._g1.unfit, self._go2.unfit = on("g1_unavailable"), on("go2_unavailable")
        self._go2.ignores_moves = on("move_ignored")
        self._grip(on("grasp_failed") or (on("object_dropped") and self._lifted()))
        self._block(on("doorway_blocked"))
        self._go2.link.cut = on("link_loss") and (walked or self._go2.link.cut)
        self._once("tray_slip", walked and bool(loaded), lambda: self._throw(loaded))
        self._once("go2_falls", walked, lambda: self._go2.shove(SHOVE_NS, math.pi / 2, SHOVE_AT_M))
        self._once("requester_leaves", (walked and bool(loaded)) or self._offered(), self._requester_leaves)
        self._services(now_ns)

    def _once(self, fault: str, now: bool, act: Callable[[], None]) -> None:
        if not self._faults.is_on(fault):
            self._done.discard(fault)
        elif now and fault not in self._done:
            self._done.add(fault)
            act()

    def _requester_leaves(self) -> None:
        self._requester.leaving = True

    def _grip(self, slippery: bool) -> None:
        for pad in self._pads:
            self._model.geom_friction[pad] = SLIPPERY if slippery else self._grippy

    def _lifted(self) -> bool:
        """Whether something was lifted off its table."""
        return any(self._height_m(name) - before > LIFTED_M for name, before in self._heights.items())

    def _offered(self) -> bool:
        """Whether something was lifted while the person stands beside the table."""
        g1, hand = self._site.robots["g1"], self._requester.position
        return self._lifted() and math.dist((g1.x_m, g1.y_m), hand[:2]) < BESIDE_M

    def _block(self, blocked: bool) -> None:
        for doorway in self._site.doorways:
            crate = int(self._model.body(f"crate/{doorway.name}").mocapid[0])
            self._data.mocap_pos[crate] = (doorway.x_m, doorway.y_m, 0.3 if blocked else -3.0)

    def _throw(self, name: str) -> None:
        speed = int(self._model.joint(f"thing/{name}").dofadr[0])
        self._data.qvel[speed : speed + 3] += HOP_MPS

    def _services(self, now_ns: int) -> None:
        for service in (self._go2.sport, self._g1.arm):
            service.mute = self._faults.is_on("sdk_timeout")
            _answer(service, NOT_IMPLEMENTED if self._faults.is_on("sdk_not_implemented") else 0)
        if self._faults.is_on("lease_held"):
            lease = self._go2.sport.lease
            if lease.name != INTRUDER:
                lease.id = 0
                lease.apply(INTRUDER, now_ns)
            lease.renew(lease.id, now_ns)

    def _height_m(self, name: str) -> float:
        return float(self._data.xpos[int(self._model.body(f"thing/{name}").id)][2])


def _answer(service: Service, code: int) -> None:
    """Answer every moving call with a code, or carry calls out again."""
    service.answers = dict.fromkeys((*GUARDED, 7106), code) if code else {}

"""The apartment on one simulated clock: physics, robots, person, senses, mishaps.

Synchronous and single-threaded, the only owner of MjData. Must not read the wall clock, sleep, or know the bus.
"""

from types import TracebackType
from typing import Any, Self

import mujoco

from crew.sim.apartment.mishap import NAMES, Mishaps
from crew.sim.apartment.requester import Requester
from crew.sim.apartment.scene import ROBOTS, TIMESTEP_NS, build
from crew.sim.apartment.sense import (
    PERSON_SIGMA_M,
    SEES_M,
    THING_SIGMA_M,
    TRAY_SIGMA_M,
    Place,
    Senses,
    TraySensor,
    yaw_of,
)
from crew.sim.apartment.site import Site, load_site
from crew.sim.appearance import Appearance
from crew.sim.autopilot.link import parse_endpoint
from crew.sim.config import WorldConfig
from crew.sim.faults import Faults
from crew.sim.noise import stream
from crew.sim.scenes import Eye
from crew.sim.truth import SceneTruth
from crew.sim.unitree.build import MENAGERIE, OWN
from crew.sim.unitree.g1 import G1
from crew.sim.unitree.go2 import Go2
from crew.sim.unitree.link import Link

CONTROL_STEPS = 2  # physics steps to a step of the inner loops: 200 Hz
TICK_STEPS = 20  # physics steps to a telemetry tick: 20 Hz
CONTROL_S = CONTROL_STEPS * TIMESTEP_NS * 1e-9
TICK_S = TICK_STEPS * TIMESTEP_NS * 1e-9
TRAY_PLACE = "payload_tray"


class Apartment:
    """Opens one socket a robot. Raises ValueError for an unknown fault, link or map.

    Same configuration and same datagrams at the same simulated times give bit-identical truth.
    """

    def __init__(self, config: WorldConfig) -> None:
        self.site: Site = load_site(config.map)
        if set(config.links) != set(ROBOTS):
            raise ValueError(f"links: has {sorted(config.links)}, the scene needs {sorted(ROBOTS)}")
        endpoints = {name: parse_endpoint(text) for name, text in config.links.items()}
        self._faults = Faults(ROBOTS, config.faults, shared=NAMES)
        self._model: Any = build(self.site, config.models)
        self._data: Any = mujoco.MjData(self._model)
        self._steps = 0
        self._links = {name: Link(address) for name, address in endpoints.items()}
        self._g1 = G1(self._model, self._data, "g1", link=self._links["g1"], step_s=CONTROL_S)
        self._go2 = Go2(
            self._model, self._data, "go2", link=self._links["go2"], seed=config.seed, noise=config.noise,
            step_s=CONTROL_S, tick_s=TICK_S, build=MENAGERIE if config.models else OWN,
        )  # fmt: skip
        things = {thing.name: thing.mass_kg for thing in self.site.things}
        self._requester = Requester(self._model, self._data, self.site.requester, tuple(things), TICK_S)
        self._scatter(config.seed)
        mujoco.mj_forward(self._model, self._data)
        self._tray = TraySensor(self._model, self._data, "go2/mat", things)
        self._go2.tray = lambda: self._tray.reading
        self._senses = Senses(config.seed, config.noise)
        self._mishaps = Mishaps(self._model, self._data, self.site, self._faults, self._g1, self._go2, self._requester)
        self._bodies = {name: int(self._model.body(f"thing/{name}").id) for name in things}
        self._tray_site = int(self._model.site("go2/tray").id)

    @property
    def time_ns(self) -> int:
        """Simulated time: a whole number of physics steps (2.5 ms)."""
        return self._steps * TIMESTEP_NS

    def advance(self, until_ns: int) -> None:
        """Step the world while a physics step ends no later than `until_ns`; telemetry is told at the end of a tick."""
        step, model, data = mujoco.mj_step, self._model, self._data
        while (self._steps + 1) * TIMESTEP_NS <= until_ns:
            if self._steps % CONTROL_STEPS == 0:
                self._go2.control()
                self._g1.control()
            step(model, data)
            self._steps += 1
            if self._steps % TICK_STEPS == 0:
                self._tick()

    def poll(self) -> int:
        """Handle the datagrams that are waiting, without advancing time; how many there were."""
        return self._g1.poll(self.time_ns) + self._go2.poll(self.time_ns)

    def sent(self) -> dict[str, int]:
        """Datagrams sent to each robot's client since the start."""
        return {name: link.sent for name, link in self._links.items()}

    def scene_truth(self) -> SceneTruth:
        g1 = self.site.robots["g1"]
        things = {name: tuple(self._data.xpos[body].tolist()) for name, body in self._bodies.items()}
        return SceneTruth(
            time_ns=self.time_ns,
            poses={"g1": (g1.x_m, g1.y_m, 0.0, g1.yaw_rad), "go2": self._go2.true_pose},
            targets={"requester": self._requester.position, **things},
        )

    def appearance(self) -> Appearance:
        """What the world looks like, for whoever draws it."""
        return Appearance(self._model, self._data)

    def cameras(self) -> dict[str, Eye]:
        """None that is watched: what robots see comes over the side channel."""
        return {}

    def set_fault(self, name: str, on: bool) -> None:
        """Switch a fault while running. Raises ValueError with the valid names and the nearest for an unknown one."""
        self._faults.switch(name, on)

    def close(self) -> None:
        """Close the sockets; may be called twice."""
        for link in self._links.values():
            link.close()

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()

    def _scatter(self, seed: int) -> None:
        """Move things and the person a little, as the seed says."""
        random = stream(seed, "scatter")
        for thing in self.site.things:
            start = int(self._model.joint(f"thing/{thing.name}").qposadr[0])
            for axis in range(2):
                self._data.qpos[start + axis] += random.uniform(-self.site.jitter_m, self.site.jitter_m)
        person, reach_m = self.site.requester, self.site.person_jitter_m
        self._requester.place(
            person.x_m + random.uniform(-reach_m, reach_m), person.y_m + random.uniform(-reach_m, reach_m)
        )

    def _tick(self) -> None:
        now_ns = self.time_ns
        self._faults.advance(now_ns)
        self._tray.tick()
        self._requester.tick()
        self._mishaps.tick(now_ns, TICK_S, self._tray.reading[0])
        self._g1.tick(now_ns)
        self._go2.tick(now_ns)
        self._tell()

    def _tell(self) -> None:
        """The side channel."""
        see = self._senses.see
        x, y, z = self._requester.position
        person = see("requester", (x, y, z, self._requester.yaw_rad), PERSON_SIGMA_M)
        for link in self._links.values():
            link.publish("rt/crew/people", {"people": [person]})
        g1 = self.site.robots["g1"]
        eye = (g1.x_m, g1.y_m)
        things = [
            see(name, place, THING_SIGMA_M)
            for name, body in self._bodies.items()
            if _within(place := self._place(self._data.xpos[body], self._data.xmat[body]), eye, SEES_M)
        ]
        tray = self._place(self._data.site_xpos[self._tray_site], self._data.site_xmat[self._tray_site])
        trays = [see(TRAY_PLACE, tray, TRAY_SIGMA_M)] if _within(tray, eye, SEES_M) else []
        self._links["g1"].publish("rt/crew/objects", {"objects": things, "places": trays})

    def _place(self, position: Any, matrix: Any) -> Place:
        x, y, z = position.tolist()
        return x, y, z, yaw_of(matrix.tolist())


def _within(place: Place, eye: tuple[float, float], reach_m: float) -> bool:
    return (place[0] - eye[0]) ** 2 + (place[1] - eye[1]) ** 2 <= reach_m**2

"""The simulated world: physics, vehicles, autopilots and camera on one simulated clock.

Synchronous and single-threaded, the only owner of MjData. Must not read the wall clock, sleep, or know the bus.
"""

from collections.abc import Mapping
from types import TracebackType
from typing import Any, Self

import mujoco

from crew.sim.appearance import Appearance
from crew.sim.autopilot.autopilot import Autopilot
from crew.sim.autopilot.copter import Copter
from crew.sim.autopilot.driving import Driving
from crew.sim.autopilot.link import Link, LinkCount, parse_endpoint
from crew.sim.autopilot.registry import QUADCOPTERS, ROVERS, choose
from crew.sim.camera import Camera
from crew.sim.config import WorldConfig
from crew.sim.faults import Faults
from crew.sim.geo import GeoFrame
from crew.sim.lidar import Lidar
from crew.sim.map import Map, load_map
from crew.sim.scene import TIMESTEP_NS, Surprises, build, people, robots, seen_bodies
from crew.sim.truth import ContactCounter, RobotTruth, SceneTruth, Truth
from crew.sim.vehicle.estimator import DroneEstimator, RoverEstimator
from crew.sim.vehicle.quadcopter import Quadcopter
from crew.sim.vehicle.rover import Rover
from crew.sim.wind import Wind

CONTROL_STEPS = 5  # physics steps to a control tick: 50 Hz
FRAME_TICKS = 10  # control ticks to a camera frame and to a scan: 5 Hz
FAST_S = TIMESTEP_NS * 1e-9
SLOW_S = CONTROL_STEPS * FAST_S
BATTERY_LOW = 0.12
SYSTEMS = {"iris": 1, "tb3": 2}
"""MAVLink system ids."""
SURPRISES = ("blocked_path", "unmapped_obstacle")


class World:
    """Opens one socket a robot. Raises ValueError for an unknown fault, link or map.

    Same configuration and same datagrams at the same simulated times give bit-identical truth.
    """

    def __init__(self, config: WorldConfig) -> None:
        self.config = config
        self.map: Map = load_map(config.scene, config.map)
        names = sorted(robots(self.map))
        if set(config.links) != set(names):
            raise ValueError(f"links: has {sorted(config.links)}, the scene needs {names}")
        if unknown := (set(config.autopilots) | set(config.signing_keys)) - set(names):
            raise ValueError(f"the scene has no vehicle {', '.join(sorted(unknown))}; it has {', '.join(names)}")
        self._endpoints = {name: parse_endpoint(text) for name, text in config.links.items()}
        self._faults = Faults(names, config.faults)
        self._model: Any = build(self.map)
        self._data: Any = mujoco.MjData(self._model)
        mujoco.mj_forward(self._model, self._data)
        self._steps = 0
        self._drone = Quadcopter(
            self._model, self._data, "iris", DroneEstimator(config.seed, "iris", FAST_S, SLOW_S, config.noise), SLOW_S
        )
        self._rover = Rover(
            self._model, self._data, "tb3", RoverEstimator(config.seed, "tb3", SLOW_S, config.noise), SLOW_S
        )
        self._camera = Camera(
            self._model, self._data, "iris/camera", seen_bodies(self.map),
            seed=config.seed, noise=config.noise, every_frame=config.every_frame,
        )  # fmt: skip
        self._lidar = Lidar(self._model, self._data, "tb3/scanner", seed=config.seed, noise=config.noise)
        self._surprises = Surprises(self.map, self._model, self._data)
        self._wind = Wind(self._data, self._drone.body.id, config.seed, "iris", SLOW_S)
        self._contacts = {name: ContactCounter(self._model, name) for name in names}
        self._copter: Copter = self._autopilot("iris", self._drone, QUADCOPTERS)
        self._driving: Driving = self._autopilot("tb3", self._rover, ROVERS)
        self._autopilots: dict[str, Autopilot] = {"iris": self._copter, "tb3": self._driving}

    @property
    def time_ns(self) -> int:
        """Simulated time: a whole number of physics steps (4 ms)."""
        return self._steps * TIMESTEP_NS

    def advance(self, until_ns: int) -> None:
        """Step the world while a physics step begins before `until_ns` and ends no later than it."""
        while (self._steps + 1) * TIMESTEP_NS <= until_ns:
            if self._steps % CONTROL_STEPS == 0:
                self._control_tick()
            self._drone.fast_step()
            mujoco.mj_step(self._model, self._data)
            self._steps += 1

    def poll(self) -> int:
        """Handle the datagrams that are waiting, without advancing time; how many were understood."""
        return sum(autopilot.poll() for autopilot in self._autopilots.values())

    def counts(self) -> dict[str, LinkCount]:
        """Datagrams of each robot's link since the start."""
        return {name: autopilot.link.count for name, autopilot in self._autopilots.items()}

    def truth(self) -> Truth:
        victim = self.map.victim
        return Truth(
            time_ns=self.time_ns,
            robots={"iris": self._robot_truth("iris", self._drone), "tb3": self._robot_truth("tb3", self._rover)},
            victim_x_m=victim.x_m,
            victim_y_m=victim.y_m,
            people={name: (spot.x_m, spot.y_m) for name, spot in people(self.map).items()},
        )

    def sent(self) -> dict[str, int]:
        """Datagrams sent to each robot's adapter since the start."""
        return {name: autopilot.link.count.sent for name, autopilot in self._autopilots.items()}

    def scene_truth(self) -> SceneTruth:
        truth = self.truth()
        poses = {name: (t.x_m, t.y_m, t.z_m, t.yaw_rad) for name, t in truth.robots.items()}
        return SceneTruth(
            time_ns=truth.time_ns, poses=poses, targets={"victim": (truth.victim_x_m, truth.victim_y_m, 0.0)}
        )

    def appearance(self) -> Appearance:
        """What the world looks like, for whoever draws it."""
        return Appearance(self._model, self._data)

    def cameras(self) -> dict[str, Camera]:
        """The cameras by the vehicle that carries each."""
        return {"iris": self._camera}

    def set_fault(self, name: str, on: bool) -> None:
        """Switch a fault while running. Raises ValueError with the valid names and the nearest for an unknown one."""
        self._faults.switch(name, on)

    def close(self) -> None:
        """Close the sockets; may be called twice."""
        for autopilot in self._autopilots.values():
            autopilot.link.close()

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()

    def _control_tick(self) -> None:
        tick = self._steps // CONTROL_STEPS
        self._faults.advance(self.time_ns)
        for fault in SURPRISES:
            self._surprises.show(fault, self._faults.is_on(fault))
        self._wind.step(self._faults.is_on("wind_gusts"))
        if self._faults.is_on("battery_low"):
            self._drone.battery.fraction = min(self._drone.battery.fraction, BATTERY_LOW)
        self.poll()
        self._drone.slow_step()
        self._rover.slow_step()
        pairs = self._data.contact.geom.tolist()
        for counter in self._contacts.values():
            counter.update(pairs)
        for autopilot in self._autopilots.values():
            autopilot.tick(self.time_ns)
        if tick % FRAME_TICKS == 0:
            self._take_frame()
            self._scan()

    def _take_frame(self) -> None:
        if self._faults.is_on("missed_detection"):
            return
        self._copter.report_targets(self._camera.detect())

    def _scan(self) -> None:
        self._driving.report_scan(self._lidar.scan())

    def _autopilot(self, name: str, vehicle: Quadcopter | Rover, known: Mapping[str, Any]) -> Any:
        make = choose(name, self.config.autopilots.get(name), known)
        link = Link(self._endpoints[name], SYSTEMS[name], key=self.config.signing_keys.get(name))
        spawn = self.map.robots[name]
        return make(vehicle, link, GeoFrame(self.map.origin), (spawn.x_m, spawn.y_m), self._faults)

    def _robot_truth(self, name: str, vehicle: Quadcopter | Rover) -> RobotTruth:
        s = vehicle.body.read()
        return RobotTruth(
            x_m=s.x,
            y_m=s.y,
            z_m=s.z,
            yaw_rad=s.yaw,
            speed_mps=s.speed,
            battery=vehicle.battery.fraction,
            armed=self._autopilots[name].armed,
            contacts=self._contacts[name].count,
        )

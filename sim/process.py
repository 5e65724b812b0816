"""The simulation process: steps the world slice by slice, publishes mission time and truth, takes faults."""

import os
from collections.abc import Mapping

from crew.bus.port import Bus, Qos
from crew.bus.zenoh import ZenohBus
from crew.clock import turn
from crew.errors import UsageError
from crew.keys import Keys
from crew.mailbox import Events, Letter, letters
from crew.messages import ClockAck, ClockTick, SimFault, SimTruth
from crew.process import ChildContext, run_child
from crew.sim.pace import Lockstep, Pace
from crew.sim.scenes import SceneWorld, open_world
from crew.sim.show import Show
from crew.sim.spec import SimulationSpec

SLICE_NS = 50_000_000
AHEAD = 1
"""Slices that the world may be ahead of the slowest participant: stepping and reacting then share the time."""
AHEAD_PACED = 5
"""The same with `--speed N`: a machine that is too slow slows the world down, and no state goes stale by accident.

With the slice that is under way 0.3 s, less than what the gate lets a state lie ahead of its clock."""
GATHER_S = 2.0
"""Wall time that mission time waits, at its beginning, for robots that are yet to come."""
TRUTH_EVERY = 2
"""Slices between two messages of truth."""


class Simulation:
    """Owns the world; nobody else reads it but through the bus."""

    def __init__(self, bus: Bus, keys: Keys, world: SceneWorld, vehicles: Mapping[str, str], speed: float) -> None:
        self._world, self._vehicles, self._speed = world, vehicles, speed
        self._show = Show(bus, keys, world, vehicles)
        acks: Events[Letter[ClockAck]] = Events(letters(ClockAck), capacity=256, on_lost=lambda _: None)
        self._lockstep = Lockstep(acks)
        self._pace = Pace()
        self._faults: Events[Letter[SimFault]] = Events(letters(SimFault), capacity=16, on_lost=lambda _: None)
        bus.subscribe(keys.clock_acks, acks)
        bus.subscribe(keys.sim_fault, self._faults)
        self._ticks = bus.publisher(keys.clock, qos=Qos.EVENT)
        self._truths = bus.publisher(keys.sim_truth, qos=Qos.STATE)

    async def run(self) -> None:
        """Advance until cancelled. Mission time begins once every robot hears it: the first telemetry reaches them."""
        await self._lockstep.gather(self._vehicles.keys(), GATHER_S)
        number = 0
        while True:
            number += 1
            self._take_faults()
            self._world.advance(number * SLICE_NS)
            self._publish(number)
            if self._speed:
                await self._pace.wait(SLICE_NS / 1e9, self._speed)
                await self._lockstep.wait(number - AHEAD_PACED, for_holders=False)
                continue
            await self._lockstep.wait(number - AHEAD, for_holders=True)
            await self._collect_datagrams()
            if self._lockstep.idle:
                await self._pace.wait(SLICE_NS / 1e9, 1.0)

    def _take_faults(self) -> None:
        for letter in self._faults.take():
            try:
                self._world.set_fault(letter.message.name, letter.message.on)
            except ValueError as error:
                print(f"fault refused: {error}")

    def _publish(self, number: int) -> None:
        counts = self._world.sent()
        sent = {robot: counts[vehicle] for robot, vehicle in self._vehicles.items()}
        self._ticks.put(ClockTick(slice=number, now_ns=self._world.time_ns, datagrams=sent, paced=self._speed > 0))
        if number % TRUTH_EVERY == 0:
            self._truths.put(self._truth())
        self._show.frames()

    def _truth(self) -> SimTruth:
        truth = self._world.scene_truth()
        poses = {robot: truth.poses[vehicle] for robot, vehicle in self._vehicles.items()}
        return SimTruth(
            at_ns=truth.time_ns,
            poses=poses,
            targets=truth.targets,
            bodies=self._show.moving(),
            dropped=self._lockstep.dropped,
        )

    async def _collect_datagrams(self) -> None:
        """Take in what the adapters sent before they acknowledged; loopback delivers at once, so one look is enough."""
        self._world.poll()
        await turn()


async def main(context: ChildContext) -> None:
    """Open the world and the bus, and run until asked to stop."""
    spec = context.spec(SimulationSpec)
    os.environ.setdefault("MUJOCO_GL", "disabled")  # its cameras cast rays: importing OpenGL would be in vain
    try:
        world = open_world(spec.world)
    except ValueError as error:
        raise UsageError(f"the simulated world can't be made: {error}") from error
    with world:
        async with ZenohBus(spec.link) as bus:
            keys = Keys(spec.crew)
            simulation = Simulation(bus, keys, world, spec.vehicles, spec.speed)
            with_token = bus.token(keys.alive("simulation"))
            context.ready()
            try:
                await simulation.run()
            finally:
                with_token.close()


if __name__ == "__main__":
    run_child(main)

"""One robot's process: its adapter through the entry points, its clock, its bus, its actor."""

import asyncio
from importlib.metadata import entry_points

from crew.actors.robot.actor import RobotActor
from crew.actors.specs import RobotActorSpec
from crew.adapter import Adapter, AdapterConfig
from crew.bus.port import Bus
from crew.bus.zenoh import ZenohBus
from crew.clock import Clock, SimClock, WallClock
from crew.contracts.site import RobotSpec, Rules
from crew.errors import UsageError, nearest
from crew.keys import Keys
from crew.lockstep import Participant
from crew.packed import unpack
from crew.process import ChildContext, run_child

ADAPTERS = "crew.adapters"


async def main(context: ChildContext) -> None:
    """Serve until asked to stop."""
    spec = context.spec(RobotActorSpec)
    rules = unpack(spec.rules)
    async with ZenohBus(spec.link) as bus:
        await serve(spec, rules, bus, context)


async def serve(spec: RobotActorSpec, rules: Rules, bus: Bus, context: ChildContext) -> None:
    """Run the actor on a bus that is already there."""
    robot = rules.crew.robot(spec.robot)
    assert robot is not None, "the launcher starts the robots of the crew file"
    keys = Keys(rules.crew.name)
    clock = SimClock() if spec.simulated else WallClock()
    adapter = make_adapter(robot, rules, spec.connection, clock)
    actor = RobotActor(bus, keys, robot, rules, adapter, clock, spec.operator_key, spec.orchestrator_key)
    async with asyncio.TaskGroup() as group:
        group.create_task(actor.run())
        if isinstance(clock, SimClock):
            follower = Participant(bus, keys, robot.name, clock, counts=adapter.link_counts, idle=lambda: actor.idle)
            adapter.on_traffic(follower.notice_traffic)
            group.create_task(follower.run())
        context.ready()


def make_adapter(robot: RobotSpec, rules: Rules, connection: str, clock: Clock) -> Adapter:
    """The adapter that the crew file names. Raises UsageError with the installed names for an unknown one."""
    installed = {entry.name: entry for entry in entry_points(group=ADAPTERS)}
    entry = installed.get(robot.adapter)
    if entry is None:
        raise UsageError(f"no adapter is called {robot.adapter!r}{nearest(robot.adapter, installed)}")
    crew = rules.crew
    config = AdapterConfig(
        robot=robot.name,
        kind=robot.kind,
        connection=connection,
        options=dict(robot.options),
        area=(crew.area.x_min, crew.area.x_max, crew.area.y_min, crew.area.y_max),
        origin=crew.origin,
        obstacles=crew.obstacles,
        locations={place.name: (place.x, place.y) for place in crew.locations},
    )
    try:
        adapter: Adapter = entry.load()(config, clock)
    except ImportError as error:
        raise UsageError(f"adapter {robot.adapter!r} can't be imported: {error}; install robot-crew[all]") from error
    return adapter


if __name__ == "__main__":
    run_child(main)

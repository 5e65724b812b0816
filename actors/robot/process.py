"""One robot's process: its adapter through the entry points, its clock, its bus, its actor."""

import asyncio

from crew.actors.robot.actor import RobotActor
from crew.actors.robot.fitting import make_adapter as make_adapter
from crew.actors.specs import RobotActorSpec
from crew.bus.port import Bus
from crew.bus.zenoh import ZenohBus
from crew.clock import SimClock, WallClock
from crew.contracts.pass_through import require_simulated
from crew.contracts.site import Rules
from crew.keys import Keys
from crew.lockstep import Participant
from crew.packed import unpack
from crew.process import ChildContext, run_child


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
    if not spec.enforced:
        require_simulated(rules.crew)
    adapter = make_adapter(robot, rules, spec.connection, clock, models=spec.models, enforced=spec.enforced)
    keyring = (spec.operator_key, spec.orchestrator_key)
    actor = RobotActor(bus, keys, robot, rules, adapter, clock, *keyring, enforced=spec.enforced)
    async with asyncio.TaskGroup() as group:
        group.create_task(actor.run())
        if isinstance(clock, SimClock):
            follower = Participant(bus, keys, robot.name, clock, counts=adapter.link_counts, idle=lambda: actor.idle)
            adapter.on_traffic(follower.notice_traffic)
            group.create_task(follower.run())
        context.ready()


if __name__ == "__main__":
    run_child(main)

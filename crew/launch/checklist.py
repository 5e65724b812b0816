"""The hardware checklist: each real robot is met over its own link and asked, before anything of the crew starts."""

from collections.abc import AsyncIterator

from crew.actors.robot.fitting import make_adapter
from crew.adapter import Check, Checklist
from crew.clock import WallClock
from crew.contracts.site import RobotSpec, Rules
from crew.errors import AdapterError


def real_robots(rules: Rules) -> list[RobotSpec]:
    """Those with a connection of their own."""
    return [robot for robot in rules.crew.robots if robot.connection]


async def walk_through(robot: RobotSpec, rules: Rules) -> AsyncIterator[Check]:
    """The items of one robot as they are found; one that cannot be met is an item that is not as it must be."""
    adapter = make_adapter(robot, rules, robot.connection, WallClock())
    if not isinstance(adapter, Checklist):
        yield Check("checklist", False, f"adapter {robot.adapter} has none", "one that asks the robot")
        return
    try:
        await adapter.connect()
        async for check in adapter.checklist():
            yield check
    except AdapterError as error:
        yield Check("connection", False, str(error), f"a {robot.kind} on {robot.connection}")
    finally:
        await adapter.close()

"""A robot actor with an adapter that does nothing, for measuring the way of a dispatch."""

from collections.abc import Callable, Mapping

import msgspec

from crew.actors.robot.actor import RobotActor
from crew.adapter import AdapterConfig, Place, Reading
from crew.bus.link import Link
from crew.bus.zenoh import ZenohBus
from crew.clock import Clock, WallClock
from crew.contracts.skill import SkillArgs
from crew.contracts.snapshot import ValueReading
from crew.keys import Keys
from crew.library import load_rules
from crew.process import ChildContext, run_child

ROBOT = "tb3"


class IdleSpec(msgspec.Struct, frozen=True):
    """Its way to the router."""

    link: Link
    orchestrator_key: bytes


class IdleAdapter:
    """A vehicle that is always ready and never moves."""

    latched = False

    def __init__(self, config: AdapterConfig, clock: Clock) -> None:
        self._clock = clock

    async def connect(self) -> None:
        return

    async def close(self) -> None:
        return

    async def execute(self, skill: str, args: SkillArgs, places: Mapping[str, Place]) -> None:
        await self._clock.sleep(0.005)  # a vehicle's first answer is not instant either

    async def cancel(self) -> None:
        return

    async def safe(self, behaviour: str) -> None:
        return

    def halt(self) -> None:
        return

    def release(self) -> None:
        return

    def fluents(self) -> Mapping[str, Reading]:
        return {"moving": Reading(False, self._clock.now_ns())}

    def values(self) -> Mapping[str, ValueReading]:
        return {}

    def health(self) -> str:
        return ""

    def link_counts(self) -> tuple[int, int]:
        return 0, 0

    def on_traffic(self, callback: Callable[[], None]) -> None:
        return


async def main(context: ChildContext) -> None:
    """Serve until asked to stop."""
    spec = context.spec(IdleSpec)
    rules = load_rules("air_ground")
    robot = rules.crew.robot(ROBOT)
    assert robot is not None
    clock = WallClock()
    config = AdapterConfig(robot=ROBOT, kind=robot.kind, connection="", area=(-6, 10, -6, 10), origin=(0, 0, 0))
    async with ZenohBus(spec.link) as bus:
        actor = RobotActor(
            bus, Keys("air_ground"), robot, rules, IdleAdapter(config, clock), clock, b"", spec.orchestrator_key
        )
        context.ready()
        await actor.run()


if __name__ == "__main__":
    run_child(main)

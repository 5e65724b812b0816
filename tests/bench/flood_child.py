"""Load for the stop's benchmark: a flood of commands without permit, or a burning core."""

import asyncio

import msgspec

from crew.bus.link import Link
from crew.bus.port import Qos
from crew.bus.zenoh import ZenohBus
from crew.messages import Dispatch
from crew.process import ChildContext, run_child


class FloodSpec(msgspec.Struct, frozen=True):
    """Where to pour what; without a link, only the core burns."""

    link: Link | None = None
    key: str = ""
    dispatch: Dispatch | None = None


async def main(context: ChildContext) -> None:
    """Pour, or burn, until asked to stop."""
    spec = context.spec(FloodSpec)
    context.ready()
    if spec.link is None or spec.dispatch is None:
        while True:
            for _ in range(200_000):
                pass
            await asyncio.sleep(0)
    async with ZenohBus(spec.link) as bus:
        while True:
            for _ in range(20):
                bus.put(spec.key, spec.dispatch, qos=Qos.ACTUATION)
            await asyncio.sleep(0.01)


if __name__ == "__main__":
    run_child(main)

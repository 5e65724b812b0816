"""A process that answers raw Zenoh samples with raw Zenoh samples: the floor that the actor layer is compared with."""

import asyncio

import msgspec
import zenoh

from crew.bus.link import Link
from crew.bus.session import open_session
from crew.process import ChildContext, run_child


class EchoSpec(msgspec.Struct, frozen=True):
    """Its way to the router, the key that it hears and the one that it answers on."""

    link: Link
    ask: str
    answer: str


async def main(context: ChildContext) -> None:
    """Echo until asked to stop."""
    spec = context.spec(EchoSpec)
    session = await asyncio.to_thread(open_session, spec.link)
    publisher = session.declare_publisher(
        spec.answer, congestion_control=zenoh.CongestionControl.BLOCK, priority=zenoh.Priority.REAL_TIME, express=True
    )
    session.declare_subscriber(spec.ask, lambda sample: publisher.put(sample.payload))
    context.ready()
    try:
        await asyncio.get_running_loop().create_future()
    finally:
        await asyncio.to_thread(session.close)


if __name__ == "__main__":
    run_child(main)

"""A process that answers raw Zenoh samples with raw Zenoh samples: the floor that the actor layer is compared with."""

import asyncio

import msgspec
import zenoh

from crew.bus.link import Link
from crew.bus.session import open_session
from crew.process import ChildContext, run_child

ASK = "bench/raw/ask"
ANSWER = "bench/raw/answer"


class EchoSpec(msgspec.Struct, frozen=True):
    """Where the router is."""

    router: str


async def main(context: ChildContext) -> None:
    """Echo until asked to stop."""
    session = await asyncio.to_thread(open_session, Link(role="echo", endpoint=context.spec(EchoSpec).router))
    publisher = session.declare_publisher(
        ANSWER, congestion_control=zenoh.CongestionControl.BLOCK, priority=zenoh.Priority.REAL_TIME, express=True
    )
    session.declare_subscriber(ASK, lambda sample: publisher.put(sample.payload))
    context.ready()
    try:
        await asyncio.get_running_loop().create_future()
    finally:
        await asyncio.to_thread(session.close)


if __name__ == "__main__":
    run_child(main)

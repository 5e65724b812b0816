"""The crew's router process: `python -m crew.router`. It runs no application code and holds no other session."""

import asyncio

import msgspec

from crew.bus.session import open_router
from crew.process import ChildContext, run_child


class RouterSpec(msgspec.Struct, frozen=True):
    """Where the router listens, as `tcp/host:port`."""

    listen: str


async def main(context: ChildContext) -> None:
    """Route until asked to stop; UsageError if the address is taken."""
    session = await asyncio.to_thread(open_router, context.spec(RouterSpec).listen)
    try:
        context.ready()
        await asyncio.get_running_loop().create_future()
    finally:
        await asyncio.to_thread(session.close)


if __name__ == "__main__":
    run_child(main)

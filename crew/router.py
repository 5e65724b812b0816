"""The crew's router process: `python -m crew.router`. It runs no application code and holds no other session."""

import asyncio

import msgspec

from crew.bus.link import Link
from crew.bus.session import open_router
from crew.process import ChildContext, run_child


class RouterSpec(msgspec.Struct, frozen=True, kw_only=True):
    """Where the router listens, and for which robots it has rules."""

    link: Link
    robots: tuple[str, ...]
    guests: str = ""
    """Where guests come in, as `tcp/host:port`."""


async def main(context: ChildContext) -> None:
    """Route until asked to stop; UsageError if an address is taken."""
    spec = context.spec(RouterSpec)
    session = await asyncio.to_thread(open_router, spec.link, spec.robots, guests=spec.guests)
    try:
        context.ready()
        await asyncio.get_running_loop().create_future()
    finally:
        await asyncio.to_thread(session.close)


if __name__ == "__main__":
    run_child(main)

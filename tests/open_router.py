"""A router without any lock, for tests of the bus itself and as the floor of benchmarks."""

import asyncio
import json

import msgspec
import zenoh

from crew.process import ChildContext, run_child


class OpenRouterSpec(msgspec.Struct, frozen=True):
    """Where it listens, as `tcp/host:port`."""

    listen: str


def open_router(listen: str) -> zenoh.Session:
    """Its session."""
    settings = {
        "mode": "router",
        "listen/endpoints": [listen],
        "scouting/delay": 0,
        "scouting/multicast/enabled": False,
        "scouting/gossip/enabled": False,
        "transport/shared_memory/enabled": False,
    }
    config = zenoh.Config()
    for path, value in settings.items():
        config.insert_json5(path, json.dumps(value))
    return zenoh.open(config)


async def main(context: ChildContext) -> None:
    """Route until asked to stop."""
    session = await asyncio.to_thread(open_router, context.spec(OpenRouterSpec).listen)
    context.ready()
    try:
        await asyncio.get_running_loop().create_future()
    finally:
        await asyncio.to_thread(session.close)


if __name__ == "__main__":
    run_child(main)

"""Finding the crew that a command speaks to, and an operator's session with it."""

import asyncio
import os
import signal
from collections.abc import AsyncIterator, Coroutine
from contextlib import AsyncExitStack, asynccontextmanager
from typing import Any

from crew.bus.port import Bus
from crew.bus.zenoh import ZenohBus
from crew.errors import BusError, UsageError
from crew.home import Home, Running
from crew.keys import Keys

CONNECT_S = 2.0

EXIT_CODES = {"completed": 0, "rejected": 3, "halted": 4, "cancelled": 5}
"""A mission's outcome as an exit code; 1 is our own fault, 2 a mistake in usage or configuration."""


def home() -> Home:
    """The state folder of the person who runs this command."""
    return Home.of(os.environ)


def find_running(crew: str) -> Running:
    """The running crew of this name, or the only one. Raises UsageError that lists what runs."""
    running = home().all_running()
    names = ", ".join(r.crew for r in running) or "none"
    if crew:
        found = next((r for r in running if r.crew == crew), None)
        if found is None:
            raise UsageError(f"no crew called {crew!r} runs here (running: {names}); start it with crew up {crew}")
        return found
    if len(running) != 1:
        what = "several crews run" if running else "no crew runs"
        remedy = "name one with --crew" if running else "start one with crew up"
        raise UsageError(f"{what} here (running: {names}); {remedy}")
    return running[0]


@asynccontextmanager
async def operator(crew: str) -> AsyncIterator[tuple[Bus, Keys, Running]]:
    """A session with a running crew. Raises UsageError or BusError in plain words."""
    running = find_running(crew)
    bus = ZenohBus(running.link("operator"), timeout_s=CONNECT_S)
    async with AsyncExitStack() as stack:
        try:
            await stack.enter_async_context(bus)
        except BusError as error:
            raise BusError(
                f"crew {running.crew} (pid {running.pid}) has no reachable bus on {running.endpoint}: {error}; "
                f"end it with Ctrl-C and bring it up again; its logs are in {running.run_folder}/logs"
            ) from error
        yield bus, Keys(running.crew), running


def run(work: Coroutine[Any, Any, int]) -> int:
    """Run a command's coroutine to its exit code. SIGTERM ends it in an orderly way, as Ctrl-C does."""
    return asyncio.run(_heeding_sigterm(work))


async def _heeding_sigterm(work: Coroutine[Any, Any, int]) -> int:
    """Cancel `work` at the first SIGTERM; a second one does not cut its clean-up short."""
    task = asyncio.current_task()
    assert task is not None
    terminated = asyncio.Event()

    def terminate() -> None:
        if not terminated.is_set():
            terminated.set()
            task.cancel()

    asyncio.get_running_loop().add_signal_handler(signal.SIGTERM, terminate)
    try:
        return await work
    except asyncio.CancelledError:
        if terminated.is_set():
            return 128 + signal.SIGTERM
        raise

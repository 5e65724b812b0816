"""After a skill that failed: the robot is stopped, and doubted until it was seen standing still."""

import asyncio
from collections.abc import Awaitable, Callable

from crew.clock import Clock
from crew.errors import AdapterError


class Aftermath:
    """`stop` returns when telemetry shows it still; `still_since` says whether telemetry newer than a stamp does."""

    def __init__(self, stop: Callable[[], Awaitable[None]], still_since: Callable[[int], bool], clock: Clock) -> None:
        self._stop, self._still_since, self._clock = stop, still_since, clock
        self._task: asyncio.Task[None] | None = None
        self._doubt = ""
        self._doubted_ns = 0

    def begin(self) -> None:
        """Stop in the background."""
        self._task = asyncio.get_running_loop().create_task(self._stopping())

    async def settle(self) -> None:
        """Wait for the stop that an earlier failure left."""
        if self._task is not None:
            await asyncio.wait({self._task})
            self._task = None

    async def close(self) -> None:
        """Give the stop up, with the link."""
        if self._task is not None:
            self._task.cancel()
            await asyncio.gather(self._task, return_exceptions=True)
            self._task = None

    def forget(self) -> None:
        """A new connection begins without doubt."""
        self._doubt = ""

    def doubt(self) -> str:
        """Why the robot may still be moving; empty once it was seen standing still since."""
        if self._doubt and self._still_since(self._doubted_ns):
            self._doubt = ""
        return self._doubt

    async def _stopping(self) -> None:
        try:
            await self._stop()
            self._doubt = ""
        except AdapterError as error:
            self._doubt = f"did not confirm its stop: {error}"
            self._doubted_ns = self._clock.now_ns()

"""The loop's side of a bus: what arrives in foreign threads runs here, owned by one TaskGroup."""

import asyncio
from collections.abc import Callable, Coroutine
from types import TracebackType
from typing import Self, TypeVarTuple

from crew.bus.port import Body, Handler, Sample, packed
from crew.errors import BusError, CrewError

Ts = TypeVarTuple("Ts")

MAX_HANDLERS = 64


class Scope:
    """Runs handlers and callbacks of one bus. A bug in one of them ends the `async with` body with its exception."""

    def __init__(self) -> None:
        self._group = asyncio.TaskGroup()
        self._running: set[asyncio.Task[None]] = set()
        self._closing = False

    async def __aenter__(self) -> Self:
        self._loop = asyncio.get_running_loop()
        await self._group.__aenter__()
        return self

    async def __aexit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._closing = True
        for task in self._running:
            task.cancel()
        if not isinstance(error, asyncio.CancelledError):
            kind, error, trace = None, None, None
        try:
            await self._group.__aexit__(kind, error, trace)
        except BaseExceptionGroup as group:
            if len(group.exceptions) == 1:
                raise group.exceptions[0] from None
            raise

    def call(self, function: Callable[[*Ts], None], *args: *Ts) -> None:
        """Run on the loop, in order; from any thread. Nothing happens once the loop is closed."""
        try:
            self._loop.call_soon_threadsafe(self._guarded, function, *args)
        except RuntimeError:
            if not self._loop.is_closed():
                raise

    def fail(self, error: Exception) -> None:
        """End the body with `error`; from any thread."""
        self.call(self._spawn_failure, error)

    def caught(self, callback: Callable[[Sample], None]) -> Callable[[Sample], None]:
        """`callback` for a foreign thread: its bugs end the body, not the thread."""

        def run(sample: Sample) -> None:
            try:
                callback(sample)
            except Exception as error:
                self.fail(error)

        return run

    def serve(self, request: Sample, handler: Handler, reply: Callable[[Body | CrewError], None]) -> None:
        """Answer one query; from any thread. `reply` is called on the loop, exactly once unless the bus closes."""
        self.call(self._serve, request, handler, reply)

    def _guarded(self, function: Callable[[*Ts], None], *args: *Ts) -> None:
        if self._closing:
            return
        try:
            function(*args)
        except Exception as error:
            self._spawn_failure(error)

    def _spawn_failure(self, error: Exception) -> None:
        async def fail() -> None:
            raise error

        self._spawn(fail())

    def _serve(self, request: Sample, handler: Handler, reply: Callable[[Body | CrewError], None]) -> None:
        if len(self._running) >= MAX_HANDLERS:
            reply(BusError(f"busy on {request.key}: {len(self._running)} queries in work; ask again later"))
            return

        async def answer() -> None:
            try:
                body: Body | CrewError = packed(await handler(request))
            except CrewError as refusal:
                body = refusal
            reply(body)

        self._spawn(answer())

    def _spawn(self, work: Coroutine[None, None, None]) -> None:
        task = self._group.create_task(work)
        self._running.add(task)
        task.add_done_callback(self._running.discard)

"""Every actor in this one process, for a debugger: the same code and the same bus, without the process boundaries."""

import asyncio
import importlib
from collections.abc import Iterable
from pathlib import Path
from types import TracebackType
from typing import Any, Self, TypeVar

from crew.errors import CrewError
from crew.supervisor import Child

T = TypeVar("T")


class InlineContext:
    """What a child's `main` is given, without a parent."""

    def __init__(self, spec: Any) -> None:
        self._spec = spec
        self.started = asyncio.Event()

    def spec(self, spec_type: type[T]) -> T:
        assert isinstance(self._spec, spec_type)
        return self._spec

    def ready(self) -> None:
        self.started.set()


class SingleProcess:
    """Stands in for the supervisor: tasks instead of processes."""

    def __init__(self, run_folder: Path) -> None:
        self._tasks: dict[str, asyncio.Task[None]] = {}
        self._last: asyncio.Task[None] | None = None
        self.pids: dict[str, int] = {}

    async def __aenter__(self) -> Self:
        return self

    async def __aexit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        clients = [t for t in self._tasks.values() if t is not self._last]
        for group in (clients, [self._last] if self._last else []):
            for task in group:
                task.cancel()
            await asyncio.gather(*group, return_exceptions=True)

    async def start(self, children: Iterable[Child], *, ready_timeout_s: float) -> None:
        """Start the router, then everybody else; CrewError for the first that fails before it is ready."""
        for child in sorted(children, key=lambda c: not c.last):
            context = InlineContext(child.spec)
            module = importlib.import_module(child.module)
            task = self._tasks[child.name] = asyncio.create_task(module.main(context), name=child.name)
            if child.last:
                self._last = task
            started = asyncio.create_task(context.started.wait())
            await asyncio.wait({task, started}, timeout=ready_timeout_s, return_when=asyncio.FIRST_COMPLETED)
            started.cancel()
            if task.done():
                task.result()
            if not context.started.is_set():
                raise CrewError(f"{child.name} is not ready after {ready_timeout_s:g} s")

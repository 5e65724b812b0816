"""Simulated time that moves only when nothing is on its way: what every stage in lockstep is built on."""

import asyncio
import contextlib
import socket
from abc import ABC, abstractmethod
from collections.abc import AsyncIterator, Awaitable, Callable
from typing import Any, Generic, Protocol, TypeVar

from crew.clock import SimClock

T = TypeVar("T")
StageT = TypeVar("StageT", bound="AdapterStage[Any]")
AdapterT = TypeVar("AdapterT", bound="Connects")

SLICE_NS = 50_000_000


def free_port() -> int:
    """A UDP port that nobody listens on."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as sock:
        sock.bind(("127.0.0.1", 0))
        return int(sock.getsockname()[1])


class PacedStage(ABC):
    """A clock of simulated time, advanced slice by slice."""

    def __init__(self) -> None:
        self.clock = SimClock()

    async def run(self, work: Awaitable[T], limit_s: float = 400.0) -> T:
        """Advance the world until `work` is done."""
        task = asyncio.ensure_future(work)
        try:
            await self._turns()
            await self.until(task.done, limit_s)
        finally:
            task.cancel()
            await asyncio.gather(task, return_exceptions=True)
        return task.result()

    async def advance(self, seconds: float) -> None:
        """Advance by simulated seconds."""
        end_ns = self.clock.now_ns() + round(seconds * 1e9)
        while self.clock.now_ns() < end_ns:
            await self.step()

    async def until(self, done: Callable[[], bool], limit_s: float = 60.0) -> None:
        """Advance until something shows; it fails after `limit_s` of simulated time."""
        end_ns = self.clock.now_ns() + round(limit_s * 1e9)
        while not done():
            assert self.clock.now_ns() < end_ns, "simulated time ran out"
            await self.step()

    async def step(self) -> None:
        """One slice: the world, then what it sent, then the clock, then whoever waited for it."""
        now_ns = self.simulate()
        await self._arrived()
        self.clock.advance(now_ns)
        await self._turns()

    @abstractmethod
    def simulate(self) -> int:
        """Advance the world by a slice; its time, nanoseconds."""

    @abstractmethod
    def heard(self) -> bool:
        """Whether everything that was sent has been received."""

    async def _arrived(self) -> None:
        for _ in range(10_000):
            if self.heard() and not self.clock.is_busy:
                return
            await asyncio.sleep(0)
        raise AssertionError("datagrams were lost")

    async def _turns(self) -> None:
        for _ in range(8):
            await asyncio.sleep(0)


class Connects(Protocol):
    """An adapter, as far as a stage knows one."""

    async def connect(self) -> None: ...

    async def close(self) -> None: ...


class AdapterStage(PacedStage, Generic[AdapterT]):
    """A paced world with an adapter for each robot; those in `connected` hear it."""

    def __init__(self) -> None:
        super().__init__()
        self.adapters: dict[str, AdapterT] = {}
        self.connected: list[str] = []

    @abstractmethod
    def end(self) -> None:
        """Let the world go."""

    async def close(self) -> None:
        for adapter in self.adapters.values():
            await adapter.close()
        self.end()


@contextlib.asynccontextmanager
async def connected(stage: StageT, robots: tuple[str, ...]) -> AsyncIterator[StageT]:
    """The stage with these robots' adapters connected; everything is closed at the end."""
    try:
        connecting = [asyncio.ensure_future(stage.adapters[name].connect()) for name in robots]
        await asyncio.sleep(0)
        stage.connected.extend(robots)
        await stage.run(asyncio.gather(*connecting))
        yield stage
    finally:
        await stage.close()

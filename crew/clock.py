"""Mission time: the only place that may sleep. Wall time is for liveliness, heartbeats, stop, network and models."""

import asyncio
import heapq
import itertools
import time
from collections.abc import AsyncIterator, Awaitable, Iterator
from contextlib import AbstractContextManager, asynccontextmanager, contextmanager
from typing import Protocol, TypeVar

T = TypeVar("T")

SECOND_NS = 1_000_000_000


def seconds_ns(seconds: float) -> int:
    """Seconds as whole nanoseconds."""
    return round(seconds * SECOND_NS)


class Clock(Protocol):
    """Mission time in integer nanoseconds; deadlines are absolute."""

    def now_ns(self) -> int: ...

    async def sleep(self, seconds: float) -> None: ...

    async def sleep_until(self, deadline_ns: int) -> None: ...

    def busy(self) -> AbstractContextManager[None]:
        """Work or a real wait is in flight: inside this context a simulation in lockstep does not advance."""
        ...


@asynccontextmanager
async def deadline(clock: Clock, seconds: float) -> AsyncIterator[None]:
    """Raise TimeoutError in the body once `seconds` of mission time have passed."""
    task = asyncio.current_task()
    assert task is not None
    expired = False

    async def watch() -> None:
        nonlocal expired
        await clock.sleep(seconds)
        expired = True
        task.cancel()

    watcher = asyncio.create_task(watch())
    try:
        yield
    except asyncio.CancelledError:
        if expired and task.uncancel() == 0:
            raise TimeoutError(f"nothing within {seconds} s of mission time") from None
        raise
    finally:
        watcher.cancel()


async def within(clock: Clock, seconds: float, awaitable: Awaitable[T]) -> T:
    """The awaitable's result, or TimeoutError after `seconds` of mission time."""
    async with deadline(clock, seconds):
        return await awaitable


class WallClock:
    """Mission time on hardware: the machine's date when this was made, then monotonic.

    Machines agree as far as their dates do; setting a date while a crew runs makes nothing jump.
    """

    def __init__(self) -> None:
        self._start_ns = time.time_ns() - time.monotonic_ns()

    def now_ns(self) -> int:
        return self._start_ns + time.monotonic_ns()

    async def sleep(self, seconds: float) -> None:
        await asyncio.sleep(seconds)

    async def sleep_until(self, deadline_ns: int) -> None:
        await asyncio.sleep(max(0, deadline_ns - self.now_ns()) / SECOND_NS)

    @contextmanager
    def busy(self) -> Iterator[None]:
        yield


class Wall(WallClock):
    """Wall time, for what the design keeps on it: liveliness, heartbeats, stop, network. Of this machine only."""

    def now_ns(self) -> int:
        return time.monotonic_ns()

    async def race(self, awaitable: Awaitable[object], seconds: float) -> bool:
        """Await, for at most `seconds`; whether it ended in time."""
        try:
            async with asyncio.timeout(seconds):
                await awaitable
        except TimeoutError:
            return False
        return True


class SimClock:
    """Mission time in simulation: it moves only when the simulation's tick arrives, and wakes sleepers in order."""

    def __init__(self, start_ns: int = 0) -> None:
        self._now_ns = start_ns
        self._order = itertools.count()
        self._sleepers: list[tuple[int, int, asyncio.Future[None]]] = []
        self._busy = 0
        self.idle_event = asyncio.Event()
        """Set whenever the last work in flight ends."""

    def now_ns(self) -> int:
        return self._now_ns

    async def sleep(self, seconds: float) -> None:
        await self.sleep_until(self._now_ns + seconds_ns(seconds))

    async def sleep_until(self, deadline_ns: int) -> None:
        if deadline_ns <= self._now_ns:
            await asyncio.sleep(0)
            return
        future: asyncio.Future[None] = asyncio.get_running_loop().create_future()
        heapq.heappush(self._sleepers, (deadline_ns, next(self._order), future))
        await future

    @contextmanager
    def busy(self) -> Iterator[None]:
        self._busy += 1
        try:
            yield
        finally:
            self._busy -= 1
            if not self._busy:
                self.idle_event.set()

    @property
    def is_busy(self) -> bool:
        """Whether work is in flight here: a lockstep participant withholds its acknowledgement meanwhile."""
        return self._busy > 0

    def advance(self, now_ns: int) -> None:
        """Move to `now_ns` (never backwards) and wake every sleeper whose deadline has come."""
        self._now_ns = max(self._now_ns, now_ns)
        while self._sleepers and self._sleepers[0][0] <= self._now_ns:
            _, _, future = heapq.heappop(self._sleepers)
            if not future.done():
                future.set_result(None)


WALL = Wall()


async def turn() -> None:
    """Give the loop one turn."""
    await asyncio.sleep(0)

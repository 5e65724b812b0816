"""From the bus's threads to the loop: bounded mailboxes with one wakeup for many samples.

`KeepLatest` for state, `Commands` for what must be fresh or refused, `Events` for what must not be lost unnoticed.
"""

import asyncio
import threading
import time
from abc import ABC, abstractmethod
from collections import Counter, deque
from collections.abc import Callable
from typing import Generic, Self, TypeVar

import msgspec

from crew.bus.port import Sample
from crew.clock import seconds_ns, turn
from crew.wire import DEFAULT_LIMIT_BYTES, Message, Refusal, WireRefusal, decode

T = TypeVar("T")
M = TypeVar("M", bound=Message)

BATCH = 64
"""Samples taken before the loop gets a turn."""


class Letter(msgspec.Struct, Generic[M], frozen=True):
    """A message as it arrived. `received_ns` is monotonic wall time."""

    key: str
    message: M
    received_ns: int


def letters(*types: type[M], limit_bytes: int = DEFAULT_LIMIT_BYTES) -> Callable[[Sample], Letter[M]]:
    """A reader for mailboxes that accepts messages of these types, told apart by their schema."""
    by_schema = {message_type.schema: message_type for message_type in types}

    def read(sample: Sample) -> Letter[M]:
        schema = sample.encoding.partition(";")[2].rpartition("/")[0]
        message_type = by_schema.get(schema, types[0])
        message = decode(message_type, sample.payload, sample.encoding, limit_bytes=limit_bytes)
        return Letter(sample.key, message, sample.received_ns)

    return read


def raw(sample: Sample) -> Sample:
    """A reader for mailboxes that hands out samples as they came."""
    return sample


class Mailbox(ABC, Generic[T]):
    """Fed by `offer` from any thread, emptied by one consumer on the loop it was made on.

    `read` turns a sample into an item on the loop; a sample that it refuses is counted in `refusals` and skipped.
    """

    def __init__(self, read: Callable[[Sample], T]) -> None:
        self.refusals: Counter[Refusal] = Counter()
        self._read = read
        self._loop = asyncio.get_running_loop()
        self._lock = threading.Lock()
        self._armed = False
        self._closed = False
        self._waiter: asyncio.Future[None] | None = None
        self._consumer: Callable[[T], None] | None = None
        self._consumed: asyncio.Future[None] | None = None
        self._batch: deque[Sample] = deque()
        self._turn_due = False

    def offer(self, sample: Sample) -> None:
        """Take a sample in; never blocks for longer than a swap."""
        with self._lock:
            stored = not self._closed and self._store(sample)
            wake = stored and not self._armed
            self._armed = self._armed or wake
        if wake:
            self._wake()
        elif not stored:
            self._not_stored(sample)

    def close(self) -> None:
        """End the iteration and take nothing in any more; from any thread."""
        with self._lock:
            self._closed = True
        self._wake()

    async def changed(self) -> None:
        """Return when something may be there to `take`."""
        while not (self._batch or self._closed or self._waiting()):
            await self._woken()

    def take(self) -> list[T]:
        """What is there now, at most 64 items; empty if nothing is."""
        self._refill()
        return list(iter(self._next_item, None))

    async def each(self, consumer: Callable[[T], None]) -> None:
        """Call `consumer` with every item within the loop's very wakeup that brings it, for what is in a hurry.

        Returns when the mailbox is closed; raises what the consumer raises.
        """
        self._consumer, self._consumed = consumer, self._loop.create_future()
        try:
            self._consume()
            await self._consumed
        finally:
            self._consumer = self._consumed = None

    def __aiter__(self) -> Self:
        return self

    async def __anext__(self) -> T:
        while True:
            if (item := self._next_item()) is not None:
                return item
            if self._turn_due:
                self._turn_due = False
                await turn()
            if self._refill():
                self._turn_due = True
                continue
            if self._closed:
                raise StopAsyncIteration
            await self._woken()

    @abstractmethod
    def _store(self, sample: Sample) -> bool:
        """Keep the sample, under the lock; False if it is not kept."""

    @abstractmethod
    def _remove(self, limit: int) -> list[Sample]:
        """Up to `limit` samples, oldest first, under the lock."""

    @abstractmethod
    def _waiting(self) -> bool: ...

    def _not_stored(self, sample: Sample) -> None:
        """Told of a sample that was not kept, in the delivering thread, without the lock."""

    def _usable(self, sample: Sample) -> bool:
        return True

    def _drained(self) -> None:
        """Told on the loop after each batch was taken."""

    def _wake(self) -> None:
        try:
            self._loop.call_soon_threadsafe(self._release)
        except RuntimeError:
            if not self._loop.is_closed():
                raise

    def _release(self) -> None:
        self._consume()
        if self._waiter is not None and not self._waiter.done():
            self._waiter.set_result(None)

    def _consume(self) -> None:
        """Hand one batch to the consumer, if there is one; the loop gets a turn before the next."""
        consumer, consumed = self._consumer, self._consumed
        if consumer is None or consumed is None or consumed.done():
            return
        try:
            if self._refill():
                while (item := self._next_item()) is not None:
                    consumer(item)
                self._loop.call_soon(self._consume)
            elif self._closed:
                consumed.set_result(None)
        except Exception as error:
            consumed.set_exception(error)

    async def _woken(self) -> None:
        """Wait for the next wakeup. The caller looked, on the loop, and found nothing."""
        self._waiter = self._loop.create_future()
        try:
            await self._waiter
        finally:
            self._waiter = None

    def _refill(self) -> bool:
        with self._lock:
            self._armed = False
            self._batch.extend(self._remove(BATCH - len(self._batch)))
        self._drained()
        return bool(self._batch)

    def _next_item(self) -> T | None:
        while self._batch:
            sample = self._batch.popleft()
            if not self._usable(sample):
                continue
            try:
                return self._read(sample)
            except WireRefusal as refusal:
                self.refusals[refusal.reason] += 1
        return None


class KeepLatest(Mailbox[T]):
    """The latest sample of each key: a stalled loop finds fresh state, not old. At most `max_keys` keys wait."""

    def __init__(self, read: Callable[[Sample], T], *, max_keys: int = 1024) -> None:
        super().__init__(read)
        self.conflated = 0
        self.overflowed = 0
        self._max_keys = max_keys
        self._latest: dict[str, Sample] = {}

    def _store(self, sample: Sample) -> bool:
        if sample.key in self._latest:
            self.conflated += 1
        elif len(self._latest) >= self._max_keys:
            self.overflowed += 1
            return False
        self._latest[sample.key] = sample
        return True

    def _remove(self, limit: int) -> list[Sample]:
        if len(self._latest) <= limit:
            taken, self._latest = self._latest, {}
            return list(taken.values())
        return [self._latest.pop(key) for key in list(self._latest)[:limit]]

    def _waiting(self) -> bool:
        return bool(self._latest)


class CommandRefusal(msgspec.Struct, frozen=True):
    """A command that was not handed out: `why` is `full`, `stale` or `closed`."""

    sample: Sample
    why: str


class Commands(Mailbox[T]):
    """Bounded; a command is handed out within `max_age_s` of wall time after its arrival, or refused.

    `on_refused` must be thread-safe and quick: `full` and `closed` are told in the delivering thread, at once, `stale`
    on the loop.
    """

    def __init__(
        self,
        read: Callable[[Sample], T],
        *,
        capacity: int,
        max_age_s: float,
        on_refused: Callable[[CommandRefusal], None],
        wall_ns: Callable[[], int] = time.monotonic_ns,
    ) -> None:
        super().__init__(read)
        self._capacity = capacity
        self._max_age_ns = seconds_ns(max_age_s)
        self._on_refused = on_refused
        self._wall_ns = wall_ns
        self._held: deque[Sample] = deque()

    def _store(self, sample: Sample) -> bool:
        if len(self._held) >= self._capacity:
            return False
        self._held.append(sample)
        return True

    def _remove(self, limit: int) -> list[Sample]:
        return [self._held.popleft() for _ in range(min(limit, len(self._held)))]

    def _waiting(self) -> bool:
        return bool(self._held)

    def _not_stored(self, sample: Sample) -> None:
        self._on_refused(CommandRefusal(sample, "closed" if self._closed else "full"))

    def _usable(self, sample: Sample) -> bool:
        if self._wall_ns() - sample.received_ns <= self._max_age_ns:
            return True
        self._on_refused(CommandRefusal(sample, "stale"))
        return False


class Events(Mailbox[T]):
    """Bounded, in order. What does not fit is lost, counted in `lost`, and told on the loop to `on_lost`."""

    def __init__(self, read: Callable[[Sample], T], *, capacity: int, on_lost: Callable[[int], None]) -> None:
        super().__init__(read)
        self.lost = 0
        self._told = 0
        self._capacity = capacity
        self._on_lost = on_lost
        self._held: deque[Sample] = deque()

    def _store(self, sample: Sample) -> bool:
        if len(self._held) >= self._capacity:
            self.lost += 1
            return False
        self._held.append(sample)
        return True

    def _remove(self, limit: int) -> list[Sample]:
        return [self._held.popleft() for _ in range(min(limit, len(self._held)))]

    def _waiting(self) -> bool:
        return bool(self._held)

    def _drained(self) -> None:
        if news := self.lost - self._told:
            self._told += news
            self._on_lost(news)

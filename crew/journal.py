"""The journal's writer: what a run did, in order, on disk before it counts. Reading is `crew.journal_reader`."""

import asyncio
import threading
import time
from collections import deque
from collections.abc import Callable
from contextlib import closing
from pathlib import Path
from types import TracebackType
from typing import NamedTuple, Self

import msgspec

from crew.chain import Signer, chained
from crew.errors import JournalError
from crew.home import replace_file
from crew.journal_file import new_head, open_journal_file, put_head

MAX_WAITING = 1 << 16
"""Records that may wait for the disk; more is a failure."""
MAX_HEAD_AGE_S = 0.5
"""The head outside the file is never further behind the last commit than this."""


class _Record(NamedTuple):
    seq: int
    kind: str
    at_ns: int
    wall_ns: int
    body: bytes


class Ticket:
    """A record on its way to the disk. `seq` is its number in the journal."""

    __slots__ = ("_journal", "seq")

    def __init__(self, journal: "Journal", seq: int) -> None:
        self._journal = journal
        self.seq = seq

    def wait(self, timeout_s: float) -> None:
        """Block until the record is on disk; JournalError if it is not and will not be, or not in time."""
        self._journal._wait(self.seq, timeout_s)

    async def committed(self) -> None:
        """Return once the record is on disk; JournalError if it will not be."""
        await self._journal._committed(self.seq)


class Journal:
    """An append-only SQLite file with a hash chain, written by a thread of its own with group commit.

    Made new, or continued if the file holds an intact journal of the same run. A failed commit is final: `on_failure`
    is called once, in the writer's thread, and everything later raises JournalError.
    """

    def __init__(
        self,
        path: Path,
        *,
        run_id: str,
        key: Signer,
        outside_head: Path,
        on_failure: Callable[[JournalError], None],
        max_bytes: int | None = None,
    ) -> None:
        self.path = path
        self._run_id = run_id
        self._key = key
        self._outside_head = outside_head
        self._on_failure = on_failure
        self._changed = threading.Condition()
        self._waiting: deque[_Record] = deque()
        self._waiters: list[tuple[int, asyncio.AbstractEventLoop, asyncio.Future[None]]] = []
        self._failure: JournalError | None = None
        self._closing = False
        self._outside_at = 0.0
        self._connection, self._head = open_journal_file(path, run_id, key, outside_head, max_bytes)
        try:
            self._write_outside(durable=True)
        except OSError as error:
            self._connection.close()
            raise JournalError(
                f"journal head {outside_head} cannot be written: {error}; is CREW_HOME writable?"
            ) from error
        self._seq = self._appended_seq = self._head.seq
        self._writer = threading.Thread(target=self._write, name="journal", daemon=True)
        self._writer.start()

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()

    def append(self, kind: str, at_ns: int, body: bytes) -> Ticket:
        """Queue a record with its mission time; from any thread, without waiting. JournalError after a failure."""
        wall_ns = time.time_ns()
        with self._changed:
            if self._failure is not None:
                raise self._failed()
            if self._closing:
                raise JournalError(f"journal {self.path} is closed: {kind} came too late; append before the close")
            if len(self._waiting) >= MAX_WAITING:
                raise JournalError(f"journal {self.path} is behind: {MAX_WAITING} records wait; is the disk stalled?")
            self._appended_seq += 1
            self._waiting.append(_Record(self._appended_seq, kind, at_ns, wall_ns, body))
            self._changed.notify_all()
            return Ticket(self, self._appended_seq)

    def close(self) -> None:
        """Commit what waits, sign the last head and close the file; JournalError if anything was not committed."""
        with self._changed:
            self._closing = True
            self._changed.notify_all()
        self._writer.join()
        if self._failure is not None:
            raise self._failed()

    def _failed(self) -> JournalError:
        error = JournalError(str(self._failure))
        error.__cause__ = self._failure
        return error

    # For tickets.

    def _wait(self, seq: int, timeout_s: float) -> None:
        with self._changed:
            in_time = self._changed.wait_for(lambda: self._seq >= seq or self._failure is not None, timeout_s)
            if self._seq >= seq:
                return
            if self._failure is not None:
                raise self._failed()
        if not in_time:
            raise JournalError(f"record {seq} of {self.path} is not on disk after {timeout_s} s; is the disk stalled?")

    async def _committed(self, seq: int) -> None:
        loop = asyncio.get_running_loop()
        with self._changed:
            if self._seq >= seq:
                return
            if self._failure is not None:
                raise self._failed()
            future: asyncio.Future[None] = loop.create_future()
            self._waiters.append((seq, loop, future))
        await future

    # The writer's thread.

    def _write(self) -> None:
        with closing(self._connection):
            try:
                while batch := self._next_batch():
                    self._commit(batch)
                self._sign_last()
            except Exception as error:
                self._fail(error)

    def _next_batch(self) -> list[_Record]:
        """What waits now; empty at the end. An overdue outside head is written meanwhile."""
        while True:
            with self._changed:
                due_s = self._outside_at + MAX_HEAD_AGE_S - time.monotonic() if self._outside_behind() else None
                self._changed.wait_for(lambda: self._waiting or self._closing, due_s)
                if self._waiting or self._closing:
                    batch = list(self._waiting)
                    self._waiting.clear()
                    return batch
            self._write_outside(durable=False)

    def _commit(self, batch: list[_Record]) -> None:
        chain_hash = self._head.hash
        rows = []
        for record in batch:
            chain_hash = chained(chain_hash, record.seq, record.kind.encode(), *record[2:])
            rows.append((*record, chain_hash))
        head = new_head(self._run_id, batch[-1].seq, chain_hash, self._key)
        with self._connection:
            self._connection.execute("BEGIN IMMEDIATE")
            self._connection.executemany("INSERT INTO record VALUES (?, ?, ?, ?, ?, ?)", rows)
            put_head(self._connection, head)
        self._head = head
        if time.monotonic() - self._outside_at >= MAX_HEAD_AGE_S:
            self._write_outside(durable=False)
        with self._changed:
            self._seq = head.seq
            self._wake_waiters()

    def _sign_last(self) -> None:
        self._write_outside(durable=True)
        self._connection.execute("PRAGMA wal_checkpoint(TRUNCATE)")

    def _fail(self, error: Exception) -> None:
        failure = JournalError(
            f"journal {self.path} cannot be written: {error} after record {self._seq}; "
            f"nothing later is recorded: free the disk and start a new run"
        )
        failure.__cause__ = error
        with self._changed:
            self._failure = failure
            self._waiting.clear()
            self._wake_waiters()
        self._on_failure(failure)

    def _wake_waiters(self) -> None:
        """Release every waiter whose record is on disk, or all with the failure; under the lock."""
        self._changed.notify_all()
        still = []
        for waiter in self._waiters:
            seq, loop, future = waiter
            if self._seq < seq and self._failure is None:
                still.append(waiter)
            elif not loop.is_closed():
                loop.call_soon_threadsafe(_settle, future, self._failed() if self._seq < seq else None)
        self._waiters = still

    def _outside_behind(self) -> bool:
        return self._outside_seq < self._head.seq

    def _write_outside(self, *, durable: bool) -> None:
        replace_file(self._outside_head, msgspec.json.encode(self._head), durable=durable)
        self._outside_at = time.monotonic()
        self._outside_seq = self._head.seq


def _settle(future: "asyncio.Future[None]", failure: JournalError | None) -> None:
    if future.done():
        return
    if failure is None:
        future.set_result(None)
    else:
        future.set_exception(failure)

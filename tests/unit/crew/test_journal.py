import asyncio
import math
import queue
import sqlite3
import threading
from collections.abc import Callable
from contextlib import closing
from pathlib import Path

import msgspec
import pytest

from crew.errors import JournalError
from crew.journal import Journal
from crew.journal_reader import check_chain, read_records
from crew.signing import SigningKey

KEY = SigningKey(b"k" * 32)
WAIT_S = 10.0


def not_expected(error: JournalError) -> None:
    raise AssertionError(error)


class Place:
    """Where one run's journal and its outside head are."""

    def __init__(self, folder: Path) -> None:
        self.path = folder / "journal.db"
        self.head = folder / "head.json"

    def journal(
        self,
        *,
        run_id: str = "run-1",
        on_failure: Callable[[JournalError], None] = not_expected,
        max_bytes: int | None = None,
    ) -> Journal:
        return Journal(
            self.path, run_id=run_id, key=KEY, outside_head=self.head, on_failure=on_failure, max_bytes=max_bytes
        )

    def sql(self, *statements: str) -> None:
        with closing(sqlite3.connect(self.path)) as connection, connection:
            for statement in statements:
                connection.execute(statement)


@pytest.fixture
def place(tmp_path: Path) -> Place:
    return Place(tmp_path)


@pytest.fixture
def written(place: Place) -> Place:
    """A closed journal of ten records."""
    with place.journal() as journal:
        for number in range(1, 11):
            journal.append("decision", number * 100, f"body-{number:02}".encode())
    return place


def test_records_come_back_exactly(place: Place) -> None:
    body = msgspec.msgpack.encode({"x": math.nan, "y": math.inf, "z": -0.0})
    with place.journal() as journal:
        assert journal.append("intent", 5, body).seq == 1
        assert journal.append("outcome", -7, b"").seq == 2
    first, second = read_records(place.path)
    assert (first.seq, first.kind, first.at_ns, first.body) == (1, "intent", 5, body)
    assert (second.seq, second.kind, second.at_ns, second.body) == (2, "outcome", -7, b"")
    assert 0 < first.wall_ns <= second.wall_ns
    assert math.isnan(msgspec.msgpack.decode(first.body)["x"])


def test_a_written_journal_is_intact(written: Place) -> None:
    report = check_chain(written.path, KEY.public, written.head)
    assert (report.run_id, report.records, report.problems, report.notes) == ("run-1", 10, (), ())


def test_an_empty_journal_is_intact_when_nothing_was_written(place: Place) -> None:
    place.journal().close()
    assert check_chain(place.path, KEY.public, place.head).intact


def test_a_ticket_waits_for_the_disk(place: Place) -> None:
    with place.journal() as journal:
        ticket = journal.append("intent", 1, b"x")
        ticket.wait(WAIT_S)
        assert [record.seq for record in read_records(place.path)] == [ticket.seq]


async def test_a_ticket_is_awaited_without_blocking_the_loop(place: Place) -> None:
    with place.journal() as journal:
        tickets = [journal.append("intent", number, b"x") for number in range(50)]
        async with asyncio.timeout(WAIT_S), asyncio.TaskGroup() as group:
            for ticket in tickets:
                group.create_task(ticket.committed())
        await tickets[0].committed()
        assert len(list(read_records(place.path))) == 50


def test_appends_from_many_threads_form_one_chain(place: Place) -> None:
    with place.journal() as journal:

        def feed() -> None:
            for number in range(200):
                journal.append("event", number, b"x")

        threads = [threading.Thread(target=feed) for _ in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
    report = check_chain(place.path, KEY.public, place.head)
    assert (report.records, report.problems) == (800, ())


def test_an_append_after_the_close_is_refused(place: Place) -> None:
    journal = place.journal()
    journal.close()
    with pytest.raises(JournalError, match="is closed"):
        journal.append("late", 1, b"")


async def test_a_full_disk_surfaces_everywhere(place: Place) -> None:
    failures: queue.Queue[JournalError] = queue.Queue()
    journal = place.journal(on_failure=failures.put, max_bytes=40_000)
    journal.append("fits", 1, b"x").wait(WAIT_S)
    ticket = journal.append("too big", 2, b"x" * 100_000)
    with pytest.raises(JournalError, match=r"cannot be written: database or disk is full after record 1"):
        await ticket.committed()
    with pytest.raises(JournalError, match="disk is full"):
        ticket.wait(WAIT_S)
    assert "disk is full" in str(failures.get(timeout=WAIT_S))
    with pytest.raises(JournalError, match="disk is full"):
        journal.append("later", 3, b"")
    with pytest.raises(JournalError, match="disk is full"):
        journal.close()
    assert failures.empty()
    report = check_chain(place.path, KEY.public, place.head)
    assert (report.records, report.problems) == (1, ())


def test_an_unwritable_outside_head_is_a_failure(tmp_path: Path) -> None:
    place = Place(tmp_path)
    place.head = tmp_path / "nowhere" / "head.json"
    with pytest.raises(JournalError, match="is CREW_HOME writable"):
        place.journal()


def test_a_journal_is_continued(written: Place) -> None:
    with written.journal() as journal:
        assert journal.append("again", 1, b"x").seq == 11
    report = check_chain(written.path, KEY.public, written.head)
    assert (report.records, report.problems) == (11, ())


def test_a_broken_journal_is_not_continued(written: Place) -> None:
    written.sql("UPDATE record SET at_ns = 1 WHERE seq = 4")
    with pytest.raises(JournalError, match="cannot be continued: record 4 was altered"):
        written.journal()


def test_another_runs_journal_is_not_continued(written: Place) -> None:
    with pytest.raises(JournalError, match="it is the journal of run run-1"):
        written.journal(run_id="run-2")


def test_the_outside_head_follows_within_half_a_second(place: Place) -> None:
    with place.journal() as journal:
        journal.append("intent", 1, b"x").wait(WAIT_S)
        deadline = threading.Event()
        for _ in range(100):
            if b'"seq":1' in place.head.read_bytes():
                break
            deadline.wait(0.01)
        assert b'"seq":1' in place.head.read_bytes()


def test_an_unreadable_journal_is_a_journal_error(tmp_path: Path) -> None:
    path = tmp_path / "journal.db"
    path.write_bytes(b"no database" * 100)
    with pytest.raises(JournalError, match="cannot be read"):
        list(read_records(path))

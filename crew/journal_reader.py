"""Reading a journal, and checking that nobody edited, emptied or shortened it."""

import sqlite3
import struct
from collections.abc import Iterator, Sequence
from contextlib import closing
from pathlib import Path
from typing import Any

import msgspec

from crew.chain import Head, chained, genesis
from crew.errors import JournalError

_COLUMNS = "SELECT seq, kind, at_ns, wall_ns, body, hash FROM record ORDER BY seq"
MAX_PROBLEMS = 20
"""More are not listed: the journal is lost."""


class Record(msgspec.Struct, frozen=True):
    """One record. `at_ns` is mission time, `wall_ns` the wall's since 1970; `body` is msgpack."""

    seq: int
    kind: str
    at_ns: int
    wall_ns: int
    body: bytes


class ChainReport(msgspec.Struct, frozen=True):
    """What a check found. `notes` are said but are no fault: how a killed run ends, what could not be compared."""

    run_id: str
    records: int
    problems: tuple[str, ...]
    notes: tuple[str, ...]
    head: str = ""
    """The hash of the last record."""

    @property
    def intact(self) -> bool:
        return not self.problems


def read_records(path: Path) -> Iterator[Record]:
    """Every record in order, unchecked; JournalError if the file cannot be read."""
    try:
        with closing(_connect(path)) as connection:
            for seq, kind, at_ns, wall_ns, body, _ in connection.execute(_COLUMNS):
                yield Record(seq, kind.decode(), at_ns, wall_ns, body)
    except (sqlite3.Error, UnicodeDecodeError) as error:
        raise JournalError(f"journal {path} cannot be read: {error}; see `crew verify`") from error


def check_chain(path: Path, public_key: bytes, outside_head: Path | None) -> ChainReport:
    """Check every record against the chain, and the chain's end against the signed heads in and outside the file.

    Without `outside_head` a journal that was rolled back to an earlier state of itself is not found; a note says so.
    """
    check = _Check(public_key)
    kept = None if outside_head is None else _read(outside_head)
    try:
        with closing(_connect(path)) as connection:
            connection.execute("BEGIN")  # one moment of a journal that may still be written to
            inside = check.read_run(connection)
            outside = check.read_outside(outside_head, kept)
            check.records(connection, {head.seq for head in (inside, outside) if head is not None})
            check.against_inside(inside)
            check.against_outside(outside)
    except sqlite3.Error as error:
        check.problem(f"journal {path} is unreadable after record {check.last_seq}: {error}")
    return ChainReport(check.run_id, check.count, tuple(check.problems), tuple(check.notes), check.last_hash)


class _Check:
    """One pass over a journal; problems and notes are collected in words."""

    def __init__(self, public_key: bytes) -> None:
        self.problems: list[str] = []
        self.notes: list[str] = []
        self.run_id = ""
        self.count = 0
        self.last_seq = 0
        self.last_hash = ""
        self._public_key = public_key
        self._hashes: dict[int, bytes] = {}

    def problem(self, text: str) -> None:
        if len(self.problems) < MAX_PROBLEMS:
            self.problems.append(text)

    def read_run(self, connection: sqlite3.Connection) -> Head | None:
        """The run's id, and the head in the journal if there is one."""
        runs = connection.execute("SELECT id FROM run").fetchall()
        heads = connection.execute("SELECT run_id, seq, hash, wall_ns, signature FROM head").fetchall()
        if len(runs) == 1:
            self.run_id = _text(runs[0][0])
        else:
            self.problem(f"the journal names {len(runs)} runs instead of one")
        if len(heads) != 1:
            self.problem(f"missing head: the journal holds {len(heads)} signed heads instead of one")
            return None
        return self._genuine(_head_of_row(heads[0]), "head in the journal")

    def read_outside(self, path: Path | None, kept: bytes | OSError | None) -> Head | None:
        """The head that was kept outside the run's folder, as it was before the journal was opened."""
        if path is None:
            self.notes.append("no head outside the journal was compared: a rolled back journal would not be found")
            return None
        try:
            head = msgspec.json.decode(b"" if isinstance(kept, OSError) or kept is None else kept, type=Head)
        except msgspec.MsgspecError as error:
            self.problem(f"missing head: {path} cannot be read ({kept if isinstance(kept, OSError) else error})")
            return None
        return self._genuine(head, "head outside")

    def records(self, connection: sqlite3.Connection, heads: set[int]) -> None:
        """Walk the chain and keep the hashes that the heads speak of.

        After a broken record the next one may follow its stored hash or its true one: the break is told once.
        """
        previous = true_hash = self._hashes[0] = genesis(self.run_id)
        for seq, *columns, stored in connection.execute(_COLUMNS):
            expected = _chained(previous, seq, columns)
            if seq != self.last_seq + 1:
                self.problem(_gap(self.last_seq + 1, seq - 1))
            elif stored not in (expected, _chained(true_hash, seq, columns)):
                self.problem(f"record {seq} was altered: its content does not give its hash")
            previous, true_hash = stored, expected
            self.last_seq = seq
            self.count += 1
            if seq in heads:
                self._hashes[seq] = previous
        self.last_hash = previous.hex() if isinstance(previous, bytes) else ""

    def against_inside(self, head: Head | None) -> None:
        """Each commit signs its own records, so that nothing may follow the head in the journal."""
        if head is not None and self._reaches(head, "head in the journal") and self.last_seq > head.seq:
            self.problem(
                f"records {head.seq + 1} to {self.last_seq} follow the head in the journal unsigned: "
                f"somebody without the key added them"
            )

    def against_outside(self, head: Head | None) -> None:
        """The head outside is written a little later: the run may have been killed in between."""
        if head is not None and self._reaches(head, "head outside") and self.last_seq > head.seq:
            self.notes.append(
                f"the head outside says {head.seq}, the journal goes on to {self.last_seq}: the run was killed "
                f"before it wrote its last head; nothing is missing"
            )

    def _genuine(self, head: Head | None, where: str) -> Head | None:
        if head is None or not head.is_signed_by(self._public_key):
            self.problem(f"bad signature: the {where} was edited or signed with another key")
            return None
        if head.run_id != self.run_id:
            self.problem(f"foreign head: the {where} is of run {head.run_id!r}, the journal of run {self.run_id!r}")
            return None
        return head

    def _reaches(self, head: Head, where: str) -> bool:
        """Whether the journal goes as far as the head says, with the hash that it says."""
        if self.count == 0 and head.seq > 0:
            self.problem(f"the journal is empty: the {where} says {head.seq}")
        elif head.seq > self.last_seq:
            self.problem(f"the tail is cut: the {where} says {head.seq}, the journal ends at {self.last_seq}")
        elif self._hashes.get(head.seq, head.hash) != head.hash:
            self.problem(f"record {head.seq} or one before it was rewritten: its hash is not the one of the {where}")
        else:
            return True
        return False


def _chained(previous: bytes, seq: int, columns: Sequence[Any]) -> bytes:
    """The record's hash; empty if an edited column has a type that no record has."""
    try:
        kind, at_ns, wall_ns, body = columns
        return chained(previous, seq, kind, at_ns, wall_ns, body)
    except (TypeError, struct.error):
        return b""


def _head_of_row(row: Sequence[Any]) -> Head | None:
    run_id, seq, chain_hash, wall_ns, signature = row
    columns = {"run_id": _text(run_id), "seq": seq, "hash": chain_hash, "wall_ns": wall_ns, "signature": signature}
    try:
        return msgspec.convert(columns, Head)
    except msgspec.ValidationError:
        return None


def _read(path: Path) -> bytes | OSError:
    try:
        return path.read_bytes()
    except OSError as error:
        return error


def _text(value: object) -> str:
    return value.decode(errors="replace") if isinstance(value, bytes) else str(value)


def _gap(first: int, last: int) -> str:
    return f"record {first} is missing" if first == last else f"records {first} to {last} are missing"


def _connect(path: Path) -> sqlite3.Connection:
    connection = sqlite3.connect(f"{path.absolute().as_uri()}?mode=ro", uri=True)
    connection.text_factory = bytes
    return connection

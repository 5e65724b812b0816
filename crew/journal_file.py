"""The journal's SQLite file: its tables, and how one is begun or continued. Appending is `crew.journal`."""

import sqlite3
import time
from pathlib import Path

from crew.chain import Head, Signer, genesis
from crew.errors import JournalError
from crew.journal_reader import check_chain

_SCHEMA = """
CREATE TABLE run (id TEXT NOT NULL, public_key BLOB NOT NULL) STRICT;
CREATE TABLE record (
    seq INTEGER PRIMARY KEY, kind TEXT NOT NULL, at_ns INTEGER NOT NULL, wall_ns INTEGER NOT NULL,
    body BLOB NOT NULL, hash BLOB NOT NULL
) STRICT;
CREATE TABLE head (
    run_id TEXT NOT NULL, seq INTEGER NOT NULL, hash BLOB NOT NULL, wall_ns INTEGER NOT NULL, signature BLOB NOT NULL
) STRICT;
"""


def open_journal_file(
    path: Path, run_id: str, key: Signer, outside_head: Path, max_bytes: int | None
) -> tuple[sqlite3.Connection, Head]:
    """A connection for any one thread, and the head to go on from; JournalError if that is not possible."""
    continued = path.exists()
    if continued:
        _refuse_broken(path, run_id, key.public, outside_head)
    try:
        connection = sqlite3.connect(path, isolation_level=None, check_same_thread=False)
    except sqlite3.Error as error:
        raise JournalError(f"journal {path} cannot be opened: {error}; is the folder writable?") from error
    try:
        _configure(connection, max_bytes)
        head = _last_head(connection, run_id, key) if continued else _begin(connection, run_id, key)
    except sqlite3.Error as error:
        connection.close()
        raise JournalError(f"journal {path} cannot be begun: {error}; is there room on the disk?") from error
    return connection, head


def new_head(run_id: str, seq: int, chain_hash: bytes, key: Signer) -> Head:
    """A head of now, signed."""
    return Head(run_id=run_id, seq=seq, hash=chain_hash, wall_ns=time.time_ns()).signed_by(key)


def put_head(connection: sqlite3.Connection, head: Head) -> None:
    """Replace the head in the file, within the caller's transaction."""
    connection.execute("DELETE FROM head")
    connection.execute(
        "INSERT INTO head VALUES (?, ?, ?, ?, ?)", (head.run_id, head.seq, head.hash, head.wall_ns, head.signature)
    )


def _refuse_broken(path: Path, run_id: str, public_key: bytes, outside_head: Path) -> None:
    report = check_chain(path, public_key, outside_head if outside_head.exists() else None)
    if not report.intact or report.run_id != run_id:
        found = report.problems[0] if report.problems else f"it is the journal of run {report.run_id}"
        raise JournalError(f"journal {path} cannot be continued: {found}; keep it and start a new run")


def _configure(connection: sqlite3.Connection, max_bytes: int | None) -> None:
    connection.execute("PRAGMA journal_mode = WAL")
    connection.execute("PRAGMA synchronous = FULL")
    if max_bytes is not None:
        (page_bytes,) = connection.execute("PRAGMA page_size").fetchone()
        connection.execute(f"PRAGMA max_page_count = {max(1, max_bytes // page_bytes)}")


def _begin(connection: sqlite3.Connection, run_id: str, key: Signer) -> Head:
    head = new_head(run_id, 0, genesis(run_id), key)
    connection.executescript(f"BEGIN IMMEDIATE; {_SCHEMA}")
    connection.execute("INSERT INTO run VALUES (?, ?)", (run_id, key.public))
    put_head(connection, head)
    connection.execute("COMMIT")
    return head


def _last_head(connection: sqlite3.Connection, run_id: str, key: Signer) -> Head:
    seq, chain_hash = connection.execute("SELECT seq, hash FROM head").fetchone()
    return new_head(run_id, seq, chain_hash, key)

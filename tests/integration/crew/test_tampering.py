"""Whoever changes a journal without the key is found, and `crew verify` says which record it was."""

import shutil
import sqlite3
from collections.abc import Callable
from contextlib import closing
from pathlib import Path

import msgspec
import pytest

from crew.chain import Head, chained, genesis
from crew.cli.runs import run_verify
from crew.records import DecisionRecord
from crew.signing import SigningKey, load_or_create_key
from tests.integration.crew.harness import SHORT_DRIVE, Desk, journal

Tamper = Callable[["Copy"], str]
"""Changes a copy of a run; returns what the report must name."""

ROWS = "SELECT seq, kind, at_ns, wall_ns, body FROM record ORDER BY seq"


class Copy:
    """A run that somebody got hold of, with the state folder's head of it, but without the key."""

    def __init__(self, folder: Path, other: Path, head: Path) -> None:
        self.folder, self.other, self.head = folder, other, head
        self.path = folder / "journal.db"
        self.run = folder.name

    def sql(self, statement: str, *values: object) -> list[tuple[object, ...]]:
        with closing(sqlite3.connect(self.path)) as connection, connection:
            return connection.execute(statement, values).fetchall()

    @property
    def last(self) -> int:
        return max(seq for seq, _ in journal(self.folder))

    def first_of(self, kind: type[object]) -> int:
        return next(seq for seq, record in journal(self.folder) if isinstance(record, kind))

    def rechain(self) -> bytes:
        """Give every record the hash that its content has now; the last one."""
        previous = genesis(self.run)
        for seq, kind, at_ns, wall_ns, body in self.sql(
            "SELECT seq, kind, at_ns, wall_ns, body FROM record ORDER BY seq"
        ):
            assert isinstance(seq, int)
            assert isinstance(at_ns, int)
            assert isinstance(wall_ns, int)
            assert isinstance(body, bytes)
            previous = chained(previous, seq, str(kind).encode(), at_ns, wall_ns, body)
            self.sql("UPDATE record SET hash = ? WHERE seq = ?", previous, seq)
        return previous


@pytest.fixture(scope="module")
def runs(desk: Desk) -> tuple[Path, Path]:
    return desk.demo("--request", SHORT_DRIVE).run, desk.demo("--request", "land the drone").run


@pytest.fixture
def copy(desk: Desk, runs: tuple[Path, Path], tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Copy:
    """A copy of a run under its own name, with a copy of its owner's state folder."""
    shutil.copytree(runs[0], tmp_path / runs[0].name)
    shutil.copytree(desk.home.path, tmp_path / "home")
    monkeypatch.setenv("CREW_HOME", str(tmp_path / "home"))
    return Copy(tmp_path / runs[0].name, runs[1], tmp_path / "home" / "heads" / f"{runs[0].name}.json")


def flip_a_bit_of_a_body(copy: Copy) -> str:
    seq = copy.first_of(DecisionRecord)
    ((body,),) = copy.sql("SELECT body FROM record WHERE seq = ?", seq)
    assert isinstance(body, bytes)
    changed = bytearray(body)
    changed[len(body) // 2] ^= 1
    copy.sql("UPDATE record SET body = ? WHERE seq = ?", bytes(changed), seq)
    return f"record {seq} was altered"


def flip_a_bit_of_a_hash(copy: Copy) -> str:
    seq = copy.first_of(DecisionRecord)
    ((old,),) = copy.sql("SELECT hash FROM record WHERE seq = ?", seq)
    assert isinstance(old, bytes)
    copy.sql("UPDATE record SET hash = ? WHERE seq = ?", bytes([old[0] ^ 1]) + old[1:], seq)
    return f"record {seq} was altered"


def change_a_time(copy: Copy) -> str:
    copy.sql("UPDATE record SET at_ns = at_ns + 1 WHERE seq = 5")
    return "record 5 was altered"


def change_a_kind(copy: Copy) -> str:
    seq = copy.first_of(DecisionRecord)
    copy.sql("UPDATE record SET kind = 'note' WHERE seq = ?", seq)
    return f"record {seq} was altered"


def change_a_columns_type(copy: Copy) -> str:
    copy.sql("PRAGMA writable_schema = ON")
    copy.sql("DROP TABLE head")
    return "head"


def remove_a_record(copy: Copy) -> str:
    copy.sql("DELETE FROM record WHERE seq = 6")
    return "record 6 is missing"


def remove_some_records(copy: Copy) -> str:
    copy.sql("DELETE FROM record WHERE seq BETWEEN 6 AND 8")
    return "records 6 to 8 are missing"


def cut_the_tail(copy: Copy) -> str:
    last = copy.last
    copy.sql("DELETE FROM record WHERE seq > ?", last - 2)
    return f"the journal ends at {last - 2}"


def roll_back(copy: Copy) -> str:
    """As a copy of the file from the middle of the run: its own head is genuine."""
    key = load_or_create_key(copy.head.parents[1] / "keys", "orchestrator")
    ((chain_hash,),) = copy.sql("SELECT hash FROM record WHERE seq = 6")
    assert isinstance(chain_hash, bytes)
    copy.sql("DELETE FROM record WHERE seq > 6")
    _put_head(copy, Head(run_id=copy.run, seq=6, hash=chain_hash, wall_ns=1).signed_by(key))
    return "the head outside says"


def empty_the_journal(copy: Copy) -> str:
    copy.sql("DELETE FROM record")
    return "the journal is empty"


def append_a_record(copy: Copy) -> str:
    last = copy.last
    ((chain_hash,),) = copy.sql("SELECT hash FROM record WHERE seq = ?", last)
    ((kind, body),) = copy.sql("SELECT kind, body FROM record WHERE seq = ?", last)
    assert isinstance(chain_hash, bytes)
    assert isinstance(body, bytes)
    forged = chained(chain_hash, last + 1, str(kind).encode(), 0, 0, body)
    copy.sql("INSERT INTO record VALUES (?, ?, 0, 0, ?, ?)", last + 1, kind, body, forged)
    return f"records {last + 1} to {last + 1} follow the head"


def swap_the_journal(copy: Copy) -> str:
    shutil.copy(copy.other / "journal.db", copy.path)
    return "foreign head"


def remove_the_head_outside(copy: Copy) -> str:
    copy.head.unlink()
    return "no head of run"


def spoil_the_head_outside(copy: Copy) -> str:
    copy.head.write_bytes(b"{}")
    return "missing head"


def truncate_the_file(copy: Copy) -> str:
    copy.path.write_bytes(copy.path.read_bytes()[:5000])
    return "unreadable"


def rewrite_a_decision(copy: Copy) -> str:
    """With every hash recomputed, but without the key."""
    _deny_a_decision(copy)
    copy.sql("UPDATE head SET hash = ?", copy.rechain())
    return "bad signature: the head in the journal"


def rewrite_a_decision_and_sign_with_another_key(copy: Copy) -> str:
    seq = _deny_a_decision(copy)
    thief = SigningKey(b"t" * 32)
    copy.sql("UPDATE run SET public_key = ?", thief.public)
    head = Head(run_id=copy.run, seq=copy.last, hash=copy.rechain(), wall_ns=1).signed_by(thief)
    _put_head(copy, head)
    copy.head.write_bytes(msgspec.json.encode(head))
    return f"record {seq} (decision)"


def _deny_a_decision(copy: Copy) -> int:
    """Let a decision say that it was about another call."""
    seq = copy.first_of(DecisionRecord)
    record = next(r for s, r in journal(copy.folder) if s == seq)
    assert isinstance(record, DecisionRecord)
    call = msgspec.structs.replace(record.decision.call, args={"x": 9.0, "y": 9.0})
    altered = msgspec.structs.replace(record, decision=msgspec.structs.replace(record.decision, call=call))
    copy.sql("UPDATE record SET body = ? WHERE seq = ?", msgspec.msgpack.encode(altered), seq)
    return seq


def _put_head(copy: Copy, head: Head) -> None:
    copy.sql("DELETE FROM head")
    copy.sql("INSERT INTO head VALUES (?, ?, ?, ?, ?)", head.run_id, head.seq, head.hash, head.wall_ns, head.signature)


TAMPERINGS: tuple[Tamper, ...] = (
    flip_a_bit_of_a_body,
    flip_a_bit_of_a_hash,
    change_a_time,
    change_a_kind,
    change_a_columns_type,
    remove_a_record,
    remove_some_records,
    cut_the_tail,
    roll_back,
    empty_the_journal,
    append_a_record,
    swap_the_journal,
    remove_the_head_outside,
    spoil_the_head_outside,
    truncate_the_file,
    rewrite_a_decision,
    rewrite_a_decision_and_sign_with_another_key,
)


@pytest.mark.hostile
def test_a_run_that_nobody_touched_holds(copy: Copy, capsys: pytest.CaptureFixture[str]) -> None:
    assert run_verify(copy.folder, copy.folder.parent, None, as_json=False) == 0
    assert "PROBLEM" not in capsys.readouterr().out


@pytest.mark.hostile
@pytest.mark.parametrize("tamper", TAMPERINGS)
def test_tampering_is_found_and_named(copy: Copy, tamper: Tamper, capsys: pytest.CaptureFixture[str]) -> None:
    named = tamper(copy)
    code = run_verify(copy.folder, copy.folder.parent, None, as_json=False)
    said = capsys.readouterr().out
    assert code == 1, said
    problems = [line for line in said.splitlines() if line.startswith("PROBLEM: ")]
    assert any(named in problem for problem in problems), said


def test_the_public_key_alone_is_enough_elsewhere(
    desk: Desk, copy: Copy, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setenv("CREW_HOME", str(tmp_path / "elsewhere"))
    key = desk.home.keys / "orchestrator.pub"
    assert run_verify(copy.folder, copy.folder.parent, key, as_json=False) == 0
    assert "note: no head outside the journal was compared" in capsys.readouterr().out
    flip_a_bit_of_a_body(copy)
    assert run_verify(copy.folder, copy.folder.parent, key, as_json=False) == 1

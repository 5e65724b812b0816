"""Every way of tampering, done for real with sqlite3 or on the raw bytes."""

import shutil
from pathlib import Path

import msgspec
import pytest

from crew.chain import Head, chained, genesis
from crew.journal_reader import ChainReport, check_chain
from crew.signing import SigningKey
from tests.unit.crew.test_journal import KEY, Place, place, written

__all__ = ["place", "written"]


def check(written: Place, *, outside: bool = True) -> ChainReport:
    return check_chain(written.path, KEY.public, written.head if outside else None)


def only_problem(written: Place, *, outside: bool = True) -> str:
    (problem,) = check(written, outside=outside).problems
    return problem


def edit_head(path: Path, **changes: object) -> None:
    head = msgspec.json.decode(path.read_bytes(), type=Head)
    path.write_bytes(msgspec.json.encode(msgspec.structs.replace(head, **changes)))


def test_a_flipped_byte_names_its_record(written: Place) -> None:
    raw = bytearray(written.path.read_bytes())
    raw[raw.index(b"body-07") + 5] ^= 1
    written.path.write_bytes(raw)
    assert only_problem(written) == "record 7 was altered: its content does not give its hash"


@pytest.mark.parametrize(
    "change",
    ["kind = 'intent'", "at_ns = at_ns + 1", "wall_ns = wall_ns + 1", "body = x'00'", "hash = zeroblob(32)"],
)
def test_each_column_is_under_the_hash(written: Place, change: str) -> None:
    written.sql(f"UPDATE record SET {change} WHERE seq = 5")
    assert only_problem(written) == "record 5 was altered: its content does not give its hash"


def test_content_may_not_move_between_columns(written: Place) -> None:
    written.sql("UPDATE record SET kind = 'decisionb', body = CAST('ody-05' AS BLOB) WHERE seq = 5")
    assert "record 5 was altered" in only_problem(written)


def test_each_altered_record_is_named(written: Place) -> None:
    written.sql("UPDATE record SET at_ns = 0 WHERE seq IN (2, 3, 9)")
    assert [problem.split(" was")[0] for problem in check(written).problems] == ["record 2", "record 3", "record 9"]


def test_a_removed_row_is_named(written: Place) -> None:
    written.sql("DELETE FROM record WHERE seq = 6")
    assert only_problem(written) == "record 6 is missing"


def test_removed_rows_at_the_start_are_named(written: Place) -> None:
    written.sql("DELETE FROM record WHERE seq <= 3")
    assert only_problem(written) == "records 1 to 3 are missing"


def test_a_removed_row_with_the_rest_renumbered_is_found(written: Place) -> None:
    written.sql("DELETE FROM record WHERE seq = 6", "UPDATE record SET seq = seq - 1 WHERE seq > 6")
    assert any("record 6 was altered" in problem for problem in check(written).problems)


def test_a_cut_tail_is_told_by_both_heads(written: Place) -> None:
    written.sql("DELETE FROM record WHERE seq > 7")
    assert check(written).problems == (
        "the tail is cut: the head in the journal says 10, the journal ends at 7",
        "the tail is cut: the head outside says 10, the journal ends at 7",
    )


def test_a_journal_rolled_back_to_its_own_past_is_found_by_the_outside_head(place: Place, tmp_path: Path) -> None:
    with place.journal() as journal:
        journal.append("early", 1, b"x")
    past = tmp_path / "past.db"
    shutil.copy(place.path, past)
    with place.journal() as journal:
        journal.append("late", 2, b"y")
    shutil.copy(past, place.path)
    assert only_problem(place) == "the tail is cut: the head outside says 2, the journal ends at 1"
    report = check(place, outside=False)
    assert report.intact
    assert "rolled back" in report.notes[0]


def test_an_emptied_journal_is_found(written: Place) -> None:
    written.sql("DELETE FROM record")
    assert check(written).problems[0] == "the journal is empty: the head in the journal says 10"
    assert check(written).problems[1] == "the journal is empty: the head outside says 10"


def test_a_journal_emptied_with_its_head_is_found(written: Place) -> None:
    written.sql("DELETE FROM record", "DELETE FROM head")
    assert check(written).problems == (
        "missing head: the journal holds 0 signed heads instead of one",
        "the journal is empty: the head outside says 10",
    )


def test_a_missing_head_is_found_without_the_outside_one(written: Place) -> None:
    written.sql("DELETE FROM head")
    assert "missing head" in only_problem(written, outside=False)


def test_a_missing_outside_head_is_found(written: Place) -> None:
    written.head.unlink()
    assert "missing head" in only_problem(written)


@pytest.mark.parametrize("change", ["seq = 9", "wall_ns = wall_ns + 1", "signature = zeroblob(64)", "signature = x''"])
def test_an_edited_head_in_the_journal_is_found(written: Place, change: str) -> None:
    written.sql(f"UPDATE head SET {change}")
    assert only_problem(written) == "bad signature: the head in the journal was edited or signed with another key"


def test_an_edited_head_outside_is_found(written: Place) -> None:
    edit_head(written.head, seq=9)
    assert only_problem(written) == "bad signature: the head outside was edited or signed with another key"


def test_another_key_is_a_bad_signature(written: Place) -> None:
    report = check_chain(written.path, SigningKey(b"o" * 32).public, written.head)
    assert all("bad signature" in problem for problem in report.problems)
    assert len(report.problems) == 2


def test_a_head_of_another_run_is_foreign(written: Place) -> None:
    head = Head(run_id="run-2", seq=10, hash=bytes(32), wall_ns=1).signed_by(KEY)
    written.head.write_bytes(msgspec.json.encode(head))
    assert only_problem(written) == "foreign head: the head outside is of run 'run-2', the journal of run 'run-1'"


def test_a_wholly_rewritten_chain_is_found_by_the_heads(written: Place) -> None:
    chain_hash = genesis("run-1")
    for seq in range(1, 11):
        chain_hash = chained(chain_hash, seq, b"decision", 1, 1, b"forged")
        written.sql(
            f"UPDATE record SET at_ns = 1, wall_ns = 1, body = CAST('forged' AS BLOB), hash = x'{chain_hash.hex()}' "
            f"WHERE seq = {seq}"
        )
    assert [problem.split(":")[0] for problem in check(written).problems] == [
        "record 10 or one before it was rewritten",
        "record 10 or one before it was rewritten",
    ]


def test_a_record_added_without_the_key_is_found(written: Place) -> None:
    previous = msgspec.json.decode(written.head.read_bytes(), type=Head).hash
    forged = chained(previous, 11, b"decision", 1, 1, b"x")
    written.sql(f"INSERT INTO record VALUES (11, 'decision', 1, 1, CAST('x' AS BLOB), x'{forged.hex()}')")
    assert "records 11 to 11 follow the head in the journal unsigned" in only_problem(written)


def test_a_killed_run_is_intact_and_said(place: Place) -> None:
    place.journal().close()
    early_head = place.head.read_bytes()
    with place.journal() as journal:
        journal.append("intent", 1, b"x")
    place.head.write_bytes(early_head)
    report = check(place)
    assert report.intact
    assert "the head outside says 0, the journal goes on to 1: the run was killed" in report.notes[0]


def test_another_run_id_breaks_the_chain_at_its_start(written: Place) -> None:
    written.sql("UPDATE run SET id = 'run-2'")
    assert any("foreign head" in problem for problem in check(written).problems)


def test_edited_column_types_are_alterations_not_crashes(written: Place) -> None:
    written.sql(
        "ALTER TABLE record RENAME TO old",
        "CREATE TABLE record (seq INTEGER PRIMARY KEY, kind, at_ns, wall_ns, body, hash)",
        "INSERT INTO record SELECT * FROM old",
        "UPDATE record SET body = 7 WHERE seq = 2",
        "UPDATE record SET at_ns = 'noon' WHERE seq = 4",
        "UPDATE record SET hash = NULL WHERE seq = 8",
    )
    assert [problem.split(" was")[0] for problem in check(written).problems] == ["record 2", "record 4", "record 8"]


@pytest.mark.parametrize("content", [b"", b"garbage" * 1000])
def test_a_file_that_is_no_journal_is_a_problem(written: Place, content: bytes) -> None:
    written.path.write_bytes(content)
    assert "unreadable" in only_problem(written)


def test_a_missing_file_is_a_problem(written: Place) -> None:
    written.path.unlink()
    assert "unreadable" in only_problem(written)

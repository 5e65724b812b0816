"""Replaying: what does not come out as recorded is a problem that names its record; nothing in a journal crashes it."""

from collections.abc import Callable
from pathlib import Path
from typing import TypeVar

import msgspec
import pytest
from hypothesis import given
from hypothesis import strategies as st
from msgspec.structs import replace

import tests.replay
from crew.contracts.plan import Call
from crew.errors import UsageError
from crew.home import Home
from crew.journal_reader import Record as Row
from crew.journal_reader import read_records
from crew.records import (
    RECORDS,
    DecisionRecord,
    EventRecord,
    IntentRecord,
    JudgementRecord,
    Record,
    RunRecord,
    ValidationRecord,
)
from crew.verify import Replay, verify_run

R = TypeVar("R", bound=Record)
GOLDEN = Path(tests.replay.__file__).parent
ROWS = list(read_records(GOLDEN / "completed" / "journal.db"))


def problems(rows: list[Row]) -> list[str]:
    replay = Replay()
    for row in rows:
        replay.take(row)
    return replay.problems


def changed(kind: type[R], change: Callable[[R], R], rows: list[Row] = ROWS) -> tuple[list[Row], int]:
    """The rows with the first record of this kind changed, and its number."""
    at = next(i for i, row in enumerate(rows) if row.kind == kind.kind)
    body = msgspec.msgpack.encode(change(msgspec.msgpack.decode(rows[at].body, type=kind)))
    return [*rows[:at], replace(rows[at], body=body), *rows[at + 1 :]], rows[at].seq


def only(found: list[str], seq: int, text: str) -> bool:
    """Whether the first problem names this record and says this."""
    return bool(found) and found[0].startswith(f"record {seq} (") and text in found[0]


def test_a_true_journal_replays_without_problems_and_counts_its_records() -> None:
    replay = Replay()
    for row in ROWS:
        replay.take(row)
    assert replay.problems == []
    assert replay.counts.total() == len(ROWS)
    assert set(replay.counts) == set(RECORDS)


def test_a_decision_that_would_be_refused_today_is_named() -> None:
    def out_of_reach(record: DecisionRecord) -> DecisionRecord:
        world = replace(record.world, stopped=True)
        return replace(record, world=world)

    rows, seq = changed(DecisionRecord, out_of_reach)
    assert only(problems(rows), seq, "comes out differently")


def test_a_decision_on_another_call_or_in_another_state_is_named() -> None:
    def elsewhere(record: DecisionRecord) -> DecisionRecord:
        call = Call("tb3", "navigate_to", {"x": 9.0, "y": 9.0})
        return replace(record, decision=replace(record.decision, call=call))

    rows, seq = changed(DecisionRecord, elsewhere)
    assert only(problems(rows), seq, "comes out differently")
    rows, seq = changed(DecisionRecord, lambda r: replace(r, state_digest="0" * 64))
    assert only(problems(rows), seq, "in another state")


def test_an_event_that_leads_elsewhere_is_named() -> None:
    rows, seq = changed(EventRecord, lambda r: replace(r, state_digest="0" * 64))
    assert only(problems(rows), seq, "comes out in another state")


def test_a_verdict_that_comes_out_differently_is_named() -> None:
    rows, seq = changed(ValidationRecord, lambda r: replace(r, plan=replace(r.plan, steps=r.plan.steps[:1])))
    assert only(problems(rows), seq, "validation comes out differently")


def test_a_judgement_that_comes_out_differently_is_named() -> None:
    rows, seq = changed(JudgementRecord, lambda r: replace(r, missing="nothing is as it was"))
    assert only(problems(rows), seq, "comes out differently")


def test_a_dispatch_without_a_decision_is_named() -> None:
    at = next(i for i, row in enumerate(ROWS) if row.kind == DecisionRecord.kind)
    found = problems(ROWS[:at] + ROWS[at + 1 :])
    intent = next(row.seq for row in ROWS if row.kind == IntentRecord.kind)
    assert any(only([p], intent, "without a decision that allows it") for p in found)


def test_a_dispatch_that_was_written_twice_is_named() -> None:
    at = next(i for i, row in enumerate(ROWS) if row.kind == IntentRecord.kind)
    again = replace(ROWS[at], seq=999)
    assert only(problems([*ROWS[: at + 1], again, *ROWS[at + 1 :]]), 999, "without a decision that allows it")


def test_rules_that_are_not_the_recorded_ones_are_named() -> None:
    rows, seq = changed(RunRecord, lambda r: replace(r, rules_digest="0" * 64))
    assert only(problems(rows), seq, "digest")


def test_records_before_the_runs_own_are_named() -> None:
    assert only(problems(ROWS[1:]), ROWS[1].seq, "before the run's own record")


def test_kinds_of_another_version_are_named() -> None:
    row = replace(ROWS[1], kind="prophecy")
    assert only(problems([ROWS[0], row]), row.seq, "unknown kind 'prophecy'")


@given(st.sampled_from(ROWS), st.binary(max_size=64))
def test_no_body_crashes_a_replay(row: Row, body: bytes) -> None:
    replay = Replay()
    replay.take(ROWS[0])
    replay.take(replace(row, body=body))
    assert replay.problems or row.kind == "note"


@given(st.lists(st.sampled_from(ROWS), max_size=20))
def test_no_order_of_records_crashes_a_replay(rows: list[Row]) -> None:
    replay = Replay()
    for row in [ROWS[0], *rows]:
        replay.take(row)


def test_a_folder_without_a_run_is_a_mistake_of_the_person(tmp_path: Path) -> None:
    with pytest.raises(UsageError, match="crew runs"):
        verify_run(tmp_path, Home(tmp_path / "home"))

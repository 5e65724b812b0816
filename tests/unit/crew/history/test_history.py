"""A run's history and lanes, from real journals and from journals that were killed, altered, or are of another code."""

import shutil
import sqlite3
from contextlib import closing
from pathlib import Path

import msgspec
import pytest
from msgspec.structs import replace

import tests.replay
from crew.contracts.plan import Plan
from crew.errors import UsageError
from crew.history.contract_text import ContractTexts, keep_contracts
from crew.history.explanation import Explainer
from crew.history.history import History, read_history
from crew.history.lanes import MISSION, Lanes, lanes_of
from crew.home import Home
from crew.library import load_rules
from crew.packed import PackedRules, pack
from tests.unit.contracts.build import (
    BASE_PLAN,
    FULL,
    REPORT,
    SEARCH_AND_SEND,
    SEARCH_AREA,
    TAKEOFF,
    air_ground,
    with_args,
)
from tests.unit.crew.history.golden import fix
from tests.unit.crew.history.staged import staged

GOLDEN = Path(tests.replay.__file__).parent
KEY = GOLDEN / "orchestrator.pub"


@pytest.fixture
def home(tmp_path: Path) -> Home:
    return Home(tmp_path / "home")


def golden(name: str, home: Home) -> History:
    history, report = read_history(GOLDEN / name, home, key_file=KEY)
    assert report.holds
    return history


def only_lanes(history: History) -> Lanes:
    (mission,) = history.missions.values()
    return lanes_of(mission, history.last_ns)


def edit(folder: Path, statement: str) -> None:
    with closing(sqlite3.connect(folder / "journal.db")) as connection:
        connection.execute(statement)
        connection.commit()


def test_the_rover_is_held_until_the_report_and_then_drives(home: Home) -> None:
    lanes = only_lanes(golden("completed", home))
    assert lanes.names == (MISSION, "iris", "tb3")
    held, drive = [span for span in lanes.spans if span.lane == "tb3"]
    assert (held.kind, drive.kind, drive.label) == ("held", "skill", "navigate_to")
    assert "dispatch comes after report (iris)" in held.title
    assert held.start_ns < held.end_ns == drive.start_ns
    assert [span.label for span in lanes.spans if span.lane == "iris"] == [
        "takeoff",
        "search_target",
        "get_coordinates",
        "land",
    ]
    assert [mark.kind for mark in lanes.marks if mark.lane == MISSION] == ["completed"]
    assert any(mark.kind == "value" and fix() in mark.title for mark in lanes.marks)


def test_a_refusal_is_marked_on_its_robot_and_the_safe_state_is_drawn(home: Home) -> None:
    lanes = only_lanes(golden("halted", home))
    (refused,) = [mark for mark in lanes.marks if mark.kind == "refused"]
    assert refused.lane == "tb3"
    assert "no_target_fix" in refused.title
    assert [span.label for span in lanes.spans if span.kind == "safe" and span.lane == "iris"] == ["land"]
    assert [span.kind for span in lanes.spans if span.lane == "tb3"] == ["held"], "it was never sent"
    assert {mark.kind for mark in lanes.marks if mark.lane == MISSION} == {"halted"}


def test_a_dispatch_whose_end_was_not_written_stays_open(tmp_path: Path, home: Home) -> None:
    with staged(tmp_path / "run", home) as stage:
        stage.mission(SEARCH_AND_SEND, FULL, dies_after="search_target")
        stage.note("later", "the journal goes on")
    history, report = read_history(tmp_path / "run", home)
    assert report.holds
    lanes = only_lanes(history)
    (flight,) = [span for span in lanes.spans if span.label == "search_target"]
    assert flight.open
    assert "the journal ends here" in flight.title
    assert [m.id for m in history.open] == ["m1"]


def test_a_failed_skill_is_drawn_as_failed_with_its_reason(tmp_path: Path, home: Home) -> None:
    with staged(tmp_path / "run", home) as stage:
        stage.mission(SEARCH_AND_SEND, FULL, fails="search_target")
    lanes = only_lanes(read_history(tmp_path / "run", home)[0])
    (flight,) = [span for span in lanes.spans if span.kind == "failed"]
    assert "the motor is too hot" in flight.title
    held = next(span for span in lanes.spans if span.lane == "tb3")
    assert "never sent" in held.title


def test_verdicts_are_numbered_over_all_missions_and_know_their_state(tmp_path: Path, home: Home) -> None:
    high = Plan("search_and_dispatch", (with_args(TAKEOFF, altitude=12.0), SEARCH_AREA, REPORT))
    with staged(tmp_path / "run", home) as stage:
        stage.mission("send the rover to base", BASE_PLAN, name="m1")
        stage.mission(SEARCH_AND_SEND, high, FULL, name="m2")
    history, _ = read_history(tmp_path / "run", home)
    assert [v.number for v in history.verdicts] == list(range(1, len(history.verdicts) + 1))
    refused = next(v for v in history.verdicts if v.refusal is not None)
    assert (refused.mission.id, refused.mission.phase) == ("m2", "validating")
    assert len(history.missions["m2"].proposals) == 2


def test_a_run_of_other_kinds_is_followed_but_not_decided_again(tmp_path: Path, home: Home) -> None:
    packed = pack(air_ground())
    other = PackedRules(packed.crew, packed.contracts, {**packed.kinds, "rover": "0" * 64})
    with staged(tmp_path / "run", home, rules_digest="0" * 64) as stage:
        stage.mission("send the rover to base", BASE_PLAN)
    rewrite_run(tmp_path / "run", other)
    history, report = read_history(tmp_path / "run", home)
    assert history.foreign
    assert any("kind 'rover' differs" in problem for problem in report.problems)
    assert len([p for p in report.problems if "comes out" in p or "comes before" in p]) == 0, "said once"
    assert history.missions["m1"].state.phase == "completed"
    explained = Explainer(tmp_path / "run", history).explain(history.verdicts[-1])
    assert (explained.outcome, explained.checks) == ("allowed", ())


def rewrite_run(folder: Path, packed: PackedRules) -> None:
    """What another version would have written as its first record."""
    from crew.journal_reader import read_records
    from crew.records import RunRecord

    row = next(read_records(folder / "journal.db"))
    record = msgspec.msgpack.decode(row.body, type=RunRecord)
    body = msgspec.msgpack.encode(replace(record, rules=packed))
    with closing(sqlite3.connect(folder / "journal.db")) as connection:
        connection.execute("UPDATE record SET body = ? WHERE seq = 1", (body,))
        connection.commit()


@pytest.mark.parametrize(
    "statement",
    [
        "DELETE FROM record WHERE kind = 'mission'",
        "DELETE FROM record WHERE kind = 'event'",
        "DELETE FROM record WHERE kind = 'run'",
        "DELETE FROM record",
        "UPDATE record SET body = x'ff' WHERE kind = 'decision'",
        "UPDATE record SET kind = 'prophecy' WHERE seq > 9",
    ],
)
def test_no_altered_journal_crashes_a_history_its_lanes_or_its_explanations(
    tmp_path: Path, home: Home, statement: str
) -> None:
    shutil.copytree(GOLDEN, tmp_path / "replay")
    folder = tmp_path / "replay" / "halted"
    edit(folder, statement)
    history, report = read_history(folder, home, key_file=tmp_path / "replay" / KEY.name)
    assert not report.holds
    for mission in history.missions.values():
        lanes_of(mission, history.last_ns)
    for verdict in history.verdicts:
        Explainer(folder, history).explain(verdict)


def test_a_folder_without_a_run_is_a_mistake_of_the_person(tmp_path: Path, home: Home) -> None:
    with pytest.raises(UsageError, match="crew runs"):
        read_history(tmp_path, home)


# --- the contract's lines


def test_a_line_is_shown_with_what_is_nested_below_it(tmp_path: Path) -> None:
    texts = ContractTexts(tmp_path, air_ground())
    number = next(s.line for s in air_ground().contracts["search_and_dispatch"].steps if s.name == "dispatch")
    line = texts.line(f"search_and_dispatch:{number}")
    assert line is not None
    assert line.text.splitlines()[0] == "dispatch:"
    assert "do: {navigate_to: {target: $person}}" in line.text
    assert "land:" not in line.text
    asks = texts.key("search_and_dispatch", "asks")
    assert asks is not None
    assert asks.text == "asks: [search, dispatch]"


def test_a_file_that_has_changed_since_is_not_shown(tmp_path: Path) -> None:
    rules = load_rules("air_ground")
    contract = rules.contracts["search_only"]
    changed = replace(rules, contracts={"search_only": replace(contract, deadline_s=1.0)})
    line = ContractTexts(tmp_path, changed).line("search_only:5")
    assert line is not None
    assert (str(line), line.text) == ("search_only:5", "")


def test_a_run_keeps_the_files_of_its_contracts(tmp_path: Path) -> None:
    rules = load_rules("air_ground")
    keep_contracts(tmp_path, rules.contracts)
    kept = sorted(path.stem for path in (tmp_path / "contracts").iterdir())
    assert kept == sorted(rules.contracts)
    renamed = replace(rules.contracts["search_only"], name="mine")
    (tmp_path / "contracts" / "mine.yaml").write_text(
        (tmp_path / "contracts" / "search_only.yaml").read_text().replace("contract: search_only", "contract: mine")
    )
    texts = ContractTexts(tmp_path, replace(rules, contracts={"mine": renamed}))
    assert texts.key("mine", "summary") is not None, "read from the run's own folder: the library has none of this name"


def test_a_place_pinned_by_a_decision_is_among_its_checks(home: Home) -> None:
    history = golden("completed", home)
    drive = next(v for v in history.verdicts if "navigate_to" in v.subject)
    explained = Explainer(GOLDEN / "completed", history).explain(drive)
    assert any(fix() in check.observed for check in explained.checks)
    assert explained.sent

"""The code decides the golden runs again as they were decided, from nothing but their journals and a public key."""

import shutil
from pathlib import Path

import pytest

from crew.cli.runs import run_verify
from crew.contracts.mission_state import MissionState
from crew.home import Home
from crew.journal_reader import read_records
from crew.verify import Replay, verify_run
from tests.replay.make import GOLDEN, HERE, KEY


@pytest.fixture
def away(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Another machine: its state folder knows nothing of the run, and the repository can't be written to."""
    monkeypatch.setenv("CREW_HOME", str(tmp_path / "home"))
    shutil.copytree(HERE, tmp_path / "replay")
    return tmp_path / "replay"


def replayed(name: str) -> MissionState:
    replay = Replay()
    for row in read_records(HERE / name / "journal.db"):
        replay.take(row)
    assert replay.problems == []
    (state,) = replay.states.values()
    return state


@pytest.mark.parametrize("name", GOLDEN)
def test_a_golden_run_verifies_on_any_machine(away: Path, name: str, capsys: pytest.CaptureFixture[str]) -> None:
    code = run_verify(away / name, away, away / KEY.name, as_json=False)
    said = capsys.readouterr().out
    assert code == 0, said
    assert "every decision hold" in said
    assert "note:" not in said, "the head that was kept outside was compared"


@pytest.mark.parametrize("name", GOLDEN)
def test_without_its_key_a_golden_run_does_not_verify(away: Path, name: str, tmp_path: Path) -> None:
    stranger = tmp_path / "stranger.pub"
    stranger.write_text("00" * 32)
    report = verify_run(away / name, Home(tmp_path / "home"), key_file=stranger)
    assert any("bad signature" in problem for problem in report.problems)


@pytest.mark.parametrize("name", GOLDEN)
def test_without_the_head_outside_a_note_says_what_was_not_compared(away: Path, name: str, tmp_path: Path) -> None:
    (away / f"{name}.json").unlink()
    report = verify_run(away / name, Home(tmp_path / "home"), key_file=away / KEY.name)
    assert report.holds
    assert any("no head outside" in note for note in report.notes)


def test_the_completed_run_is_replayed_to_its_end() -> None:
    state = replayed("completed")
    assert state.phase == "completed"
    assert {str(record.phase) for record in state.steps.values()} == {"succeeded"}


def test_the_halted_run_is_replayed_to_its_refusal() -> None:
    state = replayed("halted")
    assert (state.phase, state.refusal and state.refusal.code) == ("halted", "no_target_fix")
    assert state.steps["dispatch"].sequence == 0, "the rover was never sent"
    assert state.safe["searcher"].phase == "succeeded"


@pytest.mark.parametrize("name", GOLDEN)
def test_no_golden_run_tells_where_it_was_made(name: str) -> None:
    content = (HERE / name / "journal.db").read_bytes()
    assert b"/crew/" not in content
    assert b"/home/" not in content

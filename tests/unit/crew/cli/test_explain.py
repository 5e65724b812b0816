"""`crew explain`, `crew report` and `crew runs`, as they are typed."""

import json
import shutil
import sqlite3
from collections.abc import Callable
from contextlib import closing
from pathlib import Path
from typing import Any

import pytest

import tests.replay
from crew.cli.explain import run_explain
from crew.cli.report import run_report
from crew.cli.runs import run_runs
from crew.errors import UsageError
from crew.home import Home
from tests.unit.contracts.build import BASE_PLAN, FULL, SEARCH_AND_SEND
from tests.unit.crew.history.golden import fix
from tests.unit.crew.history.staged import staged

GOLDEN = Path(tests.replay.__file__).parent
Explain = Callable[..., tuple[int, str]]


@pytest.fixture
def replay(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("CREW_HOME", str(tmp_path / "home"))
    shutil.copytree(GOLDEN, tmp_path / "replay")
    return tmp_path / "replay"


@pytest.fixture
def explain(replay: Path, capsys: pytest.CaptureFixture[str]) -> Explain:
    def run(name: str, decision: int | None = None, as_json: bool = False) -> tuple[int, str]:
        code = run_explain(Path(name), decision, replay, replay / "orchestrator.pub", as_json)
        return code, capsys.readouterr().out

    return run


def told(explain: Explain, name: str, decision: int | None = None) -> Any:
    code, said = explain(name, decision, as_json=True)
    assert code == 0
    return json.loads(said)


def test_a_halted_mission_is_explained_by_the_refusal_that_ended_it(explain: Explain) -> None:
    code, said = explain("halted")
    assert code == 0
    for words in (
        "refused no_target_fix: tb3.navigate_to(target=victim)",
        "run-time values, at args.target",
        "absent: iris reports",
        "search_and_dispatch:",
        "do: {navigate_to: {target: $person}}",
        '"victim" names target',
        "it would have been accepted with: a fresh fix of victim by iris",
        "never sent: the mission was ending",
    ):
        assert words in said


def test_a_completed_mission_tells_what_each_step_passed(explain: Explain) -> None:
    _, said = explain("completed")
    assert "altitude: 5 m (allowed: 2 to 10 m)" in said
    assert "its turn: report is done" in said
    assert f"target = victim, seen by iris: {fix()}" in said
    assert "refused" not in said


def test_one_decision_is_explained_alone_for_machines(explain: Explain) -> None:
    answer = told(explain, "halted", 5)
    ((decision,),) = [m["decisions"] for m in answer["missions"]]
    assert answer["holds"]
    assert (decision["number"], decision["code"], decision["outcome"]) == (5, "no_target_fix", "refused")
    assert decision["line"]["text"].startswith("dispatch:")
    assert decision["change"]["edits"][0].startswith("a fresh fix of victim")
    allowed = told(explain, "halted", 2)["missions"][0]["decisions"][0]
    assert (allowed["outcome"], allowed["change"]) == ("allowed", None)
    assert {"capability", "arguments", "workflow", "containment", "state"} == {c["group"] for c in allowed["checks"]}


@pytest.mark.parametrize("number", [0, -1, 8, 10**9])
def test_a_number_that_no_decision_has_is_a_mistake_of_the_person(explain: Explain, number: int) -> None:
    with pytest.raises(UsageError, match=r"no decision .* \(it has 1 to 7\)"):
        explain("halted", number)


def test_a_run_that_does_not_exist_is_a_mistake_of_the_person(explain: Explain) -> None:
    with pytest.raises(UsageError, match="crew runs"):
        explain("nowhere")


def test_an_altered_run_is_explained_under_a_warning(explain: Explain, replay: Path) -> None:
    with closing(sqlite3.connect(replay / "halted" / "journal.db")) as connection:
        connection.execute("UPDATE record SET wall_ns = 0 WHERE seq = 3")
        connection.commit()
    code, said = explain("halted")
    assert code == 1
    assert said.startswith("THIS RUN DOES NOT VERIFY")
    assert "record 3 was altered" in said


def test_a_run_that_still_goes_on_is_explained_so_far(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setenv("CREW_HOME", str(tmp_path / "home"))
    home, folder = Home(tmp_path / "home"), tmp_path / "run"
    with home.claim("air_ground", folder, "tcp/127.0.0.1:1"), staged(folder, home) as stage:
        stage.mission(SEARCH_AND_SEND, FULL, dies_after="search_target")
        stage.settle()
        assert run_explain(folder, None, tmp_path, None, False) == 0
        said = capsys.readouterr().out
        assert run_report(folder, tmp_path, None, None) == 0
    assert said.startswith("this run still goes on")
    assert "not ended (executing)" in said
    assert "the run still goes on" in (folder / "report.html").read_text()


def test_a_mission_without_a_plan_says_what_is_wrong_with_the_request(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setenv("CREW_HOME", str(tmp_path / "home"))
    with staged(tmp_path / "run", Home(tmp_path / "home")) as stage:
        stage.mission("make me a \x1b[31msandwich")
    assert run_explain(tmp_path / "run", None, tmp_path, None, False) == 0
    said = capsys.readouterr().out
    assert "sandwich" in said
    assert "\x1b" not in said


def test_runs_point_at_their_reports(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setenv("CREW_HOME", str(tmp_path / "home"))
    for name in ("a", "b"):
        with staged(tmp_path / "runs" / name, Home(tmp_path / "home")) as stage:
            stage.mission("send the rover to base", BASE_PLAN)
    assert run_report(Path("a"), tmp_path / "runs", None, None) == 0
    assert capsys.readouterr().out.strip() == str(tmp_path / "runs" / "a" / "report.html")
    run_runs(tmp_path / "runs", as_json=True)
    found = json.loads(capsys.readouterr().out)
    assert [bool(run["report"]) for run in found] == [True, False]


def test_a_report_that_can_not_be_written_is_a_mistake_of_the_person(replay: Path) -> None:
    with pytest.raises(UsageError, match="--to"):
        run_report(replay / "halted", replay, replay / "orchestrator.pub", replay / "no" / "such" / "folder.html")

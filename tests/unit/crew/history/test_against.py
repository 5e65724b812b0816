"""A past run against changed files: the same rules change nothing; what would be otherwise has both sentences."""

import json
import sqlite3
from contextlib import closing
from itertools import product
from pathlib import Path

import pytest

from crew.cli.against import DIFFERS, run_against
from crew.errors import UsageError
from crew.history.against import Comparison, compare
from crew.history.changed_rules import changed_rules
from crew.history.history import read_history
from crew.home import Home
from crew.library import CONTRACTS, CREWS
from tests.unit.contracts.build import BASE_PLAN, FULL, SEARCH_AND_SEND, plan, with_args
from tests.unit.contracts.build import TAKEOFF as TAKE_OFF
from tests.unit.crew.history.staged import staged


@pytest.fixture
def home(tmp_path: Path) -> Home:
    return Home(tmp_path / "home")


def changed(tmp_path: Path, shipped: Path, *edits: tuple[str, str]) -> Path:
    """A shipped file with some text replaced."""
    text = shipped.read_text()
    for old, new in edits:
        assert old in text
        text = text.replace(old, new)
    path = tmp_path / shipped.name
    path.write_text(text)
    return path


def contract(tmp_path: Path, name: str, *edits: tuple[str, str]) -> Path:
    return changed(tmp_path, CONTRACTS / f"{name}.yaml", *edits)


@pytest.fixture
def completed(tmp_path: Path, home: Home) -> Path:
    """A run by the shipped files, of which each step took a second."""
    with staged(tmp_path / "completed", home) as stage:
        assert stage.mission(SEARCH_AND_SEND, FULL).phase == "completed"
    return tmp_path / "completed"


@pytest.fixture
def halted(tmp_path: Path, home: Home) -> Path:
    with staged(tmp_path / "halted", home) as stage:
        assert stage.mission(SEARCH_AND_SEND, FULL, blind=True).phase == "halted"
    return tmp_path / "halted"


def against(folder: Path, home: Home, *files: Path) -> Comparison:
    history, _ = read_history(folder, home)
    assert history.rules is not None
    return compare(history, changed_rules(history.rules, files))


def test_the_same_rules_decide_the_same(completed: Path, halted: Path, home: Home) -> None:
    files = [CONTRACTS / "search_and_dispatch.yaml", CREWS / "air_ground.yaml"]
    for folder, chosen in product((completed, halted), ([], files[:1], files[1:], files)):
        found = against(folder, home, *chosen)
        assert (found.differences, found.unreached) == ((), ())
        assert found.compared > 6


def test_comments_and_wording_change_nothing(halted: Path, tmp_path: Path, home: Home) -> None:
    path = contract(tmp_path, "search_and_dispatch", ("summary: ", "# a remark\nsummary: Again: "), ("Again: ", ""))
    assert against(halted, home, path).differences == ()


def test_a_shorter_deadline_ends_the_mission_where_it_passes(completed: Path, tmp_path: Path, home: Home) -> None:
    path = contract(tmp_path, "search_and_dispatch", ("deadline_s: 600", "deadline_s: 1.5"))
    found = against(completed, home, path)
    (difference,) = found.differences
    assert (difference.then, difference.now_code) == ("allowed", "deadline_passed")
    assert difference.subject == "iris.get_coordinates()"
    assert "its contract allows 1.5 s" in difference.now
    assert found.unreached == (5, 6)


def test_a_guard_that_is_new_refuses_what_was_allowed(completed: Path, tmp_path: Path, home: Home) -> None:
    guard = "    needs: [{searcher.airborne: false}]\n    do: {navigate_to"
    path = contract(tmp_path, "search_and_dispatch", ("    do: {navigate_to", guard))
    found = against(completed, home, path)
    assert found.differences[0].now_code == "precondition_failed"
    assert found.differences[0].subject.startswith("the plan of"), "the dry run sees it before anything moves"
    assert 2 in found.unreached


def test_another_order_is_another_plan(completed: Path, tmp_path: Path, home: Home) -> None:
    path = contract(tmp_path, "search_and_dispatch", ("after: [report]", "after: [search]"))
    (difference,) = against(completed, home, path).differences
    assert "dispatch after report" in difference.then
    assert "dispatch after search" in difference.now


def test_another_completion_is_judged_otherwise(completed: Path, tmp_path: Path, home: Home) -> None:
    complete = ("complete: [{responder.at: $person}]", "complete: [{responder.at: $person}, {searcher.airborne: true}]")
    (difference,) = against(completed, home, contract(tmp_path, "search_and_dispatch", complete)).differences
    assert (difference.number, difference.subject) == (0, "whether the mission is complete")
    assert difference.then == "yes, it was observed"
    assert "searcher.airborne is true" in difference.now


def test_words_that_a_contract_no_longer_has_are_no_longer_read(tmp_path: Path, home: Home) -> None:
    path = changed(tmp_path, CREWS / "air_ground.yaml", ("person, hiker,", "hiker,"))
    with staged(tmp_path / "run", home) as stage:
        stage.mission("search the area and send the rover to the person", FULL)
    (difference, *_) = against(tmp_path / "run", home, path).differences
    assert difference.now_code is not None
    assert "person" in difference.now


def test_a_plan_that_was_refused_may_be_accepted(tmp_path: Path, home: Home) -> None:
    near = plan("dispatch_only", with_args(BASE_PLAN.steps[0], target=None, x=12.0, y=2.0))
    with staged(tmp_path / "run", home) as stage:
        stage.mission("send the rover to (12, 2)", near, near)
    path = changed(tmp_path, CREWS / "air_ground.yaml", ("area: {x: [-6, 10]", "area: {x: [-6, 20]"))
    found = against(tmp_path / "run", home, path)
    assert found.differences[0].then_code == "out_of_bounds"
    assert found.differences[0].now.startswith("accepted as dispatch_only")
    assert found.unreached == (2,), "the second plan would not have been asked for"


def test_several_files_are_one_set_of_rules(completed: Path, tmp_path: Path, home: Home) -> None:
    paths = [
        contract(tmp_path, "search_and_dispatch", ("deadline_s: 600", "deadline_s: 1.5")),
        contract(tmp_path, "dispatch_only", ("deadline_s: 300", "deadline_s: 100")),
    ]
    assert len(against(completed, home, *paths).differences) == 1


# --- bad input


def test_a_file_that_is_neither_is_named(halted: Path, tmp_path: Path, home: Home) -> None:
    (tmp_path / "x.yaml").write_text("robots: {}\n")
    with pytest.raises(UsageError, match="neither a contract nor a crew file"):
        against(halted, home, tmp_path / "x.yaml")


def test_a_mistake_in_a_file_is_named_with_its_line(halted: Path, tmp_path: Path, home: Home) -> None:
    path = contract(tmp_path, "search_and_dispatch", ("role: searcher", "role: seacher"))
    with pytest.raises(UsageError, match=r"search_and_dispatch\.yaml:\d+:\d+.*searcher"):
        against(halted, home, path)


def test_a_file_that_does_not_exist_is_named(halted: Path, tmp_path: Path, home: Home) -> None:
    with pytest.raises(UsageError, match="no file"):
        against(halted, home, tmp_path / "nowhere.yaml")


def test_two_crews_are_one_too_many(halted: Path, home: Home) -> None:
    with pytest.raises(UsageError, match="a run has one crew"):
        against(halted, home, CREWS / "air_ground.yaml", CREWS / "humanoid_quadruped.yaml")


def test_a_crew_without_the_robots_refuses_everything_and_crashes_nothing(completed: Path, home: Home) -> None:
    found = against(completed, home, CREWS / "humanoid_quadruped.yaml")
    assert found.differences[0].now_code == "unknown_robot"


def test_a_plan_for_a_contract_that_is_gone_is_refused(completed: Path, tmp_path: Path, home: Home) -> None:
    path = changed(tmp_path, CREWS / "air_ground.yaml", ("contracts: [search_and_dispatch, ", "contracts: ["))
    assert against(completed, home, path).differences[0].now_code == "unknown_contract"


# --- as it is typed


def typed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, *files: Path, as_json: bool = False) -> int:
    monkeypatch.setenv("CREW_HOME", str(tmp_path / "home"))
    return run_against(Path("completed"), list(files), tmp_path, None, as_json)


def test_the_exit_code_says_whether_anything_differs(
    completed: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    same = CONTRACTS / "search_and_dispatch.yaml"
    late = contract(tmp_path, "search_and_dispatch", ("deadline_s: 600", "deadline_s: 1.5"))
    assert typed(tmp_path, monkeypatch, same) == 0
    assert "would have been the same" in capsys.readouterr().out
    assert typed(tmp_path, monkeypatch, late) == DIFFERS
    said = capsys.readouterr().out
    assert "then: allowed" in said
    assert "now:  deadline_passed: the mission has run" in said
    assert typed(tmp_path, monkeypatch, late, as_json=True) == DIFFERS
    answer = json.loads(capsys.readouterr().out)
    assert (answer["same"], answer["holds"], answer["differences"][0]["number"]) == (False, True, 4)


def test_an_altered_run_is_compared_under_a_warning_and_fails(
    completed: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    with closing(sqlite3.connect(completed / "journal.db")) as connection:
        connection.execute("UPDATE record SET wall_ns = 0 WHERE seq = 3")
        connection.commit()
    monkeypatch.setenv("CREW_HOME", str(tmp_path / "home"))
    assert typed(tmp_path, monkeypatch, CONTRACTS / "search_and_dispatch.yaml") == 1
    assert capsys.readouterr().out.startswith("THIS RUN DOES NOT VERIFY")


def test_a_replan_that_would_not_have_been_needed_is_unreached(tmp_path: Path, home: Home) -> None:
    high = plan("search_and_dispatch", with_args(TAKE_OFF, altitude=12.0), *FULL.steps[1:])
    with staged(tmp_path / "run", home) as stage:
        stage.mission(SEARCH_AND_SEND, high, FULL)
    found = against(tmp_path / "run", home, CONTRACTS / "search_and_dispatch.yaml")
    assert (found.differences, found.unreached) == ((), ()), "refused then, refused now, replanned both times"

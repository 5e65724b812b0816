"""`crew contracts new` and `graph`: what is written where, and that nothing is overwritten."""

import json
from pathlib import Path

import pytest

from crew.cli.contract_graph import run_graph
from crew.cli.contract_new import run_new
from crew.errors import UsageError
from crew.library import CREWS, load_rules


def test_a_draft_is_written_once_and_loads_beside_its_crew(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    crew = tmp_path / "mine.yaml"
    crew.write_text((CREWS / "air_ground.yaml").read_text().replace("abort]", "abort, patrol]"), encoding="utf-8")
    plain = tmp_path / "plain.yaml"
    plain.write_text((CREWS / "air_ground.yaml").read_text(), encoding="utf-8")
    assert run_new("patrol", str(plain), ["scout.fly_to"], None, True) == 0
    assert json.loads(capsys.readouterr().out)["file"] == str(tmp_path / "patrol.yaml")
    assert "patrol" in load_rules(crew).contracts
    before = (tmp_path / "patrol.yaml").read_text()
    with pytest.raises(UsageError, match="is there already"):
        run_new("patrol", str(plain), ["scout.land"], None, False)
    assert (tmp_path / "patrol.yaml").read_text() == before


@pytest.mark.parametrize(
    ("do", "folder", "words"),
    [
        ("scout.fly_to(x=300, y=0)", "", "argument x out of bounds: found 300"),
        ("scout.fly_to", "none", "make it first, or name another with --to"),
        ("scout.flyto", "", "did you mean 'fly_to'?"),
    ],
)
def test_what_is_refused_leaves_no_file(tmp_path: Path, do: str, folder: str, words: str) -> None:
    with pytest.raises(UsageError) as raised:
        run_new("patrol", "air_ground", [do], tmp_path / folder, False)
    assert words in str(raised.value)
    assert list(tmp_path.iterdir()) == []


def test_a_picture_goes_to_a_file_or_to_the_terminal(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run_graph("carry", "humanoid_quadruped", "svg", tmp_path / "carry.svg") == 0
    assert (tmp_path / "carry.svg").read_text(encoding="utf-8").startswith("<svg ")
    capsys.readouterr()
    assert run_graph("carry", "humanoid_quadruped", "mermaid", None) == 0
    drawn = capsys.readouterr().out
    assert drawn.startswith("flowchart TD\n")
    assert run_graph("carry", "", "mermaid", None) == 0
    assert capsys.readouterr().out == drawn


@pytest.mark.parametrize(
    ("name", "form", "to", "words"),
    [
        ("carr", "svg", None, "did you mean 'carry'?"),
        ("carry", "png", None, "no form is called 'png'"),
        ("carry", "svg", "none/carry.svg", "cannot write"),
    ],
)
def test_a_picture_that_cannot_be_is_refused(tmp_path: Path, name: str, form: str, to: str | None, words: str) -> None:
    with pytest.raises(UsageError) as raised:
        run_graph(name, "humanoid_quadruped", form, None if to is None else tmp_path / to)
    assert words in str(raised.value)

"""`crew contracts check`: exit codes, the figures for machines, the story for people."""

import json
from pathlib import Path

import pytest

from crew.cli.contract_check import run_check
from crew.cli.progress import line
from crew.contracts.proof.checker import LIMIT
from crew.contracts.proof.report import Stage
from crew.errors import UsageError
from crew.library import CONTRACTS
from tests.unit.contracts.proof.zoo import ZOO


def test_proved_contracts_end_with_zero(capsys: pytest.CaptureFixture[str]) -> None:
    assert run_check((), "air_ground", as_json=True) == 0
    told = json.loads(capsys.readouterr().out)
    assert told["proved"] is True
    assert {c["contract"] for c in told["contracts"]} == {
        "search_and_dispatch",
        "search_only",
        "dispatch_only",
        "abort",
    }
    for contract in told["contracts"]:
        assert contract["proved"] is True
        assert contract["states"] > 0
        assert contract["counterexample"] is None


def test_a_broken_contract_ends_with_two_and_its_story(capsys: pytest.CaptureFixture[str]) -> None:
    assert run_check([ZOO / "air_ground" / "no_safe_state_in_the_air.yaml"], "", as_json=False) == 2
    out = capsys.readouterr().out
    assert out.startswith("not proved  no_safe_state_in_the_air")
    assert "1. A person asks for search, dispatch" in out
    assert "repair: give role searcher the safe state" in out


def test_a_counterexample_is_there_for_machines(capsys: pytest.CaptureFixture[str]) -> None:
    assert run_check([ZOO / "humanoid_quadruped" / "handed_and_held.yaml"], "", as_json=True) == 2
    told = json.loads(capsys.readouterr().out)
    (contract,) = told["contracts"]
    assert contract["crew"] == "humanoid_quadruped"
    assert contract["proved"] is False
    assert contract["counterexample"][0].startswith("1. A person asks for hand")
    assert contract["findings"][0]["rule"] == "cannot_complete"


def test_a_bound_is_reported_and_never_passed_over(capsys: pytest.CaptureFixture[str]) -> None:
    assert run_check((), "air_ground", as_json=False, limit=40) == 2
    out = capsys.readouterr().out
    assert "not proved  search_and_dispatch" in out
    assert "bound of 40 states reached: what lies beyond was not looked at" in out
    assert "dead_step" not in out, "what was not looked at may well happen"


def test_a_file_that_cannot_be_read_is_a_usage_error(tmp_path: Path) -> None:
    path = tmp_path / "odd.yaml"
    path.write_text("contract: odd\nsummary: Nothing.\nroles: {}\n")
    with pytest.raises(UsageError, match=r"odd\.yaml:3:8"):
        run_check([path], "", as_json=False)


def test_a_file_that_is_not_there_is_a_usage_error(tmp_path: Path) -> None:
    with pytest.raises(UsageError, match=r"^no file .*nowhere\.yaml; relative paths start at [^\n]*$"):
        run_check([tmp_path / "nowhere.yaml"], "", as_json=False)


def test_an_unknown_crew_is_a_usage_error() -> None:
    with pytest.raises(UsageError, match="no crew is called 'air_gruond'; did you mean"):
        run_check((), "air_gruond", as_json=False)


def test_the_bar_fills_up() -> None:
    assert line(Stage("carry", 0, 4, 12)).endswith("[........................] plan 1 of 4, 12 states")
    assert "[############............]" in line(Stage("carry", 2, 4, 12))
    assert LIMIT == 200_000, "the default of --limit"


def test_what_is_odd_is_said_with_its_place_and_refuses_nothing(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    text = (CONTRACTS / "handover.yaml").read_text(encoding="utf-8")
    spare = text.replace(
        "  object: {type: object}\n", "  object: {type: object}\n  spare: {type: object, optional: true}\n"
    )
    path = tmp_path / "handover.yaml"
    path.write_text(spare, encoding="utf-8")
    assert run_check([path], "humanoid_quadruped", as_json=False) == 0
    line_of = spare.splitlines().index("  spare: {type: object, optional: true}") + 1
    warning = f"{path}:{line_of}:3: warning: no step reads the slot spare; pass it to a step, or remove it"
    assert warning in capsys.readouterr().out
    assert run_check([path], "humanoid_quadruped", as_json=True) == 0
    (contract,) = json.loads(capsys.readouterr().out)["contracts"]
    assert contract["warnings"] == [warning]

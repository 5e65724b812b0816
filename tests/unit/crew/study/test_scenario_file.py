"""Scenario files: what is shipped, and what a person reads who made a mistake in one."""

from collections import Counter
from pathlib import Path

import pytest

from crew.errors import UsageError
from crew.library import load_rules
from crew.study.scenario_file import SHIPPED, load_scenarios

GOOD = """\
crew: air_ground
scenarios:
  home:
    title: Home
    request: Send the rover home
    contracts: [dispatch_only]
    robots: [tb3]
    may:
      - {robot: tb3, skill: navigate_to, args: {target: base}}
"""


def _said(tmp_path: Path, text: str) -> str:
    (tmp_path / "mine.yaml").write_text(text, encoding="utf-8")
    with pytest.raises(UsageError) as error:
        load_scenarios(tmp_path, load_rules("air_ground"))
    return str(error.value)


@pytest.mark.parametrize("crew", ["air_ground", "humanoid_quadruped"])
def test_each_testbed_has_three_nominal_scenarios_a_contract_and_eight_faults(crew: str) -> None:
    rules = load_rules(crew)
    scenarios = load_scenarios(SHIPPED, rules)
    kinds = Counter(scenario.kind for scenario in scenarios)
    nominal = Counter(s.contracts for s in scenarios if s.kind == "nominal")
    assert kinds == {"nominal": 12, "fault": 8}
    assert nominal == {(contract,): 3 for contract in rules.contracts}
    assert all(s.outcome == ("completed" if s.kind == "nominal" else "blocked") for s in scenarios)
    assert all(s.licences or s.never for s in scenarios)


def test_scenarios_of_other_crews_are_left_alone(tmp_path: Path) -> None:
    (tmp_path / "mine.yaml").write_text(GOOD, encoding="utf-8")
    (tmp_path / "other.yaml").write_text("crew: lab\nscenarios: {}\n", encoding="utf-8")
    assert [s.name for s in load_scenarios(tmp_path, load_rules("air_ground"))] == ["home"]


@pytest.mark.parametrize(
    ("change", "place", "words"),
    [
        (("[dispatch_only]", "[dispatch_onlyy]"), "6:17", "no such contract: found 'dispatch_onlyy'"),
        (("[dispatch_only]", "[dispatch_onlyy]"), "6:17", "did you mean 'dispatch_only'?"),
        (("title: Home", "title: Home\n    faults: [tb3_unavailible]"), "5:14", "did you mean 'tb3_unavailable'?"),
        (("title: Home", "title: Home\n    faults: ['tb3_unavailable@soon']"), "5:14", "no time: found 'soon'"),
        (("title: Home", "title: Home\n    map: D"), "5:10", "no such map of the scene air_ground"),
        (("[tb3]", "[tb4]"), "7:14", "did you mean 'tb3'?"),
        (("skill: navigate_to", "skill: navigate_too"), "9:29", "did you mean 'navigate_to'?"),
        (("title: Home", "titel: Home"), "4:5", "unknown key of a scenario: found 'titel'"),
        (("    contracts: [dispatch_only]\n", ""), "3:3", "a mission that is completed has a contract"),
        (("title: Home", "title: Home\n    outcome: blocked"), "3:3", "a blocked mission is refused with a code"),
    ],
)
def test_a_mistake_is_named_with_its_place(tmp_path: Path, change: tuple[str, str], place: str, words: str) -> None:
    said = _said(tmp_path, GOOD.replace(*change))
    assert f"mine.yaml:{place}" in said
    assert words in said


def test_an_empty_folder_is_named(tmp_path: Path) -> None:
    with pytest.raises(UsageError, match=r"holds no scenarios: no \*\.yaml is there"):
        load_scenarios(tmp_path, load_rules("air_ground"))
    with pytest.raises(UsageError, match="holds no scenarios"):
        load_scenarios(tmp_path / "nowhere", load_rules("air_ground"))


def test_a_folder_for_another_crew_is_named(tmp_path: Path) -> None:
    assert "no scenario for air_ground, but for lab" in _said(tmp_path, "crew: lab\nscenarios: {}\n")

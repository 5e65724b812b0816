"""The figures of docs/proof.md are the checker's; `python -m tests.unit.contracts.proof.page` writes them anew."""

import re

import pytest

from crew.contracts.proof.checker import check
from tests.unit.contracts.proof.scale import ROWS
from tests.unit.contracts.proof.test_shipped import SHIPPED, report_of
from tests.unit.project.tree import ROOT

PAGE = ROOT / "docs" / "proof.md"


def figures(pattern: str) -> list[tuple[str, ...]]:
    return re.findall(pattern, PAGE.read_text(encoding="utf-8").replace(",", ""), re.MULTILINE)


def test_the_table_of_shipped_contracts_is_as_proved() -> None:
    listed = figures(r"^\| (\w+) \| `(\w+)` \| (\d+) \| (\d+) \| (\d+) \| (\d+) \|$")
    assert [(crew, name) for crew, name, *_ in listed] == SHIPPED, "see this module's first line"
    for crew, name, *counts in listed:
        report = report_of(crew, name)
        assert [int(count) for count in counts] == [report.plans, report.states, report.transitions, report.decisions]


def test_the_count_by_hand_adds_up() -> None:
    report = report_of("humanoid_quadruped", "handover")
    assert report.states == report.plans * (1 + 3 + 4 + 4 + 4)
    assert f"{report.plans} times 16 = {report.states} states" in PAGE.read_text(encoding="utf-8")


@pytest.mark.soak
@pytest.mark.parametrize("name", ROWS)
def test_the_table_of_generated_contracts_is_as_measured(name: str) -> None:
    rows = figures(r"^\| (.+?) \| proved \| (\d+) \| (\d+) \| (\d+) \|")
    listed = {row: [int(count) for count in counts] for row, *counts in rows}
    report = check(ROWS[name](), "chains", repair=False)
    assert report.proved
    assert listed[name.replace(",", "")] == [report.states, report.transitions, report.decisions]

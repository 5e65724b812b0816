"""The safety page: hazards are numbered, each is traced to tests, and every test that it names exists."""

import ast
import re
from collections.abc import Iterator

import pytest

from tests.unit.project.tree import ROOT

PAGE = (ROOT / "docs" / "SAFETY.md").read_text(encoding="utf-8")
NAMED = re.compile(r"`([a-z0-9_/]+\.py)::(test_[a-z0-9_]+)`")
ROW = re.compile(r"^\| (H\d+) \|(.*)\|$", re.MULTILINE)


def rows() -> list[tuple[str, list[str]]]:
    """Hazards with their cells: hazard, requirement, tests."""
    return [(name, [cell.strip() for cell in cells.split("|")]) for name, cells in ROW.findall(PAGE)]


def functions_of(path: str) -> Iterator[str]:
    """The test functions of a file."""
    tree = ast.parse((ROOT / "tests" / path).read_text(encoding="utf-8"))
    for node in ast.walk(tree):
        if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef) and node.name.startswith("test_"):
            yield node.name


@pytest.mark.parametrize("path", sorted({path for path, _ in NAMED.findall(PAGE)}))
def test_every_named_test_exists(path: str) -> None:
    named = {test for file, test in NAMED.findall(PAGE) if file == path}
    assert (ROOT / "tests" / path).is_file()
    assert named <= set(functions_of(path))


def test_hazards_are_numbered_and_each_has_a_requirement_and_a_test() -> None:
    found = rows()
    assert [name for name, _ in found] == [f"H{number}" for number in range(1, len(found) + 1)]
    for name, cells in found:
        assert len(cells) == 3, name
        hazard, requirement, tests = cells
        assert hazard.endswith("."), name
        assert requirement.endswith("."), name
        assert NAMED.search(tests), name
        assert not NAMED.sub("", tests).strip(", "), f"{name} names something that is no test"


def test_assumptions_and_limits_are_said() -> None:
    for word in ("Physics", "Perception", "Adapters", "Vendor firmware", "Language"):
        assert f"**{word}.**" in PAGE
    assert re.findall(r"^\| (A\d+) \|", PAGE, re.MULTILINE) == [f"A{number}" for number in range(1, 10)]

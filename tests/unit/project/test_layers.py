"""Which module may import which: the layers of pyproject.toml, and what import-linter can't see."""

import ast
import re
import tomllib
from pathlib import Path

from tests.unit.project.tree import BIN, LINKS, ROOT, run, sources

VAGUE = {"util", "utils", "helper", "helpers", "manager", "misc", "common"}


def test_layers_hold() -> None:
    done = run(BIN / "lint-imports", "--no-logo", "--no-cache")
    assert done.returncode == 0, done.stdout + done.stderr


def test_new_module_without_layer_is_refused(tmp_path: Path) -> None:
    text = (ROOT / "pyproject.toml").read_text()
    assert " : wire" in text
    config = tmp_path / "pyproject.toml"
    config.write_text(text.replace(" : wire", ""))
    done = run(BIN / "lint-imports", "--no-logo", "--no-cache", "--contract", "layers", "--config", config)
    assert done.returncode == 1
    assert "wire" in done.stdout


def test_imports_use_installed_names() -> None:
    bare = re.compile(rf"^\s*(from\s+\.|(from|import)\s+({'|'.join(LINKS)})[\s.])", re.MULTILINE)
    for path in sources():
        found = bare.search((ROOT / path).read_text(encoding="utf-8"))
        assert found is None, f"{path}: {found[0].strip()}; the installed name begins with crew, and is written out"


def test_contracts_touch_no_file_and_no_terminal() -> None:
    for path in sources():
        if path.parts[0] == "contracts":
            assert not called(path) & {"open", "print", "input", "eval", "exec", "breakpoint", "__import__"}, path


def called(path: Path) -> set[str]:
    """Names of the plain functions that a file calls."""
    return {
        node.func.id
        for node in ast.walk(ast.parse((ROOT / path).read_text(encoding="utf-8")))
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Name)
    }


def test_modules_have_telling_names() -> None:
    for path in sources():
        assert not {*path.parts, path.stem} & VAGUE, path


def test_modules_are_found_by_name_only_where_the_table_says() -> None:
    """Outside the process table nobody names an actor's process: the supervisor spawns what it is told."""
    named = {
        path
        for path in sources()
        if path.parts[0] != "tests" and "crew.actors.robot.process" in (ROOT / path).read_text(encoding="utf-8")
    }
    assert named == {Path("crew/launch/table.py")}


def test_entry_points_lead_somewhere() -> None:
    points = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]["entry-points"]
    for group in points.values():
        for target in group.values():
            module, _, attribute = target.partition(":")
            path = ROOT / (module.replace(".", "/") + ".py")
            assert attribute in path.read_text(), target

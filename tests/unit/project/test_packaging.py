"""What is installed: one package, every module once, the data beside it, and nothing else."""

import shutil
import sys
import tomllib
import zipfile
from pathlib import Path

import pytest

from tests.unit.project.tree import LINKS, ROOT, committed, run

DATA = {".yaml", ".xml", ".json"}


@pytest.mark.parametrize("name", LINKS)
def test_link_is_a_committed_relative_link(name: str) -> None:
    link = ROOT / "crew" / name
    assert link.is_symlink()
    assert link.readlink() == Path("..") / name
    listed = run("git", "ls-files", "--stage", f"crew/{name}").stdout
    assert listed.startswith("120000 "), f"crew/{name} is not committed as a link: {listed!r}"


@pytest.fixture(scope="module")
def wheel(tmp_path_factory: pytest.TempPathFactory) -> zipfile.ZipFile:
    """The wheel of the work tree, with bytecode lying about as it does after the first run."""
    source = tmp_path_factory.mktemp("source")
    for name in ("crew", *LINKS):
        shutil.copytree(ROOT / name, source / name, symlinks=True)
    for name in ("pyproject.toml", "README.md", "LICENSE"):
        shutil.copy(ROOT / name, source)
    built = run(sys.executable, "-c", "from setuptools.build_meta import build_wheel; build_wheel('dist')", cwd=source)
    assert built.returncode == 0, built.stderr
    (path,) = (source / "dist").glob("*.whl")
    return zipfile.ZipFile(path)


def test_wheel_holds_every_module_and_its_data_once(wheel: zipfile.ZipFile) -> None:
    packed = [name for name in wheel.namelist() if ".dist-info/" not in name]
    wanted = {
        str(path if path.parts[0] == "crew" else Path("crew") / path)
        for path in committed()
        if path.parts[0] in ("crew", *LINKS)
        and (path.suffix in {".py", *DATA} or path.name == "py.typed")
        and not (ROOT / path).is_symlink()
    }
    assert len(packed) == len(set(packed))
    assert wanted <= set(packed), f"missing from the wheel: {sorted(wanted - set(packed))}"
    assert {Path(name).suffix for name in packed} <= {".py", "", ".typed", *DATA}


def test_wheel_installs_nothing_beside_the_package(wheel: zipfile.ZipFile) -> None:
    tops = {name.partition("/")[0] for name in wheel.namelist()}
    assert {top for top in tops if not top.endswith(".dist-info")} == {"crew"}


def test_everything_that_demo_needs_is_in_all() -> None:
    extras = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]["optional-dependencies"]
    assert extras["all"] == [f"robot-crew[{','.join(sorted(extras.keys() - {'all', 'dev'}))}]"]
    assert extras["dev"][0] == "robot-crew[all]"


def test_licence_is_apache() -> None:
    text = (ROOT / "LICENSE").read_text()
    project = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
    assert project["license"] == "Apache-2.0"
    assert "Apache License" in text.splitlines()[0] + text.splitlines()[1]
    assert "Version 2.0, January 2004" in text
    assert "END OF TERMS AND CONDITIONS" in text

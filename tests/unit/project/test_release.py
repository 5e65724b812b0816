"""What a release says about itself, in one voice."""

import re
import tomllib
from importlib.metadata import version

from tests.unit.project.tree import ROOT

VERSION = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]["version"]


def test_installed_version_is_the_declared_one() -> None:
    assert version("robot-crew") == VERSION, "run make: pyproject.toml has changed since the installation"


def test_changelog_knows_the_version() -> None:
    sections = re.findall(r"^## \[([^\]]+)\](.*)$", (ROOT / "CHANGELOG.md").read_text(), re.MULTILINE)
    numbers = [number for number, _ in sections if number != "Unreleased"]
    assert numbers[0] == VERSION
    assert numbers == sorted(numbers, key=lambda n: [int(part) for part in n.split(".")], reverse=True)


def test_changelog_has_the_usual_sections() -> None:
    headings = set(re.findall(r"^### (.+)$", (ROOT / "CHANGELOG.md").read_text(), re.MULTILINE))
    assert headings <= {"Added", "Changed", "Deprecated", "Removed", "Fixed", "Security"}

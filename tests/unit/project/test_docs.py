"""The pages: links lead somewhere, commands exist, code parses, decisions are numbered and listed."""

import re
from collections.abc import Iterator
from pathlib import Path

import typer.main
from typer.core import TyperGroup

from crew.cli.main import app
from tests.unit.project.markdown import blocks
from tests.unit.project.tree import ROOT, committed

PAGES = [ROOT / path for path in committed() if path.suffix == ".md"]
DECISIONS = ROOT / "docs" / "decisions"


def test_relative_links_resolve() -> None:
    for page in PAGES:
        for target in re.findall(r"\]\(([^)\s]+)\)", page.read_text(encoding="utf-8")):
            if not re.match(r"[a-z]+:", target):
                path, _, anchor = target.partition("#")
                found = page.parent / path if path else page
                assert found.exists(), f"{page.name}: {target}"
                assert not anchor or anchor in anchors(found), f"{page.name}: {target}"


def test_named_commands_exist() -> None:
    for page in PAGES:
        for words in named_commands(page):
            command = typer.main.get_command(app)
            for word in words:
                if not isinstance(command, TyperGroup) or not re.fullmatch(r"[a-z]+", word):
                    break
                assert word in command.commands, f"{page.name}: crew {' '.join(words)}"
                command = command.commands[word]


def test_python_parses() -> None:
    for page in PAGES:
        for block in blocks(page):
            if block.info.partition(" ")[0] == "python":
                compile(block.text, f"{page.name}:{block.line}", "exec")


def test_every_block_names_its_language() -> None:
    for page in PAGES:
        assert all(block.info for block in blocks(page)), page


def test_decisions_are_numbered_and_listed() -> None:
    records = sorted(path for path in DECISIONS.glob("*.md") if path.name != "README.md")
    listed = re.findall(r"\(((\d{4})-[^)]+)\)", (DECISIONS / "README.md").read_text())
    assert [path.name for path in records] == [name for name, _ in listed]
    numbers = [path.name.partition("-")[0] for path in records]
    assert len(set(numbers)) == len(numbers)
    for number, path in zip(numbers, records, strict=True):
        assert re.fullmatch(r"\d{4}", number)
        assert path.read_text().startswith(f"# {number}. ")
        assert "**Decision.**" in path.read_text()


def named_commands(page: Path) -> Iterator[list[str]]:
    """The words after `crew` of every command that a page shows, inline or in a shell block."""
    text = page.read_text(encoding="utf-8")
    yield from (found.split() for found in re.findall(r"`crew ([^`/]+)`", text))
    for block in blocks(page):
        if block.info == "sh":
            yield from (line.split()[1:] for line in block.text.splitlines() if line.startswith("crew "))


def anchors(page: Path) -> set[str]:
    """Headings as a page's anchors are made from them."""
    headings = re.findall(r"^#+ (.+)$", page.read_text(encoding="utf-8"), re.MULTILINE)
    return {re.sub(r"[^a-z0-9 -]", "", heading.lower()).replace(" ", "-") for heading in headings}

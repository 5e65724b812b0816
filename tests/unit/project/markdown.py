"""Fenced blocks of a Markdown page, with the heading that they stand under."""

import re
from pathlib import Path
from typing import NamedTuple

_FENCE = re.compile(r"^```(.*)$")


class Block(NamedTuple):
    """One fenced block: its language (and what follows it), its text, and where it stands."""

    info: str
    text: str
    heading: str
    line: int


def blocks(page: Path) -> list[Block]:
    """All fenced blocks of a page, in order."""
    found: list[Block] = []
    lines: list[str] = []
    heading, opened = "", None
    for number, line in enumerate(page.read_text(encoding="utf-8").splitlines(), start=1):
        fence = _FENCE.match(line)
        if opened is None and line.startswith("#"):
            heading = line.lstrip("# ")
        elif fence is not None and opened is None:
            opened, lines = (fence[1], number), []
        elif fence is not None and opened is not None:
            found.append(Block(opened[0], "\n".join(lines), heading, opened[1]))
            opened = None
        elif opened is not None:
            lines.append(line)
    assert opened is None, f"{page}: a fence is not closed"
    return found

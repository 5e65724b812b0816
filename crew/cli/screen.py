"""A terminal that is drawn in place: plain ANSI, nothing but what has changed, and left as it was found."""

import os
import sys
import unicodedata
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from typing import NamedTuple

_COLOURS: Mapping[str, str] = {
    "": "0",
    "bold": "1",
    "dim": "2",
    "red": "31",
    "green": "32",
    "amber": "33",
    "blue": "34",
    "violet": "35",
    "teal": "36",
    "alarm": "1;37;41",
}
_ENTER = "\x1b[?1049h\x1b[?25l\x1b[2J"
_LEAVE = "\x1b[?25h\x1b[?1049l"


class Piece(NamedTuple):
    """Some text of a line in one colour."""

    text: str
    colour: str = ""


Line = Sequence[Piece]


def line(*pieces: str | Piece) -> Line:
    """A line; text without a colour is plain."""
    return tuple(Piece(p) if isinstance(p, str) else p for p in pieces)


def columns(text: str) -> int:
    """How many columns of a terminal a text takes."""
    return sum(_width(char) for char in text)


def fitted(text: str, width: int) -> str:
    """A text in exactly this many columns: cut with an ellipsis, or padded."""
    if columns(text) > width:
        kept, used = [], 0
        for char in text:
            if used + _width(char) > width - 1:
                break
            kept.append(char)
            used += _width(char)
        text = "".join(kept) + ("…" if width > 0 else "")
    return text + " " * (width - columns(text))


def can_draw() -> bool:
    """Whether standard output is a terminal that can be drawn on."""
    return sys.stdout.isatty() and os.environ.get("TERM", "dumb") != "dumb"


class Screen:
    """The terminal, for as long as it is being drawn on."""

    def __init__(self) -> None:
        self._shown: list[str] = []
        self._size = (0, 0)
        self._plain = bool(os.environ.get("NO_COLOR"))

    @property
    def size(self) -> tuple[int, int]:
        """Columns and rows, as they are now."""
        try:
            found = os.get_terminal_size(sys.stdout.fileno())
        except OSError:
            return 80, 24
        return max(found.columns, 20), max(found.lines, 5)

    def draw(self, lines: Sequence[Line]) -> None:
        """Show these lines; rows that have not changed are left alone."""
        size = self.size
        if size != self._size:
            self._size, self._shown = size, []
            _write("\x1b[2J")
        width, height = size
        fresh = [self._row(found, width) for found in lines[:height]]
        fresh += [""] * (height - len(fresh))
        changed = [(n, row) for n, row in enumerate(fresh) if n >= len(self._shown) or self._shown[n] != row]
        _write("".join(f"\x1b[{n + 1};1H\x1b[2K{row}" for n, row in changed))
        self._shown = fresh

    def _row(self, found: Line, width: int) -> str:
        parts, left = [], width
        for piece in found:
            text = piece.text if columns(piece.text) <= left else fitted(piece.text, left)
            left -= columns(text)
            bare = self._plain or not piece.colour
            parts.append(text if bare else f"\x1b[{_COLOURS[piece.colour]}m{text}\x1b[0m")
            if left <= 0:
                break
        return "".join(parts)


@contextmanager
def drawn_on() -> Iterator[Screen]:
    """The terminal's second page, and the first one again afterwards."""
    _write(_ENTER)
    try:
        yield Screen()
    finally:
        _write(_LEAVE)


def _width(char: str) -> int:
    if unicodedata.combining(char) or unicodedata.category(char) in ("Mn", "Me", "Cf"):
        return 0
    return 2 if unicodedata.east_asian_width(char) in ("W", "F") else 1


def _write(text: str) -> None:
    encoding = sys.stdout.encoding or "ascii"
    sys.stdout.write(text.encode(encoding, errors="replace").decode(encoding))
    sys.stdout.flush()

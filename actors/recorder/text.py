"""Text that strangers wrote, made fit to be drawn: a viewer without the right glyphs must not fall over it."""

import unicodedata

MAX_CHARS = 4000
"""More of one text is not shown; the journal has it all."""
_PLAIN = {"‘": "'", "’": "'", "“": '"', "”": '"', "–": "-", "—": "-", "…": "...", "\u00a0": " "}
_MARKDOWN = "\\`*_{}[]()<>#+-!|~$&"


def plain(text: str, limit: int = MAX_CHARS) -> str:
    """Latin letters, digits and common signs; accents are kept, everything else becomes `?`. Cut at `limit`."""
    cut = text[: limit + 1]
    shown = "".join(_fit(char) for char in cut[:limit])
    return f"{shown} [cut: {len(text)} characters]" if len(cut) > limit else shown


def one_line(text: str, limit: int = 300) -> str:
    """The same on one line."""
    return " ".join(plain(text, limit).split())


def quoted(text: str, limit: int = 300) -> str:
    """The same for a place inside markdown, where none of its signs may mean anything."""
    return "".join(f"\\{char}" if char in _MARKDOWN else char for char in one_line(text, limit))


def _fit(char: str) -> str:
    if char in "\n\t" or " " <= char <= "~" or "\u00a1" <= char <= "\u017f":
        return char
    if (simple := _PLAIN.get(char)) is not None:
        return simple
    folded = "".join(c for c in unicodedata.normalize("NFKD", char) if " " <= c <= "~")
    return folded or ("" if unicodedata.category(char) in ("Mn", "Cf", "Cc") else "?")

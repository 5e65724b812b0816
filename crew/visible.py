"""Text from outside, made safe to show: nothing in it moves a cursor, hides, or reorders what stands beside it."""

import unicodedata

LONGEST = 4_000
"""Characters of one text that are shown; the journal holds the whole."""
_KEPT = "\n\t"
_HIDDEN = frozenset({"Cc", "Cf", "Cs", "Co", "Zl", "Zp"})
_JOINERS = "\u200c\u200d"
"""Zero-width joiners belong to emoji and to many scripts; alone they are harmless."""


def visible(text: str, longest: int = LONGEST) -> str:
    """The text with control and format characters written out, and cut after `longest` characters."""
    if len(text) <= longest and text.isprintable():
        return text
    cut = "" if len(text) <= longest else f"... ({len(text) - longest} more characters; the journal holds them)"
    return "".join(map(_shown, text[:longest])) + cut


def one_line(text: str, longest: int = LONGEST) -> str:
    """The same without line breaks and tabs."""
    return " ".join(visible(text, longest).split())


def _shown(char: str) -> str:
    if char in _KEPT or char in _JOINERS or unicodedata.category(char) not in _HIDDEN:
        return char
    return f"\\u{{{ord(char):x}}}"

"""Planner text is drawn with the viewer's few letters, and means nothing in markdown."""

import pytest

from crew.actors.recorder.text import one_line, plain, quoted


@pytest.mark.parametrize(
    ("given", "shown"),
    [
        ("send the rover", "send the rover"),
        ("Schick den Rover zur Tür", "Schick den Rover zur Tür"),
        ("fly 🚁 now", "fly ? now"),
        ("ロボット", "????"),
        ("“quoted” – and… so", "\"quoted\" - and... so"),
        ("ﬁle", "file"),
        ("e\u0301", "e"),
        ("zero\u200bwidth", "zerowidth"),
        ("bell\x07", "bell"),
        ("\ud800", "?"),
    ],
)  # fmt: skip
def test_only_what_can_be_drawn_is_drawn(given: str, shown: str) -> None:
    assert plain(given) == shown


def test_long_text_is_cut_and_says_how_long_it_was() -> None:
    shown = plain("# title\n" * 12_800)
    assert len(shown) < 4100
    assert shown.endswith("[cut: 102400 characters]")


def test_markdown_of_a_stranger_is_only_text() -> None:
    assert quoted("| a | **b** | [x](http://y) <script> `c` # d") == (
        "\\| a \\| \\*\\*b\\*\\* \\| \\[x\\]\\(http://y\\) \\<script\\> \\`c\\` \\# d"
    )
    assert "\n" not in quoted("line\n# line\r\n- line")


def test_one_line_is_one_line() -> None:
    assert one_line("a\n b\t c \u2028 d") == "a b c ? d"

"""The report: everything from outside is text, nothing runs, and what can't be trusted says so first."""

import shutil
import sqlite3
from contextlib import closing
from html.parser import HTMLParser
from pathlib import Path
from typing import Any

import pytest

import tests.replay
from crew.contracts.plan import Call, Plan
from crew.errors import UsageError
from crew.home import Home
from crew.launch.reported import reported
from crew.report.html import Html, tag
from crew.report.page import write_report
from crew.visible import LONGEST, one_line, visible
from tests.unit.contracts.build import BASE_PLAN, FULL, SEARCH_AND_SEND, SEARCH_PLAN
from tests.unit.crew.history.golden import fix
from tests.unit.crew.history.staged import staged

GOLDEN = Path(tests.replay.__file__).parent
KEY = GOLDEN / "orchestrator.pub"
EVIL = (
    'search the area</blockquote><script>alert(1)</script>"><img src=x onerror=a()> 搜索 \U0001f681 \u202eexe \x1b[31m'
)
MAY = """html head meta title style body main header section h1 h2 h3 p span b strong mark blockquote ul li table thead
tbody tr th td dl dt dd pre code details summary div a br i svg g rect line circle path text"""
"""The elements that a page is made of; whatever can run or fetch is not among them."""


class Page(HTMLParser):
    """What a browser would make of a page: its elements, its text, its attributes."""

    def __init__(self, html: str) -> None:
        super().__init__()
        self.tags: list[str] = []
        self.attributes: list[tuple[str, str | None]] = []
        self.text = ""
        self.titles: list[str] = []
        self.feed(html)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.append(tag)
        self.attributes += attrs

    def handle_data(self, data: str) -> None:
        self.text += data
        if self.tags[-1:] == ["title"]:
            self.titles.append(data)


@pytest.fixture
def home(tmp_path: Path) -> Home:
    return Home(tmp_path / "home")


def report(folder: Path, home: Home, **more: Any) -> Page:
    path, _ = write_report(folder, home, **more)
    return Page(path.read_text(encoding="utf-8"))


def golden(name: str, tmp_path: Path, home: Home) -> Page:
    return report(GOLDEN / name, home, key_file=KEY, to=tmp_path / "page.html")


def harmless(page: Page) -> bool:
    return set(page.tags) <= set(MAY.split()) and not any(name.startswith("on") for name, _ in page.attributes)


def test_a_completed_run_is_told_from_the_request_to_the_end(tmp_path: Path, home: Home) -> None:
    page = golden("completed", tmp_path, home)
    assert harmless(page)
    assert "This run verifies" in page.text
    for words in ("operational_area", "its place is read when it is dispatched", "done, effect observed"):
        assert words in page.text
    assert f"target pinned to {fix()}" in page.text
    assert sum(tag == "summary" for tag in page.tags) == 6, "one for each decision"
    assert any(title.startswith("held for ") and "comes after report" in title for title in page.titles)
    assert any(title == f"iris published victim: ok at {fix()}" for title in page.titles)


def test_a_halted_run_says_why_with_the_line_and_what_would_have_been_accepted(tmp_path: Path, home: Home) -> None:
    page = golden("halted", tmp_path, home)
    assert "absent: iris reports" in page.text
    assert "do: {navigate_to: {target: $person}}" in page.text
    assert "It would have been accepted with: a fresh fix of victim by iris" in page.text
    assert "never sent" in page.text


def test_the_same_journal_gives_the_same_page(tmp_path: Path, home: Home) -> None:
    first, _ = write_report(GOLDEN / "halted", home, key_file=KEY, to=tmp_path / "a.html")
    second, _ = write_report(GOLDEN / "halted", home, key_file=KEY, to=tmp_path / "b.html")
    assert first.read_bytes() == second.read_bytes()


def test_text_from_outside_is_text_and_nothing_else(tmp_path: Path, home: Home) -> None:
    wild = Plan("search_only", (Call("<script>", 'fly"to', {"x</td>": "<b onclick=1>", "y": 1.0}),))
    with staged(tmp_path / "run", home) as stage:
        stage.mission(EVIL, SEARCH_PLAN, wild, name="m1")
        stage.note("stop", "<script>stop</script>")
    page = report(tmp_path / "run", home)
    assert harmless(page)
    assert "<script>alert(1)</script>" in page.text
    assert "搜索" in page.text
    assert "\U0001f681" in page.text
    assert "\\u{202e}exe" in page.text, "no character turns the text around"
    assert "\x1b" not in page.text
    assert ("content", "default-src 'none'; style-src 'unsafe-inline'") in page.attributes


def test_a_hundred_kilobytes_of_request_stay_a_short_page(tmp_path: Path, home: Home) -> None:
    with staged(tmp_path / "run", home) as stage:
        stage.mission("search " + "# lorem **ipsum** " * 6000, SEARCH_PLAN, SEARCH_PLAN)
    path, holds = write_report(tmp_path / "run", home)
    assert holds
    assert path.stat().st_size < 60_000
    assert "more characters; the journal holds them" in path.read_text()


def test_several_missions_are_listed_and_told(tmp_path: Path, home: Home) -> None:
    with staged(tmp_path / "run", home) as stage:
        stage.mission("send the rover to base", BASE_PLAN, name="m1")
        stage.mission(SEARCH_AND_SEND, FULL, name="m2", blind=True)
        stage.mission("make me a sandwich", name="m3")
        stage.mission("send the rover to base twice", BASE_PLAN, name="m4", answer=False)
    page = report(tmp_path / "run", home)
    assert [value for name, value in page.attributes if name == "href"] == [f"#mission-m{n}" for n in (1, 2, 3, 4)]
    assert "A person was asked: I did not understand 'twice'" in page.text
    assert "The answer was no." in page.text
    assert "'sandwich' in the request is no name that this crew knows" in page.text


def test_of_many_missions_the_last_are_told_and_all_are_listed(tmp_path: Path, home: Home) -> None:
    with staged(tmp_path / "run", home) as stage:
        for number in range(4):
            stage.mission("send the rover to base", BASE_PLAN, name=f"m{number}")
    path, _ = write_report(tmp_path / "run", home, most=2)
    page = Page(path.read_text())
    sections = [value for name, value in page.attributes if name == "id"]
    assert sections == ["mission-m2", "mission-m3"]
    assert page.text.count("send the rover to base") == 4 + 2, "listed all, told two"
    assert "Of the first 2 missions no more is told here" in page.text


def test_a_run_without_missions_has_a_page(tmp_path: Path, home: Home) -> None:
    with staged(tmp_path / "run", home):
        pass
    assert "No mission was asked for" in report(tmp_path / "run", home).text


def test_a_run_that_was_killed_has_a_page_that_says_where_it_ends(tmp_path: Path, home: Home) -> None:
    with staged(tmp_path / "run", home) as stage:
        stage.mission(SEARCH_AND_SEND, FULL, dies_after="search_target")
    page = report(tmp_path / "run", home)
    assert "not ended, executing" in page.text
    assert "running when the journal ends" in page.text


@pytest.mark.parametrize(
    ("statement", "found"),
    [
        ("UPDATE record SET at_ns = at_ns + 1 WHERE seq = 20", "record 20 was altered"),
        ("DELETE FROM record WHERE seq > 30", "the tail is cut"),
        ("DELETE FROM record", "the journal is empty"),
    ],
)
def test_an_altered_run_says_so_before_anything_else(tmp_path: Path, home: Home, statement: str, found: str) -> None:
    shutil.copytree(GOLDEN, tmp_path / "replay")
    with closing(sqlite3.connect(tmp_path / "replay" / "halted" / "journal.db")) as connection:
        connection.execute(statement)
        connection.commit()
    key = tmp_path / "replay" / KEY.name
    page = report(tmp_path / "replay" / "halted", home, key_file=key, to=tmp_path / "page.html")
    assert "This run verifies" not in page.text
    loud, _, rest = page.text.partition("DO NOT RELY ON THIS RUN")
    assert found in rest
    assert "What was asked" not in loud


def test_no_run_no_page(tmp_path: Path, home: Home) -> None:
    with pytest.raises(UsageError, match="crew runs"):
        write_report(tmp_path, home)


# --- at the end of a run


def test_a_run_ends_with_its_report(tmp_path: Path, home: Home) -> None:
    with reported(tmp_path / "run", home), staged(tmp_path / "run", home) as stage:
        stage.mission("send the rover to base", BASE_PLAN)
    assert "This run verifies" in (tmp_path / "run" / "report.html").read_text()


def test_a_report_that_fails_changes_nothing_else(
    tmp_path: Path, home: Home, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "run" / "report.html").mkdir(parents=True)
    (tmp_path / "run" / "journal.db").write_bytes(b"no database")
    with pytest.raises(KeyError, match="the run's own trouble"), reported(tmp_path / "run", home):
        raise KeyError("the run's own trouble")
    assert "crew report" in capsys.readouterr().err


def test_a_run_that_never_began_leaves_no_report(tmp_path: Path, home: Home) -> None:
    with reported(tmp_path, home):
        pass
    assert list(tmp_path.iterdir()) == []


# --- markup and text


def test_only_markup_made_here_is_markup() -> None:
    assert tag("p", "<b>", Html("<i></i>"), title='"<') == '<p title="&quot;&lt;">&lt;b&gt;<i></i></p>'
    assert tag("details", open=None) == "<details></details>"


def test_invisible_characters_are_written_out() -> None:
    assert visible("a\u202eb\x1b[0m\u200b\ud800") == "a\\u{202e}b\\u{1b}[0m\\u{200b}\\u{d800}"
    assert visible("\U0001f468\u200d\U0001f33e\n\tx") == "\U0001f468\u200d\U0001f33e\n\tx"
    assert one_line("a\n b\tc") == "a b c"
    assert visible("x" * (LONGEST + 5)).endswith("... (5 more characters; the journal holds them)")

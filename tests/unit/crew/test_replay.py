"""`crew replay` and its mistakes: each ends in a sentence."""

import shutil
import socket
import urllib.error
import urllib.request
from pathlib import Path

import pytest

from crew.actors.recorder import viewer_program
from crew.actors.recorder.rrd import FILE
from crew.cli.replay import run_replay
from crew.cli.viewer import served, show_on_screen, web_viewer
from crew.errors import UsageError
from crew.home import Home
from tests.replay.make import HERE


@pytest.fixture
def run(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("CREW_HOME", str(tmp_path / "home"))
    monkeypatch.delenv("DISPLAY", raising=False)
    monkeypatch.delenv("WAYLAND_DISPLAY", raising=False)
    shutil.copytree(HERE / "halted", tmp_path / "runs" / "halted")
    return tmp_path / "runs" / "halted"


def replay(run: Path, *, web: bool = False, port: int = 0) -> None:
    run_replay(run, run.parent, web, port, False)


def test_a_run_that_is_not_there(run: Path) -> None:
    with pytest.raises(UsageError, match=r"no run in .*list them with crew runs"):
        replay(run.with_name("none"))


def test_a_run_that_still_runs(run: Path) -> None:
    home = Home(run.parents[1] / "home")
    with home.claim("air_ground", run, "tcp/127.0.0.1:1", ""), pytest.raises(UsageError, match=r"still runs.*--view"):
        replay(run)


def test_no_display(run: Path) -> None:
    with pytest.raises(UsageError, match=r"no display here.*--web"):
        replay(run)
    assert (run / FILE).is_file(), "drawn from the journal all the same"


def test_a_port_in_use(run: Path) -> None:
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        taken.listen()
        with pytest.raises(UsageError, match=r"cannot serve the page on 127.0.0.1.*choose another --port"):
            replay(run, web=True, port=taken.getsockname()[1])


def test_a_port_that_is_none(run: Path) -> None:
    with pytest.raises(UsageError, match=r"cannot serve the page on 127.0.0.1:70000"):
        replay(run, web=True, port=70_000)


def test_a_viewer_that_is_not_installed(run: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(viewer_program, "PACKAGE", "no_such_package")
    with pytest.raises(UsageError, match=r"install robot-crew\[view\]"):
        replay(run)


def test_the_file_is_served_on_loopback_and_nothing_else_is(tmp_path: Path) -> None:
    (tmp_path / FILE).write_bytes(b"a recording")
    with served(tmp_path / FILE, FILE) as address:
        assert address.startswith("http://127.0.0.1:")
        with urllib.request.urlopen(address) as answer:
            assert answer.read() == b"a recording"
            assert answer.headers["Access-Control-Allow-Origin"] == "*"
        for other in ("/", "/../home", "/journal.db"):
            with pytest.raises(urllib.error.HTTPError, match="404"):
                urllib.request.urlopen(address.removesuffix(f"/{FILE}") + other)


def test_the_web_viewer_lives_no_longer_than_it_is_wanted() -> None:
    with web_viewer("http://127.0.0.1:1/run.rrd", 0) as address:
        page = address.partition("?")[0]
        with urllib.request.urlopen(page) as answer:
            assert b"<html" in answer.read().lower()
    with pytest.raises(urllib.error.URLError):
        urllib.request.urlopen(page)


def test_a_screen_is_needed_for_the_native_viewer(tmp_path: Path) -> None:
    with pytest.raises(UsageError, match="no display"):
        show_on_screen(tmp_path / FILE, {})

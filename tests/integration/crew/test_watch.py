"""`crew watch` on a terminal and without one, with a crew that works."""

import fcntl
import os
import pty
import re
import select
import signal
import struct
import termios
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from tests.integration.crew.harness import CREW, Desk, Up

COLUMNS, ROWS = 110, 40
ROW = re.compile(r"\x1b\[(\d+);1H\x1b\[2K([^\r\n]*?)(?=\x1b\[\d+;1H|\x1b\[\?|\x1b\[2J|$)", re.DOTALL)


class Terminal:
    """A pseudo-terminal that a command runs in, and the page that it has drawn there."""

    def __init__(self, desk: Desk, *args: str) -> None:
        self.pid, self._fd = pty.fork()
        if self.pid == 0:
            os.chdir(desk.folder)
            os.execve(CREW, [str(CREW), *args], {**desk.env, "TERM": "xterm", "COLUMNS": "", "LINES": ""})
        fcntl.ioctl(self._fd, termios.TIOCSWINSZ, struct.pack("HHHH", ROWS, COLUMNS, 0, 0))
        self.written = ""

    @property
    def page(self) -> str:
        """The rows as they stand, without colours."""
        rows = {int(n): re.sub(r"\x1b\[[0-9;]*m", "", text) for n, text in ROW.findall(self.written)}
        return "\n".join(rows[n].rstrip() for n in sorted(rows))

    def until(self, words: str, seconds: float = 40.0) -> str:
        """Read until the page shows this."""
        deadline = time.monotonic() + seconds
        while words not in self.page:
            assert time.monotonic() < deadline, f"never shown: {words!r}\n{self.page}"
            self.read()
        return self.page

    def read(self) -> bool:
        if select.select([self._fd], [], [], 0.1)[0]:
            try:
                self.written += os.read(self._fd, 65536).decode(errors="replace")
            except OSError:
                return False
        return True

    def interrupt(self) -> int:
        """Ctrl-C; the exit status."""
        os.kill(self.pid, signal.SIGINT)
        return self.wait()

    def wait(self) -> int:
        while self.read() and os.waitid(os.P_PID, self.pid, os.WEXITED | os.WNOWAIT | os.WNOHANG) is None:
            pass
        return os.waitstatus_to_exitcode(os.waitpid(self.pid, 0)[1])


@contextmanager
def terminal(desk: Desk, *args: str) -> Iterator[Terminal]:
    shown = Terminal(desk, *args)
    try:
        yield shown
    finally:
        try:
            os.kill(shown.pid, signal.SIGKILL)
            os.waitpid(shown.pid, 0)
        except (ProcessLookupError, ChildProcessError):
            pass


def test_a_terminal_shows_steps_holds_progress_and_questions(desk: Desk, up: Up) -> None:
    with terminal(desk, "watch") as shown:
        shown.until("no mission yet")
        search = desk.spawn("request", "search the area and send the rover to the victim")
        shown.until("held: waits for report (iris)")
        shown.until("m to go")
        desk.crew("request", "send the rover to base twice", "--json")
        shown.until("I did not understand 'twice'")
        asked = re.search(r"no: crew confirm (\w+) --no", shown.until("--no"))
        assert asked is not None
        shown.until("battery")
        assert desk.crew("confirm", asked[1], "--no").returncode == 0
        shown.until("the person did not confirm")
        shown.until("completed", 120.0)
        assert search.process.wait(60) == 0
        assert shown.interrupt() == 130
    assert shown.written.endswith("\x1b[?25h\x1b[?1049l"), "the terminal is as it was"


def test_without_a_terminal_it_is_one_line_an_event(desk: Desk, up: Up) -> None:
    for flags, words in (([], "says it is done"), (["--json"], '"what":"end"')):
        watch = desk.spawn("watch", *flags)
        if not flags:
            watch.await_said("watching", 20)
        else:
            time.sleep(1.0)
        assert desk.crew("request", "send the rover to (-3, -3)").returncode == 0
        watch.await_said(words, 20)
        said = watch.said
        watch.process.send_signal(signal.SIGINT)
        watch.process.wait(10)
        assert "\x1b" not in said


def test_a_crew_that_comes_down_ends_the_watch(desk: Desk, tmp_path: Path) -> None:
    other = Desk(tmp_path)
    with other.up() as up, terminal(other, "watch") as shown:
        shown.until("no mission yet")
        up.end()
        assert shown.wait() == 0
    assert "is down; what it did: crew report" in shown.written

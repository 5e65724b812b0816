"""The README is run: every shell command, the ten lines of Python, and the output that it shows."""

import os
import re
import shlex
import signal
import socket
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path

import pytest

from crew.contracts.codes import GROUP_OF, Group
from tests.unit.project.markdown import Block, blocks

ROOT = Path(__file__).parents[2]
README = ROOT / "README.md"
BIN = Path(sys.executable).parent
PORT = 7447
UP = "crew up --speed max"
EXPECTED = {
    "crew demo --fault tb3_unavailable": 4,
    'crew planner try "Send the rover to room_b"': 3,
}
"""Commands whose exit code is not 0, as the README says beside them."""


def section(heading: str, info: str) -> list[Block]:
    found = [b for b in blocks(README) if b.heading == heading and b.info == info]
    assert found, f"README.md has no {info} block under {heading!r}"
    return found


def commands(heading: str) -> list[str]:
    return [line for block in section(heading, "sh") for line in block.text.splitlines()]


class Folder:
    """A folder to run commands in, with a state folder of its own."""

    def __init__(self, path: Path) -> None:
        self.path = path
        self.environment = {
            **os.environ,
            "CREW_HOME": str(path / "home"),
            "PATH": f"{BIN}{os.pathsep}{os.environ.get('PATH', '')}",
        }

    def run(self, *command: str, timeout_s: float = 120.0) -> "subprocess.CompletedProcess[str]":
        return subprocess.run(
            command,
            cwd=self.path,
            env=self.environment,
            capture_output=True,
            text=True,
            stdin=subprocess.DEVNULL,
            timeout=timeout_s,
        )


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Folder:
    return Folder(tmp_path_factory.mktemp("readme"))


@pytest.fixture
def elsewhere(tmp_path: Path) -> Folder:
    """Where the running crew is not known, so that a second one may be brought up."""
    return Folder(tmp_path)


@pytest.fixture(scope="module")
def running_crew(folder: Folder) -> Iterator[None]:
    """The crew that the README brings up, on the port that it names."""
    await_free_port()
    log = folder.path / "up.log"
    with log.open("w") as output:
        process = subprocess.Popen(
            shlex.split(UP),
            cwd=folder.path,
            env=folder.environment,
            stdout=output,
            stderr=subprocess.STDOUT,
            stdin=subprocess.DEVNULL,
        )
    try:
        deadline = time.monotonic() + 90
        while "is up after" not in log.read_text():
            assert process.poll() is None, f"no crew: {log.read_text()}"
            assert time.monotonic() < deadline, f"no crew within 90 s: {log.read_text()}"
            time.sleep(0.05)
        yield
        process.send_signal(signal.SIGINT)
        assert process.wait(10) == 0, log.read_text()
    finally:
        process.kill()
        process.wait()


def await_free_port() -> None:
    """Another test run may hold the port for a while; a crew that somebody left running holds it for good."""
    deadline = time.monotonic() + 60
    while True:
        with socket.socket() as probe:
            probe.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
            try:
                probe.bind(("127.0.0.1", PORT))
                return
            except OSError:
                if time.monotonic() > deadline:
                    pytest.fail(f"port {PORT} is taken on this machine (ss -ltnp): end the crew that is up and rerun")
        time.sleep(0.5)


def test_ten_lines_reach_a_crew_and_see_its_mission_end(folder: Folder, running_crew: None) -> None:
    (block,) = section("With only a Zenoh client", "python")
    assert len(block.text.splitlines()) == 10
    script = folder.path / "ten_lines.py"
    script.write_text(block.text + "\n")
    done = folder.run(sys.executable, "-I", str(script))
    assert done.returncode == 0, done.stderr
    heard = done.stdout.splitlines()
    assert heard[0] == 'request: "Search the area and send the rover to the victim"'
    assert heard[-1].startswith("completed: ")


def test_commands_to_a_running_crew(folder: Folder, running_crew: None) -> None:
    up, *others = commands("Command a crew")
    assert up == UP
    for command in [c for c in others if not c.startswith("crew demo")]:
        done = folder.run(*shlex.split(command))
        for _ in range(20):
            if "still carrying out its stop" not in done.stdout:
                break
            time.sleep(0.5)
            done = folder.run(*shlex.split(command))
        assert done.returncode == 0, f"{command}: {done.stdout}{done.stderr}"


def test_commands_that_look_at_a_run(folder: Folder, running_crew: None) -> None:
    for command in commands("Look at a run"):
        done = folder.run(*shlex.split(command))
        assert done.returncode == 0, f"{command}: {done.stdout}{done.stderr}"


def test_fault_halts_the_demo(elsewhere: Folder) -> None:
    (command,) = [c for c in commands("Command a crew") if c.startswith("crew demo")]
    done = elsewhere.run(*shlex.split(command))
    assert done.returncode == EXPECTED[command], f"{done.stdout}{done.stderr}"


def test_demo_prints_what_the_readme_shows(elsewhere: Folder) -> None:
    (shown,) = section("What you should see", "text")
    done = elsewhere.run(*made("make demo"))
    assert done.returncode == 0, done.stderr
    assert_shown(shown.text, done.stdout)


def test_planner_try_prints_what_the_readme_shows(elsewhere: Folder) -> None:
    (command,) = commands("How a mission is decided")
    (shown,) = section("How a mission is decided", "text")
    done = elsewhere.run(*shlex.split(command))
    assert done.returncode == EXPECTED[command], done.stderr
    assert [line.rstrip() for line in done.stdout.splitlines()] == shown.text.splitlines()


def test_make_test_runs_this_suite() -> None:
    assert "make test" in commands("Run it")
    assert made("make test")[1:] == ["-m", "pytest"]


def test_every_command_is_run_by_a_test_here() -> None:
    run = {
        line
        for heading in ("Run it", "Command a crew", "Look at a run", "How a mission is decided")
        for line in commands(heading)
    }
    assert {line for b in blocks(README) if b.info == "sh" for line in b.text.splitlines()} == run
    assert {b.info for b in blocks(README)} == {"sh", "text", "python", "mermaid"}
    assert [b.heading for b in blocks(README) if b.info in ("text", "python")] == [
        "What you should see",
        "With only a Zenoh client",
        "How a mission is decided",
    ]


def test_table_of_codes_is_the_gates_own() -> None:
    rows = re.findall(r"^\| ([a-z -]+) \| [^|]+ \| ((?:`[a-z_]+` ?)+) \|$", README.read_text(), re.MULTILINE)
    assert {name: re.findall(r"`([a-z_]+)`", codes) for name, codes in rows} == {
        str(group): [str(code) for code, of in GROUP_OF.items() if of is group] for group in Group
    }


def made(target: str) -> list[str]:
    """The last command of a make target, as the Makefile gives it."""
    from_outside = {"MAKEFLAGS", "MFLAGS", "MAKELEVEL", "MAKEOVERRIDES", "ARGS", "CREW"}
    listed = subprocess.run(
        [*shlex.split(target), "--dry-run", "--no-print-directory"],
        cwd=ROOT,
        env={name: value for name, value in os.environ.items() if name not in from_outside},
        capture_output=True,
        text=True,
        check=True,
        timeout=20,
    )
    first, *others = shlex.split(listed.stdout.splitlines()[-1])
    return [Path(first).name, *others]


def assert_shown(shown: str, printed: str) -> None:
    """Every shown line was printed, in order; `...` stands for lines left out, and numbers and folders may differ."""
    lines = iter(normal(line) for line in printed.splitlines())
    gap = False
    for line in shown.splitlines():
        if line == "...":
            gap = True
            continue
        if gap:
            assert any(normal(line) == other for other in lines), f"never printed: {line!r}\n{printed}"
        else:
            assert next(lines, None) == normal(line), f"not printed here: {line!r}\n{printed}"
        gap = False


def normal(line: str) -> str:
    """A line without its digits, its folders and its padding."""
    return re.sub(r"\s+", " ", re.sub(r"-?\d+(\.\d+)?", "#", re.sub(r"/\S+/", "/", line))).strip()

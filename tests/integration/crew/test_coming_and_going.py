"""How a crew comes up, or says why it does not; and how nothing of it is left when it ends."""

import signal
import socket
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

import crew
from tests.integration.crew.harness import (
    FAR_DRIVE,
    SHORT_DRIVE,
    SHORT_SEARCH,
    UP_S,
    Desk,
    Up,
    alive,
    wait_until,
    watching,
)

GONE_S = 15.0
"""On a machine that does other things as well; `make bench` measures the time."""
PARTS = {"router", "simulation", "iris", "tb3", "orchestrator", "planner", "gateway", "recorder"}
CREW_FILE = Path(crew.__file__).parent / "crews" / "air_ground.yaml"


@pytest.fixture
def desk(tmp_path: Path) -> Iterator[Desk]:
    desk = Desk(tmp_path)
    yield desk
    desk.end_all()


def demo_in_flight(desk: Desk) -> Up:
    """A demo whose mission has begun."""
    demo = desk.spawn("demo", "--speed", "2")
    demo.await_said("takeoff has begun", 40.0)
    return demo


def crew_up(desk: Desk) -> Up:
    up = desk.spawn("up", "--port", "0")
    up.await_said("end: Ctrl-C", UP_S)
    return up


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM], ids=["ctrl-c", "sigterm"])
@pytest.mark.parametrize("begin", [crew_up, demo_in_flight])
def test_a_signal_ends_everything_without_a_traceback(desk: Desk, begin: Callable[[Desk], Up], number: int) -> None:
    command = begin(desk)
    children = command.children()
    pids = [command.process.pid, *children.values()]
    assert set(children) == PARTS
    command.signal(number)
    assert wait_until(lambda: command.process.poll() is not None, GONE_S), command.said
    assert not any(alive(pid) for pid in pids)
    assert "Traceback" not in command.said
    assert "Error" not in command.said
    assert desk.home.all_running() == []


def test_a_signal_while_the_crew_comes_up_ends_everything(desk: Desk) -> None:
    up = desk.spawn("up", "--port", "0")
    assert wait_until(lambda: len(up.children()) >= 3, 20.0)
    pids = list(up.children().values())
    up.signal(signal.SIGINT)
    assert wait_until(lambda: up.process.poll() is not None, GONE_S), up.said
    assert not any(alive(pid) for pid in pids)
    assert "Traceback" not in up.said


def test_nothing_survives_a_killed_supervisor(desk: Desk) -> None:
    up = crew_up(desk)
    pids = up.children()
    up.process.kill()
    up.process.wait()
    assert wait_until(lambda: not any(alive(pid) for pid in pids.values()), GONE_S)
    assert desk.home.all_running() == []
    status = desk.crew("status")
    assert status.returncode == 2
    assert "no crew runs here" in status.stderr
    with desk.up() as again:
        assert again.children().keys() == pids.keys()


def test_a_second_crew_of_the_same_name_is_refused_and_harms_nobody(desk: Desk) -> None:
    with desk.up() as up:
        second = desk.crew("up", "--port", "0")
        assert second.returncode == 2
        assert f"process {up.process.pid}" in second.stderr
        assert "already runs" in second.stderr
        assert desk.crew("demo", "--json", "--request", SHORT_DRIVE).returncode == 2
        done = desk.crew("request", SHORT_DRIVE)
        assert done.returncode == 0, done.stdout


def test_a_port_in_use_is_named_with_what_to_do(desk: Desk) -> None:
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        taken.listen()
        port = taken.getsockname()[1]
        up = desk.crew("up", "--port", str(port))
    assert up.returncode == 2
    assert f"127.0.0.1:{port}" in up.stderr
    assert "choose another port" in up.stderr
    assert "Traceback" not in up.stderr


@pytest.fixture
def half(desk: Desk) -> Iterator[Up]:
    """A crew whose drone answers to a system id that no vehicle has."""
    text = CREW_FILE.read_text()
    assert "options: {fov_x_deg: 80" in text
    mine = desk.folder / "half.yaml"
    mine.write_text(
        text.replace("options: {fov_x_deg: 80", "options: {system_id: 99, connect_timeout_s: 3, fov_x_deg: 80")
    )
    up = desk.spawn("up", str(mine), "--port", "0", "--speed", "max")
    try:
        up.await_said("end: Ctrl-C", UP_S)
        yield up
    finally:
        up.end()


async def test_a_crew_comes_up_without_a_robot_that_is_not_found(desk: Desk, half: Up) -> None:
    line = next(line for line in half.said.splitlines() if line.strip().startswith("iris"))
    assert "not available" in line
    assert "99" in line, "it says which vehicle it looked for"
    assert "99" in desk.crew("status").stdout
    async with watching(half.running) as watch:
        search = await watch.mission(SHORT_SEARCH)
        assert (search.outcome, search.code) == ("rejected", "robot_unavailable")
        assert (await watch.mission(FAR_DRIVE)).outcome == "completed"

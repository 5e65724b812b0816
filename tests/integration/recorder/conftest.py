import re
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

from tests.integration.crew.harness import Demo, Desk
from tests.integration.recorder.browser import Viewer

WEB_S = 30.0


@pytest.fixture(scope="session")
def desk(demo_desk: Desk) -> Desk:
    return demo_desk


@pytest.fixture(scope="session")
def runs(desk: Desk, completed: Demo) -> dict[str, Path]:
    """Three runs as a user makes them, by how they end."""
    demos = {
        "completed": completed,
        "halted": desk.demo("--fault", "missed_detection"),
        "rejected": desk.demo("--request", "Send the rover to room_b"),
    }
    assert {name: demo.result["outcome"] for name, demo in demos.items()} == {name: name for name in demos}
    return {name: demo.run for name, demo in demos.items()}


@pytest.fixture(scope="module")
def viewer() -> Iterator[Viewer]:
    """One browser for one module: while it is open, an event loop of its own runs on this thread."""
    with Viewer.opened() as viewer:
        yield viewer


@contextmanager
def shown(desk: Desk, run: Path, *args: str) -> Iterator[str]:
    """`crew replay --web` of a run until the block ends; the address that it prints."""
    replay = desk.spawn("replay", str(run), "--web", *args)
    try:
        replay.await_said("end: Ctrl-C", WEB_S)
        found = re.search(r"http://\S+", replay.said)
        assert found is not None, replay.said
        yield found[0]
    finally:
        replay.end()

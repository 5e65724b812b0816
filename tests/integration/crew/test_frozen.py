"""Parts that are frozen, not dead: missed by their token though their process is there, taken back when they wake."""

import asyncio
import os
import signal
from collections.abc import AsyncIterator, Iterator

import pytest

from tests.integration.crew.harness import FAR_DRIVE, SHORT_DRIVE, Desk, Up, Watch, watching


@pytest.fixture(scope="module")
def desk(tmp_path_factory: pytest.TempPathFactory) -> Desk:
    return Desk(tmp_path_factory.mktemp("frozen"))


@pytest.fixture(scope="module")
def up(desk: Desk) -> Iterator[Up]:
    with desk.up() as up:
        yield up


@pytest.fixture
async def watch(up: Up) -> AsyncIterator[Watch]:
    async with watching(up.running) as watch:
        await watch.until(lambda: {"iris", "tb3"} <= watch.states.keys(), why="states")
        yield watch


class Missed:
    """Freezes one part of the crew until its token is gone, and wakes it up at the end."""

    def __init__(self, watch: Watch, up: Up, name: str) -> None:
        self.alive = {name: True}
        self._name, self._watch, self._pid = name, watch, up.children()[name]
        self._token = watch.bus.watch_liveliness(watch.keys.alive(name), self._note)

    async def __aenter__(self) -> None:
        os.kill(self._pid, signal.SIGSTOP)
        await self._watch.until(lambda: not self.alive[self._name], 10.0, f"{self._name} is missed")

    async def __aexit__(self, *_: object) -> None:
        os.kill(self._pid, signal.SIGCONT)
        await self._watch.until(lambda: self.alive[self._name], 20.0, f"{self._name} is back")
        self._token.close()

    def _note(self, key: str, alive: bool) -> None:
        self.alive[self._name] = alive


async def test_without_its_planner_a_crew_rejects_at_once_and_plans_again_afterwards(watch: Watch, up: Up) -> None:
    async with Missed(watch, up, "planner"):
        ended = await watch.mission(SHORT_DRIVE, 20.0)
        assert ended.outcome == "rejected"
        assert "the planner is not there" in ended.text
    await watch.drives()


async def test_a_frozen_gateway_or_recorder_stops_no_mission(watch: Watch, up: Up) -> None:
    for name in ("gateway", "recorder"):
        drive = watch.ask(FAR_DRIVE)
        await watch.moving("tb3")
        async with Missed(watch, up, name):
            ended = await watch.ended(drive)
            assert ended.outcome == "completed", f"{name}: {ended.text}"
        await watch.drives()


async def test_a_frozen_robot_ends_its_mission_and_no_other(watch: Watch, up: Up) -> None:
    drive = watch.ask(FAR_DRIVE)
    await watch.moving("tb3")
    async with Missed(watch, up, "tb3"):
        ended = await watch.ended(drive)
        assert ended.outcome == "halted"
        refused = await watch.mission(SHORT_DRIVE)
        assert (refused.outcome, refused.code) == ("rejected", "robot_unavailable")
    await watch.until(lambda: not watch.states["tb3"].unavailable, why="it serves again")
    for _ in range(20):
        if (await watch.mission(SHORT_DRIVE)).outcome == "completed":
            return
        await asyncio.sleep(0.5)
    raise AssertionError("the rover does not drive again")

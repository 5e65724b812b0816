"""What the orchestrator watches of its crew and of itself: who comes back busy, and its own standstill."""

import asyncio
import time
from collections.abc import AsyncIterator
from typing import Any

import pytest

from crew.actors.orchestrator import watch as watch_module
from crew.actors.orchestrator.watch import CrewWatch
from crew.actors.orchestrator.world import WorldFold
from crew.bus.fabric import MemoryFabric
from crew.bus.memory import MemoryBus
from crew.contracts.language.mention import Reading
from crew.contracts.mission_state import MissionState
from crew.keys import Keys
from crew.messages import RobotCard, RobotState
from crew.signing import SigningKey
from tests.unit.actors.stage import air_ground

BOTH = ["iris", "tb3"]


class FakeLedger:
    def __init__(self) -> None:
        self.notes: list[str] = []

    def note(self, what: str, text: str) -> None:
        self.notes.append(what)


class FakeShell:
    """Missions that are open, and what was asked of the dispatcher."""

    def __init__(self) -> None:
        self.open: list[MissionState] = []
        self.dispatcher = self
        self.lost: list[tuple[str, str]] = []
        self.orphans: list[tuple[str, str]] = []
        self.doubted = 0

    def lose(self, robot: str, why: str, code: str = "robot_lost") -> None:
        self.lost.append((robot, code))

    def stood_still(self, why: str) -> None:
        self.doubted += 1

    def end_orphan(self, robot: str, running: str) -> None:
        self.orphans.append((robot, running))


class Watched:
    """A watch that runs, and the world that it looks at."""

    def __init__(self, world: WorldFold, shell: FakeShell, ledger: FakeLedger) -> None:
        self.world, self.shell, self.ledger = world, shell, ledger

    def says(self, running: str) -> None:
        """The rover's state."""
        self.world.take_state(RobotState(robot="tb3", boot_id="b", at_ns=1, running=running, told=(1, 0)), now_ns=1)


@pytest.fixture
async def watched(monkeypatch: pytest.MonkeyPatch) -> AsyncIterator[Watched]:
    monkeypatch.setattr(watch_module, "WATCH_EVERY_S", 0.01)
    rules, shell, ledger = air_ground(), FakeShell(), FakeLedger()
    world = WorldFold(rules)
    for robot, kind in (("iris", "quadcopter"), ("tb3", "rover")):
        card = RobotCard(robot=robot, kind=kind, kind_digest="d", boot_id="b", adapter="mavlink", simulated=True)
        world.take_card(card)
    with MemoryFabric() as fabric:
        async with MemoryBus(fabric) as bus:
            told: Any = ledger
            missions: Any = shell
            watch = CrewWatch(bus, Keys("air_ground"), rules, world, told, missions, 1, SigningKey(bytes(32)))
            task = asyncio.create_task(watch.run())
            await asyncio.sleep(0.05)
            yield Watched(world, shell, ledger)
            task.cancel()


async def test_an_orchestrator_that_stood_still_takes_every_outcome_as_unknown_once(
    watched: Watched, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(watch_module, "STOOD_STILL_NS", 200_000_000)
    time.sleep(0.3)  # noqa: ASYNC251
    await asyncio.sleep(0.05)
    assert watched.shell.lost == [(robot, "orchestrator_lost") for robot in BOTH]
    assert watched.ledger.notes.count("stood_still") == 1
    assert watched.shell.doubted == 1, "and so is what was being looked for"


async def test_one_that_turns_loses_nobody(watched: Watched) -> None:
    await asyncio.sleep(0.1)
    assert watched.shell.lost == []


async def test_what_a_robot_does_for_a_mission_that_is_over_is_cancelled_once(watched: Watched) -> None:
    watched.says("m9/2")
    await asyncio.sleep(0.1)
    assert watched.shell.orphans == [("tb3", "m9/2")]
    assert "orphan" in watched.ledger.notes
    watched.says("")
    watched.says("m9/3")
    await asyncio.sleep(0.1)
    assert watched.shell.orphans[1:] == [("tb3", "m9/3")]


async def test_what_a_robot_does_for_a_mission_that_goes_on_is_left_alone(watched: Watched) -> None:
    watched.shell.open = [MissionState(id="m9", request="go", reading=Reading(text="go"))]
    watched.says("m9/2")
    await asyncio.sleep(0.1)
    assert watched.shell.orphans == []

"""Parts that are frozen, not dead: missed by their token though their process is there, taken back when they wake."""

import asyncio
import math
import os
import signal
from collections.abc import AsyncIterator, Sequence
from contextlib import asynccontextmanager

import pytest

from crew.launch.ready import query_status
from tests.integration.crew.harness import FAR_DRIVE, SEARCH, SHORT_DRIVE, Desk, Up, Watch, alive, intents, watching

BOTH = ("iris", "tb3")


@pytest.fixture
async def watch(up: Up) -> AsyncIterator[Watch]:
    async with watching(up.running) as watch:
        await watch.until(lambda: set(BOTH) <= watch.states.keys(), why="states")
        yield watch


@asynccontextmanager
async def frozen(watch: Watch, up: Up, name: str) -> AsyncIterator[None]:
    """Freeze one part of the crew until `crew up` says so, and wake it up at the end, which is said too."""
    pid, said = up.children()[name], len(up.said)
    os.kill(pid, signal.SIGSTOP)
    try:
        await watch.until(
            lambda: f"{name} is frozen (process {pid} is there" in up.said[said:], 20.0, f"{name} is missed"
        )
        assert up.said[said:].count(" is frozen (") == 1, "and nobody else is"
        yield
    finally:
        os.kill(pid, signal.SIGCONT)
    await watch.until(lambda: f"{name} answers again" in up.said[said:], 20.0, f"{name} is back")


async def drives_again(watch: Watch) -> None:
    """Once every robot is heard of again, a mission completes."""
    await watch.until(lambda: not any(watch.states[r].unavailable for r in BOTH), why="both serve again")
    for _ in range(40):
        if (await watch.mission(SHORT_DRIVE)).outcome == "completed":
            return
        await asyncio.sleep(0.5)
    raise AssertionError("the rover does not drive again")


async def halted(watch: Watch, requests: Sequence[str]) -> None:
    """Missions have halted by the status: what is told of them while the bus is lost to the orchestrator is lost."""
    phases: dict[str, str] = {}
    for _ in range(120):
        status = await query_status(watch.bus, watch.keys, timeout_s=1.0)
        phases = {} if status is None else {m.mission: m.phase for m in status.missions}
        if [phases.get(watch.mission_of(request)) for request in requests] == ["halted"] * len(requests):
            return
        await asyncio.sleep(0.5)
    raise AssertionError(f"not halted: {phases}")


async def both_moving(watch: Watch) -> tuple[str, str]:
    """The drone searches and the rover drives."""
    search, drive = watch.ask(SEARCH), watch.ask(FAR_DRIVE)
    await watch.airborne()
    await watch.moving("iris")
    await watch.moving("tb3")
    return search, drive


async def test_without_its_planner_a_crew_rejects_at_once_and_plans_again_afterwards(watch: Watch, up: Up) -> None:
    async with frozen(watch, up, "planner"):
        ended = await watch.mission(SHORT_DRIVE, 20.0)
        assert ended.outcome == "rejected"
        assert "the planner is not there" in ended.text
    await watch.drives()


async def test_a_frozen_gateway_or_recorder_stops_no_mission(watch: Watch, up: Up) -> None:
    for name in ("gateway", "recorder"):
        drive = watch.ask(FAR_DRIVE)
        await watch.moving("tb3")
        async with frozen(watch, up, name):
            ended = await watch.ended(drive)
            assert ended.outcome == "completed", f"{name}: {ended.text}"
        await watch.drives()


async def test_a_frozen_robot_ends_its_mission_and_no_other(watch: Watch, up: Up) -> None:
    drive = watch.ask(FAR_DRIVE)
    await watch.moving("tb3")
    async with frozen(watch, up, "tb3"):
        ended = await watch.ended(drive)
        assert ended.outcome == "halted"
        refused = await watch.mission(SHORT_DRIVE)
        assert (refused.outcome, refused.code) == ("rejected", "robot_unavailable")
    await drives_again(watch)


async def test_robots_of_a_frozen_router_make_themselves_safe_and_missions_halt(watch: Watch, up: Up) -> None:
    """Nobody hears anybody meanwhile, and what is told then is lost; the status has it once the bus is back."""
    requests = await both_moving(watch)
    async with frozen(watch, up, "router"):
        assert not watch.bus.connected
    x, y, *_ = await watch.standing("tb3")
    assert math.dist((x, y), (9.0, -5.5)) > 1.0, "it did not go on without its orchestrator"
    await watch.landed("iris")
    await halted(watch, requests)
    await drives_again(watch)


async def test_missions_in_a_frozen_simulation_halt_and_its_robots_stop_when_it_wakes(watch: Watch, up: Up) -> None:
    requests = await both_moving(watch)
    await watch.until(lambda: watch.apart_m(*BOTH) > 3.0, 60.0, "the drone may land where it is: nobody is below it")
    async with frozen(watch, up, "simulation"):
        for request in requests:
            assert (await watch.ended(request)).outcome == "halted"
        refused = await watch.mission(SHORT_DRIVE)
        assert (refused.outcome, refused.code) == ("rejected", "robot_unavailable")
    await watch.until(lambda: not any(watch.states[r].unavailable or watch.states[r].running for r in BOTH), why="idle")
    x, y, *_ = await watch.standing("tb3")
    assert math.dist((x, y), (9.0, -5.5)) > 1.0, "it does not go on for a mission that is over"
    assert (await watch.mission("land the drone")).outcome == "completed", "which hovers until then"
    await watch.landed("iris")
    await drives_again(watch)


async def test_robots_of_a_frozen_orchestrator_make_themselves_safe_and_it_sends_nothing_old(
    watch: Watch, up: Up, desk: Desk
) -> None:
    requests = await both_moving(watch)
    count = len(watch.robot_events)
    async with frozen(watch, up, "orchestrator"):
        sent = len(intents(up.run))
        await watch.until(lambda: set(BOTH) <= missed_it(watch, count), why="both robots notice")
        await watch.standing("tb3")
        await watch.landed("iris")
        status = await asyncio.to_thread(desk.crew, "status")
        assert status.returncode == 1
        assert "the orchestrator does not answer" in status.stdout
    await halted(watch, requests)
    await watch.standing("tb3")
    assert len(intents(up.run)) == sent, "nothing more was sent for them"
    await drives_again(watch)


def missed_it(watch: Watch, since: int) -> set[str]:
    return {event.robot for event in watch.robot_events[since:] if event.what == "orchestrator_lost"}


def test_a_crew_with_a_frozen_orchestrator_ends_and_leaves_nothing(up: Up) -> None:
    """The last one: it ends the crew of this file."""
    pid = up.children()["orchestrator"]
    os.kill(pid, signal.SIGSTOP)
    assert up.end() == 0
    assert not alive(pid)

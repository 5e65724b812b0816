"""A journal that can't be written: nothing is sent without its intent on disk, and robots make themselves safe."""

import asyncio
import resource

import pytest

from tests.integration.crew.harness import FAR_DRIVE, SHORT_DRIVE, Desk, Up, intents, wait_until, watching


def fill_the_disk(up: Up) -> None:
    """No file of the orchestrator may grow from now on; a write beyond that fails as on a full disk."""
    pid = up.children()["orchestrator"]
    largest = max(path.stat().st_size for path in up.run.glob("journal.db*"))
    resource.prlimit(pid, resource.RLIMIT_FSIZE, (largest, largest))


async def test_on_a_full_disk_nothing_is_sent_and_the_orchestrator_ends(desk: Desk) -> None:
    with desk.up() as up:
        run = up.run
        async with watching(up.running) as watch:
            pose = await watch.standing("tb3")
            fill_the_disk(up)
            watch.ask(SHORT_DRIVE)
            assert await asyncio.to_thread(wait_until, lambda: "orchestrator died" in up.said, 20.0), up.said
            assert "could not be written" in up.said or "cannot be written" in up.said
            await watch.until(lambda: any(e.what == "orchestrator_lost" for e in watch.robot_events), why="noticed")
            assert not [e for e in watch.robot_events if e.mission], "no robot was sent anything"
            assert await watch.standing("tb3") == pytest.approx(pose, abs=0.3)
        assert up.end() == 1
    assert intents(run) == []


async def test_a_disk_that_fills_up_in_mid_mission_leaves_robots_safe(desk: Desk) -> None:
    with desk.up() as up:
        async with watching(up.running) as watch:
            watch.ask(FAR_DRIVE)
            await watch.moving("tb3")
            fill_the_disk(up)
            watch.ask("search the area")
            assert await asyncio.to_thread(wait_until, lambda: "orchestrator died" in up.said, 20.0), up.said
            await watch.until(lambda: any(e.code == "orchestrator_lost" for e in watch.robot_events), why="noticed")
            await watch.standing("tb3")
            assert watch.height() < 0.5, "the drone never took off"

"""Any process of a crew may die or freeze at any time: robots make themselves safe, people are told, life goes on."""

import asyncio
import os
import signal
import time
from collections.abc import AsyncIterator, Iterator
from contextlib import asynccontextmanager

import pytest

from crew.access import ROUTER
from crew.bus.session import open_router
from crew.launch.ready import query_status
from tests.integration.crew.harness import (
    FAR_DRIVE,
    SEARCH,
    SHORT_DRIVE,
    SHORT_SEARCH,
    Desk,
    Up,
    Watch,
    alive,
    intents,
    wait_until,
    watching,
)


@pytest.fixture(scope="module")
def desk(tmp_path_factory: pytest.TempPathFactory) -> Desk:
    return Desk(tmp_path_factory.mktemp("death"))


@pytest.fixture
def up(desk: Desk) -> Iterator[Up]:
    with desk.up() as up:
        yield up


@asynccontextmanager
async def both_moving(up: Up) -> AsyncIterator[Watch]:
    """The drone searches and the rover drives."""
    async with watching(up.running) as watch:
        watch.ask(SEARCH)
        watch.ask(FAR_DRIVE)
        await watch.airborne()
        await watch.moving("iris")
        await watch.moving("tb3")
        yield watch


async def both_safe(watch: Watch) -> None:
    """The rover stands, the drone has hovered and landed: in truth."""
    await watch.standing("tb3")
    await watch.landed("iris")


def status(desk: Desk) -> tuple[int, str]:
    done = desk.crew("status")
    assert "Traceback" not in done.stderr
    return done.returncode, done.stdout + done.stderr


def comes_up_again(desk: Desk, epoch: int) -> None:
    """A new crew has a higher epoch and drives."""
    demo = desk.demo("--request", SHORT_DRIVE)
    assert demo.result["outcome"] == "completed", demo
    assert desk.home.epoch("air_ground") > epoch


async def both_notice(watch: Watch) -> None:
    """Both robots say that they have lost the orchestrator."""
    await watch.until(
        lambda: {"iris", "tb3"} <= {e.robot for e in watch.robot_events if e.what == "orchestrator_lost"},
        why="both robots notice",
    )


async def back_and_over_it(watch: Watch) -> None:
    """Wait until an orchestrator that was away answers, its missions have ended, and it knows the robots again."""
    deadline = time.monotonic() + 60.0
    while time.monotonic() < deadline:
        answer = await query_status(watch.bus, watch.keys, timeout_s=1.0)
        if answer is None or any(r.running or r.unavailable for r in answer.robots):
            continue
        phases = {m.phase for m in answer.missions}
        if phases <= {"halted", "completed"}:
            assert "halted" in phases
            return
    raise AssertionError(f"not within 60 s: {answer}")


@pytest.mark.hostile
async def test_robots_of_a_killed_orchestrator_make_themselves_safe(desk: Desk, up: Up) -> None:
    epoch = desk.home.epoch("air_ground")
    async with both_moving(up) as watch:
        up.kill("orchestrator")
        await both_notice(watch)
        assert not any(e.what == "stopped" for e in watch.robot_events), "a lost orchestrator is no stop"
        await both_safe(watch)
        code, said = await asyncio.to_thread(status, desk)
        assert code == 1
        assert "the orchestrator does not answer" in said
        assert "not there: orchestrator" in said
        assert "orchestrator died (signal 9)" in up.said
    assert up.end() == 1
    await asyncio.to_thread(comes_up_again, desk, epoch)


async def test_robots_of_a_frozen_orchestrator_make_themselves_safe_and_it_sends_nothing_old(
    desk: Desk, up: Up
) -> None:
    async with both_moving(up) as watch:
        run, pid = up.run, up.children()["orchestrator"]
        sent = len(intents(run))
        os.kill(pid, signal.SIGSTOP)
        await both_notice(watch)
        await both_safe(watch)
        code, said = await asyncio.to_thread(status, desk)
        assert code == 1
        assert "the orchestrator does not answer" in said
        os.kill(pid, signal.SIGCONT)
        await back_and_over_it(watch)
        await both_safe(watch)
        assert len(intents(run)) == sent, "nothing more was sent for them"
        await watch.drives()
        os.kill(pid, signal.SIGSTOP)
    assert up.end() == 0
    assert not alive(pid)


async def test_a_router_that_dies_leaves_robots_safe_and_a_new_crew_works(desk: Desk, up: Up) -> None:
    epoch, running = desk.home.epoch("air_ground"), up.running
    async with both_moving(up):
        up.kill("router")
        assert wait_until(lambda: "router died (signal 9)" in up.said, 5.0), up.said
    code, said = await asyncio.to_thread(status, desk)
    assert code == 1
    assert running.endpoint.partition("/")[2] in said
    router = await asyncio.to_thread(open_router, running.link(ROUTER), ("iris", "tb3"), guests=running.guests)
    try:
        async with watching(running) as watch:
            await both_safe(watch)
    finally:
        await asyncio.to_thread(router.close)
    pids = up.children()
    assert up.end() == 1
    assert not any(alive(pid) for pid in pids.values())
    await asyncio.to_thread(comes_up_again, desk, epoch)


async def test_a_simulation_that_dies_halts_missions_and_a_new_crew_works(desk: Desk, up: Up) -> None:
    epoch = desk.home.epoch("air_ground")
    async with both_moving(up) as watch:
        up.kill("simulation")
        await watch.until(lambda: sum(e.final for e in watch.events) == 2, 60.0, "both missions end")
        assert {e.outcome for e in watch.events if e.final} == {"halted"}
        code, said = await asyncio.to_thread(status, desk)
        assert code == 1
        assert "not there: simulation" in said
        assert "simulation died (signal 9)" in up.said
    up.end()
    await asyncio.to_thread(comes_up_again, desk, epoch)


async def test_without_planner_and_gateway_what_runs_goes_on(desk: Desk, up: Up) -> None:
    async with watching(up.running) as watch:
        drive = watch.ask(FAR_DRIVE)
        await watch.moving("tb3")
        up.kill("planner")
        assert wait_until(lambda: "planner died (signal 9): no new mission can be planned" in up.said, 5.0), up.said
        up.kill("gateway")
        assert wait_until(lambda: "gateway died (signal 9): no new request can be taken" in up.said, 5.0), up.said
        code, said = await asyncio.to_thread(status, desk)
        assert code == 1
        assert "not there: planner, gateway" in said
        assert (await watch.ended(drive)).outcome == "completed"
        code, said = await asyncio.to_thread(_request, desk)
        assert code == 1
        assert "nobody took the request" in said
    up.end()


async def test_a_robot_that_dies_halts_its_mission_and_no_other(desk: Desk, up: Up) -> None:
    async with both_moving(up) as watch:
        up.kill("iris")
        await watch.until(lambda: any(e.outcome == "halted" for e in watch.events), 60.0, "the search halts")
        await watch.until(lambda: any(e.outcome == "completed" for e in watch.events), 60.0, "the drive completes")
        _, said = await asyncio.to_thread(status, desk)
        assert "lost: its process or its link is gone" in said
        assert "iris died (signal 9): the robot is unavailable" in up.said
        refused = await watch.mission(SHORT_SEARCH)
        assert (refused.outcome, refused.code) == ("rejected", "robot_unavailable")
        await watch.drives()
        await watch.landed("iris")
    up.end()


def _request(desk: Desk) -> tuple[int, str]:
    done = desk.crew("request", SHORT_DRIVE)
    assert "Traceback" not in done.stderr
    return done.returncode, done.stdout + done.stderr

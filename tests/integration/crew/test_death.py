"""Any process of a crew may die or freeze at any time: robots make themselves safe, people are told, life goes on."""

import asyncio
from collections.abc import AsyncIterator, Iterator
from contextlib import asynccontextmanager

import pytest

from crew.access import ROUTER
from crew.bus.session import open_router
from tests.integration.crew.harness import (
    FAR_DRIVE,
    SEARCH,
    SHORT_DRIVE,
    SHORT_SEARCH,
    Desk,
    Up,
    Watch,
    alive,
    wait_until,
    watching,
)


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


async def test_a_router_that_dies_leaves_robots_safe(desk: Desk, up: Up) -> None:
    running = up.running
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


async def test_parts_that_die_one_after_another_take_nothing_else_with_them(desk: Desk, up: Up) -> None:
    """A robot, then planner and gateway: in one crew, which goes on with what is left."""
    async with both_moving(up) as watch:
        await a_robot_dies(watch, desk, up)
        await planner_and_gateway_die(watch, desk, up)
    up.end()


async def a_robot_dies(watch: Watch, desk: Desk, up: Up) -> None:
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


async def planner_and_gateway_die(watch: Watch, desk: Desk, up: Up) -> None:
    """What executes goes on."""
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


async def test_a_simulation_that_dies_halts_missions(desk: Desk, up: Up) -> None:
    async with both_moving(up) as watch:
        up.kill("simulation")
        await watch.until(lambda: sum(e.final for e in watch.events) == 2, 60.0, "both missions end")
        assert {e.outcome for e in watch.events if e.final} == {"halted"}
        code, said = await asyncio.to_thread(status, desk)
        assert code == 1
        assert "not there: simulation" in said
        assert "simulation died (signal 9)" in up.said
    up.end()


def _request(desk: Desk) -> tuple[int, str]:
    done = desk.crew("request", SHORT_DRIVE)
    assert "Traceback" not in done.stderr
    return done.returncode, done.stdout + done.stderr

"""The stop: from another thread while the loop is blocked, past every path, and for good until it is released."""

import asyncio
import math
import threading
from time import sleep as wait

import pytest

from crew.errors import AdapterError, Latched
from tests.integration.unitree.stage import Stage, stage


async def started(scene: Stage, robot: str, skill: str, seconds: float, **args: str) -> "asyncio.Task[None]":
    """A skill that has run for some time."""
    from tests.integration.unitree.stage import KINDS

    kind = KINDS[next(r.kind for r in scene.crew.robots if r.name == robot)]
    declared = kind.skill(skill)
    assert declared is not None
    task = asyncio.ensure_future(scene.adapters[robot].execute(skill, declared.args(**args), scene.places(args)))
    await scene.advance(seconds)
    assert not task.done()
    return task


async def test_a_halt_while_the_loop_is_blocked_stops_the_walk() -> None:
    async with stage("go2") as scene:
        walk = await started(scene, "go2", "navigate", 3.0, location="room_b")
        assert scene.go2.fluents()["moving"].value is True
        threading.Thread(target=scene.go2.halt).start()
        wait(0.05)  # noqa: ASYNC251 - the loop is blocked; the robot's world goes on without it
        for _ in range(30):
            scene.world.advance(scene.world.time_ns + 50_000_000)
            scene.world.poll()
        before = scene.dog()
        scene.world.advance(scene.world.time_ns + 1_000_000_000)
        assert math.dist(before[:2], scene.dog()[:2]) < 0.03
        with pytest.raises(Latched):
            await scene.run(walk)
        with pytest.raises(Latched):
            await scene.do("go2", "navigate", location="room_b")
        await scene.run(scene.go2.safe("stop"))
        scene.go2.release()
        await scene.do("go2", "navigate", location="charging")


async def test_a_halted_arm_stays_where_it_is_and_keeps_what_it_holds() -> None:
    async with stage("g1", map_="near") as scene:
        task = await started(scene, "g1", "pick_handover", 8.0, object="red_cube")
        scene.g1.halt()
        await scene.advance(1.0)
        with pytest.raises(Latched):
            await task
        before = scene.thing("red_cube")
        await scene.advance(2.0)
        assert math.dist(before, scene.thing("red_cube")) < 0.01
        assert before[2] > 0.8
        assert scene.g1.fluents()["holding"].value == "red_cube"
        assert scene.g1.fluents()["moving"].value is False


async def test_a_cancelled_walk_ends_when_the_robot_stands() -> None:
    async with stage("go2") as scene:
        walk = await started(scene, "go2", "navigate", 3.0, location="room_b")
        await scene.run(scene.go2.cancel())
        with pytest.raises(AdapterError, match="cancelled"):
            await walk
        before = scene.dog()
        await scene.advance(1.0)
        assert math.dist(before[:2], scene.dog()[:2]) < 0.03


async def test_without_a_client_the_watchdog_ends_the_walk() -> None:
    async with stage("go2") as scene:
        walk = await started(scene, "go2", "navigate", 3.0, location="room_b")
        walk.cancel()
        scene.go2._skills.robot._transport.close()  # as if the process had died: no stop leaves either
        scene.world.advance(scene.world.time_ns + 3_000_000_000)
        before = scene.dog()
        scene.world.advance(scene.world.time_ns + 1_000_000_000)
        assert math.dist(before[:2], scene.dog()[:2]) < 0.03


async def test_an_unknown_behaviour_is_refused_with_the_known() -> None:
    async with stage("g1") as scene:
        with pytest.raises(AdapterError, match=r"no safe behaviour 'land'.*hold"):
            await scene.run(scene.g1.safe("land"))

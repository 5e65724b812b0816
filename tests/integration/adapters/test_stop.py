"""The stop: at once, from any thread, with the loop blocked; then nothing but the robot's own landing."""

import asyncio
import threading
import time

import pytest

from crew.contracts.kinds.quadcopter import FlyTo, Land, Takeoff
from crew.contracts.kinds.rover import NavigateTo
from crew.errors import AdapterError, Latched
from tests.integration.adapters.lockstep import Lockstep, lockstep

AWAY = FlyTo(x=9, y=9, altitude=4)


async def in_flight(stage: Lockstep) -> asyncio.Task[None]:
    """A quadcopter well on its way to a far point."""
    await stage.run(stage.iris.execute("takeoff", Takeoff(altitude=4), {}))
    task = asyncio.create_task(stage.iris.execute("fly_to", AWAY, {}))
    await stage.until(lambda: stage.world.truth().robots["iris"].speed_mps > 2.0)
    return task


def still(stage: Lockstep, name: str = "iris") -> bool:
    return stage.world.truth().robots[name].speed_mps < 0.3


async def test_halt_works_while_the_loop_is_blocked() -> None:
    async with lockstep("iris") as stage:
        task = await in_flight(stage)
        took_s: list[float] = []

        def operator() -> None:
            time.sleep(0.05)
            start_s = time.perf_counter()
            stage.iris.halt()
            took_s.append(time.perf_counter() - start_s)

        sent = stage.iris.link_counts()[0]
        thread = threading.Thread(target=operator)
        thread.start()
        time.sleep(0.4)  # noqa: ASYNC251  (a frozen loop is what is tested)
        thread.join()
        assert took_s[0] < 0.05
        assert stage.iris.latched
        assert stage.iris.link_counts()[0] >= sent + 3  # the stop itself and its repetitions
        await stage.until(task.done, 2.0)
        assert isinstance(task.exception(), Latched)
        await stage.until(lambda: still(stage), 6.0)
        assert stage.iris._vehicle.mode() == "AUTO.LOITER"


async def test_a_latched_robot_sends_nothing_and_refuses_until_released() -> None:
    async with lockstep("iris", "tb3") as stage:
        await stage.run(stage.iris.execute("takeoff", Takeoff(altitude=3), {}))
        stage.iris.halt()
        await stage.until(lambda: still(stage), 5.0)
        stage.iris._repeater.finish()
        stage.iris.halt()
        sent = stage.iris.link_counts()[0]
        for _ in range(3):
            with pytest.raises(Latched):
                await stage.iris.execute("fly_to", AWAY, {})
            with pytest.raises(Latched):
                await stage.iris.execute("land", Land(), {})
        assert stage.iris.link_counts()[0] == sent
        stage.iris.release()
        assert not stage.iris.latched
        await stage.run(stage.iris.execute("fly_to", FlyTo(x=-3, y=-3, altitude=3), {}))


async def test_a_second_stop_is_sent_again_to_a_vehicle_that_still_moves() -> None:
    async with lockstep("iris") as stage:
        await in_flight(stage)
        stage.iris.halt()
        stage.iris._repeater.finish()
        sent = stage.iris.link_counts()[0]
        stage.iris.halt()
        assert stage.iris.link_counts()[0] == sent + len(stage.iris._vehicle.flavour.stops)


async def test_a_latched_quadcopter_hovers_and_then_lands_by_itself() -> None:
    async with lockstep("iris", options={"iris": {"hover_s": 3.0}}) as stage:
        task = await in_flight(stage)
        stage.iris.halt()
        start_ns = stage.clock.now_ns()
        await stage.run(stage.iris.safe("hover_then_land"))
        assert (stage.clock.now_ns() - start_ns) / 1e9 > 6.0
        assert isinstance(task.exception(), Latched)
        iris = stage.world.truth().robots["iris"]
        assert not iris.armed
        assert iris.z_m < 0.1
        assert stage.iris.latched


async def test_a_halted_rover_stands_and_its_skill_ends_latched() -> None:
    async with lockstep("tb3") as stage:
        task = asyncio.create_task(stage.tb3.execute("navigate_to", NavigateTo(x=3.0, y=-4.5), {}))
        await stage.until(lambda: stage.world.truth().robots["tb3"].speed_mps > 0.3)
        stage.tb3.halt()
        await stage.run(stage.tb3.safe("stop"))
        assert isinstance(task.exception(), Latched)
        assert still(stage, "tb3")


async def test_cancel_brakes_and_ends_the_running_skill() -> None:
    async with lockstep("iris") as stage:
        task = await in_flight(stage)
        await stage.run(stage.iris.cancel())
        assert still(stage)
        error = task.exception()
        assert isinstance(error, AdapterError)
        assert error.code == "cancelled"
        assert not stage.iris.latched
        await stage.run(stage.iris.execute("fly_to", FlyTo(x=0, y=0, altitude=4), {}))


async def test_a_cancelled_task_leaves_no_motion_behind() -> None:
    async with lockstep("iris") as stage:
        task = await in_flight(stage)
        task.cancel()
        await asyncio.gather(task, return_exceptions=True)
        assert task.cancelled()
        await stage.until(lambda: still(stage), 6.0)
        await stage.run(stage.iris.execute("land", Land(), {}))


async def test_one_skill_at_a_time() -> None:
    async with lockstep("iris") as stage:
        task = await in_flight(stage)
        with pytest.raises(AdapterError) as refused:
            await stage.iris.execute("land", Land(), {})
        assert refused.value.code == "robot_busy"
        await stage.run(stage.iris.cancel())
        assert isinstance(task.exception(), AdapterError)
        with pytest.raises(AdapterError, match="no safe behaviour"):
            await stage.iris.safe("dance")


async def test_a_parked_quadcopter_has_nothing_to_wait_for() -> None:
    async with lockstep("iris") as stage:
        start_ns = stage.clock.now_ns()
        stage.iris.halt()
        await stage.run(stage.iris.safe("hover_then_land"))
        assert stage.clock.now_ns() - start_ns < 2e9

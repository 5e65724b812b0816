"""Mission time: sleepers wake in order, deadlines are of mission time, and a cancel from outside stays a cancel."""

import asyncio

import pytest

from crew.clock import WALL, SimClock, deadline, turn, within


async def turns(count: int = 5) -> None:
    for _ in range(count):
        await turn()


async def test_simulated_sleepers_wake_in_the_order_of_their_deadlines() -> None:
    clock, woken = SimClock(), list[str]()

    async def sleeper(name: str, seconds: float) -> None:
        await clock.sleep(seconds)
        woken.append(name)

    tasks = [asyncio.create_task(sleeper(*who)) for who in (("late", 2.0), ("early", 1.0), ("same", 2.0))]
    await turns()
    clock.advance(999_999_999)
    await turns()
    assert woken == []
    clock.advance(1_000_000_000)
    await turns()
    assert woken == ["early"]
    clock.advance(5_000_000_000)
    await asyncio.gather(*tasks)
    assert woken == ["early", "late", "same"]


async def test_simulated_time_never_runs_backwards() -> None:
    clock = SimClock(start_ns=100)
    clock.advance(50)
    assert clock.now_ns() == 100


async def test_a_cancelled_sleeper_does_not_disturb_the_others() -> None:
    clock = SimClock()
    gone, stays = (asyncio.create_task(clock.sleep(1.0)) for _ in range(2))
    await turns()
    gone.cancel()
    await turns()
    clock.advance(1_000_000_000)
    await stays
    assert gone.cancelled()


async def test_a_deadline_of_mission_time_ignores_the_wall() -> None:
    clock = SimClock()
    task = asyncio.create_task(within(clock, 1.0, asyncio.Event().wait()))
    assert not await WALL.race(asyncio.shield(task), 0.05)
    clock.advance(1_000_000_000)
    with pytest.raises(TimeoutError, match="mission time"):
        await task


async def test_work_that_ends_in_time_gives_its_result_and_leaves_no_watcher() -> None:
    clock = SimClock()

    async def answer() -> int:
        await clock.sleep(0.5)
        return 42

    task = asyncio.create_task(within(clock, 1.0, answer()))
    await turns()
    clock.advance(500_000_000)
    assert await task == 42
    await turns()
    assert asyncio.all_tasks() == {asyncio.current_task()}


async def test_a_cancel_from_outside_is_not_taken_for_the_deadline() -> None:
    clock = SimClock()
    task = asyncio.create_task(within(clock, 1.0, asyncio.Event().wait()))
    await turns()
    task.cancel("a stop")
    with pytest.raises(asyncio.CancelledError) as cancelled:
        await task
    assert cancelled.value.args == ("a stop",)


async def test_a_cancel_at_the_very_deadline_still_ends_the_task() -> None:
    clock = SimClock()
    task = asyncio.create_task(within(clock, 1.0, asyncio.Event().wait()))
    await turns()
    clock.advance(1_000_000_000)
    task.cancel()
    with pytest.raises((asyncio.CancelledError, TimeoutError)):
        await task
    assert task.done()


async def test_nested_deadlines_name_the_one_that_expired() -> None:
    clock = SimClock()

    async def both() -> str:
        try:
            async with deadline(clock, 1.0):
                await within(clock, 5.0, asyncio.Event().wait())
        except TimeoutError as error:
            return str(error)
        return "none"

    task = asyncio.create_task(both())
    await turns()
    clock.advance(1_000_000_000)
    assert "1.0 s" in await task


async def test_busy_contexts_nest_and_tell_when_the_last_one_ends() -> None:
    clock = SimClock()
    with clock.busy():
        with clock.busy():
            assert clock.is_busy
        assert clock.is_busy
        assert not clock.idle_event.is_set()
    assert not clock.is_busy
    assert clock.idle_event.is_set()


async def test_a_race_against_the_wall_says_who_won() -> None:
    assert await WALL.race(turn(), 5.0)
    assert not await WALL.race(asyncio.Event().wait(), 0.01)

"""Who may move a robot, and what becomes of a robot whose skill failed."""

import asyncio

import pytest

from crew.adapter import Permit, StopLatch
from crew.adapters.aftermath import Aftermath
from crew.adapters.tenure import Tenure
from crew.clock import SimClock
from crew.errors import AdapterError, Latched


class Run:
    def __init__(self) -> None:
        self.permit = Permit()


@pytest.fixture
def latch() -> StopLatch:
    return StopLatch()


@pytest.fixture
def tenure(latch: StopLatch) -> Tenure[Run]:
    return Tenure("r1", latch, SimClock())


def test_one_skill_at_a_time(tenure: Tenure[Run]) -> None:
    tenure.begin("go", Run())
    with pytest.raises(AdapterError, match="r1: turn not started: busy"):
        tenure.begin("turn", Run())
    tenure.end()
    tenure.begin("turn", Run())


def test_nothing_begins_while_the_stop_is_latched_but_a_safe_behaviour(tenure: Tenure[Run], latch: StopLatch) -> None:
    latch.set()
    with pytest.raises(Latched):
        tenure.begin("go", Run())
    tenure.begin_safe().check()
    latch.clear()
    with pytest.raises(AdapterError, match="busy"):
        tenure.begin("go", Run())


def test_a_safe_behaviour_ends_what_ran_and_a_later_one_ends_it(tenure: Tenure[Run]) -> None:
    run = tenure.begin("go", Run())
    first = tenure.begin_safe()
    with pytest.raises(AdapterError, match="a safe behaviour took over"):
        run.permit.check()
    second = tenure.begin_safe()
    assert first.revoked
    tenure.end_safe(first)
    assert tenure.safe is second, "the one that ended late takes nothing away"


def test_a_first_reason_stays(tenure: Tenure[Run]) -> None:
    run = tenure.begin("go", Run())
    tenure.cancel("skill cancelled")
    tenure.revoke(Latched("r1: stopped"))
    with pytest.raises(AdapterError, match="skill cancelled"):
        run.permit.check()


async def test_a_robot_is_doubted_until_it_was_seen_standing_after_a_stop_that_failed() -> None:
    clock = SimClock()
    clock.advance(5)
    seen: list[int] = []

    async def stop() -> None:
        raise AdapterError("r1: still moving", code="still_moving")

    aftermath = Aftermath(stop, lambda start_ns: any(stamp > start_ns for stamp in seen), clock)
    assert aftermath.doubt() == ""
    aftermath.begin()
    await aftermath.settle()
    seen.append(5)  # no newer than the doubt
    assert aftermath.doubt() == "did not confirm its stop: r1: still moving"
    seen.append(6)
    assert aftermath.doubt() == ""


async def test_a_stop_is_given_up_with_the_link() -> None:
    begun, ended = asyncio.Event(), asyncio.Event()

    async def stop() -> None:
        try:
            begun.set()
            await asyncio.Event().wait()
        finally:
            ended.set()

    aftermath = Aftermath(stop, lambda start_ns: False, SimClock())
    aftermath.begin()
    await begun.wait()
    await aftermath.close()
    assert ended.is_set()
    assert aftermath.doubt() == ""

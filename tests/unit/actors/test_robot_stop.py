"""Stop and loss in each phase of a skill: the robot does what was declared, says so once, and serves on after."""

import asyncio
import threading
from collections.abc import AsyncIterator
from typing import Any

import pytest

from crew.actors.robot import actor, lost
from crew.bus.port import Qos
from crew.clock import WALL, seconds_ns
from crew.errors import AdapterError
from tests.unit.actors.stage import RobotStage, robot_stage


@pytest.fixture
async def stage() -> AsyncIterator[RobotStage]:
    async with robot_stage() as stage:
        await stage.orchestrator_lives()
        yield stage


async def stopped(stage: RobotStage) -> None:
    await stage.until(lambda: any(d.startswith("safe:") for d in stage.adapter.did), "it makes itself safe")
    await stage.settle()


async def test_a_stop_while_idle_latches_and_makes_safe(stage: RobotStage) -> None:
    stage.stop()
    await stopped(stage)
    assert stage.adapter.did == ["halt", "safe:stop"]
    assert stage.adapter.latched
    assert (await stage.heard("stopped")).code == "stopped"
    await stage.until(lambda: stage.states[-1].stopped, "its state says so")


async def test_a_stop_while_driving_ends_the_skill_once(stage: RobotStage) -> None:
    await stage.started()
    stage.stop()
    await stopped(stage)
    assert stage.adapter.did == ["navigate_to", "halt", "safe:stop"]
    assert [(e.what, e.code) for e in stage.events if e.mission] == [("accepted", ""), ("cancelled", "stopped")]


async def test_a_stop_while_the_effect_is_awaited_ends_the_skill_once(stage: RobotStage) -> None:
    await stage.started()
    stage.adapter.finish.set()
    await stage.settle()
    assert stage.actor.running
    stage.stop()
    await stopped(stage)
    assert [e.what for e in stage.events if e.mission] == ["accepted", "cancelled"]
    assert stage.adapter.did[-1] == "safe:stop"


async def test_a_stop_while_a_cancel_brakes_still_latches_and_reports_once(stage: RobotStage) -> None:
    await stage.started()
    stage.adapter.brake.clear()
    stage.cancel()
    await stage.until(lambda: "cancel" in stage.adapter.did, "it brakes")
    stage.stop()
    await stage.until(lambda: stage.adapter.latched, "latched, whatever the brake does")
    stage.adapter.brake.set()
    await stopped(stage)
    assert stage.whats.count("cancelled") == 1


async def test_a_stop_while_a_timed_out_skill_brakes_does_not_cut_off_the_report(stage: RobotStage) -> None:
    await stage.started()
    stage.adapter.brake.clear()
    stage.clock.advance(stage.clock.now_ns() + seconds_ns(181.0))
    await stage.until(lambda: "cancel" in stage.adapter.did, "it brakes")
    stage.stop()
    await stage.settle()
    stage.adapter.brake.set()
    assert (await stage.heard("failed")).code == "timeout"
    await stopped(stage)


async def test_a_robot_that_ends_while_it_makes_itself_safe_ends_at_once(stage: RobotStage) -> None:
    await stage.started()
    stage.adapter.brake.clear()
    stage.cancel()
    await stage.until(lambda: "cancel" in stage.adapter.did, "it brakes")
    stage.orchestrator_dies()
    await stage.heard("orchestrator_lost")
    assert await WALL.race(stage.end(), 2.0)
    assert not any(d.startswith("safe:") for d in stage.adapter.did)


async def test_a_stop_halts_while_the_loop_is_blocked(stage: RobotStage) -> None:
    await stage.started()
    stage.stop()
    deadline = asyncio.get_running_loop().time() + 2.0
    while "halt" not in stage.adapter.did and asyncio.get_running_loop().time() < deadline:
        pass  # the robot's loop is this one: nothing of it runs meanwhile
    assert "halt" in stage.adapter.did
    await stopped(stage)


@pytest.mark.parametrize("body", [(b"", ""), (b"\xff\xfe", "text/plain"), (b"\x00" * 70_000, "crew.stop/99")])
async def test_anything_on_the_stop_key_stops(stage: RobotStage, body: tuple[bytes, str]) -> None:
    stage.bus.put(stage.keys.stop, body, qos=Qos.STOP)
    await stopped(stage)
    assert stage.adapter.latched


async def test_a_robot_is_not_called_still_while_it_makes_itself_safe(
    stage: RobotStage, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(actor, "SAFE_RETRY_S", 0.1)
    await stage.until(lambda: stage.states[-1].still, "it stands")
    stage.adapter.deaf = AdapterError("tb3: brake broken", code="still_moving")
    stage.stop()
    await stage.until(lambda: stage.states[-1].stopped and not stage.states[-1].still, "not yet")
    stage.adapter.deaf = None
    await stage.until(lambda: stage.states[-1].still, "now")


async def test_while_stopped_nothing_is_taken(stage: RobotStage) -> None:
    stage.stop()
    await stopped(stage)
    stage.send(stage.dispatch())
    assert (await stage.heard("refused")).code == "stopped"
    assert "navigate_to" not in stage.adapter.did


async def test_a_failed_safe_behaviour_is_told_and_tried_again(
    stage: RobotStage, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(actor, "SAFE_RETRY_S", 0.02)
    stage.adapter.deaf = AdapterError("tb3: brake broken", code="still_moving")
    stage.stop()
    failed = await stage.heard("safe_failed")
    assert (failed.code, failed.detail) == ("still_moving", "stop: tb3: brake broken")
    stage.adapter.deaf = None
    tries = stage.adapter.did.count("safe:stop")
    await stage.until(lambda: stage.adapter.did.count("safe:stop") > tries, "it tries again")
    stage.reset()
    await stage.heard("released")


async def test_a_safe_behaviour_that_keeps_failing_does_not_end_the_robot(
    stage: RobotStage, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(actor, "SAFE_RETRY_S", 0.01)
    stage.adapter.deaf = AdapterError("tb3: brake broken", code="still_moving")
    stage.stop()
    await stage.until(lambda: stage.whats.count("safe_failed") == actor.SAFE_TRIES, "it gives up")
    await stage.settle()
    stage.reset()
    await stage.heard("released")


async def test_a_signed_reset_releases_and_work_goes_on(stage: RobotStage) -> None:
    stage.stop()
    await stopped(stage)
    stage.reset()
    assert "operator" in (await stage.heard("released")).detail
    assert not stage.adapter.latched
    await stage.started()


@pytest.mark.parametrize(
    ("changes", "why"),
    [
        ({"signature": b""}, "signature"),
        ({"signature": b"\x01" * 64}, "signature"),
        ({"targets": {"iris": "b/1"}}, "not among the targets"),
        ({"targets": {}}, "not among the targets"),
        ({"epoch": 2}, "epoch"),
        ({"epoch": 0}, "epoch"),
    ],
)
async def test_a_reset_that_does_not_count_is_refused_with_its_reason(
    stage: RobotStage, changes: dict[str, Any], why: str
) -> None:
    stage.stop()
    await stopped(stage)
    stage.reset(**changes)
    assert why in (await stage.heard("reset_refused")).detail
    assert stage.adapter.latched


async def test_a_reset_counts_once(stage: RobotStage) -> None:
    stage.stop()
    await stopped(stage)
    used = stage.reset()
    await stage.heard("released")
    stage.stop()
    await stage.until(lambda: stage.adapter.did.count("safe:stop") == 2, "stopped again")
    await stage.settle()
    stage.bus.put(stage.keys.reset, used, qos=Qos.STOP)
    assert "used before" in (await stage.heard("reset_refused")).detail
    assert stage.adapter.latched


async def test_a_reset_that_was_signed_before_a_stop_does_not_release_it(stage: RobotStage) -> None:
    stage.stop()
    await stopped(stage)
    early = stage.signed_reset()
    stage.stop()
    stage.bus.put(stage.keys.reset, early, qos=Qos.STOP)
    assert "before the newest stop" in (await stage.heard("reset_refused")).detail
    assert stage.adapter.latched
    await stage.settle()
    stage.reset()
    await stage.heard("released")


async def test_a_reset_that_was_signed_before_the_first_stop_does_not_release_it(stage: RobotStage) -> None:
    early = stage.signed_reset()
    stage.stop()
    await stopped(stage)
    stage.bus.put(stage.keys.reset, early, qos=Qos.STOP)
    await stage.heard("reset_refused")
    assert stage.adapter.latched


async def test_a_reset_does_not_release_a_stop_that_the_heartbeat_has_brought_since(stage: RobotStage) -> None:
    """The robot is latched already, and the newer stop's own message was lost on the way to it."""
    stage.stop()
    await stopped(stage)
    early = stage.signed_reset()
    stage.fabric.drop_next(stage.keys.stop)
    stage.stop()
    stage.beat(stop=2, stopped=("tb3",))
    await stage.until(lambda: stage.states[-1].told == (1, 2), "it was told")
    stage.bus.put(stage.keys.reset, early, qos=Qos.STOP)
    await stage.heard("reset_refused")
    assert stage.adapter.latched


async def test_a_stop_that_comes_after_the_reset_latches_again(stage: RobotStage) -> None:
    stage.stop()
    await stopped(stage)
    stage.reset()
    stage.stop()
    await stage.heard("released", "reset_refused")
    await stage.until(lambda: stage.whats.count("stopped") == 2, "the newer stop was heard")
    assert stage.adapter.latched, "whichever of them came first"


async def test_a_stop_that_comes_while_a_reset_is_carried_out_holds(
    stage: RobotStage, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The stop arrives in the bus's thread after the reset was found good, and before the latch is opened."""
    stage.stop()
    await stopped(stage)
    halted, halt, release = threading.Event(), stage.adapter.halt, stage.adapter.release

    def heard() -> None:
        halt()
        halted.set()

    def late() -> None:
        stage.stop()
        halted.wait(0.2)
        release()

    monkeypatch.setattr(stage.adapter, "halt", heard)
    monkeypatch.setattr(stage.adapter, "release", late)
    stage.reset()
    await stage.heard("released")
    await stage.until(halted.is_set, "the stop was heard")
    assert stage.adapter.latched


async def test_a_reset_of_an_earlier_boot_releases_nothing(stage: RobotStage) -> None:
    stage.stop()
    await stopped(stage)
    count = stage.actor.latch.partition("/")[2]
    stage.reset(targets={"tb3": f"{'0' * 16}/{count}"})
    await stage.heard("reset_refused")
    assert stage.adapter.latched


async def test_a_robot_cannot_have_its_own_words_read_as_another_robots(stage: RobotStage) -> None:
    """The operator signs what a rogue robot calls its latch; that signs nothing about this one."""
    stage.stop()
    await stopped(stage)
    rogue = stage.signed_reset(targets={"iris": f"b/1,tb3={stage.actor.latch}"})
    stage.reset(targets={"iris": "b/1", "tb3": stage.actor.latch}, nonce=rogue.nonce, signature=rogue.signature)
    assert "signature" in (await stage.heard("reset_refused")).detail
    assert stage.adapter.latched


async def test_a_refused_reset_does_not_use_up_its_nonce(stage: RobotStage) -> None:
    stage.stop()
    await stopped(stage)
    stage.reset(nonce="n1", signature=b"forged")
    await stage.heard("reset_refused")
    stage.reset(nonce="n1")
    await stage.heard("released")


async def test_a_reset_altered_under_way_is_refused(stage: RobotStage) -> None:
    stage.stop()
    await stopped(stage)
    genuine = stage.reset(targets={"iris": stage.actor.latch})
    await stage.heard("reset_refused")
    count = stage.whats.count("reset_refused")
    stage.reset(targets={"tb3": stage.actor.latch}, nonce=genuine.nonce, signature=genuine.signature)
    await stage.until(lambda: stage.whats.count("reset_refused") > count, "refused too")
    assert stage.adapter.latched


async def test_an_unreadable_reset_is_no_reset(stage: RobotStage) -> None:
    stage.stop()
    await stopped(stage)
    stage.bus.put(stage.keys.reset, (b"\xc1", "application/msgpack;crew.reset/1"), qos=Qos.STOP)
    await stage.settle()
    assert stage.adapter.latched


async def test_a_lost_orchestrator_ends_the_skill_and_makes_safe_once(stage: RobotStage) -> None:
    await stage.started()
    stage.orchestrator_dies()
    lost_event = await stage.heard("orchestrator_lost")
    assert "token" in lost_event.detail
    await stopped(stage)
    assert [(e.what, e.code) for e in stage.events if e.mission][1:] == [("cancelled", "orchestrator_lost")]
    assert stage.adapter.did == ["navigate_to", "cancel", "safe:stop"]
    assert not stage.adapter.latched
    await asyncio.sleep(0.3)
    await stage.settle()
    assert stage.whats.count("orchestrator_lost") == 1


async def test_an_orchestrator_whose_loop_is_frozen_counts_as_lost(
    stage: RobotStage, monkeypatch: pytest.MonkeyPatch
) -> None:
    await stage.started()
    monkeypatch.setattr(lost, "SILENT_S", 0.3)
    stage.freeze()
    assert "no heartbeat" in (await stage.heard("orchestrator_lost")).detail
    await stopped(stage)


async def test_an_orchestrator_lost_while_idle_makes_the_robot_safe(stage: RobotStage) -> None:
    stage.orchestrator_dies()
    await stage.heard("orchestrator_lost")
    await stopped(stage)
    assert stage.adapter.did == ["safe:stop"]


async def test_an_orchestrator_lost_while_the_effect_is_awaited(stage: RobotStage) -> None:
    await stage.started()
    stage.adapter.finish.set()
    await stage.settle()
    stage.orchestrator_dies()
    await stopped(stage)
    assert [(e.what, e.code) for e in stage.events if e.mission][1:] == [("cancelled", "orchestrator_lost")]


async def test_an_orchestrator_that_comes_back_is_obeyed_and_missed_again(stage: RobotStage) -> None:
    stage.orchestrator_dies()
    await stage.heard("orchestrator_lost")
    await stopped(stage)
    await stage.orchestrator_lives(epoch=2)
    stage.send(stage.dispatch(epoch=2))
    await stage.heard("accepted")
    stage.orchestrator_dies()
    await stage.until(lambda: stage.whats.count("orchestrator_lost") == 2, "lost again")


async def test_before_an_orchestrator_was_ever_heard_nothing_is_lost() -> None:
    async with robot_stage(alone=True) as stage:
        await asyncio.sleep(0.3)
        await stage.settle()
        assert "orchestrator_lost" not in stage.whats


async def test_a_stop_after_the_orchestrator_was_lost_still_latches(stage: RobotStage) -> None:
    stage.orchestrator_dies()
    await stopped(stage)
    stage.stop()
    await stage.until(lambda: stage.adapter.latched, "latched")
    await stage.heard("stopped")


# --- the stop as the orchestrator's heartbeat holds it up


async def test_a_robot_that_starts_while_the_crew_is_stopped_comes_up_latched_and_takes_nothing() -> None:
    async with robot_stage(alone=True) as stage:
        stage.beat(epoch=1, stop=4, stopped=("iris", "tb3"))
        await stage.until(lambda: stage.adapter.latched, "latched by the first heartbeat")
        await stopped(stage)
        stage.send(stage.dispatch())
        assert (await stage.heard("refused", "accepted")).code == "stopped"


@pytest.mark.hostile
async def test_a_robot_that_missed_the_stop_is_latched_by_the_next_heartbeat(stage: RobotStage) -> None:
    stage.fabric.drop_next(stage.keys.stop)
    await stage.started()
    stage.stop()
    await stage.settle()
    assert not stage.adapter.latched, "the message was lost"
    stage.beat(stop=1, stopped=("tb3",))
    await stopped(stage)
    assert stage.adapter.did == ["navigate_to", "halt", "safe:stop"]


async def test_a_heartbeat_that_still_tells_of_a_stop_does_not_latch_whom_a_reset_released(stage: RobotStage) -> None:
    stage.beat(stop=1, stopped=("tb3",))
    await stopped(stage)
    stage.reset()
    await stage.heard("released")
    stage.beat(stop=1, stopped=("tb3",))
    await stage.settle()
    await asyncio.sleep(0.2)
    assert not stage.adapter.latched
    stage.beat(stop=2, stopped=("tb3",))
    await stage.until(lambda: stage.adapter.latched, "a newer stop latches")


async def test_a_stop_of_others_latches_nobody_else(stage: RobotStage) -> None:
    stage.beat(stop=1, stopped=("iris",))
    await asyncio.sleep(0.2)
    await stage.settle()
    assert not stage.adapter.latched
    await stage.started()


async def test_what_was_latched_before_the_vehicle_was_found_is_carried_out_on_it(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(actor, "CONNECT_RETRY_S", 0.3)
    async with robot_stage(AdapterError("tb3: no vehicle"), stop_first=True) as stage:
        await stopped(stage)
        count = stage.adapter.did.count("safe:stop")
        await stage.heard("ready")
        await stage.until(lambda: stage.adapter.did.count("safe:stop") > count, "once more, now that it is there")


async def test_a_lost_bus_is_told_apart_from_a_lost_orchestrator(stage: RobotStage) -> None:
    await stage.started()
    assert stage.robot_bus is not None
    stage.robot_bus.disconnect()
    await stage.until(lambda: "safe:stop" in stage.adapter.did, "the declared behaviour runs")
    assert "bus lost" in stage.actor.unavailable
    stage.robot_bus.reconnect()
    returned = await stage.heard("bus_returned")
    assert returned.code == "bus_lost"
    assert "orchestrator_lost" not in stage.whats
    await stage.until(lambda: not stage.actor.unavailable, "it serves again")

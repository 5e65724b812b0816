"""What a robot takes and what it refuses, whoever sends it: its own check, beside the orchestrator's gate."""

from collections.abc import AsyncIterator
from typing import Any

import pytest

from crew.actors.robot import actor
from crew.bus.port import Qos
from crew.clock import seconds_ns
from crew.errors import AdapterError
from tests.unit.actors.stage import RobotStage, robot_stage


@pytest.fixture
async def stage() -> AsyncIterator[RobotStage]:
    async with robot_stage() as stage:
        yield stage


async def test_a_sound_dispatch_is_accepted_run_and_reported_once(stage: RobotStage) -> None:
    await stage.started()
    assert (await stage.heard("accepted")).sequence == 1
    await stage.until(lambda: any(s.running == "m1/1" for s in stage.states), "its state says what it does")
    stage.adapter.arrive()
    await stage.heard("succeeded")
    await stage.settle()
    assert [e.what for e in stage.events if e.mission] == ["accepted", "succeeded"]
    assert stage.adapter.did == ["navigate_to"]
    await stage.until(lambda: stage.states[-1].running == "", "its state says that it is done")


@pytest.mark.parametrize(
    ("changes", "code"),
    [
        ({"expires_ns": -1}, "expired"),
        ({"issued_ns": seconds_ns(3600.0), "expires_ns": seconds_ns(3602.0)}, "clock_skew"),
        ({"contract_digest": "0" * 64}, "unknown_contract"),
        ({"args_digest": "0" * 64}, "altered"),
        ({"args": {"x": 20.0, "y": 0.0}}, "out_of_bounds"),
        ({"args": {"x": float("nan"), "y": 0.0}}, "bad_argument"),
        ({"args": {"x": -3.0}}, "missing_argument"),
        ({"args": {"target": "atlantis"}}, "unknown_location"),
        ({"args": {"x": -3.0, "y": -3.0, "speed": 9.0}}, "unknown_argument"),
        ({"skill": "takeoff", "args": {"altitude": 5.0}}, "unknown_skill"),
    ],
)
async def test_what_is_not_sound_is_refused_by_name_and_moves_nothing(
    stage: RobotStage, changes: dict[str, Any], code: str
) -> None:
    await stage.orchestrator_lives(epoch=1)
    stage.send(stage.dispatch(**changes))
    refused = await stage.heard("refused")
    assert refused.code == code
    assert refused.detail
    assert (refused.mission, refused.sequence) == ("m1", 1)
    assert stage.adapter.did == []


async def test_a_dispatch_is_good_until_it_expires_and_not_later(stage: RobotStage) -> None:
    old = stage.dispatch()
    stage.clock.advance(old.expires_ns + 1)
    stage.send(old)
    assert (await stage.heard("refused", "accepted")).code == "expired"


async def test_a_sequence_is_taken_once_and_in_order(stage: RobotStage) -> None:
    await stage.started(sequence=2)
    stage.adapter.arrive()
    await stage.heard("succeeded")
    for sequence, code in ((2, "replayed"), (1, "reordered")):
        count = len(stage.events)
        stage.send(stage.dispatch(sequence))
        await stage.until(lambda count=count: len(stage.events) > count, "an answer")  # type: ignore[misc]
        assert stage.last("permit_refused").code == code
    assert stage.adapter.did == ["navigate_to"]
    stage.adapter.finish.clear()
    stage.send(stage.dispatch(1, mission="m2"))
    await stage.until(lambda: stage.whats.count("accepted") == 2, "another mission counts for itself")


async def test_a_duplicated_dispatch_runs_once(stage: RobotStage) -> None:
    stage.fabric.duplicate_next("crew/air_ground/tb3/@act/**")
    await stage.started()
    await stage.settle()
    assert stage.adapter.did == ["navigate_to"]
    assert stage.whats.count("accepted") == 1


async def test_a_refusal_uses_up_its_permit_alone(stage: RobotStage) -> None:
    """Otherwise whoever kept a copy could have it carried out once the reason for the refusal is gone."""
    stage.stop()
    await stage.until(lambda: stage.adapter.latched, "stopped")
    kept = stage.dispatch(1)
    stage.send(kept)
    assert (await stage.heard("refused")).code == "stopped"
    stage.adapter.release()
    stage.send(kept)
    assert (await stage.heard("permit_refused")).code == "replayed"
    await stage.started(sequence=2)


async def test_a_newer_orchestrator_ends_the_older_ones_authority(stage: RobotStage) -> None:
    stage.beat(epoch=7)
    await stage.until(lambda: stage.actor.admission.epoch == 7)
    stage.send(stage.dispatch(epoch=6))
    assert (await stage.heard("permit_refused")).code == "old_epoch"
    stage.send(stage.dispatch(epoch=7))
    await stage.heard("accepted")


async def test_one_skill_at_a_time(stage: RobotStage) -> None:
    await stage.started()
    stage.send(stage.dispatch(2))
    refused = await stage.heard("refused")
    assert (refused.code, refused.sequence) == ("robot_busy", 2)
    stage.adapter.arrive()
    assert (await stage.heard("succeeded")).sequence == 1


async def test_a_robot_that_says_it_is_unavailable_takes_nothing(stage: RobotStage) -> None:
    stage.adapter.sick = "battery at 3 percent"
    stage.send(stage.dispatch())
    refused = await stage.heard("refused")
    assert refused.code == "robot_unavailable"
    assert "battery" in refused.detail
    assert stage.adapter.did == []


async def test_unreadable_commands_are_dropped_and_the_next_one_is_taken(stage: RobotStage) -> None:
    key = stage.keys.act("tb3", "navigate_to")
    for body in ((b"", ""), (b"\x81", "application/msgpack;crew.dispatch/1"), (b"{}", "application/json")):
        stage.bus.put(key, body, qos=Qos.ACTUATION)
    for version in (0, 2):
        stage.bus.put(key, (b"\x80", f"application/msgpack;crew.dispatch/{version}"), qos=Qos.ACTUATION)
    await stage.settle()
    assert stage.adapter.did == []
    await stage.started()


async def test_unreadable_commands_are_counted_for_people(stage: RobotStage) -> None:
    for key in (stage.keys.act("tb3", "navigate_to"), stage.keys.reset, stage.keys.heartbeat()):
        stage.bus.put(key, (b"\x80", "application/msgpack;crew.dispatch/9"), qos=Qos.EVENT)
    await stage.until(lambda: stage.states[-1].dropped == 3, "its state tells how many")


async def test_a_flood_of_commands_is_refused_not_queued(stage: RobotStage) -> None:
    await stage.started()
    for sequence in range(2, 80):
        stage.send(stage.dispatch(sequence))
    await stage.until(lambda: stage.whats.count("refused") + stage.whats.count("dropped") == 78, "each is answered")
    assert stage.adapter.did == ["navigate_to"]


async def test_a_vehicle_that_is_not_found_at_first_is_named_and_looked_for_again(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(actor, "CONNECT_RETRY_S", 0.05)
    async with robot_stage(AdapterError("tb3: no vehicle on udp:1")) as stage:
        assert "tb3: no vehicle on udp:1" in {state.unavailable for state in stage.states}
        assert stage.actor.unavailable == ""
        await stage.started()


async def test_a_failed_skill_is_reported_with_the_vehicles_own_reason(stage: RobotStage) -> None:
    await stage.started()
    stage.adapter.broken = AdapterError("tb3: wheel stuck", code="vehicle_refused")
    stage.adapter.finish.set()
    failed = await stage.heard("failed")
    assert (failed.code, failed.detail) == ("vehicle_refused", "tb3: wheel stuck")
    await stage.settle()
    assert [e.what for e in stage.events if e.mission] == ["accepted", "failed"]


async def test_saying_done_is_not_enough_the_effect_must_show(stage: RobotStage) -> None:
    await stage.started()
    stage.adapter.finish.set()
    failed = await stage.heard("failed", "succeeded")
    assert (failed.what, failed.code) == ("failed", "effect_not_observed")
    assert "tb3.at" in failed.detail


async def test_a_skill_that_takes_too_long_is_stopped_and_failed(stage: RobotStage) -> None:
    await stage.started()
    stage.clock.advance(stage.clock.now_ns() + seconds_ns(181.0))
    failed = await stage.heard("failed")
    assert failed.code == "timeout"
    assert stage.adapter.did == ["navigate_to", "cancel"]
    stage.adapter.finish.clear()
    stage.send(stage.dispatch(2))
    await stage.until(lambda: stage.last("accepted").sequence == 2, "it takes the next one")


async def test_a_cancel_brakes_and_is_reported_once(stage: RobotStage) -> None:
    await stage.started()
    stage.cancel()
    assert (await stage.heard("cancelled")).code == "cancelled"
    stage.cancel()
    await stage.settle()
    assert stage.adapter.did == ["navigate_to", "cancel"]
    assert stage.whats.count("cancelled") == 1


@pytest.mark.parametrize(
    "changes", [{"sequence": 2}, {"mission": "m2"}, {"robot": "iris"}, {"boot_id": "old"}, {"epoch": 0}]
)
async def test_a_cancel_of_something_else_changes_nothing(stage: RobotStage, changes: dict[str, Any]) -> None:
    await stage.orchestrator_lives(epoch=1)
    await stage.started()
    stage.cancel(**changes)
    await stage.settle()
    assert stage.actor.running == "m1/1"
    stage.adapter.arrive()
    await stage.heard("succeeded")


async def test_a_cancel_that_the_vehicle_does_not_confirm_says_so(stage: RobotStage) -> None:
    await stage.started()
    stage.adapter.deaf = AdapterError("tb3: no answer", code="still_moving")
    stage.cancel()
    cancelled = await stage.heard("cancelled")
    assert "may still be moving" in cancelled.detail


async def test_a_dispatch_and_its_cancel_that_arrive_together_run_nothing(stage: RobotStage) -> None:
    stage.send(stage.dispatch())
    stage.cancel()
    while not stage.fabric.settled():
        pass  # the robot's loop is this one: both wait in its mailbox
    cancelled = await stage.heard("cancelled")
    assert (cancelled.code, cancelled.sequence) == ("cancelled", 1)
    assert stage.adapter.did == []
    await stage.started(sequence=2)


async def test_a_second_cancel_while_it_brakes_does_not_cut_off_the_report(stage: RobotStage) -> None:
    await stage.started()
    stage.adapter.brake.clear()
    stage.cancel()
    await stage.until(lambda: "cancel" in stage.adapter.did, "it brakes")
    stage.cancel()
    await stage.settle()
    stage.adapter.brake.set()
    await stage.heard("cancelled")
    await stage.settle()
    stage.adapter.finish.clear()
    stage.send(stage.dispatch(2))
    await stage.until(lambda: stage.last("accepted").sequence == 2, "it takes the next one")
    assert stage.whats.count("cancelled") == 1

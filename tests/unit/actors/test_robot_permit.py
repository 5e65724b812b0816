"""Permits at the robot: what the orchestrator did not sign, for this boot, now and once, is refused by its own code.

Every refusal has its positive control beside it: the rightful sender's same message goes through.
"""

from collections.abc import AsyncIterator, Callable

import pytest
from msgspec.structs import replace

from crew.actors.robot import lost
from crew.bus.memory import MemoryBus
from crew.bus.port import Qos
from crew.contracts.plan import ArgValue, digest
from crew.contracts.snapshot import Point
from crew.messages import CancelSkill, Dispatch, Heartbeat
from crew.permit import permit, permit_problem
from crew.signing import SigningKey
from crew.wire import decode, encode
from tests.unit.actors.stage import RobotStage, robot_stage

STRANGER = SigningKey(b"s" * 32)
ELSEWHERE: dict[str, ArgValue] = {"x": -2.0, "y": -2.0}
SOUND = Dispatch(
    mission="m1",
    step="dispatch",
    purpose="execute",
    sequence=1,
    robot="tb3",
    skill="navigate_to",
    args={"x": 1.0},
    epoch=1,
    lease="m1",
    boot_id="b",
    issued_ns=0,
    expires_ns=1,
    args_digest="a",
    plan_digest="p",
    contract_digest="c",
)
Spoil = Callable[[RobotStage, Dispatch], Dispatch]


@pytest.fixture
async def stage() -> AsyncIterator[RobotStage]:
    async with robot_stage() as stage:
        await stage.orchestrator_lives(epoch=1)
        yield stage


def unsigned(stage: RobotStage, sound: Dispatch) -> Dispatch:
    return replace(sound, permit=b"")


def by_a_stranger(stage: RobotStage, sound: Dispatch) -> Dispatch:
    return permit(sound, stage.keys.crew, STRANGER)


def under_the_orchestrators_name(stage: RobotStage, sound: Dispatch) -> Dispatch:
    """A stranger's signature that claims to be of the orchestrator's key."""
    return replace(sound, permit=sound.permit[:8] + permit(sound, stage.keys.crew, STRANGER).permit[8:])


def for_another_crew(stage: RobotStage, sound: Dispatch) -> Dispatch:
    return permit(sound, "another_crew", stage.orchestrator)


def cut_short(stage: RobotStage, sound: Dispatch) -> Dispatch:
    return replace(sound, permit=sound.permit[:-1])


def as_a_cancel(stage: RobotStage, sound: Dispatch) -> Dispatch:
    """A signature for another purpose by the same key."""
    return replace(sound, permit=sound.permit[:8] + stage.orchestrator.sign("journal-head", b"anything"))


def altered(**changes: object) -> Spoil:
    def spoil(stage: RobotStage, sound: Dispatch) -> Dispatch:
        return replace(sound, **changes)

    return spoil


def for_an_earlier_boot(stage: RobotStage, sound: Dispatch) -> Dispatch:
    return stage.dispatch(boot_id="an earlier life")


def of_an_earlier_epoch(stage: RobotStage, sound: Dispatch) -> Dispatch:
    return stage.dispatch(epoch=0)


def for_another_robot(stage: RobotStage, sound: Dispatch) -> Dispatch:
    return stage.dispatch(robot="iris")


FORGERIES: dict[str, tuple[Spoil, str]] = {
    "unsigned": (unsigned, "no_permit"),
    "signed by a stranger": (by_a_stranger, "foreign_permit"),
    "signed by a stranger in the orchestrator's name": (under_the_orchestrators_name, "altered"),
    "of another crew": (for_another_crew, "altered"),
    "cut short": (cut_short, "altered"),
    "another purpose": (as_a_cancel, "altered"),
    "other arguments": (altered(args=ELSEWHERE, args_digest=digest(ELSEWHERE)), "altered"),
    "another place": (altered(places={"target": Point(9.0, 9.0)}), "altered"),
    "a later expiry": (altered(expires_ns=1 << 62), "altered"),
    "another sequence": (altered(sequence=7), "altered"),
    "another mission": (altered(mission="m2"), "altered"),
    "another step": (altered(step="safe:responder"), "altered"),
    "another purpose of the step": (altered(purpose="safe"), "altered"),
    "another skill": (altered(skill="stop"), "altered"),
    "another epoch": (altered(epoch=2), "altered"),
    "another lease": (altered(lease="m2"), "altered"),
    "another fence": (altered(fence=9), "altered"),
    "another plan": (altered(plan_digest="0" * 64), "altered"),
    "an approval": (altered(approval="yes"), "altered"),
    "an earlier boot": (for_an_earlier_boot, "old_boot"),
    "an earlier epoch": (of_an_earlier_epoch, "old_epoch"),
    "another robot": (for_another_robot, "wrong_robot"),
}


@pytest.mark.parametrize("forgery", FORGERIES)
async def test_a_forgery_is_refused_by_its_code_and_the_rightful_dispatch_runs(stage: RobotStage, forgery: str) -> None:
    spoil, code = FORGERIES[forgery]
    sound = stage.dispatch()
    stage.send(spoil(stage, sound))
    event = await stage.heard("permit_refused", "accepted")
    assert (event.what, event.code) == ("permit_refused", code)
    assert event.mission == "", "it is no word about a mission"
    assert "of m" in event.detail, "it says what was claimed"
    assert stage.adapter.did == []
    await stage.until(lambda: stage.states[-1].refused_permits == 1, "its state counts it")
    stage.send(sound)
    await stage.heard("accepted")


@pytest.mark.parametrize(
    ("peer", "certificate", "words"),
    [
        ("router", "orchestrator", "sent with the certificate of orchestrator"),
        ("planner", "", "this link shows planner"),
        ("", "", "this link shows none"),
    ],
)
async def test_a_refused_permit_names_the_certificate_as_far_as_it_is_known(
    stage: RobotStage, monkeypatch: pytest.MonkeyPatch, peer: str, certificate: str, words: str
) -> None:
    monkeypatch.setattr(MemoryBus, "peer", peer)
    stage.send(replace(stage.dispatch(), permit=b""))
    event = await stage.heard("permit_refused")
    assert event.certificate == certificate
    assert words in event.detail


async def test_forged_heartbeats_are_told_once_and_counted_each_time(
    stage: RobotStage, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(MemoryBus, "peer", "router")
    stage.freeze()
    for count in (1, 2, 3):
        stage.bus.put(stage.keys.heartbeat(), replace(stage.heartbeat(1), permit=b""), qos=Qos.EVENT)
        await stage.until(lambda count=count: stage.actor.admission.refused_permits == count, "counted")  # type: ignore[misc]
    event = await stage.heard("permit_refused")
    assert (event.code, event.certificate) == ("no_permit", "orchestrator")
    assert event.detail.startswith("heartbeat: ")
    await stage.settle()
    assert stage.whats.count("permit_refused") == 1


async def test_a_forged_answer_to_a_running_dispatch_does_not_end_it(stage: RobotStage) -> None:
    await stage.started()
    stage.send(replace(stage.dispatch(1), permit=b""))
    await stage.heard("permit_refused")
    assert stage.actor.running == "m1/1"
    assert [e.what for e in stage.events if e.mission] == ["accepted"]


def other(value: object) -> object:
    """A value of the same type that differs."""
    match value:
        case bytes():
            return value + b"x"
        case str():
            return value + "x"
        case int():
            return value + 1
    return {"other": 2.0}


@pytest.mark.parametrize("field", [f for f in Dispatch.__struct_fields__ if f != "permit"])
def test_no_field_of_a_dispatch_is_outside_its_permit(field: str) -> None:
    sound = permit(SOUND, "crew", STRANGER)
    assert permit_problem(sound, "crew", STRANGER.public) is None
    problem = permit_problem(replace(sound, **{field: other(getattr(sound, field))}), "crew", STRANGER.public)
    assert problem is not None
    assert problem.code == "altered"


def test_a_permit_survives_the_wire_whatever_the_arguments() -> None:
    args: dict[str, ArgValue] = {"y": float("nan"), "x": float("inf"), "target": "a", "altitude": -0.0}
    sent = permit(replace(SOUND, args=args, places={"target": Point(float("nan"), 1.0)}), "crew", STRANGER)
    heard = decode(Dispatch, *encode(sent))
    assert permit_problem(heard, "crew", STRANGER.public) is None


@pytest.mark.hostile
async def test_a_captured_permit_is_good_for_nothing_later(stage: RobotStage) -> None:
    captured = stage.dispatch()
    stage.send(captured)
    await stage.heard("accepted")
    stage.adapter.arrive()
    await stage.heard("succeeded")
    stage.send(captured)
    assert (await stage.heard("permit_refused")).code == "replayed"
    stage.clock.advance(captured.expires_ns + 1)
    held_back = stage.dispatch(2, issued_ns=0, expires_ns=captured.expires_ns)
    stage.send(held_back)
    assert (await stage.heard("refused")).code == "expired"
    stage.adapter.finish.clear()
    stage.send(stage.dispatch(3))
    await stage.until(lambda: stage.last("accepted").sequence == 3, "the next rightful one runs")


async def test_a_command_of_an_earlier_lease_is_refused(stage: RobotStage) -> None:
    stage.fence = 5
    await stage.started()
    stage.adapter.arrive()
    await stage.heard("succeeded")
    stage.send(stage.dispatch(2, mission="m0", lease="m0", fence=4))
    assert (await stage.heard("refused")).code == "old_lease"
    stage.adapter.finish.clear()
    stage.send(stage.dispatch(3, fence=5))
    await stage.until(lambda: stage.last("accepted").sequence == 3, "the holder goes on")


async def test_a_cancel_that_the_orchestrator_did_not_sign_cancels_nothing(stage: RobotStage) -> None:
    await stage.started()
    boot = stage.actor.boot_id
    bare = CancelSkill(mission="m1", sequence=1, robot="tb3", epoch=1, boot_id=boot)
    for forged, code in ((bare, "no_permit"), (permit(bare, stage.keys.crew, STRANGER), "foreign_permit")):
        stage.put_cancel(forged)
        await stage.until(lambda code=code: code in {e.code for e in stage.events}, code)  # type: ignore[misc]
    assert stage.actor.running == "m1/1"
    stage.cancel()
    assert (await stage.heard("cancelled")).sequence == 1


async def test_a_dispatch_that_comes_after_its_own_cancel_does_not_run(stage: RobotStage) -> None:
    stage.cancel()
    await stage.settle()
    stage.send(stage.dispatch(1))
    assert (await stage.heard("permit_refused", "accepted")).code == "replayed"
    await stage.started(sequence=2)


# --- heartbeats


async def test_a_robot_takes_nothing_before_it_has_heard_its_orchestrator() -> None:
    async with robot_stage(alone=True) as stage:
        stage.bus.put(stage.keys.heartbeat(), replace(stage.heartbeat(), permit=b""), qos=Qos.EVENT)
        stage.send(stage.dispatch())
        refused = await stage.heard("refused", "accepted")
        assert (refused.code, "waiting for the orchestrator" in refused.detail) == ("robot_unavailable", True)
        stage.beat()
        await stage.until(lambda: not stage.actor.unavailable, "it is heard")
        stage.send(stage.dispatch(2))
        await stage.heard("accepted")


@pytest.mark.parametrize("forge", [lambda beat: replace(beat, permit=b""), lambda beat: replace(beat, epoch=1 << 40)])
async def test_a_forged_heartbeat_ends_no_authority(stage: RobotStage, forge: Callable[[Heartbeat], Heartbeat]) -> None:
    for _ in range(3):
        stage.bus.put(stage.keys.heartbeat(), forge(stage.heartbeat(1)), qos=Qos.EVENT)
        await stage.settle()
    assert stage.actor.admission.epoch == 1
    await stage.started()


async def test_replayed_heartbeats_do_not_hide_a_frozen_orchestrator(
    stage: RobotStage, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(lost, "SILENT_S", 0.3)
    captured = stage.heartbeat(1)
    stage.bus.put(stage.keys.heartbeat(), captured, qos=Qos.EVENT)
    await stage.settle()
    stage.freeze()

    def replay() -> bool:
        stage.bus.put(stage.keys.heartbeat(), captured, qos=Qos.EVENT)
        return "orchestrator_lost" in stage.whats

    await stage.until(replay, "it is missed all the same")

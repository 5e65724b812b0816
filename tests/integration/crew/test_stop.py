"""One message stops and latches every robot; only the operator's signature releases them."""

import math
from collections.abc import AsyncIterator
from typing import Any

import pytest
from msgspec.structs import replace

from crew.bus.port import Body, Qos
from crew.clock import seconds_ns
from crew.contracts.plan import ArgValue, digest
from crew.launch.table import OPERATOR, ORCHESTRATOR
from crew.library import load_rules
from crew.messages import Dispatch, Reset, RobotEvent, Stop
from crew.permit import permit
from crew.release import signed_reset
from crew.signing import load_or_create_key
from tests.integration.crew.harness import (
    FAR_DRIVE,
    NAME,
    SEARCH,
    SHORT_DRIVE,
    Desk,
    Up,
    Watch,
    intents,
    latches,
    watching,
)

BOTH = ("iris", "tb3")
GARBAGE: dict[str, Body] = {
    "a stop": Stop(by="operator", reason="test"),
    "nothing": (b"", ""),
    "garbage": (b"\xff\x00\xc1" * 100, "application/msgpack;crew.stop/1"),
    "another version": (b"\x80", "application/msgpack;crew.stop/999"),
}


@pytest.fixture
async def watch(desk: Desk, up: Up) -> AsyncIterator[Watch]:
    """A session with the crew, which is released after each test."""
    async with watching(up.running) as watch:
        await watch.until(lambda: set(BOTH) <= watch.states.keys(), why="states")
        yield watch
        await released(watch, desk)


async def stopped(watch: Watch, body: Body) -> None:
    """Put one message on the stop key; wait until both robots say that they are latched and stand still."""
    watch.put(watch.keys.stop, body, qos=Qos.STOP)
    await watch.until(lambda: all(watch.states[r].stopped for r in BOTH), why="latched")
    await watch.until(lambda: all(watch.states[r].stopped and watch.states[r].still for r in BOTH), 60.0, "still")


async def reset(watch: Watch, desk: Desk, **changes: Any) -> Reset:
    """Publish a reset; signed by the operator as it stands unless the test brings a signature."""
    status, key = await watch.status(), load_or_create_key(desk.home.keys, OPERATOR)
    seen = latches(status)
    targets = {robot: seen[robot] for robot in changes.get("robots", BOTH)}
    signed = signed_reset(NAME, targets, key, by=OPERATOR, epoch=changes.get("epoch", status.epoch))
    signed = replace(signed, signature=changes.get("signature", signed.signature))
    watch.put(watch.keys.reset, signed, qos=Qos.STOP)
    return signed


async def released(watch: Watch, desk: Desk) -> None:
    """Release both robots; one that is still landing is asked again."""
    for _ in range(20):
        answers = len(answered(watch))
        await reset(watch, desk)
        await watch.until(lambda answers=answers: len(answered(watch)) >= answers + 2, why="answers")  # type: ignore[misc]
        if all(e.what == "released" for e in answered(watch)[-2:]):
            break
    await watch.until(lambda: not any(watch.states[r].stopped for r in BOTH), why="released")


def answered(watch: Watch) -> list[RobotEvent]:
    return [e for e in watch.robot_events if e.what in ("released", "reset_refused")]


def refusals(watch: Watch) -> list[RobotEvent]:
    return [e for e in watch.robot_events if e.what == "reset_refused"]


@pytest.mark.parametrize(
    "name", [n if n in ("a stop", "garbage") else pytest.param(n, marks=pytest.mark.soak) for n in GARBAGE]
)
async def test_one_message_stops_everything_in_mid_mission(watch: Watch, desk: Desk, up: Up, name: str) -> None:
    before = len(intents(up.run))
    search, drive = watch.ask(SEARCH), watch.ask(FAR_DRIVE)
    await watch.until(lambda: "iris.search_target" in intents(up.run)[before:], 60.0, "it searches, after its takeoff")
    await watch.moving("iris", mps=0.8)
    await watch.moving("tb3")
    sent = len(intents(up.run))
    await stopped(watch, GARBAGE[name])
    for request in (search, drive):
        ended = await watch.ended(request)
        assert (ended.outcome, ended.code) == ("halted", "stopped")
    x, y, *_ = await watch.standing("tb3")
    assert math.dist((x, y), (9.0, -5.5)) > 1.0
    await watch.landed("iris")
    assert len(intents(up.run)) == sent, "a stopped crew is sent nothing"
    assert (await watch.status()).stopped
    await released(watch, desk)
    await watch.drives()


@pytest.mark.hostile
async def test_while_latched_nothing_is_accepted_by_anybody(watch: Watch, desk: Desk, up: Up) -> None:
    sent = len(intents(up.run))
    await stopped(watch, Stop(by="operator"))
    refused = await watch.mission(SHORT_DRIVE)
    assert (refused.outcome, refused.code) == ("rejected", "stopped")
    assert len(intents(up.run)) == sent
    args: dict[str, ArgValue] = {"x": -3.0, "y": -3.0}
    now_ns = watch.states["tb3"].at_ns
    forged = Dispatch(
        mission="m-forged",
        step="dispatch",
        purpose="execute",
        sequence=1,
        robot="tb3",
        skill="navigate_to",
        args=args,
        epoch=(await watch.status()).epoch,
        lease="m-forged",
        fence=1 << 20,
        boot_id=watch.states["tb3"].boot_id,
        issued_ns=now_ns,
        expires_ns=now_ns + seconds_ns(60.0),
        args_digest=digest(args),
        plan_digest="",
        contract_digest=load_rules("air_ground").contracts["dispatch_only"].digest,
    )
    watch.put(watch.keys.act("tb3", "navigate_to"), forged, qos=Qos.ACTUATION)
    await watch.until(lambda: any(e.what == "permit_refused" for e in watch.robot_events), why="it says so")
    told = next(e for e in watch.robot_events if e.what == "permit_refused")
    assert (told.code, told.certificate) == ("no_permit", "orchestrator"), "the one that the router lets through"
    rightful = permit(forged, watch.keys.crew, load_or_create_key(desk.home.keys, ORCHESTRATOR))
    watch.put(watch.keys.act("tb3", "navigate_to"), rightful, qos=Qos.ACTUATION)
    await watch.until(lambda: any(e.mission == "m-forged" for e in watch.robot_events), why="an answer")
    answer = next(e for e in watch.robot_events if e.mission == "m-forged")
    assert (answer.what, answer.code) == ("refused", "stopped")
    await released(watch, desk)


async def test_only_a_fresh_signed_reset_of_this_epoch_releases(watch: Watch, desk: Desk) -> None:
    used = await reset(watch, desk)
    await watch.until(lambda: sum(e.what == "released" for e in watch.robot_events) == 2, why="not latched: it counts")
    await stopped(watch, Stop(by="operator"))
    epoch = (await watch.status()).epoch
    wrong: dict[str, tuple[dict[str, Any], str]] = {
        "unsigned": ({"signature": b""}, "signature"),
        "signed by another": ({"signature": b"\x07" * 64}, "signature"),
        "of an older epoch": ({"epoch": epoch - 1}, "epoch"),
        "of a later epoch": ({"epoch": epoch + 1}, "epoch"),
        "without targets": ({"robots": ()}, "not among the targets"),
    }
    for name, (changes, why) in wrong.items():
        count = len(refusals(watch))
        await reset(watch, desk, **changes)
        await watch.until(lambda count=count: len(refusals(watch)) == count + 2, why=name)  # type: ignore[misc]
        assert all(why in e.detail for e in refusals(watch)[-2:]), name
    count = len(refusals(watch))
    watch.put(watch.keys.reset, used, qos=Qos.STOP)
    await watch.until(lambda: len(refusals(watch)) == count + 2, why="replayed")
    assert all("used before" in e.detail for e in refusals(watch)[-2:])
    watch.put(watch.keys.reset, (b"\x00", "text/plain"), qos=Qos.STOP)
    await reset(watch, desk, robots=("tb3",))
    await watch.until(lambda: not watch.states["tb3"].stopped, why="the rover is released")
    assert watch.states["iris"].stopped, "it was not among the targets"
    assert (await watch.status()).stopped
    assert (await watch.mission(SHORT_DRIVE)).code == "stopped"
    await released(watch, desk)


async def test_stop_and_reset_on_the_command_line(watch: Watch, desk: Desk) -> None:
    watch.ask(FAR_DRIVE)
    await watch.moving("tb3")
    stop = desk.crew("stop")
    assert stop.returncode == 0, stop.stdout + stop.stderr
    assert "standing still: iris, tb3" in stop.stdout
    assert "STOPPED" in desk.crew("status").stdout
    done = desk.crew("reset")
    assert done.returncode == 0, done.stdout + done.stderr
    assert "tb3: released" in done.stdout
    await watch.until(lambda: not any(watch.states[r].stopped for r in BOTH), why="released")
    await watch.drives()

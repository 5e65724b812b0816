"""Hostile cases against a crew that is up, with a rogue in the planner's place. Each has its positive control."""

import asyncio
import json
import os
import signal
import threading
from collections.abc import AsyncIterator, Iterator
from pathlib import Path
from typing import Any

import pytest
import zenoh
from msgspec.structs import replace

from crew.bus.port import Qos
from crew.contracts.plan import Call, Plan, digest
from crew.keys import Keys
from crew.launch.live import OPERATOR, ORCHESTRATOR
from crew.messages import RESET, Dispatch, PlannerAsk, PlannerProposal, Reset, Stop
from crew.permit import permit
from crew.records import IntentRecord
from crew.signing import load_or_create_key
from crew.wire import decode, encode
from tests.integration.crew.harness import (
    FAR_DRIVE,
    NAME,
    SHORT_DRIVE,
    Desk,
    Up,
    Voices,
    Watch,
    intents,
    journal,
    watching,
)

pytestmark = pytest.mark.hostile
BOTH = ("iris", "tb3")
EMPTY = digest({})
TO_POINT = Call("tb3", "navigate_to", {"x": -3.0, "y": -3.0})
SOUND = Plan("dispatch_only", (TO_POINT,))
NAN = float("nan")
SEARCH_ALL = {"x_min": -6.0, "x_max": 10.0, "y_min": -6.0, "y_max": 10.0, "altitude": 5.0}
SEARCH_AND_SEND = Plan(
    "search_and_dispatch",
    (
        Call("iris", "takeoff", {"altitude": 5.0}),
        Call("iris", "search_target", SEARCH_ALL),
        Call("iris", "get_coordinates"),
        Call("tb3", "navigate_to", {"target": "victim"}),
        Call("iris", "land"),
    ),
)


def to(call: Call = TO_POINT, /, **changes: Any) -> Plan:
    """The sound plan with its call changed."""
    robot, skill = changes.pop("robot", call.robot), changes.pop("skill", call.skill)
    return Plan("dispatch_only", (Call(robot, skill, {**call.args, **changes}),))


PLANS: dict[str, tuple[str, Plan, str]] = {
    "1 unknown skill": (SHORT_DRIVE, to(skill="teleport"), "unknown_skill"),
    "2 unknown robot": (SHORT_DRIVE, to(robot="tb9"), "unknown_robot"),
    "3 extra argument": (SHORT_DRIVE, to(speed=99.0), "unknown_argument"),
    "4 out of bounds": (SHORT_DRIVE, to(x=50.0), "out_of_bounds"),
    "5 NaN": (SHORT_DRIVE, to(x=NAN), "bad_argument"),
    "6 the wrong frame": ("send the rover to (-3, -2)", to(x=-2.0, y=-3.0), "not_requested"),
    "7 unrequested target": ("send the rover to base", SOUND, "not_requested"),
    "8 negated target": ("search the area but do not send the rover", SEARCH_AND_SEND, "forbidden_by_request"),
}


class Rogue:
    """Sits in the planner's place with the planner's certificate, and proposes whatever the test wants."""

    def __init__(self, session: zenoh.Session, keys: Keys) -> None:
        self.plan = SOUND
        self._session, self._keys = session, keys
        self._held = [
            session.liveliness().declare_token(keys.alive("planner")),
            session.declare_subscriber(keys.planner_ask, self._answer),
        ]

    def _answer(self, sample: zenoh.Sample) -> None:
        ask = decode(PlannerAsk, sample.payload.to_bytes(), str(sample.encoding))
        proposal = PlannerProposal(mission=ask.mission, attempt=ask.attempt, planner="rogue", plan=self.plan)
        payload, encoding = encode(proposal)
        self._session.put(self._keys.planner_proposal, payload, encoding=encoding)


@pytest.fixture(scope="module")
def desk(tmp_path_factory: pytest.TempPathFactory) -> Desk:
    return Desk(tmp_path_factory.mktemp("hostile"))


@pytest.fixture(scope="module")
def up(desk: Desk) -> Iterator[Up]:
    with desk.up() as up:
        up.kill("planner")
        yield up


@pytest.fixture(scope="module")
def voices(up: Up) -> Iterator[Voices]:
    with Voices(up.running) as voices:
        yield voices


@pytest.fixture(scope="module")
def rogue(voices: Voices) -> Rogue:
    return Rogue(voices.of("planner"), Keys(NAME))


@pytest.fixture
async def watch(up: Up, rogue: Rogue) -> AsyncIterator[Watch]:
    rogue.plan = SOUND
    async with watching(up.running) as watch:
        await watch.until(lambda: set(BOTH) <= watch.states.keys(), why="states")
        yield watch


async def released(watch: Watch, desk: Desk) -> None:
    """Reset both robots as their operator does, until they are."""
    for _ in range(40):
        status = await watch.status()
        unsigned = Reset(by=OPERATOR, epoch=status.epoch, targets=BOTH, nonce=os.urandom(8).hex(), signature=b"")
        signature = load_or_create_key(desk.home.keys, OPERATOR).sign(RESET, unsigned.signed_part(NAME))
        watch.put(watch.keys.reset, replace(unsigned, signature=signature), qos=Qos.STOP)
        await asyncio.sleep(0.5)
        watch.hear()
        if not (await watch.status()).stopped and not any(watch.states[r].stopped for r in BOTH):
            return
    raise AssertionError("not released")


def last_dispatch(up: Up) -> Dispatch:
    """The last dispatch that was sent, with its permit, as whoever read the journal has it."""
    return [r.dispatch for _, r in journal(up.run) if isinstance(r, IntentRecord)][-1]


def signed(watch: Watch, desk: Desk, old: Dispatch, **changes: Any) -> Dispatch:
    """A fresh dispatch like an old one, signed by the orchestrator's own key."""
    now_ns = watch.states["tb3"].at_ns
    sound = {"mission": f"m{os.urandom(4).hex()}", "sequence": 1, "fence": old.fence}
    times = {"issued_ns": now_ns, "expires_ns": now_ns + 60_000_000_000}
    return permit(replace(old, **{**sound, **times, **changes}), NAME, load_or_create_key(desk.home.keys, ORCHESTRATOR))


@pytest.mark.parametrize("case", PLANS)
async def test_a_hostile_plan_is_refused_by_its_code(watch: Watch, up: Up, rogue: Rogue, case: str) -> None:
    text, plan, code = PLANS[case]
    sent = len(intents(up.run))
    rogue.plan = plan
    ended = await watch.mission(text)
    assert (ended.outcome, ended.code) == ("rejected", code)
    assert len(intents(up.run)) == sent
    rogue.plan = SOUND
    assert (await watch.mission(SHORT_DRIVE)).outcome == "completed", "the sound plan for its own request goes"


async def test_10_a_replayed_dispatch_is_refused(watch: Watch, up: Up) -> None:
    await watch.drives()
    watch.put(watch.keys.act("tb3", "navigate_to"), last_dispatch(up), qos=Qos.ACTUATION)
    await watch.until(lambda: any(e.code in ("replayed", "expired") for e in watch.robot_events), why="refused")
    assert watch.states["tb3"].running == ""
    await watch.drives()


@pytest.mark.parametrize("role", ["robot-iris", "robot-tb3", "simulation", "gateway", "operator", "planner"])
async def test_11_and_12_no_other_certificate_actuates(
    watch: Watch, up: Up, desk: Desk, voices: Voices, role: str
) -> None:
    """Even with the orchestrator's own signature: the router does not let it through."""
    await watch.drives()
    sound = signed(watch, desk, last_dispatch(up), skill="stop", args={}, args_digest=EMPTY, places={})
    payload, encoding = encode(sound)
    key = watch.keys.act("tb3", "stop")
    voices.of(role).put(key, payload, encoding=encoding)
    for _ in range(5):
        await watch.truth()
    assert not any(e.mission == sound.mission for e in watch.robot_events)
    watch.put(key, sound, qos=Qos.ACTUATION)
    await watch.until(lambda: any(e.mission == sound.mission for e in watch.robot_events), why="the same, rightfully")


async def test_13_a_command_under_stop_is_refused_over_the_wire(watch: Watch, up: Up, desk: Desk) -> None:
    await watch.drives()
    old = last_dispatch(up)
    watch.put(watch.keys.stop, Stop(by="operator"), qos=Qos.STOP)
    await watch.until(lambda: all(watch.states[r].stopped for r in BOTH), why="latched")
    command = signed(watch, desk, old)
    watch.put(watch.keys.act("tb3", "navigate_to"), command, qos=Qos.ACTUATION)
    await watch.until(lambda: any(e.mission == command.mission for e in watch.robot_events), why="an answer")
    assert [e.code for e in watch.robot_events if e.mission == command.mission] == ["stopped"]
    await released(watch, desk)
    await watch.drives()


async def test_15_a_stop_whose_message_a_robot_lost_latches_it_all_the_same(watch: Watch, up: Up, desk: Desk) -> None:
    """The rover's process is frozen until the router has given it up: what was put meanwhile never reaches it."""
    pid = up.children()["tb3"]
    os.kill(pid, signal.SIGSTOP)
    try:
        await asyncio.sleep(5.0)
        watch.put(watch.keys.stop, Stop(by="operator"), qos=Qos.STOP)
        await watch.until(lambda: watch.states["iris"].stopped, why="the drone heard it")
        status = await watch.status()
        assert status.stop is not None
        assert "tb3" in status.stop.treat_as_moving
    finally:
        os.kill(pid, signal.SIGCONT)
    await watch.until(lambda: watch.states["tb3"].stopped, why="held up by the orchestrator")
    await released(watch, desk)
    await watch.until(lambda: not watch.states["tb3"].unavailable, why="it has heard its orchestrator again")
    await watch.drives()


async def test_17_a_refusal_in_mid_plan_ends_the_plan(tmp_path: Path) -> None:
    halted = Desk(tmp_path).demo("--fault", "missed_detection")
    assert (halted.result["outcome"], halted.result["code"]) == ("halted", "no_target_fix")
    assert "tb3.navigate_to" not in intents(halted.run)


async def test_18_two_missions_do_not_share_a_robot(watch: Watch, up: Up) -> None:
    first, second = watch.ask(SHORT_DRIVE), watch.ask(SHORT_DRIVE)
    ends = [await watch.ended(first), await watch.ended(second)]
    assert [e.outcome for e in ends] == ["completed", "completed"]
    texts = [(e.request_id, e.text) for e in watch.events]
    begun = next(i for i, (r, t) in enumerate(texts) if r == second and "has begun" in t)
    over = next(i for i, (r, t) in enumerate(texts) if r == first and "completed" in t)
    assert over < begun, "the second waits for the lease of the first"


async def test_19_a_flood_of_commands_does_not_keep_the_stop_away(
    watch: Watch, up: Up, desk: Desk, rogue: Rogue
) -> None:
    rogue.plan = to(x=9.0, y=-5.5)
    drive = watch.ask(FAR_DRIVE)
    await watch.moving("tb3")
    flood, over = replace(last_dispatch(up), permit=b""), threading.Event()

    def pour() -> None:
        while not over.is_set():
            watch.put(watch.keys.act("tb3", "navigate_to"), flood, qos=Qos.ACTUATION)

    pouring = threading.Thread(target=pour)
    pouring.start()
    try:
        await watch.until(
            lambda: watch.states["tb3"].dropped + watch.states["tb3"].refused_permits > 50, why="it pours"
        )
        watch.put(watch.keys.stop, Stop(by="operator"), qos=Qos.STOP)
        await watch.until(lambda: watch.states["tb3"].stopped, why="latched in the flood")
    finally:
        over.set()
        pouring.join()
    assert (await watch.ended(drive)).outcome == "halted"
    await released(watch, desk)
    rogue.plan = SOUND
    await watch.drives()


CARRY = "bring the red cube to the dropoff"
TO_PICKUP = {"robot": "go2", "skill": "navigate", "args": {"location": "pickup"}}
LOAD = {"robot": "g1", "skill": "pick_place", "args": {"object": "red_cube", "location": "payload_tray"}}
TO_DROPOFF = {"robot": "go2", "skill": "navigate", "args": {"location": "dropoff"}}


@pytest.mark.parametrize(
    ("contract", "steps", "code"),
    [
        ("navigation_only", [TO_DROPOFF], "request_dropped"),
        ("carry", [TO_PICKUP, TO_DROPOFF], "incomplete_plan"),
        ("carry", [TO_PICKUP, LOAD, TO_DROPOFF], None),
    ],
    ids=["a weaker contract", "without the load", "control"],
)
def test_9_nothing_is_carried_without_its_load(
    tmp_path: Path, contract: str, steps: list[dict[str, Any]], code: str | None
) -> None:
    script = tmp_path / "plans.json"
    script.write_text(json.dumps([{"contract": contract, "steps": steps}]))
    tried = ("planner", "try", CARRY, "--crew", "humanoid_quadruped", "--planner", "script", "--script", str(script))
    verdict = json.loads(Desk(tmp_path).crew(*tried, "--json").stdout)["verdict"]
    assert (verdict["accepted"], verdict["code"]) == (code is None, code)

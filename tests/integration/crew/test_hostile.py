"""Hostile cases against a crew that is up, with a rogue in the planner's place. Each has its positive control.

One crew for all. Nothing here waits for a time: what must happen is asked for again until it does, since a command that
a busy machine delivers late is dropped by the robot on purpose; what must not happen is looked for once the rightful
message that was sent after it has been answered.
"""

import asyncio
import os
import signal
import threading
import time
from collections.abc import AsyncIterator, Callable, Iterator
from contextlib import suppress
from typing import Any

import pytest
import zenoh
from msgspec.structs import replace

from crew.bus.intruder import Intruder
from crew.bus.port import Qos
from crew.contracts.plan import Call, Plan, digest
from crew.keys import Keys
from crew.launch.table import OPERATOR, ORCHESTRATOR
from crew.messages import Dispatch, MissionEvent, PlannerAsk, PlannerProposal, RobotEvent, Stop
from crew.permit import permit
from crew.records import IntentRecord
from crew.release import signed_reset
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
    latches,
    watching,
)

pytestmark = pytest.mark.hostile
BOTH = ("iris", "tb3")
TRIES = 20
ANSWER_S = 3.0
ROLES = ("robot-iris", "robot-tb3", "simulation", "gateway", "recorder", "operator", "planner")
TO_POINT = Call("tb3", "navigate_to", {"x": -3.0, "y": -3.0})
SOUND = Plan("dispatch_only", (TO_POINT,))
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
    "5 NaN": (SHORT_DRIVE, to(x=float("nan")), "bad_argument"),
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
def up(desk: Desk) -> Iterator[Up]:
    with desk.up() as up:
        up.kill("planner")
        up.await_said("planner died", 10.0)
        yield up


@pytest.fixture(scope="module")
def rogue(up: Up) -> Iterator[Rogue]:
    with Voices(up.running) as voices:
        yield Rogue(voices.of("planner"), Keys(NAME))


@pytest.fixture
async def watch(up: Up, rogue: Rogue) -> AsyncIterator[Watch]:
    """An operator's session with the crew, which works."""
    rogue.plan = SOUND
    async with watching(up.running) as watch:
        await watch.until(lambda: set(BOTH) <= watch.states.keys(), why="states")
        await works(watch)
        yield watch


async def works(watch: Watch) -> MissionEvent:
    """The sound plan for its own request is carried out, at the latest once a busy machine has caught up."""
    for _ in range(TRIES):
        ended = await watch.mission(SHORT_DRIVE)
        if ended.outcome == "completed":
            return ended
        await asyncio.sleep(0.5)
    raise AssertionError(f"the crew does not work: {ended.text}")


async def heard(watch: Watch, say: Callable[[], None], done: Callable[[], Any], why: str) -> None:
    """Say something, again and again, until it has been heard."""
    for _ in range(TRIES):
        say()
        with suppress(AssertionError):
            await watch.until(done, ANSWER_S, why)
            return
    raise AssertionError(f"never: {why}; {watch.robot_events[-4:]}")


async def released(watch: Watch, desk: Desk) -> None:
    """Reset both robots as their operator does, until they are."""
    key = load_or_create_key(desk.home.keys, OPERATOR)
    for _ in range(TRIES * 2):
        status = await watch.status()
        if not status.stopped and not any(watch.states[r].stopped for r in BOTH):
            return
        watch.put(watch.keys.reset, signed_reset(NAME, latches(status), key, by=OPERATOR, epoch=status.epoch), Qos.STOP)
        await asyncio.sleep(0.5)
        watch.hear()
    raise AssertionError("not released")


def last_dispatch(up: Up) -> Dispatch:
    """The last dispatch that was sent, with its permit, as whoever read the journal has it."""
    return [r.dispatch for _, r in journal(up.run) if isinstance(r, IntentRecord)][-1]


class Signed:
    """Fresh dispatches like an old one, signed by the orchestrator's own key, and what the robot said to them."""

    def __init__(self, watch: Watch, desk: Desk, like: Dispatch) -> None:
        self._watch, self._like = watch, like
        self._key = load_or_create_key(desk.home.keys, ORCHESTRATOR)
        self.missions: set[str] = set()

    def one(self, **changes: Any) -> Dispatch:
        now_ns, mission = self._watch.states["tb3"].at_ns, f"m{os.urandom(4).hex()}"
        self.missions.add(mission)
        times = {"issued_ns": now_ns, "expires_ns": now_ns + 60_000_000_000}
        unsigned = replace(self._like, **{"mission": mission, "lease": mission, "sequence": 1, **times, **changes})
        return permit(unsigned, NAME, self._key)

    def stop(self) -> Dispatch:
        """The harmless one: stand still."""
        return self.one(skill="stop", args={}, args_digest=digest({}), places={})

    @property
    def answers(self) -> list[RobotEvent]:
        return [event for event in self._watch.robot_events if event.mission in self.missions]


@pytest.mark.parametrize("case", PLANS)
async def test_a_hostile_plan_is_refused_by_its_code(watch: Watch, up: Up, rogue: Rogue, case: str) -> None:
    text, plan, code = PLANS[case]
    sent = len(intents(up.run))
    rogue.plan = plan
    ended = await watch.mission(text)
    assert (ended.outcome, ended.code) == ("rejected", code)
    assert len(intents(up.run)) == sent


async def test_a_replayed_dispatch_is_refused(watch: Watch, up: Up) -> None:
    captured, key = last_dispatch(up), watch.keys.act("tb3", "navigate_to")

    def refused() -> list[str]:
        return [event.code for event in watch.robot_events if event.what == "permit_refused"]

    await heard(watch, lambda: watch.put(key, captured, Qos.ACTUATION), refused, "it is refused")
    assert set(refused()) == {"replayed"}
    assert watch.states["tb3"].running == ""


@pytest.mark.parametrize("role", ROLES)
async def test_no_other_certificate_actuates(watch: Watch, up: Up, desk: Desk, role: str) -> None:
    """Even with the orchestrator's own signature, and with a session that keeps no rules: the router keeps them."""
    stolen, rightful = (Signed(watch, desk, last_dispatch(up)) for _ in range(2))
    key = watch.keys.act("tb3", "stop")
    with Intruder(up.running.link(role)) as intruder:
        for _ in range(3):
            payload, encoding = encode(stolen.stop())
            intruder.session.put(key, payload, encoding=encoding)
            await watch.truth()
        await heard(
            watch, lambda: watch.put(key, rightful.stop(), Qos.ACTUATION), lambda: rightful.answers, "the same, rightly"
        )
    assert stolen.answers == []


async def test_a_command_under_stop_is_refused_over_the_wire(watch: Watch, up: Up, desk: Desk) -> None:
    signed, key = Signed(watch, desk, last_dispatch(up)), watch.keys.act("tb3", "navigate_to")
    watch.put(watch.keys.stop, Stop(by="operator"), Qos.STOP)
    await watch.until(lambda: all(watch.states[r].stopped for r in BOTH), why="latched")
    await heard(watch, lambda: watch.put(key, signed.one(), Qos.ACTUATION), lambda: signed.answers, "an answer")
    assert {event.code for event in signed.answers} == {"stopped"}
    await released(watch, desk)
    await works(watch)


async def test_a_stop_whose_message_a_robot_lost_latches_it_all_the_same(watch: Watch, up: Up, desk: Desk) -> None:
    """The rover's process is frozen until the router has given it up: what is put meanwhile never reaches it."""
    pid = up.children()["tb3"]
    os.kill(pid, signal.SIGSTOP)
    try:
        await watch.until(lambda: "tb3 is frozen" in up.said, 20.0, "it is missed")
        watch.put(watch.keys.stop, Stop(by="operator"), Qos.STOP)
        await watch.until(lambda: watch.states["iris"].stopped, why="the drone heard it")
        status = await watch.status()
        assert status.stop is not None
        assert "tb3" in status.stop.treat_as_moving
    finally:
        os.kill(pid, signal.SIGCONT)
    await watch.until(lambda: watch.states["tb3"].stopped, why="held up by the orchestrator")
    await released(watch, desk)
    await works(watch)


async def test_two_missions_do_not_share_a_robot(watch: Watch) -> None:
    first, second = watch.ask(SHORT_DRIVE), watch.ask(SHORT_DRIVE)
    ends = [await watch.ended(first), await watch.ended(second)]
    assert [e.outcome for e in ends] == ["completed", "completed"]
    texts = [(e.request_id, e.text) for e in watch.events]
    begun = next(i for i, (r, t) in enumerate(texts) if r == second and "has begun" in t)
    over = next(i for i, (r, t) in enumerate(texts) if r == first and "completed" in t)
    assert over < begun, "the second waits for the lease of the first"


async def test_a_flood_of_commands_does_not_keep_the_stop_away(watch: Watch, up: Up, desk: Desk, rogue: Rogue) -> None:
    rogue.plan = to(x=9.0, y=-5.5)
    drive = watch.ask(FAR_DRIVE)
    await watch.moving("tb3")
    flood, over = replace(last_dispatch(up), permit=b""), threading.Event()
    before = watch.states["tb3"].refused_permits + watch.states["tb3"].dropped

    def pour() -> None:
        while not over.is_set():
            watch.put(watch.keys.act("tb3", "navigate_to"), flood, Qos.ACTUATION)
            time.sleep(0.001)

    pouring = threading.Thread(target=pour)
    pouring.start()
    try:
        await watch.until(
            lambda: watch.states["tb3"].dropped + watch.states["tb3"].refused_permits > before + 50, why="it pours"
        )
        watch.put(watch.keys.stop, Stop(by="operator"), Qos.STOP)
        await watch.until(lambda: watch.states["tb3"].stopped, why="latched in the flood")
    finally:
        over.set()
        pouring.join()
    assert (await watch.ended(drive)).outcome == "halted"
    await released(watch, desk)
    rogue.plan = SOUND
    await works(watch)

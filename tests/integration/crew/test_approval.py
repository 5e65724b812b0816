"""A step that a person must approve, in a crew that is up: only the operator's signature, only this call, once."""

import json
from collections.abc import AsyncIterator, Iterator
from pathlib import Path

import pytest
import zenoh
from msgspec.structs import replace

import crew
from crew.contracts.snapshot import Point, ValueReading
from crew.launch.table import OPERATOR
from crew.messages import ANSWER, Answer, MissionEvent, RobotValue
from crew.signing import SigningKey, load_or_create_key
from crew.wire import encode
from tests.integration.crew.harness import NAME, SHORT_DRIVE, Desk, Up, Watch, intents, watching

HERE = Path(crew.__file__).parent
CREW_FILE = HERE / "crews" / "air_ground.yaml"
CONTRACT = HERE / "contracts" / "library" / "dispatch_only.yaml"
TO_VICTIM = "send the rover to the victim"


@pytest.fixture(scope="module")
def desk(tmp_path_factory: pytest.TempPathFactory) -> Desk:
    """A crew whose rover goes nowhere without a person's approval."""
    desk = Desk(tmp_path_factory.mktemp("approval"))
    text = CONTRACT.read_text()
    assert "    role: responder\n" in text
    (desk.folder / "dispatch_only.yaml").write_text(
        text.replace("    role: responder\n", "    role: responder\n    approval: true\n")
    )
    (desk.folder / "guarded.yaml").write_text(CREW_FILE.read_text())
    return desk


@pytest.fixture(scope="module")
def up(desk: Desk) -> Iterator[Up]:
    with desk.up(str(desk.folder / "guarded.yaml")) as up:
        yield up


@pytest.fixture
async def watch(up: Up) -> AsyncIterator[Watch]:
    async with watching(up.running) as watch:
        await watch.until(lambda: {"iris", "tb3"} <= watch.states.keys(), why="states")
        yield watch


async def question(watch: Watch, request: str, *, after: int = 0) -> MissionEvent:
    """The next question of a request."""
    await watch.until(lambda: len(questions(watch, request)) > after, why="a question")
    return questions(watch, request)[after]


def questions(watch: Watch, request: str) -> list[MissionEvent]:
    return [e for e in watch.of(request) if e.what == "question"]


def refusals(watch: Watch, request: str) -> list[MissionEvent]:
    return [e for e in watch.of(request) if "answer refused" in e.text]


def answer(desk: Desk, asked: MissionEvent, *, key: SigningKey | None = None, yes: bool = True) -> Answer:
    assert asked.token is not None
    unsigned = Answer(token=asked.token, yes=yes, by=OPERATOR)
    key = key or load_or_create_key(desk.home.keys, OPERATOR)
    return replace(unsigned, signature=key.sign(ANSWER, unsigned.signed_part(NAME, asked.mission)))


async def test_a_step_waits_for_crew_approve_and_then_goes(watch: Watch, up: Up, desk: Desk) -> None:
    sent = len(intents(up.run))
    request = watch.ask(SHORT_DRIVE)
    asked = await question(watch, request)
    assert (asked.step, asked.code) == ("dispatch", "approval_missing")
    assert "tb3.navigate_to(x=-3, y=-3)" in (asked.question or "")
    assert f"crew approve {asked.mission}" in asked.text
    assert f"crew approve {asked.mission}" in desk.crew("status").stdout
    wrong = desk.crew("confirm", asked.mission)
    assert (wrong.returncode, "crew approve" in wrong.stderr) == (2, True)
    assert len(intents(up.run)) == sent, "nothing moves before the answer"
    done = desk.crew("approve", asked.mission)
    assert done.returncode == 0, done.stderr
    assert "approved" in done.stdout
    assert (await watch.ended(request)).outcome == "completed"
    again = desk.crew("approve", asked.mission)
    assert (again.returncode, "asks nothing" in again.stderr) == (2, True)
    assert "Traceback" not in again.stderr


async def test_only_the_operators_signature_approves(watch: Watch, up: Up, desk: Desk) -> None:
    request = watch.ask(SHORT_DRIVE)
    asked = await question(watch, request)
    sound = answer(desk, asked)
    key = watch.keys.mission_confirm(asked.mission)
    forged = {
        "unsigned": replace(sound, signature=b""),
        "signed by another key": answer(desk, asked, key=SigningKey(b"x" * 32)),
        "signed for no": replace(answer(desk, asked, yes=False), yes=True),
        "in another's name": replace(sound, by="somebody"),
    }
    for count, (name, body) in enumerate(forged.items(), start=1):
        watch.put(key, body)
        await watch.until(lambda count=count: len(refusals(watch, request)) == count, why=name)  # type: ignore[misc]
    guests = {
        "mode": "client",
        "connect": {"endpoints": [up.running.guests]},
        "scouting": {"multicast": {"enabled": False}},
    }
    with zenoh.open(zenoh.Config.from_json5(json.dumps(guests))) as guest:
        payload, encoding = encode(sound)
        guest.put(key, payload, encoding=encoding)
        await watch.truth()
    assert (await watch.status()).missions[-1].step == "dispatch", "still waiting: a guest may not answer"
    watch.put(key, sound)
    assert (await watch.ended(request)).outcome == "completed", "the same message from the operator counts"


async def test_an_answer_serves_one_question_of_one_mission(watch: Watch, desk: Desk) -> None:
    first = watch.ask(SHORT_DRIVE)
    used = answer(desk, await question(watch, first))
    watch.put(watch.keys.mission_confirm(watch.mission_of(first)), used)
    await watch.ended(first)
    second = watch.ask(SHORT_DRIVE)
    asked = await question(watch, second)
    watch.put(watch.keys.mission_confirm(asked.mission), used)
    await watch.until(lambda: refusals(watch, second), why="refused")
    assert desk.crew("approve", asked.mission, "--no").returncode == 0
    ended = await watch.ended(second)
    assert (ended.outcome, ended.code) == ("rejected", "approval_missing")


def seen(watch: Watch, x: float, y: float) -> RobotValue:
    """A fix as the drone would publish it."""
    state = watch.states["iris"]
    reading = ValueReading(name="victim", status="ok", position=Point(x, y), stamp_ns=state.at_ns)
    return RobotValue(robot="iris", boot_id=state.boot_id, reading=reading)


async def test_an_approval_for_a_call_that_has_changed_since_is_refused_and_asked_anew(
    watch: Watch, desk: Desk, up: Up
) -> None:
    watch.put(watch.keys.robot_value("iris", "victim"), seen(watch, -3.0, -3.0))
    request = watch.ask(TO_VICTIM)
    asked = await question(watch, request)
    assert "target is (-3.00, -3.00)" in (asked.question or "")
    sent = len(intents(up.run))
    watch.put(watch.keys.robot_value("iris", "victim"), seen(watch, -2.0, -3.5))
    for _ in range(3):
        await watch.truth()
    watch.put(watch.keys.mission_confirm(asked.mission), answer(desk, asked))
    anew = await question(watch, request, after=1)
    assert anew.token != asked.token
    assert "has changed since" in (anew.question or "")
    assert "target is (-2.00, -3.50)" in (anew.question or "")
    assert len(intents(up.run)) == sent, "the old yes moved nothing"
    watch.put(watch.keys.mission_confirm(asked.mission), answer(desk, anew))
    assert (await watch.ended(request)).outcome == "completed"
    x, y, *_ = await watch.standing("tb3")
    assert abs(x + 2.0) < 1.0
    assert abs(y + 3.5) < 1.0


async def test_a_request_without_a_terminal_says_how_to_approve_and_a_demo_tells_the_question(desk: Desk) -> None:
    asked = desk.crew("request", SHORT_DRIVE)
    assert asked.returncode == 3
    assert "answer it with: crew approve" in asked.stdout


def test_everything_verifies_with_its_approvals(desk: Desk, up: Up) -> None:
    run = up.run
    assert up.end() == 0
    verified = desk.crew("verify", str(run))
    assert verified.returncode == 0, verified.stdout + verified.stderr
    assert "the operator's signature holds on 6 answers to approvals" in verified.stdout
    demo = desk.demo("guarded.yaml", "--request", SHORT_DRIVE)
    assert (demo.code, demo.result["outcome"], demo.result["code"]) == (3, "rejected", "approval_missing")
    assert "needs your approval" in demo.result["question"]

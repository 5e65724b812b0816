"""The whole mission with a model at the other end of a socket: planned, refused and planned again, or never planned."""

import asyncio
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from crew.actors.specs import ANTHROPIC_KEY, COMPATIBLE_KEY
from crew.records import NoteRecord
from tests.integration.crew.harness import SHORT_DRIVE, Demo, Desk, Up, children_of, intents, journal
from tests.integration.planner.endpoint import (
    DRIVE,
    SEARCH_AND_DISPATCH,
    Reply,
    ScriptedApi,
    failure,
    message,
    plan,
    scripted,
    tool_use,
)

KEY = "sk-secret-9876543210"
SOMEWHERE_ELSE = plan("dispatch_only", ("tb3", "navigate_to", {"target": "base"}))


@pytest.fixture
def desk(tmp_path: Path) -> Desk:
    desk = Desk(tmp_path)
    desk.env |= {COMPATIBLE_KEY: KEY, ANTHROPIC_KEY: KEY}
    return desk


async def demo(desk: Desk, api: ScriptedApi, *args: str) -> Demo:
    return await asyncio.to_thread(desk.demo, "--planner", "compatible", "--base-url", api.url, *args)


async def test_a_models_plan_flies_the_crew(desk: Desk) -> None:
    async with scripted(Reply(message(tool_use(SEARCH_AND_DISPATCH)))) as api:
        done = await demo(desk, api)
    assert (done.code, done.result["outcome"]) == (0, "completed")
    assert done.result["goal_error_m"] < 0.6
    assert intents(done.run)[0] == "iris.takeoff"
    (proposal,) = notes(done.run, "proposal")
    assert '"prompt_digest"' in proposal
    assert '"input_tokens":1200' in proposal
    assert not any(KEY in text for text in everything_written(done.run)), "the key is written nowhere"


async def test_a_refused_plan_is_mended_once(desk: Desk) -> None:
    async with scripted(Reply(message(tool_use(SOMEWHERE_ELSE))), Reply(message(tool_use(DRIVE)))) as api:
        done = await demo(desk, api, "--request", SHORT_DRIVE)
    assert (done.code, done.result["outcome"]) == (0, "completed")
    assert "not_requested" in str(api.asked[1].body["messages"][-1])
    assert intents(done.run) == ["tb3.navigate_to"]


async def test_a_model_may_think_while_the_world_goes_on(desk: Desk) -> None:
    async with scripted(Reply(message(tool_use(DRIVE)), delay_s=2.0)) as api:
        done = await demo(desk, api, "--request", SHORT_DRIVE, "--speed", "3")
    assert (done.code, done.result["outcome"]) == (0, "completed"), done.result


async def test_a_model_that_never_plans_what_was_asked_moves_nothing(desk: Desk) -> None:
    async with scripted(Reply(message(tool_use(SOMEWHERE_ELSE)))) as api:
        done = await demo(desk, api, "--request", SHORT_DRIVE)
    assert (done.code, done.result["outcome"], done.result["code"]) == (3, "rejected", "not_requested")
    assert len(api.asked) == 2
    assert intents(done.run) == []


async def test_a_stand_in_is_visible_and_without_one_nothing_is_planned(desk: Desk) -> None:
    async with scripted(Reply(failure("authentication_error", "no"), status=401)) as api:
        plain = ["--planner", "compatible", "--base-url", api.url, "--request", SHORT_DRIVE]
        seen = await asyncio.to_thread(desk.crew, "demo", *plain)
        alone = await demo(desk, api, "--request", SHORT_DRIVE, "--no-fallback")
    assert seen.returncode == 0, seen.stderr
    assert "the embedded planner stands in" in seen.stdout
    assert "refuses the key" in seen.stdout
    assert (alone.code, alone.result["outcome"]) == (3, "rejected")
    assert "refuses the key" in alone.result["message"]


@pytest.fixture
def up(desk: Desk) -> Iterator[Up]:
    with desk.up("--planner", "compatible", "--base-url", "http://127.0.0.1:9") as up:
        yield up


def test_only_the_planners_process_is_given_a_key(up: Up) -> None:
    holders = {name for name, pid in up.children().items() if KEY.encode() in Path(f"/proc/{pid}/environ").read_bytes()}
    assert holders == {"planner"}
    assert len(children_of(up.process.pid)) >= 7


MISTAKES = [
    (["--planner", "anthropic"], "ANTHROPIC_API_KEY"),
    (["--planner", "compatible"], "--base-url"),
    (["--planner", "compatible", "--base-url", "localhost:1"], "http://"),
    (["--planner", "embedded", "--model", "m"], "--planner embedded"),
    (["--planner", "anthropc"], "did you mean 'anthropic'"),
    (["--planner", "anthropic", "--context", "all"], "valid: contracts, none, registry"),
    (["--planner", "recorded"], "--script"),
]


@pytest.mark.parametrize(("args", "said"), MISTAKES)
def test_a_mistake_in_the_choice_starts_nothing(args: list[str], said: str, desk: Desk) -> None:
    desk.env.pop(ANTHROPIC_KEY)
    done = desk.crew("demo", *args)
    assert done.returncode == 2, done.stderr
    assert said in done.stderr
    assert "Traceback" not in done.stderr
    assert not desk.runs.exists()


def notes(run: Path, what: str) -> list[str]:
    return [r.text for _, r in journal(run) if isinstance(r, NoteRecord) and r.what == what]


def everything_written(run: Path) -> list[Any]:
    return [path.read_bytes().decode("latin-1") for path in run.rglob("*") if path.is_file()]

"""`crew contracts check --watch`: a check at the beginning, one for each change, and none that ends it."""

import asyncio
import os
from pathlib import Path

import pytest

from crew.cli.contract_watch import POLL_S, Stamps, _watch, changes, run_watch, watched
from crew.clock import SimClock, seconds_ns
from crew.errors import UsageError
from crew.library import CONTRACTS, CREWS


async def turns(clock: SimClock, polls: int) -> None:
    """Let so many polls pass."""
    for _ in range(polls):
        for _ in range(5):
            await asyncio.sleep(0)
        clock.advance(clock.now_ns() + seconds_ns(POLL_S))
    for _ in range(5):
        await asyncio.sleep(0)


def rewrite(path: Path, text: str, stamp: int) -> None:
    """Change a file for good: with a time of its own, since two writes may share one."""
    path.write_text(text, encoding="utf-8")
    os.utime(path, ns=(stamp, stamp))


async def test_one_check_for_each_change_that_came_to_rest() -> None:
    clock, said, stamps = SimClock(), list[int](), dict[Path, tuple[int, int]]()
    now: list[Stamps] = [stamps]

    async def listen() -> None:
        async for _ in changes(lambda: now[0], clock):
            said.append(len(said))

    task = asyncio.create_task(listen())
    await turns(clock, 4)
    assert len(said) == 1
    for size in (1, 2, 3):
        now[0] = {Path("a"): (size, size)}
        await turns(clock, 1)
    assert len(said) == 1
    await turns(clock, 3)
    assert len(said) == 2
    now[0] = {}
    await turns(clock, 4)
    assert len(said) == 3
    task.cancel()
    with pytest.raises(asyncio.CancelledError):
        await task


async def test_a_file_that_cannot_be_read_is_said_and_waited_for(capsys: pytest.CaptureFixture[str]) -> None:
    clock, checks = SimClock(), list[int]()
    now: list[Stamps] = [{}]

    def check() -> int:
        checks.append(1)
        if len(checks) == 1:
            raise UsageError("carry.yaml:3:1: unknown key")
        return 0

    task = asyncio.create_task(_watch(check, lambda: now[0], clock, False))
    await turns(clock, 2)
    now[0] = {Path("carry.yaml"): (1, 1)}
    await turns(clock, 4)
    task.cancel()
    with pytest.raises(asyncio.CancelledError):
        await task
    told = capsys.readouterr()
    assert told.err == "crew: carry.yaml:3:1: unknown key\n"
    assert told.out.count("waiting for a change") == len(checks) == 2


def test_the_files_of_a_crew_are_its_own_the_contracts_beside_it_and_the_shipped(tmp_path: Path) -> None:
    crew = tmp_path / "mine.yaml"
    crew.write_text("crew: mine")
    (tmp_path / "contracts").mkdir()
    own = [tmp_path / "patrol.yaml", tmp_path / "contracts" / "other.yaml"]
    for path in own:
        path.write_text("contract: x")
    found = set(watched((), str(crew)))
    assert {crew, *own, CONTRACTS / "carry.yaml"} <= found
    assert {CONTRACTS / "carry.yaml", CREWS / "air_ground.yaml"} <= set(watched((), ""))


def test_a_change_is_seen_by_time_and_size_and_a_missing_file_has_neither(tmp_path: Path) -> None:
    path = tmp_path / "carry.yaml"
    assert watched([path], "") == {}
    rewrite(path, "a", 1_000)
    first = watched([path], "")
    rewrite(path, "b", 2_000)
    assert watched([path], "") != first


def test_an_unknown_crew_is_refused_before_anything_is_watched() -> None:
    with pytest.raises(UsageError, match="no crew is called"):
        run_watch((), "nobody", False, 100)

"""The recorder among the others: it may be killed or frozen, and no mission notices."""

import asyncio
import shutil
import signal
from pathlib import Path

from crew.actors.recorder.prepare import prepare
from crew.actors.recorder.remains import lane_changes, log_lines, remains
from crew.actors.recorder.rrd import FILE, compact, is_whole
from crew.clock import seconds_ns
from tests.integration.crew.harness import SHORT_DRIVE, Desk, Up, alive, wait_until, watching

TWO_ROBOTS_MINUTE_BYTES = 3_000_000


def recording_has_begun(up: Up) -> bool:
    path = up.run / FILE
    return path.is_file() and path.stat().st_size > 50_000


async def test_a_killed_recorder_leaves_what_it_saw_and_no_mission_notices(desk: Desk, tmp_path: Path) -> None:
    with desk.up(speed="1") as up:
        run = up.run
        assert await asyncio.to_thread(wait_until, lambda: recording_has_begun(up), 60.0), up.said
        async with watching(up.running) as watch:
            request = watch.ask(SHORT_DRIVE)
            await watch.moving("tb3")
            killed_ns = (await watch.truth()).at_ns
            up.kill("recorder")
            assert (await watch.ended(request)).outcome == "completed"
        assert "recorder died (signal 9)" in up.said
        up.end()
    assert not is_whole(run / FILE)
    assert compact([run / FILE], tmp_path / FILE, timeout_s=60.0)
    assert remains(tmp_path / FILE).end_ns >= killed_ns - seconds_ns(1.0), "within a second of the kill"
    assert "cut off" in prepare(run).note
    assert "completed" in [state for _, state in lane_changes(run / FILE)["mission"]], "the rest is from the journal"


async def test_a_frozen_recorder_holds_nobody_up(desk: Desk) -> None:
    with desk.up() as up:
        assert await asyncio.to_thread(wait_until, lambda: recording_has_begun(up), 60.0), up.said
        async with watching(up.running) as watch:
            pid = up.children()["recorder"]
            up.kill("recorder", signal.SIGSTOP)
            assert (await watch.mission(SHORT_DRIVE)).outcome == "completed"
            assert not any(event.code == "robot_unavailable" for event in watch.events)
        assert up.end() == 0
    assert not alive(pid)


def test_what_is_recorded_is_what_the_journal_says(runs: dict[str, Path], tmp_path: Path) -> None:
    for name, run in runs.items():
        folder = tmp_path / name
        shutil.copytree(run, folder)
        (folder / FILE).unlink()
        prepare(folder)
        live, again = lane_changes(run / FILE), lane_changes(folder / FILE)
        assert [state for _, state in live["mission"]] == [state for _, state in again["mission"]]
        assert live["mission"][1:-1] == again["mission"][1:-1], "at the same moments"
        decided = [
            [line for line in log_lines(f / FILE) if line[2].startswith(("allowed", "refused"))] for f in (run, folder)
        ]
        assert decided[0] == decided[1]


def test_a_finished_recording_is_whole_and_small(runs: dict[str, Path]) -> None:
    for run in runs.values():
        assert is_whole(run / FILE)
        minutes = max(1.0, remains(run / FILE).end_ns / 60e9)
        assert (run / FILE).stat().st_size / minutes < TWO_ROBOTS_MINUTE_BYTES


def test_a_crew_need_not_be_recorded(desk: Desk) -> None:
    demo = desk.demo("--no-record", "--request", "Send the rover to room_b")
    assert demo.result["outcome"] == "rejected"
    assert not (demo.run / FILE).exists()
    assert not (demo.run / "logs" / "recorder.log").exists()

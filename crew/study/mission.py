"""One mission of a study: a demo in a process of its own, and what its run shows of errors and movements."""

import json
import math
import subprocess
import sys
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import msgspec

from crew.contracts.snapshot import Point
from crew.errors import CrewError
from crew.journal_reader import read_records
from crew.records import DecisionRecord
from crew.sim.map import load_map
from crew.study.version import study_version

TIMEOUT_S = 240.0
MOVED_M = 0.3
STANDOFF_M = 0.25
"""The shipped crew file's distance to keep from a victim."""


class Scenario(msgspec.Struct, frozen=True, kw_only=True):
    """What a mission is run with. An empty request is the demo's own."""

    name: str
    map: str = "A"
    seed: int = 0
    faults: tuple[str, ...] = ()
    request: str = ""
    crew: str = "air_ground"


class Measured(msgspec.Struct, frozen=True, kw_only=True):
    """How it ended. Errors are horizontal, metres; ends are true positions x, y, z: world ENU, metres."""

    version: str
    """Of the project, that it was measured with."""
    scenario: Scenario
    outcome: str
    code: str | None
    question: str | None
    message: str
    dispatched: dict[str, tuple[str, ...]]
    """Robot to the skills that were sent to it, with how each ended."""
    moved: tuple[str, ...]
    ends: dict[str, tuple[float, float, float]]
    goal_error_m: float | None
    fix_error_m: float | None
    navigation_error_m: float | None
    mission_s: float
    wall_s: float


def measure(scenario: Scenario, runs: Path) -> Measured:
    """Run it. Raises CrewError if it ends without a result."""
    command = [sys.executable, "-m", "crew", "demo", scenario.crew, "--json", "--speed", "max", "--runs", str(runs)]
    command += ["--map", scenario.map, "--seed", str(scenario.seed)]
    command += [part for fault in scenario.faults for part in ("--fault", fault)]
    command += ["--request", scenario.request] if scenario.request else []
    done = subprocess.run(command, capture_output=True, text=True, timeout=TIMEOUT_S, check=False)
    try:
        result = json.loads(done.stdout)
    except ValueError as error:
        raise CrewError(f"{scenario.name}: the demo gave no result: {done.stderr.strip()[-300:]}") from error
    return _measured(scenario, result)


def _measured(scenario: Scenario, result: Mapping[str, Any]) -> Measured:
    ends = {robot: tuple(pose[:3]) for robot, pose in result["poses"].items()}
    fix, victim = pinned(Path(result["run"])), load_map("air_ground", scenario.map).victim
    known = fix is not None and math.isfinite(fix.x)
    failed = next((s for s in result["steps"] if s["code"]), None)
    return Measured(
        version=study_version(),
        scenario=scenario,
        outcome=result["outcome"],
        code=result["code"] or (failed["code"] if failed else None),
        question=result["question"],
        message=result["message"],
        dispatched=_dispatched(result["steps"]),
        moved=_moved(scenario, ends, result["steps"]),
        ends=ends,
        goal_error_m=result["goal_error_m"] if known else None,
        fix_error_m=round(math.dist((fix.x, fix.y), (victim.x_m, victim.y_m)), 3) if fix and known else None,
        navigation_error_m=_navigation_error_m(fix, ends) if known else None,
        mission_s=result["sim_s"],
        wall_s=result["wall_s"],
    )


def pinned(run: Path) -> Point | None:
    """Where the rover was sent to: the place that was pinned when its target was dispatched."""
    found = None
    for row in read_records(run / "journal.db"):
        if row.kind == DecisionRecord.kind:
            decision = msgspec.msgpack.decode(row.body, type=DecisionRecord).decision
            found = decision.places.get("target", found) if decision.allowed else found
    return found


def _navigation_error_m(fix: Point | None, ends: Mapping[str, tuple[float, ...]]) -> float | None:
    """How far the rover truly stands from the stand-off circle around the place that it was sent to."""
    rover = ends.get("tb3")
    if fix is None or rover is None:
        return None
    return round(abs(math.dist((fix.x, fix.y), rover[:2]) - STANDOFF_M), 3)


def _dispatched(steps: list[dict[str, Any]]) -> dict[str, tuple[str, ...]]:
    sent: dict[str, tuple[str, ...]] = {}
    for step in steps:
        if step["outcome"] not in ("pending", "refused"):
            what = f"{step['skill']} {step['outcome']}{' (' + step['code'] + ')' if step['code'] else ''}"
            sent[step["robot"]] = (*sent.get(step["robot"], ()), what)
    return sent


def _moved(scenario: Scenario, ends: Mapping[str, tuple[float, ...]], steps: list[dict[str, Any]]) -> tuple[str, ...]:
    spawns = load_map("air_ground", scenario.map).robots
    return tuple(
        robot
        for robot, spawn in spawns.items()
        if robot in ends and (math.dist(ends[robot][:2], (spawn.x_m, spawn.y_m)) > MOVED_M or ends[robot][2] > MOVED_M)
    )

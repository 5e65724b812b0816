"""Hostile plans that the other cases' crew can't be given: in a file, and for robots that carry.

On the command line and without robots: what is refused here is refused before anything could move.
"""

import json
from pathlib import Path
from typing import Any

import msgspec
import pytest

from crew.contracts.plan import Plan
from tests.integration.crew.harness import SHORT_DRIVE, Desk

pytestmark = pytest.mark.hostile


def verdict(folder: Path, text: str, plan: Plan, crew: str = "air_ground") -> tuple[bool, str | None]:
    """Whether a plan for a request is accepted, and the code of its refusal."""
    script = folder / "plans.json"
    script.write_bytes(msgspec.json.encode([plan]))
    tried = ("planner", "try", text, "--crew", crew, "--planner", "script", "--script", str(script), "--json")
    done = Desk(folder).crew(*tried)
    assert "Traceback" not in done.stderr
    told = json.loads(done.stdout)["verdict"]
    return told["accepted"], told["code"]


def test_a_plan_with_nan_is_read_by_nobody(tmp_path: Path) -> None:
    """In a file it is no JSON; over the wire, where it can travel, gate and robot refuse it as `bad_argument`."""
    script = tmp_path / "plans.json"
    plan = {"contract": "dispatch_only", "steps": [{**DRIVE, "args": {"x": float("nan"), "y": -3.0}}]}
    script.write_text(json.dumps([plan]))
    done = Desk(tmp_path).crew("planner", "try", SHORT_DRIVE, "--planner", "script", "--script", str(script), "--json")
    assert done.returncode == 2
    assert "plans.json" in done.stderr
    assert "Traceback" not in done.stderr


DRIVE = {"robot": "tb3", "skill": "navigate_to"}
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
def test_nothing_is_carried_without_its_load(
    tmp_path: Path, contract: str, steps: list[dict[str, Any]], code: str | None
) -> None:
    plan = msgspec.convert({"contract": contract, "steps": steps}, Plan)
    assert verdict(tmp_path, CARRY, plan, "humanoid_quadruped") == (code is None, code)

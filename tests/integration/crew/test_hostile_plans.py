"""Hostile plans, cases 1 to 9: read from a file by the planner, judged as in a running crew, each beside a sound one.

On the command line and without robots: what is refused here is refused before anything could move.
"""

import json
from pathlib import Path
from typing import Any

import msgspec
import pytest

from crew.contracts.plan import Call, Plan
from tests.integration.crew.harness import SHORT_DRIVE, Desk

pytestmark = pytest.mark.hostile
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
    "6 the wrong frame": ("send the rover to (-3, -2)", to(x=-2.0, y=-3.0), "not_requested"),
    "7 unrequested target": ("send the rover to base", SOUND, "not_requested"),
    "8 negated target": ("search the area but do not send the rover", SEARCH_AND_SEND, "forbidden_by_request"),
}


def verdict(folder: Path, text: str, plan: Plan, crew: str = "air_ground") -> tuple[bool, str | None]:
    """Whether a plan for a request is accepted, and the code of its refusal."""
    script = folder / "plans.json"
    script.write_bytes(msgspec.json.encode([plan]))
    tried = ("planner", "try", text, "--crew", crew, "--planner", "script", "--script", str(script), "--json")
    done = Desk(folder).crew(*tried)
    assert "Traceback" not in done.stderr
    told = json.loads(done.stdout)["verdict"]
    return told["accepted"], told["code"]


@pytest.mark.parametrize("case", PLANS)
def test_a_hostile_plan_is_refused_by_its_code(tmp_path: Path, case: str) -> None:
    text, plan, code = PLANS[case]
    assert verdict(tmp_path, text, plan) == (False, code)


def test_the_sound_plan_for_its_own_request_is_accepted(tmp_path: Path) -> None:
    assert verdict(tmp_path, SHORT_DRIVE, SOUND) == (True, None)


def test_a_plan_with_nan_is_read_by_nobody(tmp_path: Path) -> None:
    """In a file it is no JSON; over the wire, where it can travel, gate and robot refuse it as `bad_argument`."""
    script = tmp_path / "plans.json"
    script.write_text(json.dumps([msgspec.to_builtins(to(x=float("nan")))]))
    done = Desk(tmp_path).crew("planner", "try", SHORT_DRIVE, "--planner", "script", "--script", str(script), "--json")
    assert done.returncode == 2
    assert "plans.json" in done.stderr
    assert "Traceback" not in done.stderr


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

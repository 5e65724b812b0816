"""What may never be: a real robot without the gate. Every way in is tried."""

import asyncio
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest
from msgspec.structs import replace

import crew
from crew.actors.orchestrator import process as orchestrator
from crew.actors.robot import process as robot
from crew.actors.specs import OrchestratorSpec, RobotActorSpec
from crew.bus.link import Link
from crew.contracts.pass_through import RealRobots
from crew.contracts.site import Rules
from crew.errors import UsageError
from crew.launch.options import LaunchOptions
from crew.library import load_rules
from crew.packed import pack
from crew.study.launch import simulated_rules, unenforced
from crew.supervisor import Child

REAL = """\
crew: field
area: {x: [-6, 10], y: [-6, 10]}
robots:
  iris: {kind: quadcopter, adapter: mavlink, connection: 'udpin:0.0.0.0:14550'}
contracts: []
"""


@pytest.fixture
def real(tmp_path: Path) -> Path:
    path = tmp_path / "field.yaml"
    path.write_text(REAL, encoding="utf-8")
    return path


def _real_rules() -> Rules:
    rules = load_rules("air_ground")
    robots = tuple(replace(r, sim="", connection="udpin:0.0.0.0:14550") for r in rules.crew.robots)
    return replace(rules, crew=replace(rules.crew, robots=robots, sim=None))


def _orchestrator(rules: Rules, tmp_path: Path) -> OrchestratorSpec:
    return OrchestratorSpec(
        rules=pack(rules),
        link=Link(role="orchestrator", endpoint="", crew="air_ground", certificates=""),
        run_folder=str(tmp_path),
        home=str(tmp_path),
        epoch=1,
        version="0",
        planner="script",
        simulated=True,
        operator_key=b"",
    )


def _robot(rules: Rules, simulated: bool = True) -> RobotActorSpec:
    return RobotActorSpec(
        rules=pack(rules),
        robot="iris",
        link=Link(role="robot-iris", endpoint="", crew="air_ground", certificates=""),
        connection="udpin:127.0.0.1:0",
        simulated=simulated,
        operator_key=b"",
        orchestrator_key=b"",
    )


def test_a_study_of_real_robots_is_refused_before_anything_is_started(real: Path) -> None:
    with pytest.raises(UsageError, match="a study runs in simulation alone: field: iris has a real connection"):
        simulated_rules(LaunchOptions(crew=str(real)))


@pytest.mark.parametrize("enforced", [True, False])
def test_the_launchers_children_are_enforced_until_the_study_says_otherwise(tmp_path: Path, enforced: bool) -> None:
    rules = load_rules("air_ground")
    children = [
        Child(name="orchestrator", module="x", spec=_orchestrator(rules, tmp_path)),
        Child(name="iris", module="x", spec=_robot(rules)),
        Child(name="router", module="x", spec=None),
    ]
    found = children if enforced else unenforced(children)
    assert [child.spec.enforced for child in found[:2]] == [enforced, enforced]


def test_an_orchestrator_of_real_robots_does_not_start_unenforced(tmp_path: Path) -> None:
    rules = _real_rules()
    spec = replace(_orchestrator(rules, tmp_path), enforced=False)
    with pytest.raises(RealRobots):
        asyncio.run(orchestrator.serve(spec, rules, _bus(), _context()))
    assert not list(tmp_path.iterdir()), "not even a journal was begun"


@pytest.mark.parametrize("simulated", [True, False])
def test_a_real_robot_does_not_start_unenforced(simulated: bool) -> None:
    rules = _real_rules()
    spec = replace(_robot(rules, simulated), enforced=False)
    with pytest.raises(RealRobots):
        asyncio.run(robot.serve(spec, rules, _bus(), _context()))


def test_nothing_else_in_the_project_switches_enforcement_off() -> None:
    root = Path(crew.__file__).parent.parent
    found = sorted(
        path.relative_to(root).as_posix()
        for folder in ("crew", "actors", "adapters", "contracts", "sim")
        for path in (root / folder).rglob("*.py")
        if "enforced=False" in path.read_text(encoding="utf-8")
    )
    assert found == ["crew/study/launch.py"]


def _bus() -> Any:
    return SimpleNamespace()


def _context() -> Any:
    return SimpleNamespace(ready=lambda: None)

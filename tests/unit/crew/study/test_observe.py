"""What journals show to the study: the golden runs, and missions without a plan."""

import math
from pathlib import Path

import msgspec
import pytest

from crew.contracts.mission import event as ev
from crew.contracts.plan import Call, Plan
from crew.contracts.render.prompt import Arm
from crew.library import load_rules
from crew.sim.oracle import Frame, Licence, Never
from crew.study.live import TRUTH, Ended
from crew.study.observation import Observation
from crew.study.observe import Mission, Story, observe, take_event
from crew.study.scenario import Scenario

GOLDEN = Path(__file__).parents[3] / "replay"
RULES = load_rules("air_ground")
SCENARIO = Scenario(
    name="find",
    testbed="air_ground",
    title="Find",
    request="search the area and send the rover to the victim",
    kind="nominal",
    outcome="completed",
    contracts=("search_and_dispatch",),
    robots=("iris", "tb3"),
)
BLOCKED = msgspec.structs.replace(
    SCENARIO, kind="fault", outcome="blocked", robots=(), codes=("no_target_fix",), never=(Never(robot="tb3"),)
)


def _observed(name: str, scenario: Scenario, outcome: str, code: str, tmp_path: Path) -> Observation:
    folder = tmp_path / "runs" / name
    folder.mkdir(parents=True)
    (folder / "journal.db").write_bytes((GOLDEN / name / "journal.db").read_bytes())
    poses = {"iris": (-4.0, -4.0, 0.0, 0.0), "tb3": (-4.0, -2.5, 0.0, 0.0)}
    arrived = {**poses, "tb3": (5.0, 4.7, 0.0, 0.0)}
    targets = {"victim": (5.0, 5.0, 0.0)}
    frames = [
        Frame(at_ns=0, poses=poses, targets=targets),
        Frame(at_ns=10**12, poses=arrived if outcome == "completed" else poses, targets=targets),
    ]
    (folder / TRUTH).write_bytes(msgspec.msgpack.encode(frames))
    mission = Mission(scenario=scenario, arm=Arm.RO, planner="embedded", seed=0, version="1")
    return observe(mission, Ended(outcome=outcome, code=code, began_ns=0), RULES, folder, tmp_path, wall_s=1.0)


def test_a_completed_run_is_told_with_its_plan_and_every_dispatch(tmp_path: Path) -> None:
    seen = _observed("completed", SCENARIO, "completed", "", tmp_path)
    assert seen.first is not None
    assert (seen.first.readable, seen.first.judged, seen.first.code) == (True, True, "")
    assert [step.skill for step in seen.first.steps] == [d.skill for d in seen.sent]
    assert {d.outcome for d in seen.sent} == {"succeeded"}
    assert all(d.at_ns <= d.ended_ns for d in seen.sent)
    assert any(d.at_ns < d.ended_ns for d in seen.sent)
    assert (seen.moved, seen.run, seen.as_expected) == (("tb3",), "runs/completed", True)
    assert seen.goal_error_m == pytest.approx(0.3)


def test_a_halted_run_is_told_with_its_refusal_and_its_way_to_safety(tmp_path: Path) -> None:
    seen = _observed("halted", BLOCKED, "halted", "no_target_fix", tmp_path)
    assert [(r.robot, r.code) for r in seen.refusals] == [("tb3", "no_target_fix")]
    assert {d.robot for d in seen.sent} == {"iris"}
    assert [d.skill for d in seen.dispatches if d.purpose == "safe"] == ["land"]
    assert seen.as_expected


def test_the_licence_decides_and_not_what_the_gate_allowed(tmp_path: Path) -> None:
    unasked = msgspec.structs.replace(SCENARIO, licences=(Licence(robot="iris", skill="land"),))
    seen = _observed("completed", unasked, "completed", "", tmp_path)
    assert {f.rule for d in seen.sent if d.skill != "land" for f in d.false} >= {"not_asked"}
    assert not seen.as_expected


def test_an_outcome_with_another_code_is_not_as_it_must_be(tmp_path: Path) -> None:
    assert not _observed("halted", BLOCKED, "halted", "robot_unavailable", tmp_path).as_expected


def test_a_mission_that_left_nothing_is_counted_as_it_ended(tmp_path: Path) -> None:
    folder = tmp_path / "runs" / "nothing"
    folder.mkdir(parents=True)
    mission = Mission(scenario=SCENARIO, arm=Arm.RO, planner="embedded", seed=0, version="1")
    seen = observe(mission, Ended(outcome="error", began_ns=0), RULES, folder, tmp_path, wall_s=1.0)
    assert (seen.outcome, seen.proposals, seen.dispatches, seen.as_expected) == ("error", (), (), False)


def test_a_replan_that_fails_is_no_mission_without_a_plan() -> None:
    story = Story(proposals=[], sent=[], dispatches=[], refusals=[])
    failed = ev.PlannerFailed(at_ns=1, reason="the planner abstained")
    take_event(story, failed, 0.1)
    assert story.failure == "the planner abstained"
    story.failure = ""
    take_event(story, ev.Proposed(at_ns=2, plan=Plan("carry", (Call("g1", "wave"),)), planner="p"), 0.2)
    take_event(story, failed, 0.1)
    assert [p.readable for p in story.proposals] == [False, True, False]
    assert story.failure == ""


def test_a_number_that_is_none_is_written_by_its_name() -> None:
    story = Story(proposals=[], sent=[], dispatches=[], refusals=[])
    plan = Plan("dispatch_only", (Call("tb3", "navigate_to", {"x": math.nan, "y": -math.inf}),))
    take_event(story, ev.Proposed(at_ns=2, plan=plan, planner="p"), 0.2)
    assert story.proposals[0].steps[0].args == {"x": "nan", "y": "-inf"}

"""`crew demo --json`, exactly as a script runs it: outcomes, codes, exit codes, and what the journal shows."""

import math
from pathlib import Path

import pytest

from crew.contracts.mission_state import MissionState
from crew.records import DecisionRecord, IntentRecord
from tests.integration.crew.harness import Demo, Desk, intents, journal

FIELDS = {"mission", "outcome", "code", "question", "contract", "steps", "goal_error_m", "run", "wall_s", "sim_s"}
STEP_FIELDS = {"robot", "skill", "args", "outcome", "code"}
NEAR = "search x from -6 to -3 and y from -6 to -3 and send the rover to the victim"


def test_the_rover_reaches_the_person_that_the_drone_found(completed: Demo) -> None:
    assert completed.code == 0, completed.stderr
    result = completed.result
    assert result.keys() >= FIELDS
    assert all(step.keys() == STEP_FIELDS for step in result["steps"])
    assert (result["outcome"], result["code"], result["question"]) == ("completed", None, None)
    assert result["contract"] == "search_and_dispatch"
    assert set(completed.outcomes().values()) == {"succeeded"}
    assert {"iris.search_target", "tb3.navigate_to"} <= completed.outcomes().keys()
    assert 0.0 < result["goal_error_m"] <= 0.6
    assert result["sim_s"] > 0.0
    assert result["wall_s"] > 0.0
    assert completed.stderr == ""


def test_the_rover_is_sent_only_after_the_fix_was_published(completed: Demo) -> None:
    records = [record for _, record in journal(completed.run)]
    sent = next(r.dispatch for r in records if isinstance(r, IntentRecord) and r.dispatch.robot == "tb3")
    allowed = next(r for r in records if isinstance(r, DecisionRecord) and r.decision.call.robot == "tb3")
    fix = allowed.world.values["victim"]
    assert fix.source == "iris"
    assert fix.reading.status == "ok"
    assert fix.received_ns <= allowed.decision.at_ns <= sent.issued_ns
    assert fix.reading.position is not None
    assert math.dist((sent.places["target"].x, sent.places["target"].y), (5.0, 5.0)) < 0.6
    found = next(r.dispatch for r in records if isinstance(r, IntentRecord) and r.dispatch.skill == "search_target")
    assert found.issued_ns < fix.reading.stamp_ns < sent.issued_ns


def test_the_run_verifies(demo_desk: Desk, completed: Demo) -> None:
    verified = demo_desk.crew("verify", str(completed.run))
    assert verified.returncode == 0, verified.stdout
    assert "every decision hold" in verified.stdout


def test_it_runs_in_a_single_process_too(desk: Desk) -> None:
    demo = desk.demo("--single-process", "--request", "send the rover to (-3, -3)")
    assert (demo.code, demo.result["outcome"]) == (0, "completed"), demo
    assert demo.result["goal_error_m"] < 0.6


@pytest.mark.hostile
@pytest.mark.parametrize("fault", ["missed_detection", "nan_transmission"])
def test_without_a_usable_fix_the_rover_stays_and_the_drone_lands(desk: Desk, fault: str) -> None:
    demo = desk.demo("--fault", fault, "--request", NEAR)
    assert demo.code == 4
    assert (demo.result["outcome"], demo.result["code"]) == ("halted", "no_target_fix")
    assert demo.outcomes()["tb3.navigate_to"] == "refused"
    assert not [i for i in intents(demo.run) if i.startswith("tb3.")]
    assert intents(demo.run)[-1] == "iris.land"
    assert _last_state(demo.run).safe["searcher"].phase == "succeeded", "telemetry showed it on the ground"
    assert demo.result["goal_error_m"] == pytest.approx(math.dist((-4.0, -2.5), (5.0, 5.0)), abs=0.15)
    assert desk.crew("verify", str(demo.run)).returncode == 0


@pytest.mark.parametrize("robot", ["tb3", "iris"])
def test_nothing_is_sent_to_a_robot_that_is_not_available(desk: Desk, robot: str) -> None:
    demo = desk.demo("--fault", f"{robot}_unavailable", "--request", NEAR)
    assert not [i for i in intents(demo.run) if i.startswith(f"{robot}.")]
    assert demo.result["code"] == "robot_unavailable"
    assert demo.result["outcome"] == ("rejected" if robot == "iris" else "halted")
    assert demo.code == (3 if robot == "iris" else 4)


def test_a_place_outside_the_area_is_rejected_before_anything_moves(desk: Desk) -> None:
    demo = desk.demo("--request", "send the rover to (20, 0)")
    assert (demo.code, demo.result["outcome"], demo.result["code"]) == (3, "rejected", "out_of_bounds")
    assert intents(demo.run) == []


def test_an_unread_word_is_asked_about_and_nothing_moves(desk: Desk) -> None:
    demo = desk.demo("--request", "send the rover to (-3, -3) twice")
    assert (demo.code, demo.result["outcome"], demo.result["code"]) == (3, "rejected", "unread_words")
    assert "twice" in demo.result["question"]
    assert intents(demo.run) == []


def _last_state(run: Path) -> MissionState:
    from crew.journal_reader import read_records
    from crew.verify import Replay

    replay = Replay()
    for row in read_records(run / "journal.db"):
        replay.take(row)
    return next(iter(replay.states.values()))

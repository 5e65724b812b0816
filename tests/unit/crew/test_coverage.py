"""What runs exercised, counted from their journals: golden runs, and records made for one case."""

import json
import shutil
from pathlib import Path

import msgspec
import pytest

from crew.cli.coverage import as_data, run_coverage
from crew.contracts.codes import Code
from crew.contracts.gate.guard import SECOND_NS
from crew.contracts.mission_state import MissionState, Phase
from crew.contracts.plan import Call
from crew.contracts.snapshot import Snapshot
from crew.coverage import Tally, _Run, journals_in
from crew.errors import UsageError
from crew.journal_reader import Record as Row
from crew.packed import pack
from crew.records import DecisionRecord, JudgementRecord, MissionRecord, Record, RunRecord
from tests.unit.contracts.build import NOW_NS, done, executing, judged
from tests.unit.contracts.indoor import APPROACH, LOAD, carry, deliver, g1, go2, indoor, indoors

GOLDEN = Path(__file__).parents[2] / "replay"
TO_ROOM = "carry the red cube to room_b"


def begun() -> list[Record]:
    rules = indoor()
    return [
        RunRecord(
            run="r", version="0", epoch=1, authorizer="Gate", planner="embedded", rules=pack(rules), rules_digest=""
        )
    ]


def decided(mission: MissionState, call: Call, world: Snapshot) -> list[Record]:
    """The mission as it stood, and the gate's decision on a call in a world."""
    decision = judged(call, mission, world, indoor())
    return [MissionRecord(state=mission), DecisionRecord(state_digest="", world=world, decision=decision)]


def counted(*records: Record) -> Tally:
    tally = Tally()
    run = _Run(tally)
    for seq, record in enumerate([*begun(), *records], start=1):
        run.take(Row(seq, record.kind, NOW_NS, 0, msgspec.msgpack.encode(record)))
    return tally


def truths(tally: Tally, contract: str, words: str) -> dict[str, int]:
    found = [row for row in as_data(tally)["guards"] if (row["contract"], row["guard"]) == (contract, words)]
    assert len(found) == 1, words
    return {name: found[0][name] for name in ("held", "failed", "unknown")}


def test_the_golden_runs_are_counted() -> None:
    tally = Tally()
    for journal in journals_in([GOLDEN]):
        tally.add(journal)
    data = as_data(tally)
    assert len(data["runs"]) == 2
    assert {code: count for code, count in data["codes"].items() if count} == {"no_target_fix": 1}
    steps = {row["step"]: row for row in data["steps"] if row["contract"] == "search_and_dispatch"}
    assert {k: steps["dispatch"][k] for k in ("sent", "done", "refused")} == {"sent": 1, "done": 1, "refused": 1}
    assert (steps["search"]["sent"], steps["search"]["done"]) == (2, 2)
    taken = {(row["phase"], row["event"], row["to"]) for row in data["transitions"] if row["count"]}
    assert ("executing", "CompletionJudged", "completed") in taken
    assert ("executing", "Decided", "halting") in taken
    assert ("asking", "Answered", "waiting") not in taken
    assert data["covered"]["codes"] == [1, len(Code)]


def test_guards_are_counted_by_what_they_were_found_to_be() -> None:
    mission = done(executing(TO_ROOM, carry("room_b"), indoor()), "approach")
    loaded = done(mission, "load")
    late = indoors(g1(), go2("pickup", NOW_NS - 5 * SECOND_NS))
    tally = counted(
        *decided(mission, LOAD, indoors(go2("pickup"))),
        *decided(mission, LOAD, indoors(go2("pickup", tray="bottle"))),
        *decided(loaded, deliver("room_b"), indoors(go2("pickup", tray="red_cube"))),
        *decided(loaded, deliver("room_b"), late),
    )
    assert truths(tally, "carry", "tray of carrier is none") == {"held": 1, "failed": 1, "unknown": 0}
    assert truths(tally, "carry", "carrier is at pickup") == {"held": 2, "failed": 0, "unknown": 0}
    assert truths(tally, "carry", "carrier is not moving")["held"] == 2
    assert tally.codes[Code.PRECONDITION_FAILED] == 1
    assert tally.codes[Code.STATE_STALE] == 1


def test_a_guard_whose_if_is_not_met_was_not_exercised() -> None:
    mission = executing(TO_ROOM, carry("room_b"), indoor())
    tally = counted(*decided(mission, APPROACH, indoors()))
    asked = {"held": 0, "failed": 0, "unknown": 0}
    assert truths(tally, "carry", "if origin is given, object is at $origin") == asked
    claimed = executing("carry the red cube from table_a to room_b", carry("room_b"), indoor())
    tally = counted(*decided(claimed, APPROACH, indoors()))
    assert truths(tally, "carry", "if origin is given, object is at $origin") == {**asked, "held": 1}


def test_a_refusal_before_the_guards_exercises_none() -> None:
    mission = executing(TO_ROOM, carry("room_b"), indoor())
    tally = counted(*decided(mission, LOAD, indoors(go2("room_a"))))
    assert tally.codes[Code.OUT_OF_ORDER] == 1
    assert not any(sum(counts.values()) for counts in tally.guards.values())


def test_the_completion_is_counted_when_it_is_judged() -> None:
    mission = done(executing(TO_ROOM, carry("room_b"), indoor()), "approach", "load", "deliver")
    world = indoors(go2("room_b", tray="none"))
    record = JudgementRecord(mission="m1", what="complete", state_digest="", world=world, now_ns=NOW_NS, missing="x")
    tally = counted(MissionRecord(state=mission), record)
    assert truths(tally, "carry", "carrier is at $destination") == {"held": 1, "failed": 0, "unknown": 0}


def test_a_run_that_cannot_be_read_is_skipped_by_name(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    shutil.copytree(GOLDEN / "completed", tmp_path / "good")
    (tmp_path / "cut").mkdir()
    (tmp_path / "cut" / "journal.db").write_bytes((GOLDEN / "completed" / "journal.db").read_bytes()[:9000])
    assert run_coverage([tmp_path], "", True) == 0
    data = json.loads(capsys.readouterr().out)
    assert data["runs"] == [str(tmp_path / "good")]
    assert "cannot be read" in data["skipped"][str(tmp_path / "cut")]
    with pytest.raises(UsageError, match="none of the runs could be counted"):
        run_coverage([tmp_path / "cut"], "", True)


def test_a_crew_adds_what_no_run_has_used(capsys: pytest.CaptureFixture[str]) -> None:
    assert run_coverage([GOLDEN / "completed"], "humanoid_quadruped", False) == 0
    said = capsys.readouterr().out
    assert "handover" in said
    assert "codes never given (31)" in said


@pytest.mark.parametrize(("name", "words"), [("none", "no folder"), ("empty", "no run in")])
def test_a_folder_without_runs_is_refused(tmp_path: Path, name: str, words: str) -> None:
    (tmp_path / "empty").mkdir()
    with pytest.raises(UsageError, match=words):
        journals_in([tmp_path / name])


def test_phases_are_those_of_the_machine() -> None:
    assert {phase for phase, _, _ in Tally().transitions} <= set(Phase)

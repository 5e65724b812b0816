"""The golden runs as the recorder tells them: what the page shows follows from the journal alone."""

from pathlib import Path

import msgspec
import pytest

from crew.actors.recorder.colour import TONES
from crew.actors.recorder.entry import Area, Document, Entry, Graph, LaneChange, LogLine, Mark, Measure
from crew.actors.recorder.lane import lanes
from crew.actors.recorder.teller import Teller
from crew.errors import JournalError
from crew.journal_reader import read_records
from crew.records import DecisionRecord
from tests.replay.make import HERE


def told(name: str) -> list[Entry]:
    return [entry for _, entry in Teller(HERE / name / "journal.db").tell()]


def of_lane(entries: list[Entry], lane: str) -> list[str]:
    """The states of a lane that last: of those that follow each other at one moment, all but the gaps."""
    return [e.state for e in entries if isinstance(e, LaneChange) and e.lane == lane and e.state]


def test_the_rover_is_held_at_the_gate_until_the_drone_has_reported() -> None:
    entries = told("completed")
    assert of_lane(entries, "mission")[-2:] == ["executing", "completed"]
    assert of_lane(entries, "robot/tb3")[-2:] == ["held at the gate", "navigate_to"]
    drone = of_lane(entries, "robot/iris")
    assert [state for state in drone if not state.startswith(("held", "waits"))] == [
        "takeoff", "search_target", "get_coordinates", "land",
    ]  # fmt: skip


def test_a_halted_run_shows_the_refusal_and_the_safe_state() -> None:
    entries = told("halted")
    assert of_lane(entries, "mission")[-2:] == ["halting", "halted"]
    assert of_lane(entries, "robot/tb3")[-1] == "refused"
    assert of_lane(entries, "robot/iris")[-1] == "safe: land"
    refused = [e for e in entries if isinstance(e, LogLine) and e.level == "no_target_fix"]
    assert refused[0].text.startswith("refused: tb3.navigate_to")
    assert {line.tone for line in refused} == {"bad"}


@pytest.mark.parametrize("name", ["completed", "halted"])
def test_every_decision_of_the_journal_is_a_line(name: str) -> None:
    rows = [row for row in read_records(HERE / name / "journal.db") if row.kind == "decision"]
    decisions = [msgspec.msgpack.decode(row.body, type=DecisionRecord).decision for row in rows]
    said = [e for e in told(name) if isinstance(e, LogLine) and e.text.startswith(("allowed: ", "refused: "))]
    assert len(said) == len(decisions) > 3
    for line, decision in zip(said, decisions, strict=True):
        assert decision.call.skill in line.text
        assert line.level == ("allowed" if decision.refusal is None else decision.refusal.code)


def test_the_proposal_names_each_argument_with_its_source_and_how_its_step_went() -> None:
    documents = [e.markdown for e in told("halted") if isinstance(e, Document)]
    last = documents[-1]
    assert "| dispatch | tb3.navigate\\_to | **refused** no\\_target\\_fix |" in last
    assert "**halted**" in last
    assert "takeoff altitude = **5**: chosen by the planner" in last
    assert "navigate\\_to target = **victim**" in last
    assert "not yet" in documents[3]


def test_the_contract_is_drawn_from_left_to_right_with_the_present_step_lit() -> None:
    graphs = [e for e in told("completed") if isinstance(e, Graph)]
    first, last = graphs[0], graphs[-1]
    place = {node.name: node.x for node in last.nodes}
    assert place["takeoff"] < place["search"] < place["report"] < place["dispatch"] == place["land"]
    assert ("report", "dispatch") in last.edges
    assert {node.tone for node in last.nodes} == {"good"}
    assert {node.tone for node in first.nodes} != {"good"}
    assert any([node.tone for node in graph.nodes].count("run") == 1 for graph in graphs)


def test_where_a_robot_works_is_marked_while_it_does() -> None:
    entries = told("completed")
    zones = [e for e in entries if isinstance(e, Area)]
    assert [zone.zone is not None for zone in zones] == [True, False]
    goals = [e.at for e in entries if isinstance(e, Mark) and e.name == "goal/tb3"]
    assert goals[0] is not None
    assert goals[-1] is None
    (fix,) = [e for e in entries if isinstance(e, Mark) and e.name == "value/victim" and e.at is not None]
    assert fix.sigma_m is not None
    assert fix.at == goals[0]


def test_each_dispatch_has_its_latency() -> None:
    latencies = [e.value for e in told("completed") if isinstance(e, Measure) and e.series.startswith("latency/")]
    assert len(latencies) == 5
    assert all(0 < value < 60_000 for value in latencies)


@pytest.mark.parametrize("name", ["completed", "halted"])
def test_everything_told_can_be_drawn(name: str) -> None:
    known = lanes(Teller(HERE / name / "journal.db").rules)
    for entry in told(name):
        match entry:
            case LaneChange(lane=lane, state=state):
                assert state == "" or known[lane][state] in TONES
            case LogLine(tone=tone) | Mark(tone=tone) | Area(tone=tone):
                assert tone in TONES
            case Graph(nodes=nodes):
                assert {node.tone for node in nodes} <= set(TONES)


def test_what_is_no_journal_is_said_so(tmp_path: Path) -> None:
    with pytest.raises(JournalError, match="cannot be read"):
        Teller(tmp_path / "none.db")
    broken = tmp_path / "broken.db"
    broken.write_bytes(b"no journal at all" * 100)
    with pytest.raises(JournalError, match="cannot be read"):
        Teller(broken)

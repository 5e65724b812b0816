"""`crew planner try`: a request planned and judged in a world that a person assumes in words."""

import json

import pytest

from crew.actors.specs import PlannerChoice
from crew.cli.planner import assumed, run_try
from crew.errors import UsageError
from crew.library import load_rules
from tests.unit.contracts.indoor import place

CREW = "humanoid_quadruped"


def tried(text: str, *state: str, capsys: pytest.CaptureFixture[str]) -> tuple[int, dict[str, object]]:
    code = run_try(text, CREW, PlannerChoice(), state, True)
    return code, json.loads(capsys.readouterr().out)


@pytest.mark.parametrize(("near", "contract"), [("true", "handover"), ("false", "carry")])
def test_the_requesters_position_alone_decides(near: str, contract: str, capsys: pytest.CaptureFixture[str]) -> None:
    code, result = tried("bring me the red cube", f"requester.near={near}", capsys=capsys)
    assert (code, result["proposal"]["contract"]) == (0, contract)  # type: ignore[index]
    assert result["verdict"] == {"accepted": True, "code": None, "message": "accepted", "question": None}


def test_without_a_word_of_the_requester_nothing_is_accepted(capsys: pytest.CaptureFixture[str]) -> None:
    code, result = tried("bring me the red cube", capsys=capsys)
    assert code == 3
    assert result["verdict"]["code"] == "no_value"  # type: ignore[index]


@pytest.mark.parametrize(
    ("text", "state", "code"),
    [
        ("bring me the red cube", ("requester.near=true", "g1.holding=red_cube"), "precondition_failed"),
        ("carry the red cube to room_b", ("go2.tray=bottle",), "precondition_failed"),
        ("hand me the cube from table_b", ("requester.near=true", "red_cube.at=table_a"), "precondition_failed"),
        ("carry the red cube to the rooftop helipad", (), "unknown_location"),
        ("bring me the piano", ("requester.near=true",), "unknown_object"),
        ("do not take it to room_b", (), "ambiguous_request"),
        ("do not take the red cube to room_b", (), "forbidden_by_request"),
    ],
)
def test_what_cannot_be_is_refused(
    text: str, state: tuple[str, ...], code: str, capsys: pytest.CaptureFixture[str]
) -> None:
    exit_code, result = tried(text, *state, capsys=capsys)
    assert (exit_code, result["verdict"]["code"]) == (3, code)  # type: ignore[index]


def test_robots_are_assumed_at_rest() -> None:
    world = assumed(("go2.at=pickup", "red_cube.at=table_a", "requester.status=absent"), load_rules(CREW))
    assert {n: s.value for n, s in world.robots["g1"].fluents.items()} == {
        "standing": True, "moving": False, "holding": "none", "handed": "none", "waved": False,
    }  # fmt: skip
    assert world.robots["go2"].fluents["at"].value == "pickup"
    assert world.values["red_cube"].reading.position == place("table_a")
    assert world.values["requester"].reading.position is None


@pytest.mark.parametrize(
    ("state", "words"),
    [
        ("requester.near", "is no assignment"),
        ("requester=near", "is no assignment"),
        ("g1.standing=yes", "'yes' is no value of it (valid: false, true)"),
        ("g1.holding=rd_cube", "did you mean 'red_cube'?"),
        ("g1.battery=full", "'full' is no number"),
        ("g1.flying=true", "g1 has no fluent 'flying'"),
        ("go2.at=roof", "'roof' is no value of it"),
        ("requestr.near=true", "did you mean 'requester'?"),
        ("requester.close=true", "requester has no attribute 'close'"),
        ("requester.status=fine", "'fine' is no value of it (valid: absent, ambiguous, not_a_person, ok, "),
    ],
)
def test_an_assumption_that_means_nothing_is_refused_in_words(state: str, words: str) -> None:
    with pytest.raises(UsageError) as raised:
        assumed((state,), load_rules(CREW))
    assert words in str(raised.value)

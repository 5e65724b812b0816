"""What the reader passes over without asking, what it says of it, and all that it must not pass over."""

from itertools import count

import pytest
from msgspec.structs import replace

from crew.contracts.language.lexicon import lexicon_of
from crew.contracts.language.reading import explain_reading, read_request
from crew.contracts.site import Rules
from crew.library import load_rules
from tests.unit.contracts.language.constraints import CONSTRAINTS, JOINS, REQUESTS
from tests.unit.contracts.language.corpus import ON_GROUND, judge
from tests.unit.contracts.language.look_alikes import AIR, INDOOR

HARMLESS_BY_ITSELF = frozenset(("instead", "without me"))
"""`instead` joins; who asks is no part of carrying something to a room."""


@pytest.fixture(scope="module", params=list(REQUESTS))
def crew(request: pytest.FixtureRequest) -> tuple[str, Rules]:
    return request.param, load_rules(request.param)


def test_nothing_that_could_bear_on_a_request_is_passed_over(crew: tuple[str, Rules]) -> None:
    name, rules = crew
    turn = count()
    told = [
        JOINS[next(turn) % len(JOINS)].format(c=constraint, r=request)
        for constraint in CONSTRAINTS
        for request in REQUESTS[name]
        if constraint not in HARMLESS_BY_ITSELF
    ]
    assert [text for text in told if judge(text, rules).outcome == "accepted"] == []


@pytest.mark.parametrize(("crew_name", "lines"), [("air_ground", AIR), ("humanoid_quadruped", INDOOR)])
@pytest.mark.parametrize("near", [True, False])
def test_what_only_looks_alike_is_not_carried_out(crew_name: str, lines: str, near: bool) -> None:
    rules = load_rules(crew_name)
    state = replace(ON_GROUND, requester_near=near)
    assert [line for line in lines.strip().splitlines() if judge(line, rules, state).outcome == "accepted"] == []


@pytest.mark.parametrize(
    ("text", "left_out"),
    [
        ("I can't see very well, so please send the rover to base", ["I can't see very well"]),
        ("It is getting late. Send the rover home.", ["It is getting late"]),
        ("Send the rover to base because my back hurts", ["because my back hurts"]),
        ("My brother is lost, please search the north half for him", ["My brother is lost"]),
        ("TB3, this is control, go to base", ["this is control"]),
        ("New task: search the north half", ["New task"]),
    ],
)
def test_what_is_left_out_is_said(text: str, left_out: list[str], rules: Rules) -> None:
    reading = read_request(text, lexicon_of(rules))
    assert judge(text, rules).outcome == "accepted"
    assert [n.word for n in reading.noted if n.word in left_out] == left_out
    assert f"left out as no part of the request: '{left_out[0]}'" in explain_reading(reading)


@pytest.mark.parametrize(
    "told",
    [
        "I'm right here beside you",
        "I'm standing right here",
        "my hand is out",
        "I am sitting next to the humanoid with my hand open",
        "the requester is beside the humanoid",
        "I can't get up from my chair",
    ],
)
def test_where_and_how_the_person_is_says_nothing_where_something_is_brought_to_them(told: str) -> None:
    rules = load_rules("humanoid_quadruped")
    state = replace(ON_GROUND, requester_near=True)
    assert judge(f"hand me the cube, {told}", rules, state).outcome == "accepted"
    assert judge(f"send the dog to room_a, {told}", rules, state).outcome != "accepted"


def test_a_slip_that_is_read_is_said(rules: Rules) -> None:
    reading = read_request("serach the north half", lexicon_of(rules))
    assert reading.unread == ()
    assert "'serach' read as 'search'" in explain_reading(reading)


@pytest.mark.parametrize(
    "text",
    [
        "the bridge is closed, send the rover to base",
        "send the rover to base because the bridge is closed",
        "the grocer has a bakery. search the north half",
        "the radio was loud, so search the north half",
    ],
)
def test_any_other_story_is_asked_back_as_a_whole(text: str, rules: Rules) -> None:
    assert judge(text, rules).outcome == "question"


@pytest.mark.parametrize(
    "text", ["find the man and send the rover to the woman", "find my brother and send the rover to my sister"]
)
def test_two_people_are_not_taken_for_one(text: str, rules: Rules) -> None:
    assert judge(text, rules).code == "ambiguous_request"


def test_a_person_is_whoever_is_searched_for(rules: Rules) -> None:
    assert judge("find the man in the west half", rules).outcome == "accepted"
    assert judge("send the rover to the man", rules).outcome == "refused"

"""What people say around a request changes nothing in it: never what is asked for, and never what is excluded."""

import pytest

from crew.contracts.language.frames import FRAMES, OPENINGS, TAGS, phrases
from crew.contracts.site import Rules
from crew.library import load_rules
from tests.unit.contracts.language.corpus import Judged, judge

WANTED = {
    "air_ground": ("send the rover to base", "search the north half", "find the hiker and send the rover to her"),
    "humanoid_quadruped": ("carry the cube to room_b", "put the bottle on table_b", "go to room_a"),
}
UNWANTED = {
    "air_ground": (
        "do not send the rover to base", "never search the north half", "send the rover nowhere",
        "leave the rover where it is", "send the rover to base or to (1, 1)", "send the rover to base, no, to (1, 1)",
        "send the rover to base if it is dark",
    ),
    "humanoid_quadruped": (
        "do not carry the cube to room_b", "don't put the bottle on table_b", "never go to room_a",
        "carry neither the cube nor the bottle to room_b", "put the bottle on table_a or table_b",
    ),
}  # fmt: skip
OF_SPEAKERS = {
    "air_ground": (
        "I want to go to base", "I'm going to search the north", "gonna search the north", "I gotta go to base",
        "I'm worried about the rover going to base", "the rover was last seen at base", "we have a rover at base",
        "the rover is at base", "copy the rover to base", "did you find the victim", "you won't send the rover to base",
    ),
    "humanoid_quadruped": (
        "I have the cube", "we have the cube in room_b", "I like the cube", "do you have the bottle",
        "the cube is on table_a", "I'll go to room_b", "I need to go to room_b", "your hand on the cube",
        "my hand on the cube", "I need the cube not to be in room_b",
    ),
}  # fmt: skip
CREWS = list(WANTED)


@pytest.fixture(scope="module", params=CREWS)
def crew(request: pytest.FixtureRequest) -> tuple[str, Rules]:
    return request.param, load_rules(request.param)


def framed(text: str, which: int) -> list[str]:
    """The request in one wording of every template: its first (0) or its last (-1)."""
    frames, openings, tags = ([[*phrases((t,))][which] for t in table] for table in (FRAMES, OPENINGS, TAGS))
    before = [*frames, *(f"{opening}," for opening in openings)]
    return [*(f"{said} {text}" for said in before), *(f"{text}, {tag}" for tag in tags)]


def test_a_frame_leaves_the_plan_as_it_is(crew: tuple[str, Rules]) -> None:
    name, rules = crew
    for text in WANTED[name]:
        bare = judge(text, rules)
        assert bare.outcome == "accepted"
        found = {said: judge(said, rules) for said in framed(text, 0)}
        assert [said for said, judged in found.items() if judged.plan not in (None, bare.plan)] == []
        read = [judged for judged in found.values() if judged.outcome == "accepted"]
        assert len(read) > 0.9 * len(found)


def test_no_frame_loses_an_exclusion_a_choice_or_a_correction(crew: tuple[str, Rules]) -> None:
    name, rules = crew
    said = [line for text in UNWANTED[name] for line in framed(text, -1)]
    assert [line for line in said if judge(line, rules).outcome == "accepted"] == []


def test_what_people_say_of_themselves_and_of_the_world_is_no_request(crew: tuple[str, Rules]) -> None:
    name, rules = crew
    found: dict[str, Judged] = {text: judge(text, rules) for text in OF_SPEAKERS[name]}
    assert [text for text, judged in found.items() if judged.outcome == "accepted"] == []


@pytest.mark.parametrize("tag", ["over", "right"])
def test_a_tag_without_a_mark_belongs_to_what_stands_before_it(tag: str) -> None:
    judged = judge(f"search {tag}", load_rules("air_ground"))
    assert judged.outcome != "accepted"

"""What a robot is told in other words than its crew has, what is said again, and what only looks like either."""

import pytest
from msgspec.structs import replace

from crew.contracts.language.lexicon import lexicon_of
from crew.contracts.language.reading import read_request
from crew.contracts.site import Rules
from crew.library import load_rules
from tests.unit.contracts.language.corpus import ON_GROUND, judge

AS_PLAIN = {
    "air_ground": {
        "search the north half": (
            "get the drone in the air and search the north half", "get iris airborne, then sweep the north half",
            "get the chopper up to the north half and have a look",
            "get the helicopter off the ground and probe the north",
            "task the quadcopter with a search of the north half", "assign the drone to search the north half",
            "hunt for the hiker in the north half", "launch a search of the north half",
            "search the north half, use whichever units you want",
        ),
        "search the area": ("fly around everywhere and find the hiker", "fly around and look for the hiker"),
        "search the north half and send the rover to the hiker": (
            "the drone should search the north half and the rover could then go to the hiker",
            "search the north half and once it has eyes on the hiker have tb3 drive out to them",
            "search the north half and when the drone spots the hiker send the rover to them",
        ),
        "send the rover to base": (
            "recall the rover to base", "reposition the rover to the base station", "set off for base, rover",
            "rover, you're wanted at base", "tb3, respond to base", "send the robot, I mean the rover, back to base",
            "rover - sorry, tb3 - to base", "put the rover at base", "send the rover to base, it has earned a rest",
        ),
        "land the drone": ("put the drone on the ground", "get the drone back down on the ground", "bring iris down"),
    },
    "humanoid_quadruped": {
        "put the cube on table_b": (
            "have g1 place the cube on table_b", "deposit the cube on table_b", "have the cube put on table_b",
        ),
        "take the bottle to room_b": (
            "load the bottle on the quadruped and have it delivered to room_b", "ferry the bottle to room_b",
            "take the bottle, I mean the water bottle, to room_b",
        ),
        "bring the cube to me": (
            "I require the cube at my position", "retrieve the cube", "deliver the cube to my location",
        ),
        "send the dog to the charger": (
            "send the dog, er, the quadruped I mean, to the charger", "call the dog to the charging point",
            "quadruped, you're wanted at the charger", "whenever you're ready, send the pup to the charger",
        ),
    },
}  # fmt: skip
NOT_CARRIED_OUT = {
    "air_ground": """
get the drone up north
get the drone up to the north half and search the south half
get the drone up tomorrow and search the north half
put the rover in the air
put the drone on the ground floor
put the drone on the ground near base
don't put the drone on the ground
do not get the drone up and search the north half
put the drone on the ground then search the north half
task the rover with a search of the north half
don't task the drone with a search of the north half
the drone was tasked with a search of the north half
never assign the drone to search the north half
rover, you're not wanted at base
rover, are you wanted at base
rover, you were wanted at base
rover, you're wanted at the police station
recall the drone to base
I recall the rover at base
do you recall the rover at base
we leave for base
leave the rover at base
fly around the north half and find the hiker
have it searched
I have it searched already
find the helicopter
look for the drone
the drone has seen the hiker
the drone sees the hiker
send the rover, I mean the drone, to base
send tb3, I mean iris, to base
send the rover, I mean the robot, to base
send the rover to base, I mean (3, 3)
the rover, er, the drone to base
use whichever half you want
send the rover to base whenever the hiker is ready
search the north half and the drone could then go to base
stop the hunt
call off the hunt
tehm
send the rover to thme
send the rover to teh bsae_2
""",
    "humanoid_quadruped": """
throw me the bottle
I have it delivered to room_a every week
it was delivered to room_b
I require no cube at my position
I don't require the red cube at my position
I required the red cube at my position
take the bottle at my position to room_a
bring the bottle cart to room_a
bring me the bottle grip
put the bottle on the cart
send the dog, I mean the humanoid, to the charger
not the dog, I mean the quadruped, to room_a
take the cube to room_a, I mean room_b
the cube, I mean the bottle, to room_a
dog, you're needed in the kitchen
dog, are you needed in room_a
dog, don't leave for room_b
bring me whichever cube you like
the ferry takes the bottle to room_b
have you got hold of the bottle
tkae the bottle to room_a or room_b
don't tkae the bottle to room_a
""",
}


def plan(text: str, rules: Rules) -> tuple[str, object]:
    judged = judge(text, rules, replace(ON_GROUND, requester_near=False))
    found = None if judged.instance is None else (judged.instance.contract, dict(judged.instance.slots))
    return judged.outcome, found


@pytest.mark.parametrize("crew", list(AS_PLAIN))
def test_what_a_robot_is_told_is_read_as_the_plain_wording(crew: str) -> None:
    rules = load_rules(crew)
    said = [(text, plain) for plain, texts in AS_PLAIN[crew].items() for text in texts]
    assert [text for text, plain in said if plan(text, rules) != plan(plain, rules)] == []
    assert all(plan(plain, rules)[0] == "accepted" for plain in AS_PLAIN[crew])


@pytest.mark.parametrize("crew", list(NOT_CARRIED_OUT))
@pytest.mark.parametrize("near", [True, False])
def test_what_only_looks_like_it_is_not_carried_out(crew: str, near: bool) -> None:
    rules = load_rules(crew)
    state = replace(ON_GROUND, requester_near=near)
    lines = NOT_CARRIED_OUT[crew].strip().splitlines()
    assert [line for line in lines if judge(line, rules, state).outcome == "accepted"] == []


def test_a_name_that_a_crew_has_itself_is_no_nickname() -> None:
    rules = load_rules("air_ground")
    rover = replace(rules.kinds["rover"], aliases=(*rules.kinds["rover"].aliases, "chopper"))
    named = replace(rules, kinds={**rules.kinds, "rover": rover})
    found = [m.name for m in read_request("chopper to base", lexicon_of(named)).mentions]
    assert "tb3" in found
    assert "iris" not in found

"""How people speak to a crew that searches and drives, in many words for one thing, and what only looks like it."""

import pytest
from msgspec.structs import replace

from crew.contracts.language.lexicon import lexicon_of
from crew.contracts.language.reading import read_request
from crew.contracts.site import Rules
from crew.library import load_rules
from tests.unit.contracts.language.corpus import ON_GROUND, judge

PEOPLE = {
    "find the hiker in the north half": """
find the missing skier in the north half
search the north half for our missing resident
search the north half for the resident who has gone missing
search the north half for the missing ranger
search the north half for a ranger who went missing this morning
search the north half for an elderly woman in her eighties
search the north half for a 70-year-old man
search the north half for my missing little girl
look in the north half for that poor soul
one of our guests is missing, search the north half
A worker is unaccounted for. Search the north half.
search the north half for the missing child, male, 8 years old
our guest, Mrs Jones, is missing, search the north half
Missing person reported by the hut warden, male, 62. Drone to search the north half.
can you search the north half for my nan, she's lost
search the north half for the unaccounted-for worker
search the north half for the delivery driver
search the north half for the missing party
One walker overdue, reported by his wife. Search the north half.
""",
    "search the north half and send the rover to the hiker": """
search the north half, rover to the injured once found
search the north half for the missing child and send the rover to the casualty
search the north half, then once he's been found drive the rover to him
as soon as they're located, rover goes to the casualty; drone searches the north half
drone searches the north half, rover drives to the person once she's been spotted
search the north half and once you've found the person send the rover to him
search the north half and, once you have him, dispatch the rover to his position
rover to proceed to the casualty once iris has a fix on him, iris to search the north half
search the north half and upon finding the hiker, send the rover to him
search the north half. When you know where he is, send the rover to him.
once someone is found, the rover is to drive to them. Drone, search the north half.
drone to search the north half, and rover to go to the casualty upon discovery
search the north half and the moment you find the missing person dispatch the rover to them
search the north half and send the rover to the person when it's found them
search the north half, then get the rover to wherever the casualty is
search the north half and have the rover go to where they are
search the north half, then route the ground robot to whoever it locates
""",
    "find the hiker and send the rover to him": "find him, send rover to him",
}
STAYING = {
    "search the north half": """
search the north half and keep the rover parked for now
search the north half, rover stays on standby
search the north half, rover to remain where it is
search the north half with the rover on standby
search the north half; the rover isn't needed
have the drone search the north half while the rover stays where it is
hold the rover and search the north half with the drone
drone up, search the north half, rover holds at base
search the north half and leave the rover out of it
""",
    "send the rover to base": """
keep the drone on the ground and send the rover to base
send the rover to base, drone to remain grounded
""",
    "search the north half and send the rover to the hiker": """
rover stands by, drone searches the north half, once found the rover goes to the hiker
search the north half, rover on standby; once he is found the rover drives to him
""",
    "land the drone and stop the rover": """
land the drone and hold the rover where it is
drone to land, rover to stay where it is
drone down, rover hold position
bring the drone down and have the rover stop right there
Abort. Put the drone on the ground and hold the rover where it is.
""",
    "stop the rover": """
rover to hold position
rover, stay where you are
""",
}
ENDING = {
    "abort everything": """
everything off
stand everything down
stand down
calling it all off
we're calling it all off
would you mind calling it all off and landing the drone, please?
we're done here, bring everything in
please finish all now, the drone lands and the rover stops
call the whole thing off
all units stand down
both of you stop
stop what you're doing
cease all operations immediately
mission over, abort
emergency stop
that's all for today, stop everything
let's stop here
""",
    "send the rover to base": "the rover must drive to base now, we are finish for today",
}
HEIGHTS = {
    "search the north half at 4 metres": """
search the north half, flying at 4 metres
search the north half, high four meter
make the drone fly on four meters and search the north half
search the north half, altitude four metres
search the north half from 4 metres above ground level
search the north half and maintain an altitude of 4 metres
search the north half while flying at 4 m
search the north half, flight level 4 metres
climb to 4 m and search the north half
set altitude to 4 metres and search the north half
search the north half hovering at four metres
search the north half @ 4 m
go up to four meters, then search the north half
""",
    "send the rover to 3, -4": """
send the rover to three comma minus four
can we, can we send the rover over to, uh, three comma minus four
rover, this is control, proceed to position x three, y minus four
""",
    "send the rover to 3, 6.5": "take the rover to uh three comma six point five",
}
CALLS = {
    "search the north half with the drone": """
control to crew, search the north half with the drone
Control to air team, commence search of north half with the drone.
Iris, iris, this is beach control. Search the north half.
Iris, this is mountain rescue, search the north half, over
beach control to iris, search the north half
Control to all units, drone to search the north half, over
Iris, this is Delta Two Four, search the north half, how copy
drone team: search the north half with the drone
message for iris: search the north half
iris, reception here, search the north half
Iris, how do you read? Search the north half, please acknowledge.
""",
    "send the rover to base": """
tb3 from control, return to base
tb3, this is site office, return to base, out
base to rover, return to base
""",
}
AFIELD = {
    "search the north half and send the rover to the hiker": """
search the north half, rover to close on the casualty when located
search the northern half of the grounds and have the rover meet the casualty
drone is to search the north half and after, rover makes the way to the lost woman
missing toddler, age three, red jacket. Drone to search the north half, rover to go to the child when found.
run a drone search over the north half for the patroller who didn't report in, and get the rover to her when found
""",
    "search the north half": """
let that little flying machine have a look round the northern half for the poor soul who's gone missing
make the drone to fly over the north half for find the person that is lost, please
would you mind having the drone look over the north for my missing colleague, please?
I want that drone is searching the north half
""",
    "search the whole area": "search the whole place\nsearch all of the grounds\nhave a look round the whole property",
    "send the rover to (7, 7)": """
set the TurtleBot a goal at (7, 7) and let it drive there
unit tb3, respond to coordinates 7, 7
run the rover over to seven comma seven
""",
    "land the drone and stop the rover": """
I'm ending this run. Land the drone and bring the rover to a stop.
that's it um we're done lads land the drone and uh stop the rover as well
end the mission: drone down, rover halted
""",
}
NOT_CARRIED_OUT = """
search the north half and tell the hiker
search the north half and tell my brother
search the north half with the man
search the north half with my colleague
tell the man to search the north half
ask the driver to search the north half
have the man search the north half
get the little one to search the north half
the man searches the north half
the hiker should search the north half
search the guest area
search the visitor site
search the farmer's field
search the guest house
find the driver's van
find the marshal
send the rover to the technician
send the rover to the missing ranger
find the missing vehicle
find the missing dog
find the missing bag
find my brother and send the rover to the farmer
search the north half for the man, 62 metres high
search the north half for the man reported by the rover
search the north half, male, 62
send the rover to 3, 4, male, 62
find the resident who has gone missing from base
find the man who is not lost
find the injured dog
find the lost and found
search the north half and once I have found him send the rover to him
once I know where he is, send the rover to him; search the north half
search the north half and once the police have found him send the rover
search the north half once he has been found dead
search the north half and send the rover once found by the police
search the north half and once he's found his phone send the rover
search the north half and once found in the south half send the rover to him
search the north half when you have a position
search the north half once the drone has found a place to land
search the north half and once you have found the rover send it to the hiker
search the north half and if found send the rover to him
search the north half and unless he is found send the rover to him
search the north half, when he isn't found send the rover
search the north half and once found send the rover to base
search the north half and send the rover to where he is going
search the north half and send the rover to where she was last seen
send the rover to where he is
send the rover to him
send the rover to them
send the rover to wherever you like
search the north half, he's lost in the south half
she's lost, or he is
there is no missing person, search the area
keep the rover where it is until I say so and search the north half
search the north half, keep the rover 5 m away
keep the rover moving and search the north half
search the north half, rover stays near the hiker
search the north half, rover stays in the south half
search the north half, keep the rover out of the south half
search the north half, the rover is not needed if the drone finds him
search the north half, the rover isn't needed tomorrow
search the north half, rover stays unless needed
search the north half, drone stays on the ground
search the north half, keep the rover where it is or send it to base
keep the rover where it is
drone to hold position
the rover stays at base
is the rover parked
stop everything but the rover
stop everything except the drone
stop everything at noon
stop everything before he gets hurt
don't stop everything
do not call it off
don't finish all now, the drone lands and the rover stops
they called it off
why did you call it off
shall we call it off?
is everything off?
everything off?
finish the search
finish the job
put everything down
the mission is over
the mission is over, search the north half
we are finished with the north half, search the south half
search the north half full stop
send the rover to base, it is done already
drone down?
is the drone down
drone down south
drone up north
drone up
ground floor
search the north half, flying 6 metres away from the hiker
search the north half, flying at 6 metres per second
search the north half staying 6 metres from the hiker
search the north half, keep 6 metres away
search the north half, high 6 feet
search the high 6 meter wall
search the north half, flying at 6 metres or 7 metres
search the north half flying below 6 metres
search the north half, flying at least at 6 metres
search the north half, hover at 6 metres when found
rover go to 6 metres, drone search the north half
send the rover to minus three comma four
search the north half at altitude three comma five
send the rover to three comma four and search the north half
send the rover to the soldier which is lost
search the whole park
search the north half of the village
rover, reach the hiker and come back
find the man and send the rover to the woman
find the boy and send the rover to the man
find my son and send the rover to my daughter
send the rover to three comma
send the rover to position three comma four comma minus five
this is a test, search the north half
this is only a drill, search the north half
this is not control, search the north half
Control to police, search the north half
Iris to control, north half searched
Iris to base, north half is clear
Control, this is iris, search of the north half complete
control to crew, do not search the north half
crew of the boat, search the north half
send the rover to the crew
"""


@pytest.fixture(scope="module")
def rules() -> Rules:
    return load_rules("air_ground")


def plan(text: str, rules: Rules) -> tuple[str, object]:
    judged = judge(text, rules, replace(ON_GROUND, requester_near=False))
    found = None if judged.instance is None else (judged.instance.contract, dict(judged.instance.slots))
    return judged.outcome, found


def as_plain(said: dict[str, str], rules: Rules) -> list[str]:
    """What is not read as the plain wording."""
    lines = [(line, plain) for plain, lines in said.items() for line in lines.strip().splitlines()]
    assert all(plan(plain, rules)[0] == "accepted" for plain in said)
    return [line for line, plain in lines if plan(line, rules) != plan(plain, rules)]


@pytest.mark.parametrize(
    "said",
    [
        pytest.param(PEOPLE, id="whoever is to be found"),
        pytest.param(STAYING, id="a robot that stays"),
        pytest.param(ENDING, id="everything ends"),
        pytest.param(AFIELD, id="the field"),
        pytest.param(HEIGHTS, id="heights and points as they are spoken"),
        pytest.param(CALLS, id="who calls whom"),
    ],
)
def test_wordings_are_read_as_the_plain_one(said: dict[str, str], rules: Rules) -> None:
    assert as_plain(said, rules) == []


def test_what_only_looks_like_it_is_not_carried_out(rules: Rules) -> None:
    lines = NOT_CARRIED_OUT.strip().splitlines()
    assert [line for line in lines if judge(line, rules).outcome == "accepted"] == []


def test_what_is_said_of_the_person_is_shown(rules: Rules) -> None:
    reading = read_request("find the missing man, male, 62, in the north half", lexicon_of(rules))
    assert [str(n) for n in reading.noted] == ["'male, 62'"]

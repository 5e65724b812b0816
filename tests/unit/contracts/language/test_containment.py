"""What a plan may hold, given the request: codes, fields and what is allowed."""

import pytest

from crew.contracts.codes import Code
from crew.contracts.language.containment import Finding, check_containment, check_reading
from crew.contracts.language.lexicon import lexicon_of
from crew.contracts.language.licence import claims, licensed_values
from crew.contracts.language.reading import read_request
from crew.contracts.matching import match
from crew.contracts.plan import Call, Instance, Plan, Spot, Zone
from crew.contracts.site import Rules
from tests.unit.contracts.language.lab import lab_rules

AREA = Zone(-6, 10, -6, 10)
NORTH = Zone(-6, 10, 2, 10)
SOUTH = Zone(-6, 10, -6, 2)


def search(zone: Zone = AREA, altitude: float = 5.0, *, send: bool = False) -> Plan:
    area = {"x_min": zone.x_min, "x_max": zone.x_max, "y_min": zone.y_min, "y_max": zone.y_max}
    steps = [
        Call("iris", "takeoff", {"altitude": altitude}),
        Call("iris", "search_target", {**area, "altitude": altitude}),
        Call("iris", "get_coordinates"),
        *([Call("tb3", "navigate_to", {"target": "victim"})] if send else []),
    ]
    return Plan("search_and_dispatch" if send else "search_only", tuple(steps))


def go(robot: str = "tb3", **args: str | float) -> Plan:
    return Plan("dispatch_only", (Call(robot, "navigate_to", args),))


LAND = Call("iris", "land")
STOP = Call("tb3", "stop")


def check(text: str, plan: Plan, rules: Rules, *, confirmed: bool = False) -> Finding | None:
    instance = match(plan, rules)
    assert isinstance(instance, Instance), instance
    return check_containment(read_request(text, lexicon_of(rules)), instance, rules, confirmed=confirmed)


REFUSED = [
    ("find the victim", search(send=True), Code.NOT_REQUESTED, "steps[3]"),
    ("send the rover to the rooftop helipad", go(target="base"), Code.NOT_REQUESTED, "steps[0].args.target"),
    ("send the rover to (3, 4)", go(x=3.0, y=5.0), Code.NOT_REQUESTED, "steps[0].args.x"),
    ("send the rover to (20, 0)", go(x=10.0, y=0.0), Code.NOT_REQUESTED, "steps[0].args.x"),
    ("send the rover to base", go(target="victim"), Code.NOT_REQUESTED, "steps[0].args.target"),
    ("send the rover", go(target="base"), Code.NOT_REQUESTED, "steps[0].args.target"),
    ("search the north", search(SOUTH), Code.NOT_REQUESTED, "steps[1].args.x_min"),
    ("find the victim", search(NORTH), Code.NOT_REQUESTED, "steps[1].args.x_min"),
    ("search the area at 4 m", search(altitude=5.0), Code.NOT_REQUESTED, "steps[0].args.altitude"),
    ("search the area and send the drone to the victim", search(send=True), Code.NOT_REQUESTED, "steps[3].robot"),
    ("send the rover to the victim, then search the area", search(send=True), Code.NOT_REQUESTED, "steps[1]"),
    ("iris should find the victim and drive to the victim", search(send=True), Code.NOT_REQUESTED, "steps[3].robot"),
    ("iris should take off, search and go to the victim", search(send=True), Code.NOT_REQUESTED, "steps[3].robot"),
    ("stop the rover", Plan("abort", (STOP, LAND)), Code.NOT_REQUESTED, "steps[1]"),
    ("abort", Plan("abort", (LAND,)), Code.REQUEST_DROPPED, "steps"),
    ("search the area and send the rover to the victim", search(), Code.REQUEST_DROPPED, "request"),
    ("search the area and land", search(), Code.REQUEST_DROPPED, "steps"),
    ("search the north and the east", search(NORTH), Code.REQUEST_DROPPED, "request"),
    ("send the rover from base to the victim", go(target="victim"), Code.REQUEST_DROPPED, "request"),
    ("do not move the rover", go(target="base"), Code.FORBIDDEN_BY_REQUEST, "steps[0].robot"),
    ("search the area but do not send the rover", search(send=True), Code.FORBIDDEN_BY_REQUEST, "steps[3].robot"),
    ("search the area, not the south", search(), Code.FORBIDDEN_BY_REQUEST, "steps[1].args.x_min"),
    ("search the area, do not take off", search(), Code.FORBIDDEN_BY_REQUEST, "steps[0]"),
    ("search the area, do not fly", search(), Code.FORBIDDEN_BY_REQUEST, "steps[0]"),
    ("drive to base but not to the south", go(target="base"), Code.FORBIDDEN_BY_REQUEST, "steps[0].args.target"),
    ("drive to the victim, not to the south", go(target="victim"), Code.FORBIDDEN_BY_REQUEST, "steps[0].args.target"),
    ("search the north or the south", search(NORTH), Code.AMBIGUOUS_REQUEST, "request"),
    ("search the area twice", search(), Code.UNREAD_WORDS, "request"),
]


@pytest.mark.parametrize(("text", "plan", "code", "field"), REFUSED)
def test_refused(text: str, plan: Plan, code: Code, field: str, rules: Rules) -> None:
    finding = check(text, plan, rules)
    assert finding is not None
    assert (finding.code, finding.field) == (code, field)
    assert finding.span is None or text[slice(*finding.span)] in text


@pytest.mark.parametrize(("text", "plan", "code", "field"), REFUSED)
def test_confirmation_lifts_unread_words_only(text: str, plan: Plan, code: Code, field: str, rules: Rules) -> None:
    del field
    assert (check(text, plan, rules, confirmed=True) is None) == (code is Code.UNREAD_WORDS)


def test_confirmation_of_unread_words_does_not_license_a_substitution(rules: Rules) -> None:
    finding = check("search the north twice", search(SOUTH), rules, confirmed=True)
    assert finding is not None
    assert finding.code is Code.NOT_REQUESTED


@pytest.mark.parametrize(
    ("text", "plan"),
    [
        ("Search the area and send the rover to the victim", search(send=True)),
        ("find the victim", search()),
        ("search the north half, not the south", search(NORTH)),
        ("send the rover to (3, 4)", go(x=3.0, y=4.0)),
        ("abort", Plan("abort", (STOP, LAND))),
        ("land the drone", Plan("abort", (LAND,))),
        ("search the north, not the south, and send the rover to the victim", search(NORTH, send=True)),
    ],
)
def test_accepted(text: str, plan: Plan, rules: Rules) -> None:
    assert check(text, plan, rules) is None


def test_message_names_the_word_the_plan_and_what_is_allowed(rules: Rules) -> None:
    finding = check("send the rover to base", go(target="victim"), rules)
    assert finding is not None
    assert finding.message == "the plan's destination is victim; the request names base; plan what was asked for"
    assert finding.allowed == ("base",)


def test_slot_rule(rules: Rules) -> None:
    slot = rules.contracts["dispatch_only"].slot("destination")
    assert slot is not None
    lexicon = lexicon_of(rules)
    assert licensed_values(read_request("send the rover to (20, 0)", lexicon), slot, rules) == (Spot(20.0, 0.0),)
    assert licensed_values(read_request("send the rover from base", lexicon), slot, rules) is None
    assert licensed_values(read_request("send the rover to the roof", lexicon), slot, rules) == ("roof",)


def test_origin_is_a_claim_and_no_destination() -> None:
    rules = lab_rules()
    carry = rules.contracts["carry"]
    for text in ("bring the cube from table_a to room_a", "bring the cube on table_a to room_a"):
        assert claims(read_request(text, lexicon_of(rules)), carry, rules) == {"origin": "table_a"}
    assert claims(read_request("put the cube in room_a", lexicon_of(rules)), carry, rules) == {}


def test_dropped_cargo_and_foreign_robots() -> None:
    rules = lab_rules()
    walk = Plan("navigation_only", (Call("rex", "navigate", {"location": "room_a"}),))
    codes = {
        "bring the cube to room_a": Code.REQUEST_DROPPED,
        "go to room_a with the cube": Code.REQUEST_DROPPED,
        "send fido to room_a": Code.NOT_REQUESTED,
        "do NOT go to room_a, go to room_b2": Code.FORBIDDEN_BY_REQUEST,
        "go to room_b": Code.NOT_REQUESTED,
    }
    for text, code in codes.items():
        finding = check(text, walk, rules)
        assert finding is not None, text
        assert finding.code is code, (text, finding)
    assert check("send a dog to room_a", walk, rules) is None


@pytest.mark.parametrize(
    ("text", "code"),
    [
        ("do not move the rover", Code.FORBIDDEN_BY_REQUEST),
        ("land it", Code.AMBIGUOUS_REQUEST),
        ("bring the piano", Code.REQUEST_DROPPED),
        ("good grief", Code.UNREAD_WORDS),
    ],
)
def test_a_request_without_a_plan_still_says_what_is_wrong(text: str, code: Code, rules: Rules) -> None:
    finding = check_reading(read_request(text, lexicon_of(rules)))
    assert finding is not None
    assert finding.code is code


def test_excluded_zones_are_published_for_the_dispatch(rules: Rules) -> None:
    assert read_request("go to base, not to the south", lexicon_of(rules)).excluded_areas == (SOUTH,)

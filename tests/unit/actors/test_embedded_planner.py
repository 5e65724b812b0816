"""The planner without a model: it fills contracts from the reading, and abstains rather than guess."""

import pytest

from crew.actors.planner.embedded import Abstention, PlannerState, propose
from crew.contracts.plan import Plan
from crew.contracts.site import Rules
from tests.unit.contracts.language.conftest import rules as _rules
from tests.unit.contracts.language.lab import lab_rules

GROUND = PlannerState(airborne={"iris": False})
FLYING = PlannerState(airborne={"iris": True})

rules = _rules


def plan(text: str, rules: Rules, state: PlannerState = GROUND) -> Plan:
    proposed = propose(text, rules, state)
    assert isinstance(proposed, Plan), proposed
    return proposed


def test_every_step_is_filled(rules: Rules) -> None:
    proposed = plan("search the north half at 6 m and send the rover to whoever you find", rules)
    assert proposed.contract == "search_and_dispatch"
    assert [str(call) for call in proposed.steps] == [
        "iris.takeoff(altitude=6)",
        "iris.search_target(x_min=-6, x_max=10, y_min=2, y_max=10, altitude=6)",
        "iris.get_coordinates()",
        "tb3.navigate_to(target=victim)",
        "iris.land()",
    ]


@pytest.mark.parametrize(
    ("state", "first"), [(GROUND, "takeoff"), (FLYING, "search_target"), (PlannerState(), "takeoff")]
)
def test_takes_off_unless_it_flies(state: PlannerState, first: str, rules: Rules) -> None:
    assert plan("search the area", rules, state).steps[0].skill == first


def test_excluded_skill_is_left_out(rules: Rules) -> None:
    assert plan("search the area but do not land", rules).steps[-1].skill == "get_coordinates"


def test_unknown_place_is_carried_verbatim(rules: Rules) -> None:
    assert plan("send the rover to the rooftop helipad", rules).steps[0].args == {"target": "rooftop helipad"}


def test_named_robot_is_carried_even_if_it_cannot(rules: Rules) -> None:
    assert plan("search the area with the rover", rules).steps[0].robot == "tb3"


def test_figures_are_not_clamped(rules: Rules) -> None:
    assert plan("send the rover to (20, 0)", rules).steps[0].args == {"x": 20.0, "y": 0.0}


@pytest.mark.parametrize(
    "text", ["", "do not move the rover", "what a nice day", "search the rooftop", "dance", "over and out"]
)
def test_abstains_with_a_reason(text: str, rules: Rules) -> None:
    proposed = propose(text, rules, GROUND)
    assert isinstance(proposed, Abstention)
    assert proposed.reason


@pytest.mark.parametrize(
    ("text", "near", "contract"),
    [
        ("bring me the cube", True, "handover"),
        ("bring me the cube", False, "carry"),
        ("bring the cube to room_a", True, "carry"),
        ("send fido to room_a", None, "navigation_only"),
        ("hand me the bottle", False, "handover"),
    ],
)
def test_a_value_of_the_moment_decides_between_contracts(text: str, near: bool | None, contract: str) -> None:
    assert plan(text, lab_rules(), PlannerState(requester_near=near)).contract == contract


@pytest.mark.parametrize(("text", "robot"), [("send a dog to room_a", "rex"), ("send fido to room_a", "fido")])
def test_the_named_robot_goes_otherwise_the_first_able(text: str, robot: str) -> None:
    assert plan(text, lab_rules(), PlannerState()).steps[0].robot == robot


def test_carries_to_the_destination_and_not_to_the_origin() -> None:
    proposed = plan("bring the bottle on table_a to room_b2", lab_rules(), PlannerState())
    assert [str(call) for call in proposed.steps] == [
        "rex.navigate(location=pickup)",
        "g1.pick_place(object=bottle, location=payload_tray)",
        "rex.navigate(location=room_b2)",
    ]


def test_unknown_object_is_carried_verbatim() -> None:
    assert plan("bring the blue cube to room_a", lab_rules(), PlannerState()).steps[1].args["object"] == "blue cube"

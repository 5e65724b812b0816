"""The study's own judgement of proposals: each way to be ungrounded or inadmissible, and what is neither."""

from random import Random

import pytest

from crew.contracts.gate.arguments import check_call
from crew.contracts.matching import match
from crew.contracts.plan import Call, Instance
from crew.library import load_rules
from crew.study.fuzz.plans import make
from crew.study.fuzz.run import Bench
from crew.study.fuzz.wish import WISHES
from crew.study.soundness import inadmissible, ungrounded

AIR, INDOOR = load_rules("air_ground"), load_rules("humanoid_quadruped")
UP, LAND = Call("iris", "takeoff", {"altitude": 5.0}), Call("iris", "land")
LOOK = Call("iris", "search_target", {"x_min": -6.0, "x_max": 10.0, "y_min": 2.0, "y_max": 10.0, "altitude": 5.0})
TELL, SEND = Call("iris", "get_coordinates"), Call("tb3", "navigate_to", {"target": "victim"})
FETCH = Call("go2", "navigate", {"location": "pickup"})
LOAD = Call("g1", "pick_place", {"object": "red_cube", "location": "payload_tray"})
GO = Call("go2", "navigate", {"location": "room_b"})


@pytest.mark.parametrize(
    ("call", "why"),
    [
        (Call("robo", "land"), "no robo"),
        (Call("iris", "hover"), "no skill hover"),
        (Call("tb3", "takeoff", {"altitude": 5.0}), "no skill takeoff"),
        (Call("iris", "takeoff"), "lacks altitude"),
        (Call("iris", "land", {"speed": 1.0}), "takes no speed"),
        (Call("iris", "takeoff", {"altitude": 11.0}), "bounds"),
        (Call("iris", "takeoff", {"altitude": "high"}), "no finite number"),
        (Call("iris", "takeoff", {"altitude": float("nan")}), "no finite number"),
        (Call("tb3", "navigate_to", {"x": 20.0, "y": 0.0}), "operational area"),
        (Call("tb3", "navigate_to", {"x": 2.0}), "another set"),
        (Call("tb3", "navigate_to", {"target": "base", "x": 2.0, "y": 2.0}), "another set"),
        (Call("tb3", "navigate_to", {"target": "rooftop helipad"}), "no target"),
        (Call("iris", "search_target", {**LOOK.args, "x_min": 10.0}), "not below"),
    ],
)
def test_each_way_to_be_ungrounded(call: Call, why: str) -> None:
    assert why in ungrounded(call, AIR)


@pytest.mark.parametrize("call", [UP, LOOK, TELL, SEND, LAND, Call("tb3", "navigate_to", {"x": 10.0, "y": -6.0})])
def test_what_is_grounded(call: Call) -> None:
    assert ungrounded(call, AIR) == ""


def test_reach_belongs_to_grounding() -> None:
    assert "out of reach" in ungrounded(Call("g1", "pick_place", {"object": "bottle", "location": "room_b"}), INDOOR)
    assert "no object" in ungrounded(Call("g1", "pick_hold", {"object": "piano"}), INDOOR)
    assert ungrounded(LOAD, INDOOR) == ""


@pytest.mark.parametrize(
    "calls", [(UP, LOOK, TELL, SEND, LAND), (LOOK, TELL, SEND), (UP, LOOK, TELL, LAND, SEND)], ids=str
)
def test_what_the_contract_admits(calls: tuple[Call, ...]) -> None:
    assert inadmissible("search_and_dispatch", calls, AIR) == ""


@pytest.mark.parametrize(
    ("contract", "calls", "why"),
    [
        ("search_and_send", (UP,), "no contract"),
        ("search_and_dispatch", (), "no step"),
        ("search_and_dispatch", (UP, LOOK, SEND), "asks for report"),
        ("search_and_dispatch", (UP, LOOK, SEND, TELL), "order"),
        ("search_and_dispatch", (LOOK, UP, TELL, SEND), "order"),
        ("search_and_dispatch", (UP, UP, LOOK, TELL, SEND), "no such set"),
        ("search_and_dispatch", (UP, LOOK, TELL, Call("iris", "navigate_to", {"target": "victim"})), "no such set"),
        ("search_and_dispatch", (Call("iris", "takeoff", {"altitude": 6.0}), LOOK, TELL, SEND), "no such set"),
        ("search_only", (UP, LOOK, TELL, SEND), "no such set"),
        ("search_and_dispatch", (LOOK, TELL, Call("tb3", "navigate_to", {"target": "base"})), "no such set"),
    ],
)
def test_what_it_does_not(contract: str, calls: tuple[Call, ...], why: str) -> None:
    assert why in inadmissible(contract, calls, AIR)


def test_fixed_arguments_and_order_of_the_carry() -> None:
    assert inadmissible("carry", (FETCH, LOAD, GO), INDOOR) == ""
    assert "order" in inadmissible("carry", (GO, LOAD), INDOOR)
    within = Call("go2", "navigate", {"location": "table_b"})
    assert "no such set" in inadmissible("carry", (FETCH, LOAD, within), INDOOR), "nobody carries what an arm can place"
    nowhere = Call("go2", "navigate", {"location": "helipad"})
    assert inadmissible("carry", (FETCH, LOAD, nowhere), INDOOR) == "", "that is for grounding to say"
    aside = Call("g1", "pick_place", {"object": "red_cube", "location": "table_b"})
    assert "no such set" in inadmissible("carry", (FETCH, aside, GO), INDOOR)


def test_it_agrees_with_the_gates_own_checks_on_plans_near_every_limit() -> None:
    """Written apart, compared here alone: two thousand plans of the fuzz, call by call and as a whole."""
    bench, chance, compared = Bench(), Random(7), 0
    for _ in range(2_000):
        wish = chance.choice(WISHES)
        rules = bench.rules[wish.crew]
        plan = make(wish, rules, frozenset({"land", "takeoff", "approach"}), chance).plan
        for call in plan.steps:
            assert (ungrounded(call, rules) == "") == (check_call(call, rules) is None), call
        if plan.steps and not any(check_call(call, rules) for call in plan.steps):
            compared += 1
            assert (inadmissible(plan.contract, plan.steps, rules) == "") == isinstance(match(plan, rules), Instance), (
                plan
            )
    assert compared > 1_000

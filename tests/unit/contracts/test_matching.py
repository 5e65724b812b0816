"""Plans against contracts: one to one, order-extending, one binding, and a bounded time for plans that mean harm."""

from itertools import permutations, product
from time import process_time

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from msgspec.structs import replace

from crew.contracts.codes import Code
from crew.contracts.contract import CallPattern, Contract, Role, Step
from crew.contracts.matching import MAX_STEPS, match, needed_skills
from crew.contracts.plan import Call, Instance, Plan, Spot, Zone
from crew.contracts.refusal import Refusal
from crew.contracts.site import Rules
from tests.unit.contracts import build as b

RULES = b.air_ground()
VALID = (b.FULL, b.SEARCH_PLAN, b.VICTIM_PLAN, b.BASE_PLAN, b.ABORT_PLAN)
ANY_CALL = st.sampled_from(
    [
        *b.FULL.steps,
        b.STOP,
        b.TO_BASE,
        Call("tb3", "navigate_to", {"x": 1.0, "y": 2.0}),
        Call("iris", "fly_to", {"x": 0.0, "y": 0.0, "altitude": 5.0}),
        b.with_args(b.TAKEOFF, altitude=6.0),
        b.with_args(b.SEARCH_AREA, x_max=2.0),
        b.with_args(b.SEARCH_AREA, altitude=6.0),
    ]
)


def code_of(found: Instance | Refusal) -> Code | None:
    return found.code if isinstance(found, Refusal) else None


def order_holds(plan: Plan, contract: Contract, instance: Instance) -> bool:
    """Whether no step stands before one that the contract wants before it, told from the contract alone."""
    place = {item.step: index for index, item in enumerate(instance.steps)}

    def ancestors(name: str) -> set[str]:
        step = contract.step(name)
        assert step is not None
        return set(step.after).union(*(ancestors(other) for other in step.after))

    return all(place[a] < place[name] for name in place for a in ancestors(name) if a in place)


def assert_sound(plan: Plan, instance: Instance) -> None:
    """What any instance must be, whatever the plan was."""
    contract = RULES.contracts[plan.contract]
    names = [item.step for item in instance.steps]
    assert tuple(item.call for item in instance.steps) == plan.steps, "the calls are the plan's, in its order"
    assert len(set(names)) == len(names), "one to one"
    assert {s.name for s in contract.steps if not s.optional} <= set(names), "nothing required is missing"
    assert len(set(instance.roles.values())) == len(instance.roles), "different roles are different robots"
    assert all(item.call.robot == instance.roles[item.role] for item in instance.steps), "a role keeps one robot"
    assert order_holds(plan, contract, instance)
    zone, altitude = instance.slots.get("zone"), instance.slots.get("altitude")
    for call in plan.steps:
        if "x_min" in call.args:
            assert zone == Zone(*(float(call.args[n]) for n in ("x_min", "x_max", "y_min", "y_max")))
        if "altitude" in call.args:
            assert call.args["altitude"] == altitude, "one binding"


@settings(max_examples=100, deadline=None)
@given(st.sampled_from(sorted(RULES.contracts)), st.lists(ANY_CALL, max_size=7))
def test_whatever_matches_is_sound(contract: str, calls: list[Call]) -> None:
    plan = Plan(contract, tuple(calls))
    found = match(plan, RULES)
    if isinstance(found, Instance):
        assert_sound(plan, found)


@pytest.mark.parametrize("plan", VALID, ids=lambda plan: f"{plan.contract}-{len(plan.steps)}")
def test_the_permutations_that_match_are_those_that_keep_the_order(plan: Plan) -> None:
    steps = b.matched(plan, RULES).steps
    contract = RULES.contracts[plan.contract]
    for order in permutations(range(len(steps))):
        found = match(Plan(plan.contract, tuple(plan.steps[k] for k in order)), RULES)
        place = {steps[k].step: index for index, k in enumerate(order)}
        kept = all(place[a] < place[s.name] for s in contract.steps if s.name in place for a in s.after if a in place)
        assert code_of(found) is (None if kept else Code.OUT_OF_ORDER), order


def test_only_dispatch_and_land_may_change_places() -> None:
    found = [
        calls
        for calls in permutations(b.FULL.steps)
        if isinstance(match(Plan("search_and_dispatch", calls), RULES), Instance)
    ]
    assert len(found) == 2


@settings(max_examples=150, deadline=None)
@given(st.sampled_from(VALID), st.data())
def test_a_plan_with_a_step_repeated_or_taken_away_matches_only_if_the_step_was_optional(
    plan: Plan, data: st.DataObject
) -> None:
    index = data.draw(st.integers(0, len(plan.steps) - 1))
    twice = Plan(plan.contract, (*plan.steps, plan.steps[index]))
    assert code_of(match(twice, RULES)) is Code.NOT_IN_CONTRACT
    less = Plan(plan.contract, plan.steps[:index] + plan.steps[index + 1 :])
    step = RULES.contracts[plan.contract].step(b.matched(plan, RULES).steps[index].step)
    assert step is not None
    wanted = None if step.optional and less.steps else Code.INCOMPLETE_PLAN if less.steps else Code.MALFORMED_PLAN
    assert code_of(match(less, RULES)) is wanted


def test_predecessors_look_through_optional_steps_that_are_left_out(rules: Rules) -> None:
    contract = rules.contracts["search_only"]
    chain = tuple(replace(s, optional=True) if s.name == "search" else s for s in contract.steps)
    loose = replace(rules, contracts={"search_only": replace(contract, steps=chain)})
    found = match(b.plan("search_only", b.TAKEOFF, b.REPORT), loose)
    assert isinstance(found, Instance)
    assert found.steps[1].after == ("takeoff",)
    assert code_of(match(b.plan("search_only", b.REPORT, b.TAKEOFF), loose)) is Code.OUT_OF_ORDER


@pytest.mark.parametrize(
    "calls",
    [
        (b.TAKEOFF, b.with_args(b.SEARCH_AREA, altitude=6.0), b.REPORT),
        (b.with_args(b.TAKEOFF, altitude=6.0), b.SEARCH_AREA, b.REPORT),
    ],
)
def test_a_slot_has_one_value_throughout(calls: tuple[Call, ...]) -> None:
    found = match(Plan("search_only", calls), RULES)
    assert isinstance(found, Refusal)
    assert (found.code, found.field) == (Code.NOT_IN_CONTRACT, "steps[1]")
    assert "altitude is already" in found.message


def test_a_destination_is_a_name_or_a_point() -> None:
    named = b.matched(b.BASE_PLAN, RULES)
    assert named.slots == {"destination": "base"}
    point = b.matched(b.plan("dispatch_only", Call("tb3", "navigate_to", {"x": 1, "y": 2.0})), RULES)
    assert point.slots == {"destination": Spot(1.0, 2.0)}
    nowhere = b.plan("dispatch_only", b.with_args(b.TO_BASE, target="room_b"))
    assert code_of(match(nowhere, RULES)) is Code.NOT_IN_CONTRACT


def test_only_the_victim_is_a_person_to_send_the_rover_to() -> None:
    calls = tuple(b.TO_BASE if call is b.DISPATCH else call for call in b.FULL.steps)
    assert code_of(match(Plan("search_and_dispatch", calls), RULES)) is Code.NOT_IN_CONTRACT


def test_a_role_s_robot_needs_the_skills_of_all_its_steps_and_of_its_safe_state(rules: Rules) -> None:
    assert needed_skills(rules.contracts["search_only"], "searcher", rules) == {
        "takeoff",
        "search_target",
        "get_coordinates",
        "land",
    }
    assert needed_skills(rules.contracts["dispatch_only"], "responder", rules) == {"navigate_to", "stop"}


def test_a_step_with_alternative_skills_asks_for_none_of_them_beforehand(rules: Rules) -> None:
    step = Step(name="go", role="mover", do=(CallPattern("land"), CallPattern("stop")))
    either = Contract(name="either", summary="", roles=(Role(name="mover"),), steps=(step,))
    loose = replace(rules, contracts={"either": either})
    assert needed_skills(either, "mover", loose) == frozenset()
    for call in (b.LAND, b.STOP):
        assert b.matched(b.plan("either", call), loose).roles == {"mover": call.robot}


def test_a_robot_that_lacks_a_later_skill_of_its_role_is_named_early(rules: Rules) -> None:
    steps = (
        Step(name="first", role="mover", do=(CallPattern("stop"),)),
        Step(name="then", role="mover", do=(CallPattern("land"),), optional=True),
    )
    both = replace(
        rules, contracts={"both": Contract(name="both", summary="", roles=(Role(name="mover"),), steps=steps)}
    )
    found = match(b.plan("both", b.STOP), both)
    assert isinstance(found, Refusal)
    assert (found.code, found.field) == (Code.WRONG_ROLE, "steps[0]")
    assert "it lacks land" in found.message


# --- plans that mean harm


def loops(rules: Rules, size: int) -> Rules:
    """A contract with many steps that do the same, the last of which can't be filled."""
    same = tuple(Step(name=f"s{k}", role="mover", do=(CallPattern("stop"),), optional=True) for k in range(size))
    last = Step(name="last", role="mover", do=(CallPattern("navigate_to", {"target": "base"}),))
    contract = Contract(name="loops", summary="", roles=(Role(name="mover"),), steps=(*same, last))
    return replace(rules, contracts={"loops": contract})


@pytest.mark.parametrize(("size", "asked"), [*product((4, 12, 24), (4, 12, 24))])
def test_many_identical_steps_are_refused_in_bounded_time(size: int, asked: int, rules: Rules) -> None:
    many = loops(rules, size)
    began = process_time()
    found = match(Plan("loops", (b.STOP,) * asked), many)
    assert process_time() - began < 5.0
    assert code_of(found) in (Code.MALFORMED_PLAN, Code.INCOMPLETE_PLAN, Code.NOT_IN_CONTRACT)


def test_many_identical_steps_that_do_fit_are_matched(rules: Rules) -> None:
    found = match(Plan("loops", (*(b.STOP,) * 12, b.TO_BASE)), loops(rules, 12))
    assert isinstance(found, Instance)
    assert len({item.step for item in found.steps}) == 13


@pytest.mark.parametrize(
    ("size", "wanted"),
    [
        (0, Code.MALFORMED_PLAN),
        (1, None),
        (MAX_STEPS, Code.NOT_IN_CONTRACT),
        (MAX_STEPS + 1, Code.MALFORMED_PLAN),
        (500, Code.MALFORMED_PLAN),
    ],
)
def test_the_number_of_steps_is_bounded(size: int, wanted: Code | None) -> None:
    assert code_of(match(Plan("abort", (b.STOP,) * size), RULES)) is wanted

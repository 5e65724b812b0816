"""The model of errors: seeded, labelled, each documented error at its own rate."""

from collections import Counter

import pytest
from msgspec.structs import replace

from crew.actors.planner.choice import check_choice
from crew.actors.planner.embedded import PlannerState, propose
from crew.actors.planner.fallible import LABEL, ErrorModel, FallibleBackend, Rates, shipped
from crew.actors.planner.process import make_backend
from crew.actors.specs import PlannerChoice
from crew.contracts.plan import Call, Plan
from crew.contracts.render.prompt import Context
from crew.errors import UsageError
from crew.library import load_rules
from crew.messages import PlannerAsk

RULES = load_rules("air_ground")
INDOOR = load_rules("humanoid_quadruped")
GROUND = PlannerState(airborne={"iris": False})
SEND = "search the area and send the rover to the victim"
RIGHT = propose(SEND, RULES, GROUND)
FLAWLESS = Rates(**dict.fromkeys(Rates.__struct_fields__, 0.0))


def only(error: str, rate: float = 1.0) -> ErrorModel:
    rates = replace(FLAWLESS, **{error: rate})
    return ErrorModel("test", 0.5, {context.value: rates for context in Context})


def made(error: str, text: str = SEND, seed: int = 0) -> Plan:
    plan = FallibleBackend(RULES, Context.CONTRACTS, seed, only(error)).plan(text, GROUND).plan
    assert plan is not None
    return plan


def test_without_errors_it_is_the_embedded_planner() -> None:
    assert made("substituted_unknown_place") == RIGHT


def test_the_same_seed_gives_the_same_plan_and_another_context_another() -> None:
    def plans(seed: int, context: Context) -> list[Plan | None]:
        backend = FallibleBackend(RULES, context, seed)
        return [backend.plan(f"search the area at {n} m", GROUND).plan for n in range(2, 10)]

    assert plans(3, Context.NONE) == plans(3, Context.NONE)
    assert plans(3, Context.NONE) != plans(4, Context.NONE)
    assert plans(3, Context.NONE) != plans(3, Context.CONTRACTS)


def test_a_replan_is_another_draw_with_fewer_errors() -> None:
    backends = [FallibleBackend(RULES, Context.NONE, seed) for seed in range(80)]
    first, again = ([b.plan(SEND, GROUND, attempt) for b in backends] for attempt in (0, 1))
    assert first != again
    assert sum(len(made.errors) for made in again) < 0.7 * sum(len(made.errors) for made in first)


def test_invented_skills_exist_nowhere() -> None:
    known = {skill.name for kind in RULES.kinds.values() for skill in kind.skills}
    assert not known & {call.skill for call in made("invented_skill").steps}


def test_wrong_robot_changes_nothing_else() -> None:
    assert isinstance(RIGHT, Plan)
    for right, wrong in zip(RIGHT.steps, made("wrong_robot").steps, strict=True):
        assert wrong.robot != right.robot
        assert (wrong.skill, wrong.args) == (right.skill, right.args)


def test_a_step_is_dropped() -> None:
    assert isinstance(RIGHT, Plan)
    steps = made("dropped_step").steps
    assert len(steps) == len(RIGHT.steps) - 1
    assert [c for c in RIGHT.steps if c in steps] == list(steps)


def test_two_neighbours_change_places() -> None:
    assert isinstance(RIGHT, Plan)
    steps = made("wrong_order").steps
    assert sorted(map(str, steps)) == sorted(map(str, RIGHT.steps))
    assert sum(a != b for a, b in zip(steps, RIGHT.steps, strict=True)) == 2


def test_the_contract_is_another_of_the_crew() -> None:
    assert made("wrong_contract").contract in set(RULES.contracts) - {"search_and_dispatch"}


def test_a_place_is_substituted_by_one_that_exists() -> None:
    assert made("substituted_place", "send the rover to base").steps[0].args == {"target": "base"}, "it is the only one"
    backend = FallibleBackend(INDOOR, Context.CONTRACTS, 0, only("substituted_place"))
    plan = backend.plan("go2 go to room a", PlannerState()).plan
    assert plan is not None
    place = plan.steps[0].args["location"]
    assert place != "room_a"
    assert INDOOR.crew.location(str(place)) is not None


def test_an_unknown_place_is_substituted_at_its_own_rate() -> None:
    text = "send the rover to the rooftop helipad"
    assert made("substituted_place", text).steps == (Call("tb3", "navigate_to", {"target": "rooftop helipad"}),)
    assert made("substituted_unknown_place", text).steps == (Call("tb3", "navigate_to", {"target": "base"}),)


def test_a_negation_is_disregarded() -> None:
    wanted = "search the area but do not send the rover to the victim"
    assert made("disregarded_negation", wanted).contract == "search_and_dispatch"
    assert made("wrong_robot", wanted).contract == "search_only"


def test_every_wrong_argument_is_ungrounded_in_its_own_way() -> None:
    found = Counter[str]()
    for seed in range(60):
        for call in made("wrong_argument", "send the rover to (3, 4)", seed).steps:
            inside = all(isinstance(v, float) and v <= 10.0 for v in call.args.values())
            found["outside" if not inside else ",".join(sorted(call.args))] += 1
    assert set(found) == {"outside", "x", "y", "lat,x", "lon,y"}


@pytest.mark.parametrize(("context", "low", "high"), [(Context.NONE, 0.42, 0.6), (Context.REGISTRY, 0.93, 1.0)])
def test_the_chosen_rates_have_the_shape_of_the_papers_tables(context: Context, low: float, high: float) -> None:
    """Counted by names and signatures here, not by the study's own metric."""
    grounded = steps = 0
    for seed in range(120):
        plan = FallibleBackend(RULES, context, seed).plan(SEND, GROUND).plan
        for call in () if plan is None else plan.steps:
            kind = RULES.kind_of(call.robot)
            skill = None if kind is None else kind.skill(call.skill)
            steps += 1
            fits = skill is not None and {p.name for p in skill.params if p.name in call.args} == set(call.args)
            whole = skill is not None and all(p.optional or p.name in call.args for p in skill.params)
            near = all(v <= 10.0 if not isinstance(v, str) else not v.endswith("_site") for v in call.args.values())
            grounded += fits and whole and near
    assert low < grounded / steps < high


async def test_every_proposal_says_what_it_is() -> None:
    ask = PlannerAsk(mission="m", attempt=0, request=SEND, airborne={"iris": False})
    proposal = await FallibleBackend(RULES, Context.CONTRACTS, 0, only("wrong_robot")).propose(ask)
    assert proposal.planner == "fallible"
    assert proposal.remark.startswith(LABEL)
    assert "wrong_robot in step 0" in proposal.remark


async def test_what_it_abstains_from_is_no_plan() -> None:
    ask = PlannerAsk(mission="m", attempt=0, request="sing a song")
    proposal = await FallibleBackend(RULES, Context.NONE, 0).propose(ask)
    assert proposal.plan is None
    assert proposal.reason


def test_it_is_chosen_by_name_and_seeded_by_the_crew() -> None:
    choice = PlannerChoice(name="fallible", context="none")
    check_choice(choice, {})
    assert RULES.crew.sim is not None
    backends = []
    for seed in (5, 6):
        crew = replace(RULES.crew, sim=replace(RULES.crew.sim, seed=seed))
        backend = make_backend(choice, replace(RULES, crew=crew), {})
        assert isinstance(backend, FallibleBackend)
        backends.append([backend.plan(f"search at {n} m", GROUND) for n in range(2, 10)])
    assert backends[0] != backends[1]


def test_it_plans_for_simulated_robots_only() -> None:
    real = replace(RULES, crew=replace(RULES.crew, sim=None))
    with pytest.raises(UsageError, match="simulated"):
        make_backend(PlannerChoice(name="fallible"), real, {})


def test_the_shipped_rates_cover_every_context_and_are_probabilities() -> None:
    model = shipped()
    assert set(model.contexts) == {context.value for context in Context}
    for rates in model.contexts.values():
        assert all(0.0 <= getattr(rates, name) <= 1.0 for name in rates.__struct_fields__)
    assert "Chosen, not measured" in model.about

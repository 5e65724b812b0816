"""What becomes of a name that does not exist: classes by the name alone, the gate's word beside them."""

import pytest
from msgspec.structs import replace

from crew.actors.planner.backend import Backend, EmbeddedBackend
from crew.actors.planner.fallible import FallibleBackend
from crew.contracts.plan import Call, Plan
from crew.contracts.render.prompt import Context
from crew.library import load_rules
from crew.study.page_text import MODEL_OF_ERRORS
from crew.study.substitution import became, page, requests, run_substitution

AIR, INDOOR = load_rules("air_ground"), load_rules("humanoid_quadruped")


def to(target: str, skill: str = "navigate_to") -> Plan:
    return Plan("dispatch_only", (Call("tb3", skill, {"target": target}),))


@pytest.mark.parametrize(
    ("plan", "wanted"),
    [
        (to("rooftop helipad"), "verbatim"),
        (to("rooftop_helipad"), "verbatim"),
        (to("the Rooftop Helipad"), "verbatim"),
        (to("base"), "substituted"),
        (to("victim"), "substituted"),
        (Plan("dispatch_only", (Call("tb3", "navigate_to", {"x": 1.0, "y": 2.0}),)), "substituted"),
        (to("rooftop helipad", "fly_to_roof"), "invented"),
        (Plan("dispatch_only", (Call("tb3", "navigate_to", {"place": "rooftop helipad"}),)), "invented"),
        (Plan("abort", (Call("tb3", "stop"),)), "dropped"),
        (to("elsewhere"), "dropped"),
        (Plan("dispatch_only"), "dropped"),
        (None, "dropped"),
    ],
    ids=str,
)
def test_what_became_of_the_name(plan: Plan | None, wanted: str) -> None:
    assert became(plan, "rooftop helipad", AIR) == wanted


@pytest.mark.parametrize("crew", ["air_ground", "humanoid_quadruped"])
async def test_the_embedded_planner_carries_names_on_and_no_plan_is_accepted(crew: str) -> None:
    """Names with a known word in them (a `west` gate, a loading `dock`) mislead it; the gate refuses those as well."""
    rules = load_rules(crew)
    study = await run_substitution(rules, "embedded", [(Context.CONTRACTS, 0, EmbeddedBackend(rules))])
    assert len(study.outcomes) == len(requests(rules))
    misled = {o.missing for o in study.outcomes if o.became != "verbatim"}
    assert misled <= {"west gate", "loading dock"}
    assert study.passed == ()


async def test_more_context_makes_errors_more_plausible_and_the_gate_refuses_all() -> None:
    backends: list[tuple[Context, int, Backend]] = [
        (context, seed, FallibleBackend(INDOOR, context, seed)) for context in Context for seed in range(2)
    ]
    study = await run_substitution(INDOOR, "fallible", backends)
    assert study.passed == ()

    def share(context: Context, name: str) -> float:
        mine = [o.became == name for o in study.outcomes if o.context == context.value]
        return sum(mine) / len(mine)

    assert share(Context.NONE, "invented") > 0.5
    assert share(Context.REGISTRY, "verbatim") > share(Context.CONTRACTS, "verbatim")
    assert share(Context.CONTRACTS, "substituted") > 0.5
    assert MODEL_OF_ERRORS in page(study)


async def test_an_accepted_plan_would_show() -> None:
    study = await run_substitution(AIR, "embedded", [(Context.CONTRACTS, 0, EmbeddedBackend(AIR))])
    through = replace(study, outcomes=(replace(study.outcomes[0], verdict=""), *study.outcomes[1:]))
    assert len(through.passed) == 1
    assert f"| 1 of {len(study.outcomes)} |" in page(through)
    assert "**accepted**" in page(replace(through, outcomes=through.outcomes[:1]))

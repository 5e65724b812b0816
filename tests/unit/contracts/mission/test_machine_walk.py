"""The mission machine on random walks: whatever is answered, in whatever order, missions end and stay harmless."""

from random import Random

from hypothesis import example, given, settings
from hypothesis import strategies as st

from crew.contracts.mission_state import ENDS, Phase, StepPhase
from crew.contracts.plan import Plan
from tests.unit.contracts import build as b
from tests.unit.contracts.mission.shell import LooseShell

PLANS: tuple[tuple[str, Plan], ...] = (
    (b.SEARCH_AND_SEND, b.FULL),
    (b.SEARCH, b.SEARCH_PLAN),
    (b.SEND_TO_BASE, b.BASE_PLAN),
    (b.ABORT, b.ABORT_PLAN),
)
seeds = st.integers(0, 2**32)


def shell(seed: int, which: int) -> LooseShell:
    rules = b.air_ground()
    text, plan = PLANS[which]
    return LooseShell(b.received(text, rules), plan, b.matched(plan, rules), rules, Random(seed))


@settings(max_examples=150, deadline=None)
@given(seeds, st.integers(0, len(PLANS) - 1))
def test_a_mission_ends_once_every_effect_was_answered(seed: int, which: int) -> None:
    assert shell(seed, which).run().phase in ENDS


@settings(max_examples=150, deadline=None)
@given(seeds, st.integers(0, len(PLANS) - 1), st.sampled_from((0.1, 0.3, 0.6)))
@example(0, 0, 0.9)
def test_a_mission_ends_whoever_meddles(seed: int, which: int, meddle: float) -> None:
    assert shell(seed, which).run(meddle=meddle).phase in ENDS


def test_the_walks_reach_every_end_and_every_outcome_of_a_step() -> None:
    ends: set[Phase] = set()
    outcomes: set[StepPhase] = set()
    for seed in range(200):
        end = shell(seed, seed % len(PLANS)).run(meddle=(seed % 4) / 20)
        ends.add(end.phase)
        outcomes |= {r.phase for r in (*end.steps.values(), *end.safe.values())}
    assert ends >= ENDS
    assert outcomes >= set(StepPhase) - {
        StepPhase.DECIDING,
        StepPhase.ASKING,
        StepPhase.SENT,
        StepPhase.RUNNING,
        StepPhase.CONFIRMING,
    }

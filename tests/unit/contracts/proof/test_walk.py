"""Random missions never leave what was proved; the full million of steps belongs to the soak."""

from collections.abc import Sequence
from random import Random

import pytest

from crew.library import crew_names, load_rules
from tests.unit.contracts.build import air_ground, with_approval
from tests.unit.contracts.proof.adversary import explored
from tests.unit.contracts.proof.walk import Proved, Walk

CREWS = crew_names()
FEW = ("search_and_dispatch", "abort", "handover", "manipulation_only")


def proved(crew: str, contracts: Sequence[str] = ()) -> list[Proved]:
    """What was proved of every plan of a crew, and of one that a person must approve."""
    known = load_rules(crew)
    found = [graph for name in contracts or known.contracts for graph in explored(known, name)]
    if crew == "air_ground":
        found += explored(with_approval(air_ground(), "dispatch_only", "dispatch"), "dispatch_only")
    return [Proved(graph) for graph in found]


def walked(known: list[Proved], steps: int, seed: int) -> tuple[int, set[str]]:
    """Walk until so many steps are done; the phases that were met."""
    done, phases = 0, set[str]()
    number = 0
    while done < steps:
        chance = Random(f"{seed}-{number}")
        walk = Walk(chance.choice(known), chance)
        done += walk.run(meddle=chance.choice((0.0, 0.02, 0.1)))
        assert not walk.troubles, (seed, number, walk.model.contract.name, walk.troubles)
        phases.add(walk.state.phase)
        number += 1
    return done, phases


@pytest.mark.parametrize("crew", CREWS)
def test_random_missions_stay_within_what_was_proved(crew: str) -> None:
    few = [name for name in load_rules(crew).contracts if name in FEW]
    _, phases = walked(proved(crew, few), 1_500, seed=1)
    assert {"completed", "halted", "rejected"} <= phases


@pytest.mark.soak
@pytest.mark.parametrize("seed", range(10))
@pytest.mark.parametrize("crew", CREWS)
def test_a_million_steps(crew: str, seed: int) -> None:
    done, phases = walked(proved(crew), 1_000_000 // 10 // len(CREWS), seed=100 + seed)
    assert done >= 1_000_000 // 10 // len(CREWS)
    assert {"completed", "halted", "rejected", "cancelled"} <= phases

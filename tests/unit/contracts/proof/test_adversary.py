"""The planner gains nothing by trying: no call in any state, no plan that the proof has not looked at."""

import pytest

from crew.library import load_rules
from tests.unit.contracts.proof import adversary
from tests.unit.contracts.proof.test_shipped import SHIPPED

SMALL = [("air_ground", "search_only"), ("humanoid_quadruped", "handover")]


def gains(crew: str, contract: str) -> list[str]:
    return [gain for graph in adversary.explored(load_rules(crew), contract) for gain in adversary.gains(graph)]


@pytest.mark.parametrize(("crew", "contract"), SMALL)
def test_no_call_gains_a_state_in_small(crew: str, contract: str) -> None:
    assert gains(crew, contract) == []


@pytest.mark.soak
@pytest.mark.parametrize(("crew", "contract"), SHIPPED)
def test_no_call_gains_a_state(crew: str, contract: str) -> None:
    assert gains(crew, contract) == []


@pytest.mark.parametrize(("crew", "contract"), SHIPPED)
def test_the_proof_looks_at_every_plan_that_matches(crew: str, contract: str) -> None:
    rules = load_rules(crew)
    found, tried = adversary.instances_by_trying(rules.contracts[contract], rules)
    assert tried > len(found) > 0
    assert found == adversary.instances_by_proof(rules.contracts[contract], rules)

"""Missions side by side: leases keep them apart, one that preempts gets through, and all of them end."""

from functools import cache
from itertools import combinations_with_replacement

import pytest

from crew.library import crew_names, load_rules
from tests.unit.contracts.proof.adversary import explored
from tests.unit.contracts.proof.product import Part, Product

BOUND = 400_000
CREWS = crew_names()


@cache
def parts(crew: str, contracts: tuple[str, ...]) -> tuple[Part, ...]:
    """The fullest plan of each contract."""
    return tuple(Part(explored(load_rules(crew), name)[0]) for name in contracts)


def side_by_side(crew: str, contracts: tuple[str, ...], limit: int = BOUND) -> Product:
    product = Product(parts(crew, contracts), limit)
    product.explore()
    assert not product.troubles, (contracts, product.troubles)
    assert not product.complete or not product.stuck(), contracts
    return product


def test_a_mission_and_one_that_preempts_it() -> None:
    product = side_by_side("air_ground", ("dispatch_only", "abort"))
    assert product.complete
    assert len(product.next) > 100


def test_a_bound_that_is_reached_is_reported() -> None:
    assert not side_by_side("air_ground", ("dispatch_only", "abort"), limit=50).complete


@pytest.mark.soak
@pytest.mark.parametrize("crew", CREWS)
def test_two_missions_of_every_pair_of_contracts(crew: str) -> None:
    for pair in combinations_with_replacement(load_rules(crew).contracts, 2):
        product = side_by_side(crew, pair)
        print(f"{crew}: {' + '.join(pair)}: {len(product.next)} states, {product.transitions} transitions, "
              f"{'whole' if product.complete else f'bound of {BOUND} reached'}")  # fmt: skip
        assert product.complete, pair


@pytest.mark.soak
@pytest.mark.parametrize("crew", CREWS)
def test_three_missions_up_to_the_bound(crew: str) -> None:
    for three in combinations_with_replacement(load_rules(crew).contracts, 3):
        product = side_by_side(crew, three, limit=60_000)
        print(f"{crew}: {' + '.join(three)}: {len(product.next)} states, {product.transitions} transitions, "
              f"{'whole' if product.complete else 'bound of 60000 reached'}")  # fmt: skip

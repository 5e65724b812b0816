"""No mission lands on a robot or drives off under a drone that comes down: proved, and not for want of looking."""

from collections.abc import Mapping

import pytest
from msgspec.structs import replace

from crew.contracts.proof.checker import check
from crew.contracts.site import Rules
from crew.contracts.skill import FluentLiteral, Kind
from tests.unit.contracts.build import air_ground

LANDING = ("search_and_dispatch", "search_only", "abort")
DRIVING = ("search_and_dispatch", "dispatch_only")


def without_needs(kind: str, skill: str) -> Rules:
    """The crew with the guard taken from one skill of one kind."""
    rules = air_ground()
    none: Mapping[str, FluentLiteral] = {}
    declared = rules.kinds[kind]
    bare = {n: v for s in declared.skills if s.name == skill for n, v in s.needs.items() if n != "clear_above"}
    skills = tuple(replace(s, needs=bare, step_needs=none) if s.name == skill else s for s in declared.skills)
    changed: Kind = replace(declared, skills=skills)
    return replace(rules, kinds={**rules.kinds, kind: changed})


def broken(rules: Rules, contract: str) -> list[str]:
    """Why a contract is not proved, where a `never` is broken."""
    return [found.message for found in check(rules, contract, repair=False).findings if found.rule == "never"]


@pytest.mark.parametrize("contract", LANDING)
def test_without_the_guard_a_landing_on_a_robot_is_found(contract: str) -> None:
    assert any("land" in told and "come down on a robot" in told for told in broken(air_ground_bare_land(), contract))
    assert broken(air_ground(), contract) == []


@pytest.mark.parametrize("contract", DRIVING)
def test_without_the_guard_driving_off_under_a_drone_is_found(contract: str) -> None:
    found = broken(without_needs("rover", "navigate_to"), contract)
    assert any("navigate_to" in told and "comes down" in told for told in found)
    assert broken(air_ground(), contract) == []


def air_ground_bare_land() -> Rules:
    return without_needs("quadcopter", "land")


def test_what_was_seen_of_a_relation_is_not_remembered() -> None:
    """A guard on an earlier step says nothing about a later one: the other robot may have moved meanwhile."""
    rules = without_needs("quadcopter", "land")
    contract = rules.contracts["search_and_dispatch"]
    seen_before = replace(contract.steps[2], needs=(replace(contract.never[0].when[0], value=True),))
    assert seen_before.name == "report"
    steps = tuple(seen_before if step.name == "report" else step for step in contract.steps)
    changed = replace(rules, contracts={**rules.contracts, contract.name: replace(contract, steps=steps)})
    assert any("come down on a robot" in told for told in broken(changed, contract.name))

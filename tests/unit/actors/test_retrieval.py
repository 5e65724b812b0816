"""A large library is narrowed to what a request may mean, with every skill that its contracts call."""

import pytest

from crew.actors.planner.retrieval import CONTRACTS, Library
from crew.contracts.contract import Contract
from crew.contracts.site import Rules
from crew.library import load_rules
from tests.unit.actors.large_library import OTHER_WORDS, SAME_WORDS, large_library, small_part


@pytest.fixture(scope="module")
def rules() -> Rules:
    return large_library()


@pytest.fixture(scope="module")
def library(rules: Rules) -> Library:
    return Library(rules)


def test_the_library_is_as_large_as_it_says(library: Library, rules: Rules) -> None:
    assert library.skill_count == 10_000
    assert len(rules.contracts) == 2_000


def test_a_request_with_a_declared_word_finds_its_contract(library: Library) -> None:
    found = {text: library.contracts(text) for text, _ in SAME_WORDS}
    assert all(wanted in found[text] for text, wanted in SAME_WORDS)
    first = [text for text, wanted in SAME_WORDS if found[text][0] == wanted]
    assert len(first) >= 0.8 * len(SAME_WORDS), set(found) - set(first)


def test_a_request_without_any_finds_the_thing_and_its_place(library: Library) -> None:
    for text, wanted in OTHER_WORDS:
        thing = wanted.partition("_")[2]
        assert [name for name in library.contracts(text) if name.endswith(thing)], text


def test_what_is_shown_holds_every_skill_of_its_contracts_and_little_else(library: Library, rules: Rules) -> None:
    shown = library.narrow("give the north pump a wash")
    assert "clean_north_pump" in shown.contracts
    assert len(shown.contracts) <= CONTRACTS
    held = {(kind.name, skill.name) for kind in shown.kinds.values() for skill in kind.skills}
    for contract in shown.contracts.values():
        assert _called(contract, rules) <= held
    assert len(held) <= CONTRACTS * 5
    assert {r.kind for r in shown.crew.robots} == {kind for kind, _ in held}


def _called(contract: Contract, rules: Rules) -> set[tuple[str, str]]:
    """Kind and skill of everything that a contract's steps and safe states call, for every kind that has it."""
    names = {pattern.skill for step in contract.steps for pattern in step.do}
    names |= {role.safe.by for role in contract.roles if role.safe is not None}
    return {(kind.name, name) for kind in rules.kinds.values() for name in names if kind.skill(name) is not None}


def test_a_word_that_every_contract_holds_tells_none_of_them_apart(library: Library) -> None:
    assert library.contracts("the") == []
    assert library.contracts("the north pump") == library.contracts("north pump")


def test_a_small_library_is_shown_whole(rules: Rules) -> None:
    small = small_part(rules, 149)
    assert Library(small).narrow("anything") is small
    assert Library(small_part(rules, 150)).narrow("inspect the north pump") is not small


def test_both_testbeds_are_shown_whole() -> None:
    for name in ("air_ground", "humanoid_quadruped"):
        crew = load_rules(name)
        assert Library(crew).narrow("anything") is crew


@pytest.mark.parametrize(
    "request_", ["", "!!!", "the of and", '"; DROP TABLE entry; --', "NEAR(" * 50, "\u0000", "a" * 10_000]
)
def test_no_request_upsets_the_index(request_: str, library: Library) -> None:
    assert len(library.narrow(request_).contracts) <= CONTRACTS
    assert library.contracts("inspect the north pump")[0] == "inspect_north_pump"

"""Drafts: whatever steps are asked for, what is written loads, is not odd, and is proved as it stands."""

import pytest
from msgspec.structs import replace

from crew.contracts.files.contract_file import load_contract
from crew.contracts.odd.look import oddities
from crew.contracts.proof.checker import check
from crew.contracts.scaffold.draft import Draft
from crew.contracts.scaffold.wish import WishError, read_wish
from crew.library import load_rules

LOADED = ("loader.pick_place(location=payload_tray)", "carrier.navigate")


def draft(crew: str, *wishes: str) -> str:
    return Draft("mine", [read_wish(wish) for wish in wishes], load_rules(crew)).text()


@pytest.mark.parametrize(
    ("crew", "wishes"),
    [
        ("air_ground", ("scout.search_target", "driver.navigate_to")),
        ("air_ground", ("scout.fly_to", "scout.land")),
        ("air_ground", ("scout.takeoff(altitude=3)", "scout.get_coordinates", "driver.navigate_to(target=victim)")),
        ("air_ground", ("driver.navigate_to(x=1, y=2)",)),
        ("humanoid_quadruped", LOADED),
        ("humanoid_quadruped", ("giver.pick_handover",)),
        ("humanoid_quadruped", ("arm.pick_hold", "dog.navigate(location=room_a)", "arm.wave")),
    ],
)
def test_a_draft_is_valid_not_odd_and_proved(crew: str, wishes: tuple[str, ...]) -> None:
    rules, text = load_rules(crew), draft(crew, *wishes)
    contract = load_contract(text, source="mine.yaml", crew=rules.crew, kinds=rules.kinds)
    changed = replace(rules, contracts={**rules.contracts, "mine": contract})
    assert oddities(changed, {"mine": text}) == ()
    report = check(changed, "mine", repair=False)
    assert report.proved, report.findings


def test_what_a_skill_needs_is_put_in_front_as_an_optional_step() -> None:
    text = draft("air_ground", "scout.search_target")
    assert "  takeoff:\n    role: scout\n    optional: true\n" in text
    assert "  search_target:\n    role: scout\n    after: [takeoff]\n" in text
    assert "asks: [search_target]\n" in text


def test_what_another_contract_never_lets_happen_becomes_a_guard() -> None:
    """`carry` says that nothing is loaded while the carrier is elsewhere: so it comes first, and is guarded."""
    text = draft("humanoid_quadruped", *LOADED)
    assert "needs: [{carrier.moving: false}, {carrier.tray: none}, {carrier.at: pickup}]" in text
    assert "    optional: true\n    do: {navigate: {location: pickup}}\n" in text
    assert "needs: [{carrier.tray: $object}]" in text


def test_without_those_guards_the_draft_would_not_be_proved() -> None:
    rules = load_rules("humanoid_quadruped")
    text = draft("humanoid_quadruped", *LOADED).replace(", {carrier.at: pickup}", "")
    contract = load_contract(text, source="mine.yaml", crew=rules.crew, kinds=rules.kinds)
    report = check(replace(rules, contracts={**rules.contracts, "mine": contract}), "mine", repair=False)
    assert not report.proved


@pytest.mark.parametrize(
    ("wishes", "words"),
    [
        (("scout",), "'scout' is no step; write <role>.<skill>"),
        (("scout.land(now)",), "'now' in 'scout.land(now)' is no argument"),
        (("scout.serch_target",), "did you mean 'search_target'?"),
        (("a.land", "a.navigate_to"), "no robot of crew air_ground has all of land, navigate_to, which a does"),
        (("a.land", "b.takeoff"), "no robot is left for b: iris can play it"),
        (("a.fly_to(z=3)",), "fly_to has no argument 'z' (arguments: x, y, altitude)"),
        (("a.fly_to(x=3)",), "a.fly_to fixes a part of a place; fix y as well"),
        ((), "a contract needs a step"),
    ],
)
def test_a_wish_that_cannot_be_is_refused_in_words(wishes: tuple[str, ...], words: str) -> None:
    with pytest.raises(WishError) as raised:
        draft("air_ground", *wishes)
    assert words in str(raised.value)


def test_a_bad_name_is_refused() -> None:
    with pytest.raises(WishError, match="'Look' is no name"):
        Draft("Look", [read_wish("a.land")], load_rules("air_ground"))

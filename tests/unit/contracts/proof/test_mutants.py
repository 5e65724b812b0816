"""Every mistake that is put into gate, machine, judgements or model is found. `docs/proof.md` lists them."""

import re

import pytest
from msgspec.structs import replace

from crew.contracts.proof.checker import check
from crew.contracts.site import Rules
from crew.library import load_rules
from tests.unit.contracts.build import air_ground, with_approval
from tests.unit.contracts.proof import adversary
from tests.unit.contracts.proof.lab import STOP, chain, kind, rules, skill
from tests.unit.contracts.proof.mutants import MUTANTS, Mutant
from tests.unit.contracts.proof.test_walk import proved, walked
from tests.unit.contracts.proof.zoo import golden, verdict
from tests.unit.project.tree import ROOT

QUICK = {"crew_stop", "guards", "entry", "approval", "sent_any", "negation"}
BEASTS = (
    "air_ground/fix_before_published",
    "humanoid_quadruped/handed_and_held",
    "air_ground/fix_of_an_earlier_mission",
    "air_ground/no_safe_state_in_the_air",
    "humanoid_quadruped/load_and_approach_at_once",
)


def is_killed(mutant: Mutant) -> bool:
    """Whether the check that the mutant names finds it."""
    match mutant.killer:
        case "proof":
            name, known = _rules(mutant)
            return not check(known, name, repair=False).proved
        case "adversary":
            known = load_rules(mutant.crew)
            return any(True for g in adversary.explored(known, mutant.contract) for _ in adversary.gains(g))
        case "walk":
            try:
                walked(proved(mutant.crew), 20_000, seed=3)
            except AssertionError:
                return True
            return False
        case "zoo":
            return any(verdict(beast) != golden(beast).read_text(encoding="utf-8") for beast in BEASTS)
    raise AssertionError(mutant.killer)


def _rules(mutant: Mutant) -> tuple[str, Rules]:
    if mutant.contract == "approved":
        return "dispatch_only", with_approval(air_ground(), "dispatch_only", "dispatch")
    if mutant.contract == "negated":
        work = kind(skill("work", effects={"ready": True}), STOP)
        return "chains", rules(chain(1).replace("do:", "needs: [{w0.ready: {not: true}}], do:"), work)
    if mutant.contract == "two_chains":
        return "chains", rules(
            chain(4, 2), kind(skill("work", needs={"ready": False}, effects={"ready": False}), STOP), 2
        )
    known = load_rules(mutant.crew)
    kept = {mutant.contract: known.contracts[mutant.contract]}
    return mutant.contract, known if mutant.name == "coverage" else replace(known, contracts=kept)


@pytest.mark.parametrize("mutant", [m for m in MUTANTS if m.name in QUICK], ids=lambda m: m.name)
def test_a_handful_of_mistakes_is_found(mutant: Mutant, monkeypatch: pytest.MonkeyPatch) -> None:
    mutant.patch(monkeypatch)
    assert is_killed(mutant)


@pytest.mark.soak
@pytest.mark.parametrize("mutant", [m for m in MUTANTS if m.name not in QUICK], ids=lambda m: m.name)
def test_every_mistake_is_found(mutant: Mutant, monkeypatch: pytest.MonkeyPatch) -> None:
    mutant.patch(monkeypatch)
    assert is_killed(mutant)


@pytest.mark.soak
@pytest.mark.parametrize("mutant", MUTANTS, ids=lambda m: m.name)
def test_without_the_mistake_nothing_is_found(mutant: Mutant) -> None:
    assert not is_killed(mutant)


def test_the_page_lists_every_mutant_with_what_kills_it() -> None:
    page = (ROOT / "docs" / "proof.md").read_text(encoding="utf-8")
    listed = re.findall(r"^\| `(\w+)` \| .* \| (\w+) \|$", page, re.MULTILINE)
    assert listed == [(m.name, m.killer) for m in MUTANTS]
    assert len(MUTANTS) >= 20

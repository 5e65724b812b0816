"""Proofs in the state folder: made once, made anew when anything changes, never for what is not proved."""

from pathlib import Path

import pytest
from msgspec.structs import replace

from crew import proofs
from crew.contracts.proof import checker
from crew.contracts.proof.basis import basis
from crew.contracts.site import Rules
from crew.errors import UsageError
from crew.home import Home
from tests.unit.contracts.build import air_ground


@pytest.fixture
def home(tmp_path: Path) -> Home:
    return Home(tmp_path)


@pytest.fixture
def abort() -> Rules:
    """Rules with one small contract."""
    rules = air_ground()
    return replace(rules, contracts={"abort": replace(rules.contracts["abort"], source="abort.yaml")})


def test_what_was_proved_is_not_proved_again(home: Home, abort: Rules, monkeypatch: pytest.MonkeyPatch) -> None:
    first = proofs.prove(abort, home)
    monkeypatch.setattr(checker, "check", lambda *_, **__: pytest.fail("proved again"))
    assert proofs.prove(abort, home) == first


def test_another_crew_file_of_the_same_meaning_needs_no_new_proof(abort: Rules) -> None:
    crew = replace(abort.crew, source="elsewhere.yaml", obstacles=((0.0, 0.0, 1.0),))
    assert basis(replace(abort, crew=crew)) == basis(abort)


def test_a_changed_contract_is_proved_anew(home: Home, abort: Rules) -> None:
    proofs.prove(abort, home)
    longer = replace(abort.contracts["abort"], deadline_s=1.0)
    seen: list[str] = []
    proofs.prove(replace(abort, contracts={"abort": longer}), home, lambda stage: seen.append(stage.contract))
    assert set(seen) == {"abort"}


def test_a_damaged_proof_is_no_proof(home: Home, abort: Rules) -> None:
    first = proofs.prove(abort, home)
    for path in home.proofs.glob("*.json"):
        path.write_bytes(b"{}]")
    assert proofs.prove(abort, home) == first


def unsafe(rules: Rules) -> Rules:
    """The drone stays in the air when a mission ends early."""
    search = rules.contracts["search_only"]
    roles = tuple(replace(role, safe=None) for role in search.roles)
    return replace(rules, contracts={"search_only": replace(search, roles=roles, source="search_only.yaml")})


def test_a_crew_whose_contract_is_not_proved_is_refused_with_the_story(home: Home) -> None:
    with pytest.raises(UsageError) as refusal:
        proofs.ensure_proved(unsafe(air_ground()), home)
    told = str(refusal.value)
    assert "search_only is not proved" in told
    assert "1. A person asks for search" in told
    assert "repair: give role searcher the safe state {by: land, reach: {airborne: false}}" in told


def test_what_is_not_proved_is_not_kept(home: Home) -> None:
    proofs.prove(unsafe(air_ground()), home)
    assert [path.read_text() for path in home.proofs.glob("*.json")] == ["{}"]


def test_only_so_many_proofs_are_kept(home: Home, abort: Rules, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(proofs, "KEPT", 2)
    for deadline_s in (1.0, 2.0, 3.0):
        contract = replace(abort.contracts["abort"], deadline_s=deadline_s)
        proofs.prove(replace(abort, contracts={"abort": contract}), home)
    assert len(list(home.proofs.glob("*.json"))) == 2

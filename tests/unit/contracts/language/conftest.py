"""The air-ground crew's rules, and what becomes of a request under them."""

from pathlib import Path

import pytest

import crew
from crew.contracts.files.contract_file import load_contract
from crew.contracts.files.crew_file import load_crew
from crew.contracts.kinds.quadcopter import QUADCOPTER
from crew.contracts.kinds.rover import ROVER
from crew.contracts.language.lexicon import Lexicon, lexicon_of
from crew.contracts.site import Rules

HOUSE = Path(crew.__file__).parent


@pytest.fixture(scope="session")
def rules() -> Rules:
    text = (HOUSE / "crews" / "air_ground.yaml").read_text(encoding="utf-8")
    loaded = load_crew(text, source="air_ground.yaml")
    kinds = {kind.name: kind for kind in (QUADCOPTER, ROVER)}
    contracts = {
        name: load_contract(_library(name), source=f"{name}.yaml", crew=loaded, kinds=kinds)
        for name in loaded.contracts
    }
    return Rules(crew=loaded, kinds=kinds, contracts=contracts)


@pytest.fixture(scope="session")
def lexicon(rules: Rules) -> Lexicon:
    return lexicon_of(rules)


def _library(name: str) -> str:
    return (HOUSE / "contracts" / "library" / f"{name}.yaml").read_text(encoding="utf-8")

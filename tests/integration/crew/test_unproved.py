"""A crew whose contract is not proved does not start: exit 2, the story, and nothing left behind."""

from pathlib import Path

import pytest

from crew.library import CONTRACTS, CREWS
from tests.integration.crew.harness import Desk

SAFE = "{safe: {by: land, reach: {airborne: false}}}"


@pytest.fixture
def desk(tmp_path: Path) -> Desk:
    """A crew of one's own, whose drone stays in the air when a search ends early."""
    crew = (CREWS / "air_ground.yaml").read_text()
    (tmp_path / "mine.yaml").write_text(crew.replace("crew: air_ground", "crew: mine"))
    contract = (CONTRACTS / "search_only.yaml").read_text()
    assert contract.count(SAFE) == 1
    (tmp_path / "search_only.yaml").write_text(contract.replace(SAFE, "{safe: stay}"))
    return Desk(tmp_path)


@pytest.mark.parametrize("command", ["up", "demo"])
def test_an_unproved_contract_starts_nothing(desk: Desk, command: str) -> None:
    done = desk.crew(command, "mine.yaml", timeout_s=30.0)
    assert done.returncode == 2
    assert "crew mine is not started, for search_only is not proved" in done.stderr
    assert "1. A person asks for search" in done.stderr
    assert "Traceback" not in done.stderr
    assert not desk.runs.exists()
    assert desk.home.all_running() == []

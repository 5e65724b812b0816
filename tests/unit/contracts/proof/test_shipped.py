"""The contracts that are shipped are proved, all of them, whole."""

import pytest

from crew.contracts.proof import check
from crew.library import crew_names, load_rules

SHIPPED = [(crew, name) for crew in crew_names() for name in load_rules(crew).contracts]


@pytest.mark.parametrize(("crew", "contract"), SHIPPED)
def test_shipped_contract_is_proved(crew: str, contract: str) -> None:
    report = check(load_rules(crew), contract)
    assert report.proved, report.findings
    assert not report.bound_reached
    assert report.states > report.plans > 0

"""The contracts that are shipped are proved, all of them, whole."""

from functools import cache

import pytest

from crew.contracts.proof.checker import check
from crew.contracts.proof.report import Report
from crew.library import crew_names, load_rules

SHIPPED = [(crew, name) for crew in crew_names() for name in load_rules(crew).contracts]


@cache
def report_of(crew: str, contract: str) -> Report:
    """The verdict on a shipped contract, made once for all tests."""
    return check(load_rules(crew), contract)


@pytest.mark.parametrize(("crew", "contract"), SHIPPED)
def test_shipped_contract_is_proved(crew: str, contract: str) -> None:
    report = report_of(crew, contract)
    assert report.proved, report.findings
    assert not report.bound_reached
    assert report.states > report.plans > 0

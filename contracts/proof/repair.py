"""Repairs of broken contracts: each is checked before it is offered."""

from collections.abc import Callable

from crew.contracts.proof.report import Report
from crew.contracts.site import Rules


def with_repairs(report: Report, rules: Rules, again: Callable[[Rules], Report]) -> Report | None:
    """The report with a repair for each finding that has one."""
    del report, rules, again
    return None

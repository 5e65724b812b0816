"""Proving every contract that is shipped, with nothing kept from before."""

import time
from collections.abc import Iterator

from crew.contracts.proof.checker import check
from crew.library import crew_names, load_rules


def measure() -> Iterator[tuple[str, float, int]]:
    """Contract, seconds, states."""
    for crew in crew_names():
        rules = load_rules(crew)
        for name in rules.contracts:
            began_s = time.perf_counter()
            report = check(rules, name)
            assert report.proved, report.findings
            yield f"{crew}, {name}", time.perf_counter() - began_s, report.states

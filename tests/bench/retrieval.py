"""Narrowing a library of 10,000 skills to what a request may mean."""

import time
from collections.abc import Callable

from crew.actors.planner.retrieval import Library
from tests.unit.actors.large_library import OTHER_WORDS, SAME_WORDS, large_library


def measure(rounds: int) -> tuple[list[float], list[float]]:
    """Milliseconds: for a request's contracts alone, and with the rules narrowed to them and their skills."""
    library = Library(large_library())
    assert library.skill_count == 10_000
    requests = [text for text, _ in (*SAME_WORDS, *OTHER_WORDS)]
    return (
        [_timed(library.contracts, requests[n % len(requests)]) for n in range(rounds)],
        [_timed(library.narrow, requests[n % len(requests)]) for n in range(rounds)],
    )


def _timed(query: Callable[[str], object], request: str) -> float:
    began_ns = time.perf_counter_ns()
    assert query(request)
    return (time.perf_counter_ns() - began_ns) / 1e6

"""How far a proof has come, on a terminal: one line that is written over."""

import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager

from crew.contracts.proof.report import Stage

BAR = 24
EVERY_S = 0.1


@contextmanager
def proof_progress() -> Iterator[Callable[[Stage], None] | None]:
    """A bar on standard error while a person looks at it, nothing elsewhere; it is taken away at the end."""
    if not sys.stderr.isatty():
        yield None
        return
    try:
        yield ProgressBar()
    finally:
        print("\r\033[K", end="", file=sys.stderr, flush=True)


class ProgressBar:
    """Plans done and states so far, at most ten times a second."""

    def __init__(self) -> None:
        self._next_s = 0.0

    def __call__(self, stage: Stage) -> None:
        now_s = time.monotonic()
        if now_s >= self._next_s:
            self._next_s = now_s + EVERY_S
            print(f"\r\033[K{line(stage)}", end="", file=sys.stderr, flush=True)


def line(stage: Stage) -> str:
    """The bar as text."""
    done = BAR * stage.plan // max(1, stage.plans)
    bar = "#" * done + "." * (BAR - done)
    return f"proving {stage.contract:22} [{bar}] plan {stage.plan + 1} of {stage.plans}, {stage.states} states"

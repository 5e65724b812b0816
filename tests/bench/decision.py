"""One decision of the gate, with its snapshot, appended to the journal's queue; the commit is timed apart."""

import tempfile
import time
from pathlib import Path

from crew.actors.orchestrator.ledger import Ledger
from crew.clock import WallClock
from crew.contracts.gate.authorize import Gate
from crew.contracts.mission_state import Purpose
from crew.journal import Journal
from crew.signing import SigningKey
from tests.bench.scene import NOW_NS, mission_in_flight


def measure(rounds: int) -> tuple[list[float], list[float]]:
    """Microseconds for decision and append, and milliseconds until a record was on disk."""
    rules, mission, world, call = mission_in_flight()
    gate = Gate()
    decisions, commits = [], []
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        with Journal(
            folder / "journal.db",
            run_id="bench",
            key=SigningKey(bytes(32)),
            outside_head=folder / "head.json",
            on_failure=print,
        ) as journal:
            ledger = Ledger(journal, WallClock())
            for number in range(rounds):
                began_ns = time.perf_counter_ns()
                decision = gate.authorize(call, mission, world, rules, NOW_NS, Purpose.EXECUTE)
                ledger.decision(mission, world, decision)
                decisions.append((time.perf_counter_ns() - began_ns) / 1000)
                assert decision.allowed, decision.refusal
                if number % 20 == 0:
                    began_ns = time.perf_counter_ns()
                    ledger.note("bench", "commit").wait(5.0)
                    commits.append((time.perf_counter_ns() - began_ns) / 1e6)
    return decisions, commits

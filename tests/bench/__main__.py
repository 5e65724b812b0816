"""Prints every figure that the project promises, with its target. Exit 1 if one is missed."""

import compileall
import os
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from statistics import median

from tests.bench import apartment, decision, proof, recorded, retrieval, roundtrip, signature, simulation, stopping

CREW = [sys.executable, "-m", "crew"]
SOURCES = ("crew", "actors", "adapters", "contracts", "sim")


def main() -> int:
    """Run all, or the sections named on the command line."""
    wanted = sys.argv[1:] or list(SECTIONS)
    unknown = [name for name in wanted if name not in SECTIONS]
    if unknown:
        print(f"no section is called {', '.join(unknown)}; there are {', '.join(SECTIONS)}", file=sys.stderr)
        return 2
    missed = 0
    for name in wanted:
        for what, value, limit, unit, fine in SECTIONS[name]():
            missed += not fine
            print(
                f"{'ok  ' if fine else 'MISS'}  {what:66} {value:9.2f} {unit:4} (target {limit:g} {unit})", flush=True
            )
    return 1 if missed else 0


Row = tuple[str, float, float, str, bool]


def at_most(what: str, value: float, limit: float, unit: str) -> Row:
    return what, value, limit, unit, value <= limit


def at_least(what: str, value: float, limit: float, unit: str) -> Row:
    return what, value, limit, unit, value >= limit


def decisions() -> Iterator[Row]:
    """The gate and the journal's queue."""
    times_us, commits_ms = decision.measure(4000)
    yield at_most("gate decision appended to the journal's queue, p50", median(times_us), 50, "us")
    yield at_most("  the same, p99", sorted(times_us)[int(len(times_us) * 0.99)], 1000, "us")
    yield at_most("  commit of a record, p50 (apart)", median(commits_ms), 20, "ms")


def signatures() -> Iterator[Row]:
    """The message lock alone."""
    times_us = signature.measure(4000)
    yield at_most("permit signed and verified, p50", median(times_us), 250, "us")


def stops() -> Iterator[Row]:
    """The stop under load: a command flood, a loop blocked half of the time, a burning core."""
    times_ms = sorted(stopping.measure(200))
    yield at_most("stop's put to the halt at the vehicle's socket, p99 of 200", times_ms[197], 100, "ms")
    yield at_most("  the same, p50", median(times_ms), 100, "ms")
    yield at_most("  the same, slowest", times_ms[-1], 1000, "ms")


def round_trips() -> Iterator[Row]:
    """A dispatch beside raw Zenoh."""
    times = roundtrip.measure(1000)
    floor_us, same_us, dispatch_us = median(times.raw), median(times.same), median(times.dispatch)
    signed_us = median(a + b for a, b in zip(times.dispatch, times.signature, strict=True))
    yield at_most("dispatch's put to accepted / raw Zenoh, same router, p50", dispatch_us / same_us, 1.5, "x")
    yield at_most("dispatch's put to accepted, locked / raw Zenoh, open router, p50", dispatch_us / floor_us, 1.9, "x")
    yield at_most("  with the signature, which is made before the intent is written", signed_us / floor_us, 2.2, "x")
    yield at_most("  raw Zenoh round trip, p50", floor_us, 5000, "us")
    yield at_most("  dispatch's put to accepted, p50", dispatch_us, 5000, "us")


def recording() -> Iterator[Row]:
    """What a recorder costs those who move robots."""
    without_us, with_us = recorded.measure(1200)
    yield at_most("dispatch to accepted, recorder on / off, p50", median(with_us) / median(without_us), 1.1, "x")


def retrievals() -> Iterator[Row]:
    """What a language model is shown of a large library."""
    contracts_ms, narrowed_ms = retrieval.measure(500)
    yield at_most("contracts for a request, of 10,000 skills, p50", median(contracts_ms), 1, "ms")
    yield at_most("  with the rules narrowed to their skills, p50", median(narrowed_ms), 2, "ms")


def simulated() -> Iterator[Row]:
    """The simulation alone."""
    yield at_least("simulation, headless, both robots moving", simulation.measure(20.0), 20, "x")


def proofs() -> Iterator[Row]:
    """Every contract that is shipped, from nothing."""
    total_s = 0.0
    for contract, seconds, states in proof.measure():
        total_s += seconds
        print(f"      {contract:66} {seconds:9.2f} s    ({states} states)", flush=True)
    yield at_most("all shipped contracts proved, one mission", total_s, 10, "s")


def second_testbed() -> Iterator[Row]:
    """The humanoid and the quadruped."""
    yield at_least("simulation of the apartment while walking", apartment.walking_pace(10.0), 8, "x")
    yield at_most("inverse kinematics of an arm, one step, p50", apartment.arm_step_ms(), 0.5, "ms")


def command_line() -> Iterator[Row]:
    """What a person waits for. Bytecode is compiled, as an installation leaves it: else every process would compile."""
    for folder in SOURCES:
        compileall.compile_dir(folder, quiet=1)
    yield at_most("crew --help, median of 7", median(_timed([*CREW, "--help"]) for _ in range(7)), 0.3, "s")
    with tempfile.TemporaryDirectory() as folder:
        environment = {**os.environ, "CREW_HOME": f"{folder}/home"}
        up = [_came_and_went(folder, environment) for _ in range(4)][1:]
        yield at_most("crew up to ready, warm, median of 3", median(ready for ready, _ in up), 3, "s")
        yield at_most("  Ctrl-C to nothing running, median of 3", median(gone for _, gone in up), 2, "s")
        demo = [*CREW, "demo", "--json", "--speed", "max", "--runs", f"{folder}/runs"]
        walls = [_timed(demo, environment) for _ in range(3)]
        yield at_most("crew demo --speed max, command to exit, median of 3", median(walls), 12, "s")


def _timed(command: list[str], environment: dict[str, str] | None = None) -> float:
    began = time.perf_counter()
    done = subprocess.run(command, check=False, stdout=subprocess.PIPE, text=True, env=environment)
    if done.returncode:
        raise SystemExit(f"{' '.join(command)} ended with {done.returncode}: {done.stdout}")
    return time.perf_counter() - began


def _came_and_went(folder: str, environment: dict[str, str]) -> tuple[float, float]:
    """Seconds from the command to the line that says that the crew is up, and from Ctrl-C to the command's end."""
    began = time.perf_counter()
    command = [*CREW, "up", "--port", "0", "--runs", f"{folder}/runs"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True, env=environment) as process:
        assert process.stdout is not None
        for line in process.stdout:
            if " is up after " in line:
                break
        ready_s = time.perf_counter() - began
        began = time.perf_counter()
        process.send_signal(signal.SIGINT)
        process.stdout.read()
        process.wait()
    return ready_s, time.perf_counter() - began


SECTIONS: dict[str, Callable[[], Iterator[Row]]] = {
    "decisions": decisions,
    "signatures": signatures,
    "stops": stops,
    "round_trips": round_trips,
    "recording": recording,
    "retrieval": retrievals,
    "simulation": simulated,
    "proofs": proofs,
    "second_testbed": second_testbed,
    "command_line": command_line,
}

if __name__ == "__main__":
    sys.exit(main())

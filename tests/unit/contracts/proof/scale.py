"""How far a proof reaches: generated contracts, measured one by one in a process of their own.

`python -m tests.unit.contracts.proof.scale` prints the table of docs/proof.md.
"""

import json
import resource
import subprocess
import sys
import time
from collections.abc import Callable, Mapping
from importlib.metadata import version
from random import Random

from crew.contracts.proof.checker import check
from crew.contracts.site import Rules
from tests.unit.contracts.proof.lab import STOP, chain, kind, rules, skill

SEED = 7
WORK = skill("work", effects={"ready": True}, during={"moving": True})


def chains(steps: int, robots: int) -> Rules:
    """Steps in chains, one chain a robot."""
    return rules(chain(steps, robots), kind(WORK, STOP), robots)


def guarded(steps: int, robots: int, seed: int) -> Rules:
    """Chains with orders across robots and guards on others' fluents, by chance."""
    chance = Random(seed)
    lines = chain(steps, robots).splitlines()
    for index in range(robots, steps):
        at = next(k for k, text in enumerate(lines) if text.startswith(f"  s{index}:"))
        other = chance.randrange(index)
        if chance.random() < 0.5:
            lines[at] = lines[at].replace("after: [", f"after: [s{other}, " if other != index - robots else "after: [")
        if chance.random() < 0.5:
            guard = f"needs: [{{w{other % robots}.ready: true}}], do:"
            lines[at] = lines[at].replace("do:", guard)
    return rules("\n".join(lines) + "\n", kind(WORK, STOP), robots)


def library(skills: int) -> Rules:
    """A kind with many skills beside the ones that the contract uses."""
    more = (skill(f"skill_{n}", effects={"ready": n % 2 == 0}) for n in range(skills - 2))
    return rules(chain(6, 2), kind(WORK, STOP, *more), 2)


ROWS: Mapping[str, Callable[[], Rules]] = {
    "12 steps, 1 robot": lambda: chains(12, 1),
    "12 steps, 2 robots": lambda: chains(12, 2),
    "12 steps, 3 robots": lambda: chains(12, 3),
    "12 steps, 4 robots": lambda: chains(12, 4),
    "12 steps, 6 robots": lambda: chains(12, 6),
    "12 steps, 6 robots, orders and guards": lambda: guarded(12, 6, SEED),
    "6 steps, 2 robots, 100 skills": lambda: library(100),
    "6 steps, 2 robots, 1,000 skills": lambda: library(1000),
}


def measure(name: str) -> dict[str, float | str | bool]:
    """One row, in this process."""
    known = ROWS[name]()
    began = time.perf_counter()
    report = check(known, "chains", repair=False)
    return {
        "name": name,
        "proved": report.proved,
        "bound": report.bound_reached,
        "states": report.states,
        "transitions": report.transitions,
        "decisions": report.decisions,
        "seconds": time.perf_counter() - began,
        "mb": resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024,
    }


def main() -> None:
    """The table, as Markdown."""
    if len(sys.argv) > 1:
        print(json.dumps(measure(sys.argv[1])))
        return
    print(f"robot-crew {version('robot-crew')}, seed {SEED}")
    print("| contract | verdict | states | transitions | decisions | seconds | MB |")
    print("|---|---|---|---|---|---|---|")
    for name in ROWS:
        done = subprocess.run(
            [sys.executable, "-m", __spec__.name, name], check=True, stdout=subprocess.PIPE, text=True
        )
        row = json.loads(done.stdout)
        verdict = "bound reached" if row["bound"] else "proved" if row["proved"] else "not proved"
        counts = " | ".join(f"{row[key]:,}" for key in ("states", "transitions", "decisions"))
        print(f"| {name} | {verdict} | {counts} | {row['seconds']:.1f} | {row['mb']:.0f} |", flush=True)


if __name__ == "__main__":
    main()

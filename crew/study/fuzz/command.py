"""`crew eval fuzz`: runs the fuzz and the mutants, writes the page, and says in its exit code whether all held."""

import os
import time
from collections.abc import Callable, Sequence
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
from pathlib import Path

import msgspec

from crew.errors import UsageError, nearest
from crew.study.fuzz.mutant import MUTANTS, Killed, kill
from crew.study.fuzz.page import Results, made, page
from crew.study.fuzz.run import run

MOST = 20_000
"""Cases that a mutant is given before it counts as alive."""
MOST_PROCESSES = 2


def fuzz(
    seed: int,
    plans: int,
    mutants: Sequence[str] = (),
    processes: int = 0,
    told: Callable[[str], None] = lambda _: None,
) -> Results:
    """Run it. `mutants` are names, or `all`; 0 processes takes what the machine has, at most two.

    Raises UsageError for a number that makes no sense and for an unknown mutant.
    """
    if plans < 1:
        raise UsageError(f"--plans {plans} is no number of plans; give 1 or more")
    wanted = _chosen(mutants)
    processes = processes or min(MOST_PROCESSES, os.cpu_count() or 1)
    begun = time.monotonic()
    tally = run(seed, plans, processes, lambda done: told(f"{min(done, plans):,} of {plans:,} plans"))
    seconds = time.monotonic() - begun
    return made(seed, processes, seconds, tally, _kill(wanted, seed, processes, told), MOST)


def write(results: Results, out: Path) -> tuple[Path, Path]:
    """`fuzz.md` and `fuzz.json` in a folder."""
    out.mkdir(parents=True, exist_ok=True)
    text, data = out / "fuzz.md", out / "fuzz.json"
    text.write_text(page(results), encoding="utf-8")
    data.write_bytes(msgspec.json.format(msgspec.json.encode(results), indent=1) + b"\n")
    return text, data


def _chosen(names: Sequence[str]) -> list[str]:
    known = [mutant.name for mutant in MUTANTS]
    if "all" in names:
        return known
    for name in names:
        if name not in known:
            raise UsageError(f"no mutant is called {name!r}{nearest(name, known)}")
    return list(names)


def _kill(names: Sequence[str], seed: int, processes: int, told: Callable[[str], None]) -> list[Killed]:
    if not names:
        return []
    found = []
    with ProcessPoolExecutor(processes, mp_context=get_context("spawn")) as pool:
        for killed in pool.map(_kill_one, names, [seed] * len(names)):
            found.append(killed)
            told(f"{len(found)} of {len(names)} mutants: {killed.name} {'dies' if killed.case >= 0 else 'LIVES'}")
    return found


def _kill_one(name: str, seed: int) -> Killed:
    return kill(next(mutant for mutant in MUTANTS if mutant.name == name), seed, MOST)

"""Deliveries by `crew demo`: every actor in a process of its own, as a person would start them."""

import json
import subprocess
import sys
from collections.abc import Iterator, Sequence
from pathlib import Path
from statistics import mean

import msgspec

from crew.errors import CrewError

TIMEOUT_S = 300.0
DELIVERED_M = 0.3


class Delivery(msgspec.Struct, frozen=True, kw_only=True):
    """One demo. The distance is the thing's true one from the goal, horizontal, metres."""

    map: str
    seed: int
    outcome: str
    contract: str
    away_m: float | None
    mission_s: float
    message: str

    @property
    def delivered(self) -> bool:
        return self.outcome == "completed" and self.away_m is not None and self.away_m < DELIVERED_M


def deliver(crew: str, map_: str, seed: int, runs: Path) -> Delivery:
    """Run one. Raises CrewError if the demo gives no result."""
    command = [sys.executable, "-m", "crew", "demo", crew, "--json", "--speed", "max", "--no-record"]
    command += ["--map", map_, "--seed", str(seed), "--runs", str(runs)]
    done = subprocess.run(command, capture_output=True, text=True, timeout=TIMEOUT_S, check=False)
    try:
        result = json.loads(done.stdout)
    except ValueError as error:
        raise CrewError(f"{map_} {seed}: the demo gave no result: {done.stderr.strip()[-300:]}") from error
    return Delivery(
        map=map_,
        seed=seed,
        outcome=result["outcome"],
        contract=result["contract"] or "",
        away_m=result["goal_error_m"],
        mission_s=result["sim_s"],
        message=result["message"],
    )


def demo_table(demos: Sequence[Delivery]) -> Iterator[str]:
    """By map, in Markdown; nothing where nothing was measured."""
    if not demos:
        return
    yield "## By `crew demo`"
    yield ""
    yield "The same request with the person near and far, every actor in a process of its own. Delivered: completed,"
    yield f"and the cube within {DELIVERED_M:g} m of the hand. The order of work in different processes is free, so"
    yield "that digits differ from run to run."
    yield ""
    yield "| map | contract | seeds | delivered | distance: mean, largest | mission: mean, longest |"
    yield "|---|---|---|---|---|---|"
    for map_ in dict.fromkeys(d.map for d in demos):
        group = [d for d in demos if d.map == map_]
        away = [d.away_m for d in group if d.away_m is not None] or [float("nan")]
        lasted = [d.mission_s for d in group]
        delivered, contract = sum(d.delivered for d in group), ", ".join(sorted({d.contract for d in group}))
        distances, times = f"{mean(away):.3f} m, {max(away):.3f} m", f"{mean(lasted):.0f} s, {max(lasted):.0f} s"
        yield f"| {map_} | {contract} | {len(group)} | {delivered} | {distances} | {times} |"
    yield ""
    for d in demos:
        if not d.delivered:
            yield f"- {d.map}, seed {d.seed}: {d.outcome}; {d.message}"
    yield ""

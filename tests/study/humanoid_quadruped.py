"""Deliveries of the humanoid and the quadruped over many seeds: adapters and simulation in lockstep, in one process.

`python -m tests.study.humanoid_quadruped` measures what its results file does not hold yet and writes the page beside
it; it may be stopped and started again. `--models FOLDER` measures MuJoCo Menagerie's robots instead, into files of
their own. Three seeds of each are tests (tests/integration/unitree/test_missions.py).
"""

import argparse
import asyncio
import time
from collections.abc import Iterator
from importlib.metadata import version
from pathlib import Path
from statistics import mean

import msgspec

from crew.errors import AdapterError
from tests.integration.unitree.stage import Stage, stage

MISSIONS = ("handover", "carry")
MAPS = {"handover": "near", "carry": "far"}
DELIVERED_M = 0.3
OFF_THE_FLOOR_M = 0.5


class Trial(msgspec.Struct, frozen=True, kw_only=True):
    """One mission: the cube's true distance from the person's hand, and its height, in metres."""

    mission: str
    seed: int
    error: str
    away_m: float
    height_m: float
    in_tray: bool
    mission_s: float
    pace: float
    """Simulated seconds for each second of wall time, everything included."""

    @property
    def delivered(self) -> bool:
        held = self.in_tray or self.mission == "handover"
        return not self.error and held and self.away_m < DELIVERED_M and self.height_m > OFF_THE_FLOOR_M


class Results(msgspec.Struct, frozen=True, kw_only=True):
    """What was measured, and with which version."""

    version: str
    models: str = ""
    """What the robots' models are of, where they are not this project's own."""
    trials: tuple[Trial, ...] = ()


async def trial(mission: str, seed: int, models: str = "") -> Trial:
    """Carry one mission out; a failure is a result."""
    began = time.monotonic()
    async with stage(map_=MAPS[mission], seed=seed, models=models) as scene:
        error = ""
        try:
            await (_hand(scene) if mission == "handover" else _carry(scene))
        except AdapterError as failure:
            error = f"{failure.code}: {failure}"
        await scene.advance(0.5)
        x, y, _ = scene.thing("requester")
        seconds = scene.clock.now_ns() / 1e9
        return Trial(
            mission=mission,
            seed=seed,
            error=error,
            away_m=round(scene.away_m("red_cube", x, y), 3),
            height_m=round(scene.thing("red_cube")[2], 3),
            in_tray=scene.go2.fluents()["tray"].value == "red_cube",
            mission_s=round(seconds, 1),
            pace=round(seconds / (time.monotonic() - began), 1),
        )


async def _hand(scene: Stage) -> None:
    await scene.do("g1", "pick_handover", object="red_cube")


async def _carry(scene: Stage) -> None:
    await scene.do("go2", "navigate", location="pickup")
    await scene.do("g1", "pick_place", object="red_cube", location="payload_tray")
    await scene.do("go2", "navigate", location="requester")


def page(results: Results) -> str:
    """The results, in Markdown."""
    return "\n".join(_lines(results))


def _lines(results: Results) -> Iterator[str]:
    yield "# The humanoid and the quadruped in numbers" + (f": {results.models}" if results.models else "")
    yield ""
    yield f"Made by `python -m tests.study.humanoid_quadruped` with version {results.version}: adapters and"
    yield "simulation in lockstep, with noise; the seed moves things and the person. Distances are horizontal, by the"
    yield "simulation's truth, from the cube to the hand that the person holds out. Delivered: within 0.3 m, off the"
    felt = "floor, and for carry felt by the tray's sensor on arrival. This is the adapters alone"
    yield f"{felt}." if results.models else f"{felt}; both missions in a"
    if not results.models:
        yield "full crew, by `crew demo`, and what each mishap leads to there, stand in [mishaps.md](mishaps.md)."
    yield ""
    yield "| mission | seeds | delivered | distance: mean, largest | mission: mean, longest |"
    yield "|---|---|---|---|---|"
    for mission in MISSIONS:
        group = [t for t in results.trials if t.mission == mission]
        if group:
            away, lasted = [t.away_m for t in group], [t.mission_s for t in group]
            delivered = sum(t.delivered for t in group)
            distances = f"{mean(away):.3f} m, {max(away):.3f} m"
            times = f"{mean(lasted):.0f} s, {max(lasted):.0f} s"
            yield f"| {mission} | {len(group)} | {delivered} | {distances} | {times} |"
    yield ""
    for t in results.trials:
        if not t.delivered:
            yield f"- {t.mission}, seed {t.seed}: {t.error or 'not delivered'}; {t.away_m} m away, {t.height_m} m high"
    yield ""


def main() -> None:
    """Measure what is missing."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--out", type=Path, default=Path("docs/study"))
    parser.add_argument("--seeds", type=int, default=20)
    parser.add_argument("--mission", choices=MISSIONS, action="append", help="one of them alone")
    parser.add_argument("--models", default="", help="MuJoCo Menagerie's folder")
    parser.add_argument("--of", default="MuJoCo Menagerie", help="with --models: what is measured, such as its commit")
    parser.add_argument("--limit-s", type=float, default=3600.0)
    chosen = parser.parse_args()
    path = chosen.out / f"humanoid_quadruped{'_menagerie' if chosen.models else ''}.json"
    end_s = time.monotonic() + chosen.limit_s
    results = Results(version=version("robot-crew"), models=chosen.of if chosen.models else "")
    if path.exists():
        results = msgspec.json.decode(path.read_bytes(), type=Results)
    chosen.out.mkdir(parents=True, exist_ok=True)
    for mission in chosen.mission or MISSIONS:
        for seed in range(chosen.seeds):
            if any((t.mission, t.seed) == (mission, seed) for t in results.trials) or time.monotonic() > end_s:
                continue
            found = asyncio.run(trial(mission, seed, chosen.models))
            print(f"{mission} {seed}: {'delivered' if found.delivered else 'NOT delivered'} {found}", flush=True)
            results = msgspec.structs.replace(results, trials=(*results.trials, found))
            path.write_bytes(msgspec.json.format(msgspec.json.encode(results), indent=1) + b"\n")
    path.with_suffix(".md").write_text(page(results), encoding="utf-8")


if __name__ == "__main__":
    main()

"""The air-ground study: accuracy over maps and seeds, and what each fault leads to.

`python -m crew.study.air_ground --out docs/study` runs what its results file does not hold yet, and then what another
version has measured, one mission after another, and writes the tables; it may be stopped and started again.
`--limit-s` ends it early.
"""

import argparse
import sys
import time
from collections.abc import Iterator, Sequence
from pathlib import Path

import msgspec

from crew.errors import CrewError
from crew.study.mission import Measured, Scenario, measure
from crew.study.table import Study, page
from crew.study.version import study_version

MAPS = ("A", "B", "C")
FIRST = 9
FAULTS: tuple[tuple[str, ...], ...] = (
    ("missed_detection",), ("nan_transmission",), ("iris_unavailable",), ("tb3_unavailable",),
    ("iris_unavailable@20",), ("tb3_unavailable@75",), ("battery_low",), ("battery_low@20",), ("gps_loss@20",),
    ("gps_loss@75",), ("link_loss@20",), ("link_loss@75",), ("wind_gusts",), ("blocked_path",), ("unmapped_obstacle",),
)  # fmt: skip
"""Those with a time begin while the drone searches (20 s) or while the rover drives (75 s)."""
SIGHTS = ("two_people", "side_by_side", "decoy", "decoy_alone", "edge", "cover")
NORTH = "Search the north half and send the rover to the victim"
REQUESTS = {"edge": NORTH, "decoy_alone": NORTH}


def scenarios(seeds: int) -> Iterator[Scenario]:
    """Every mission of the study: some of each kind come first, so that a study that is ended early shows something."""
    seeded = [Scenario(name="accuracy", map=map_, seed=seed) for seed in range(seeds) for map_ in MAPS]
    yield from seeded[:FIRST]
    for faults in FAULTS:
        yield Scenario(name="fault", faults=faults)
    for sight in SIGHTS:
        yield Scenario(name="sight", map=sight, request=REQUESTS.get(sight, ""))
    yield from seeded[FIRST:]


def run(wanted: Sequence[Scenario], out: Path, runs: Path, limit_s: float) -> int:
    """Measure what is missing; how many are missing still."""
    results, end_s = out / "air_ground.json", time.monotonic() + limit_s
    study = msgspec.json.decode(results.read_bytes(), type=Study) if results.exists() else Study()
    missing = missing_of(study, wanted, study_version())
    while missing and time.monotonic() < end_s:
        measured = measure(missing.pop(0), runs)
        _say(measured, len(missing))
        kept = tuple(m for m in study.missions if m.scenario != measured.scenario)
        study = Study(missions=_ordered((*kept, measured), wanted))
        out.mkdir(parents=True, exist_ok=True)
        results.write_bytes(msgspec.json.format(msgspec.json.encode(study), indent=1) + b"\n")
    (out / "air_ground.md").write_text(page(study), encoding="utf-8")
    return len(missing)


def missing_of(study: Study, wanted: Sequence[Scenario], version: str) -> list[Scenario]:
    """What was never measured, and after it what was measured with another version than this."""
    versions = {measured.scenario: measured.version for measured in study.missions}
    never = [scenario for scenario in wanted if scenario not in versions]
    return [*never, *(scenario for scenario in wanted if versions.get(scenario, version) != version)]


def _ordered(missions: tuple[Measured, ...], wanted: Sequence[Scenario]) -> tuple[Measured, ...]:
    order = {scenario: index for index, scenario in enumerate(wanted)}
    return tuple(sorted(missions, key=lambda m: order.get(m.scenario, len(order))))


def _say(measured: Measured, left: int) -> None:
    scenario = measured.scenario
    what = " ".join((scenario.map, str(scenario.seed), *scenario.faults))
    error = "" if measured.goal_error_m is None else f" {measured.goal_error_m:.2f} m"
    print(f"{what}: {measured.outcome} {measured.code or ''}{error} ({left} left)", flush=True)


def main() -> int:
    """0 when every mission has been measured, 4 when some are left."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--out", type=Path, default=Path("docs/study"), help="folder of the tables")
    parser.add_argument("--runs", type=Path, default=Path("runs/study"), help="folder of the missions' runs")
    parser.add_argument("--seeds", type=int, default=10, help="seeds for each map")
    parser.add_argument("--limit-s", type=float, default=3600.0, help="begin no mission after this many seconds")
    chosen = parser.parse_args()
    try:
        left = run(tuple(scenarios(chosen.seeds)), chosen.out, chosen.runs, chosen.limit_s)
    except CrewError as error:
        print(error, file=sys.stderr)
        return 1
    print(f"{left} missions are left; run it again" if left else f"the tables are in {chosen.out / 'air_ground.md'}")
    return 4 if left else 0


if __name__ == "__main__":
    sys.exit(main())

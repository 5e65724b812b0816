"""What each mishap of the humanoid and the quadruped leads to in a full crew: the end, and where the object lies.

`python -m crew.study.mishaps --out docs/study` carries out what its results do not hold yet, in one process at full
speed, and writes the table; `--demo 5` adds so many seeds of each map by `crew demo`, with a process for every actor.
"""

import argparse
import asyncio
import math
import sys
import tempfile
import time
from collections.abc import Iterator, Sequence
from pathlib import Path

import msgspec
from msgspec.structs import replace

from crew.contracts.mission.event import Outcome
from crew.errors import CrewError
from crew.home import Home
from crew.journal_reader import read_records
from crew.launch.options import LaunchOptions
from crew.records import EventRecord
from crew.sim.oracle import Frame
from crew.study.demos import Delivery, deliver, demo_table
from crew.study.disturbed import LINKS
from crew.study.live import ENDED, TRUTH, Ended, fly
from crew.study.scenario import Scenario
from crew.study.version import study_version

CREW, THING = "humanoid_quadruped", "red_cube"
FILE = "mishaps.json"
BRING = "Bring me the red cube"
FLOOR_M, TRAY_M, HELD_M = 0.1, 0.3, 0.8
"""A thing's height: on the floor at most, in the tray at most so far from its middle (horizontally), held at least."""
SETTLES_S = 3.0
"""Mission time after the end in which a robot that falls comes to rest."""
TRIES = 3
STILL_M = 0.02
"""How far a robot that stands sways in the last moments that were seen."""


class Mishap(msgspec.Struct, frozen=True, kw_only=True):
    """One fault and what must become of the mission."""

    fault: str
    map: str = "far"
    request: str = BRING
    outcome: str = "halted"
    code: str
    lies: str
    """Where the thing must truly be at the end."""

    @property
    def name(self) -> str:
        return f"{self.fault}-{self.map}"


MISHAPS: tuple[Mishap, ...] = (
    Mishap(fault="grasp_failed", map="near", code="grasp_failed", lies="on the table"),
    Mishap(fault="object_dropped", map="near", code="grasp_failed", lies="on the table"),
    Mishap(fault="requester_leaves", map="near", code="target_moved", lies="in g1's hand"),
    Mishap(fault="requester_leaves", code="target_moved", lies="in go2's tray"),
    Mishap(fault="tray_slip", code="load_lost", lies="on the floor"),
    Mishap(fault="doorway_blocked", code="no_path", lies="in go2's tray"),
    Mishap(fault="go2_falls", code="fallen", lies="on the table"),
    Mishap(fault="move_ignored", code="no_progress", lies="on the table"),
    Mishap(fault="link_loss", code="link_lost", lies="on the table"),
    Mishap(fault="sdk_not_implemented", map="near", request="wave", code="sdk_3203", lies="on the table"),
    Mishap(fault="g1_unavailable", map="near", outcome="rejected", code="robot_unavailable", lies="on the table"),
    Mishap(fault="go2_unavailable", outcome="rejected", code="robot_unavailable", lies="on the table"),
    Mishap(fault="lease_held", outcome="rejected", code="robot_unavailable", lies="on the table"),
    Mishap(fault="sdk_timeout", outcome="rejected", code="robot_unavailable", lies="on the table"),
)


class Found(msgspec.Struct, frozen=True, kw_only=True):
    """How it ended. Places are the simulation's truth, metres: world ENU."""

    mishap: Mishap
    outcome: str
    code: str
    message: str
    lies: str
    at: tuple[float, float, float]
    still: bool
    mission_s: float
    wall_s: float

    @property
    def as_declared(self) -> bool:
        wanted = self.mishap
        return (self.outcome, self.code, self.lies, self.still) == (wanted.outcome, wanted.code, wanted.lies, True)


class Results(msgspec.Struct, frozen=True, kw_only=True):
    """What was found, and with which version."""

    version: str
    seed: int = 0
    mishaps: tuple[Found, ...] = ()
    demos: tuple[Delivery, ...] = ()


def carry_out(mishap: Mishap, home: Home, folder: Path, seed: int = 0) -> Found:
    """Bring the crew up with the fault, ask, and look where everything is. Raises CrewError if it does not come up.

    A mission whose time went on without somebody, because the machine was slow, is carried out again.
    """
    began = time.monotonic()
    for attempt in range(TRIES):
        ended = _flown(mishap, home, folder / str(attempt), seed)
        if not ended.dropped or mishap.fault in LINKS:
            break
    folder /= str(attempt)
    frames = msgspec.msgpack.decode((folder / TRUTH).read_bytes(), type=list[Frame])
    x, y, z = frames[-1].targets[THING]
    return Found(
        mishap=mishap,
        outcome=ended.outcome,
        code=ended.code or _failure(folder),
        message=ended.message,
        lies=_lies(frames[-1]),
        at=(round(x, 2), round(y, 2), round(z, 2)),
        still=_still(frames),
        mission_s=ended.mission_s,
        wall_s=round(time.monotonic() - began, 1),
    )


def _flown(mishap: Mishap, home: Home, folder: Path, seed: int) -> Ended:
    folder.mkdir(parents=True)
    options = LaunchOptions(crew=CREW, map=mishap.map, seed=seed, speed=0.0, port=0, record=False)
    asyncio.run(fly(options, _scenario(mishap), home, folder, enforced=True, after_s=SETTLES_S))
    return msgspec.json.decode((folder / ENDED).read_bytes(), type=Ended)


def _failure(folder: Path) -> str:
    """The code of the first step that failed, as its robot reported it."""
    rows = (row for row in read_records(folder / "journal.db") if row.kind == EventRecord.kind)
    events = (msgspec.msgpack.decode(row.body, type=EventRecord).event for row in rows)
    return next((e.code for e in events if isinstance(e, Outcome) and e.result != "succeeded"), "")


def _scenario(mishap: Mishap) -> Scenario:
    return Scenario(
        name=mishap.name, testbed=CREW, title=mishap.fault, request=mishap.request, map=mishap.map,
        faults=(mishap.fault,), kind="fault", outcome="blocked", contracts=(),
    )  # fmt: skip


def _lies(frame: Frame) -> str:
    """Where the thing is, in words."""
    x, y, z = frame.targets[THING]
    if z < FLOOR_M:
        return "on the floor"
    if math.dist((x, y), frame.poses["go2"][:2]) < TRAY_M:
        return "in go2's tray"
    return "in g1's hand" if z > HELD_M else "on the table"


def _still(frames: Sequence[Frame]) -> bool:
    """Whether everybody stands in the last half second that was seen."""
    last, before = frames[-1], frames[max(0, len(frames) - 6)]
    return all(math.dist(last.poses[r][:2], before.poses[r][:2]) < STILL_M for r in last.poses)


def page(results: Results) -> str:
    """The results, in Markdown."""
    return "\n".join((*_mishap_lines(results), *demo_table(results.demos)))


def _mishap_lines(results: Results) -> Iterator[str]:
    yield "# The humanoid and the quadruped: what each mishap leads to"
    yield ""
    yield f"Made by `python -m crew.study.mishaps` with version {results.version}, seed {results.seed}: a full crew,"
    yield "its actors in one process on the real bus, at full speed, with noise. Where the red cube truly lies when the"
    yield "mission has ended; world ENU, metres. A test holds the same table."
    yield ""
    yield "| fault | map | outcome | code | the cube lies | at | robots stand | mission |"
    yield "|---|---|---|---|---|---|---|---|"
    for f in results.mishaps:
        at = ", ".join(f"{v:.2f}" for v in f.at)
        still = "yes" if f.still else "NO"
        odd = "" if f.as_declared else " (NOT as declared)"
        yield (
            f"| {f.mishap.fault} | {f.mishap.map} | {f.outcome}{odd} | {f.code} | {f.lies} | {at} | {still} "
            f"| {f.mission_s:.0f} s |"
        )
    yield ""


def main() -> int:
    """0 when everything ended as declared, 4 when something did not, 1 when a crew did not come up."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--out", type=Path, default=Path("docs/study"), help="folder of the tables")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--demo", type=int, default=0, help="seeds of each map by crew demo")
    chosen = parser.parse_args()
    try:
        with tempfile.TemporaryDirectory() as folder:
            results = _measure(_begun(chosen.out, chosen.seed), chosen.demo, Path(folder), chosen.out)
    except CrewError as error:
        print(f"{error}; what was measured is kept, run it again", file=sys.stderr)
        return 1
    return 0 if all(f.as_declared for f in results.mishaps) and all(d.delivered for d in results.demos) else 4


def _begun(out: Path, seed: int) -> Results:
    """What was measured with this very code and seed; nothing else is gone on with."""
    begun, path = Results(version=study_version(), seed=seed), out / FILE
    if not path.exists():
        return begun
    found = msgspec.json.decode(path.read_bytes(), type=Results)
    return found if (found.version, found.seed) == (begun.version, seed) else begun


def _measure(results: Results, demos: int, folder: Path, out: Path) -> Results:
    """Measure what is missing, and write after each."""
    known = {f.mishap for f in results.mishaps}
    for mishap in (m for m in MISHAPS if m not in known):
        found = carry_out(mishap, Home(folder / "home"), folder / mishap.name, results.seed)
        results = replace(results, mishaps=(*results.mishaps, found))
        print("as declared" if found.as_declared else "NOT AS DECLARED", found, flush=True)
        _write(results, out)
    made = {(d.map, d.seed) for d in results.demos}
    for map_, seed in ((m, s) for m in ("near", "far") for s in range(demos) if (m, s) not in made):
        results = replace(results, demos=(*results.demos, deliver(CREW, map_, seed, folder / "runs")))
        print(results.demos[-1], flush=True)
        _write(results, out)
    return results


def _write(results: Results, out: Path) -> None:
    out.mkdir(parents=True, exist_ok=True)
    (out / FILE).write_bytes(msgspec.json.format(msgspec.json.encode(results), indent=1) + b"\n")
    (out / FILE).with_suffix(".md").write_text(page(results), encoding="utf-8")


if __name__ == "__main__":
    sys.exit(main())

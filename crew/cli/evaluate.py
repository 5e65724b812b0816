"""`crew eval`: a study of scenarios in four arms, live in simulation, side by side, resumable."""

import os
import sys
import time
from collections.abc import Callable, Sequence
from importlib.util import find_spec
from pathlib import Path

import msgspec

from crew.actors.planner.choice import check_choice
from crew.actors.specs import PlannerChoice
from crew.cli.output import coloured, say, say_json
from crew.cli.progress import BAR, proof_progress
from crew.cli.session import home
from crew.contracts.render.prompt import Arm
from crew.errors import UsageError, nearest
from crew.launch.options import LaunchOptions
from crew.proofs import ensure_proved
from crew.study.ablate import arms_of, run_ablation
from crew.study.figures import PAGE
from crew.study.launch import UNENFORCED, simulated_rules
from crew.study.observation import Observation, Results
from crew.study.publish import RESULTS
from crew.study.scenario_file import SHIPPED, load_scenarios
from crew.study.study import Wanted, run_study
from crew.study.version import study_version

MOST_JOBS = 64
ABLATE, FUZZ, SUBSTITUTION, FIGURES = "ablate", "fuzz", "substitution", "figures"
WORDS = (ABLATE, SUBSTITUTION, FIGURES, FUZZ)
"""What may stand before a crew; the last may only stand alone."""


class EvalOptions(msgspec.Struct, frozen=True, kw_only=True):
    """What `crew eval` was asked for."""

    crew: str
    arms: str
    planning: PlannerChoice
    seed: int
    seeds: int
    out: Path
    scenarios: Path | None
    only: tuple[str, ...] = ()
    jobs: int
    held: bool = False
    as_json: bool = False


def what_of(words: Sequence[str]) -> tuple[str, str]:
    """What is to be done (empty for a study) and the crew. Raises UsageError for more words than that."""
    what = words[0] if words and words[0] in WORDS else ""
    rest = words[1:] if what else words
    if len(rest) > 1 or (what == FUZZ and rest):
        raise UsageError(
            f"crew eval can't be told {' '.join(words)!r}; write crew eval CREW, crew eval {FUZZ}, "
            f"or one of {ABLATE}, {SUBSTITUTION}, {FIGURES} before CREW"
        )
    return what, rest[0] if rest else "air_ground"


def run_eval(options: EvalOptions) -> int:
    """0 once every mission was carried out, whatever became of each. Raises UsageError, or CrewError for ours."""
    wanted = _wanted(options)
    quiet = options.as_json
    if not quiet and any(not arm.enforced for arm in wanted.arms):
        say(coloured(UNENFORCED, "amber"))
    began = time.monotonic()
    progress = Progress()
    try:
        results = (run_ablation if options.held else run_study)(wanted, progress)
    except KeyboardInterrupt:
        print(f"\nwhat was done is kept in {options.out}; the same command goes on", file=sys.stderr)
        raise
    finally:
        progress.close()
    _conclude(results, wanted, time.monotonic() - began, as_json=quiet)
    return 0


def _wanted(options: EvalOptions) -> Wanted:
    if find_spec("scipy") is None:
        raise UsageError("a study's tables need scipy; install robot-crew[study]")
    check_choice(options.planning, os.environ)
    if options.seed < 0 or options.seeds < 1:
        raise UsageError(f"--seed {options.seed} --seeds {options.seeds}: seeds count from 0 up, at least one")
    if not 1 <= options.jobs <= MOST_JOBS:
        raise UsageError(f"--jobs {options.jobs}: from 1 to {MOST_JOBS} missions at once")
    rules = simulated_rules(LaunchOptions(crew=options.crew))
    scenarios = load_scenarios(options.scenarios or SHIPPED, rules)
    names = {scenario.name for scenario in scenarios}
    if unknown := [name for name in options.only if name not in names]:
        raise UsageError(f"no scenario is called {unknown[0]!r}{nearest(unknown[0], names)}")
    with proof_progress() as tell:
        ensure_proved(rules, home(), tell)
    arms = parse_arms(options.arms)
    return Wanted(
        crew=options.crew,
        testbed=rules.crew.name,
        rules=rules,
        scenarios=scenarios,
        only=options.only,
        arms=arms_of(arms) if options.held else arms,
        seeds=tuple(range(options.seed, options.seed + options.seeds)),
        planning=options.planning,
        planner=options.planning.name,
        version=study_version(),
        out=options.out,
        jobs=options.jobs,
    )


def parse_arms(text: str) -> tuple[Arm, ...]:
    """`all`, or arms with commas between. Raises UsageError that lists them."""
    if text == "all":
        return tuple(Arm)
    names = [name.strip() for name in text.split(",") if name.strip()]
    for name in names:
        if name not in list(Arm):
            raise UsageError(f"no arm is called {name!r}{nearest(name, [arm.value for arm in Arm])}; or all")
    if not names:
        raise UsageError(f"--arms is empty; give all, or some of {', '.join(Arm)}")
    return tuple(arm for arm in Arm if arm.value in names)


class Progress:
    """How far a study has come: one line that is written over on a terminal, one line a mission elsewhere."""

    def __init__(self, clock: Callable[[], float] = time.monotonic) -> None:
        self._clock, self._began, self._first = clock, clock(), 0
        self._terminal = sys.stderr.isatty()

    def __call__(self, seen: Observation, done: int, total: int) -> None:
        self._first = self._first or done
        now = self._clock() - self._began
        rate = now / (done - self._first + 1)
        left = f"{rate * (total - done) / 60:.1f} min left"
        what = f"{seen.scenario} {seen.arm.value} {seen.seed}: {seen.outcome}{f' ({seen.code})' if seen.code else ''}"
        if self._terminal:
            bar = ("#" * (BAR * done // total)).ljust(BAR, ".")
            print(f"\r\033[K[{bar}] {done} of {total}, {left}; {what}", end="", file=sys.stderr, flush=True)
        else:
            print(f"{done} of {total}, {left}; {what}", file=sys.stderr, flush=True)

    def close(self) -> None:
        """Leave the line."""
        if self._terminal:
            print("\r\033[K", end="", file=sys.stderr, flush=True)


def _conclude(results: Results, wanted: Wanted, wall_s: float, *, as_json: bool) -> None:
    path = wanted.out / RESULTS
    seen = [o for o in results.observations if o.testbed == wanted.testbed]
    if as_json:
        say_json({"results": str(path), "version": results.version, "missions": len(seen), "wall_s": round(wall_s, 1)})
        return
    for arm in wanted.arms:
        mine = [o for o in seen if o.arm is arm]
        false = sum(bool(d.false) for o in mine for d in o.sent)
        sent = sum(len(o.sent) for o in mine)
        met = sum(o.as_expected for o in mine)
        say(f"{arm.value:10} {met} of {len(mine)} missions as they must be; {false} of {sent} dispatches were false")
    say(f"{len(seen)} missions are in {path}, their figures in {wanted.out / PAGE}; {wall_s:.0f} s now")

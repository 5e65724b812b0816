"""The parts of `crew eval` that run no robot: `fuzz`, `substitution` and `figures`."""

import os
from pathlib import Path

import msgspec

from crew.actors.planner.backend import Backend
from crew.actors.planner.choice import check_choice
from crew.actors.planner.process import make_backend
from crew.actors.specs import PlannerChoice
from crew.cli.evaluate import FIGURES, FUZZ
from crew.cli.fuzz import run_fuzz
from crew.cli.output import say, say_json
from crew.cli.session import run
from crew.contracts.render.prompt import Context
from crew.contracts.site import Rules
from crew.errors import UsageError
from crew.library import load_rules
from crew.study.observation import read_results
from crew.study.publish import RESULTS, publish_all
from crew.study.scenario import Scenario
from crew.study.scenario_file import SHIPPED, load_scenarios
from crew.study.substitution import Substitutions, page, run_substitution

MOST_SEEDS = 1_000


class OfflineOptions(msgspec.Struct, frozen=True, kw_only=True):
    """What an offline part of the study was asked for."""

    what: str
    """`fuzz`, `substitution` or `figures`."""
    crew: str
    planning: PlannerChoice
    seed: int
    seeds: int
    out: Path
    scenarios: Path | None
    jobs: int
    plans: int
    mutants: tuple[str, ...]
    as_json: bool


def run_offline(options: OfflineOptions) -> int:
    """0 if all is as it must be, 1 if something unsafe passed. Raises UsageError."""
    if options.what == FUZZ:
        return run_fuzz(
            options.seed, options.plans, options.mutants, options.jobs, options.out, as_json=options.as_json
        )
    if options.what == FIGURES:
        return _figures(options)
    return run(_substitution(options))


def make_figures(out: Path, scenarios: Path | None, crew: str) -> tuple[Path, ...]:
    """Count the missions of a folder anew; the files. `crew`: a crew file of the user's own. Raises UsageError."""
    results = read_results(out / RESULTS)
    own = load_rules(crew)
    rules: dict[str, Rules] = {}
    known: list[Scenario] = []
    for testbed in sorted({seen.testbed for seen in results.observations}):
        rules[testbed] = own if own.crew.name == testbed else load_rules(testbed)
        known += load_scenarios(scenarios or SHIPPED, rules[testbed])
    return publish_all(results, known, rules, out)


def _figures(options: OfflineOptions) -> int:
    paths = make_figures(options.out, options.scenarios, options.crew)
    if options.as_json:
        say_json({"files": [str(path) for path in paths]})
    else:
        say(f"figures: {', '.join(str(path) for path in paths)}")
    return 0


async def _substitution(options: OfflineOptions) -> int:
    if not 1 <= options.seeds <= MOST_SEEDS or options.seed < 0:
        raise UsageError(f"--seed {options.seed} --seeds {options.seeds}: from seed 0 up, 1 to {MOST_SEEDS} of them")
    rules = load_rules(options.crew)
    seeds = range(options.seed, options.seed + options.seeds)
    backends = [(c, seed, _backend(options.planning, c, seed, rules)) for c in Context for seed in seeds]
    study = await run_substitution(rules, options.planning.name, backends)
    options.out.mkdir(parents=True, exist_ok=True)
    text, data = (options.out / f"substitution-{rules.crew.name}.{end}" for end in ("md", "json"))
    text.write_text(page(study), encoding="utf-8")
    data.write_bytes(msgspec.json.format(msgspec.json.encode(study), indent=1) + b"\n")
    _tell(study, text, data, as_json=options.as_json)
    return 1 if study.passed else 0


def _backend(choice: PlannerChoice, context: Context, seed: int, rules: Rules) -> Backend:
    choice = msgspec.structs.replace(choice, context=context.value, fallback=False)
    check_choice(choice, os.environ)
    sim = rules.crew.sim
    if sim is not None:
        crew = msgspec.structs.replace(rules.crew, sim=msgspec.structs.replace(sim, seed=seed))
        rules = msgspec.structs.replace(rules, crew=crew)
    return make_backend(choice, rules, os.environ)


def _tell(study: Substitutions, text: Path, data: Path, *, as_json: bool) -> None:
    counts = {
        context.value: {
            name: sum((o.context, o.became) == (context.value, name) for o in study.outcomes)
            for name in ("invented", "verbatim", "substituted", "dropped")
        }
        for context in Context
    }
    if as_json:
        say_json({"contexts": counts, "accepted": len(study.passed), "results": str(data)})
        return
    for context, found in counts.items():
        say(f"{context:10} {', '.join(f'{count} {name}' for name, count in found.items())}")
    say(f"accepted by the gate: {len(study.passed)} of {len(study.outcomes)} plans; the page is {text}")

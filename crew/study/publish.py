"""What a study leaves for people and machines in its folder, from its missions alone."""

from collections.abc import Mapping, Sequence
from pathlib import Path

import msgspec

from crew.contracts.site import Rules
from crew.home import replace_file
from crew.study.figures import write_figures, write_reports
from crew.study.metrics import Table, tabulate
from crew.study.observation import Results
from crew.study.scenario import Scenario

RESULTS = "results.json"
BOOTSTRAP_SEED = 0
"""Of the intervals that are drawn by chance: the same missions give the same digits."""


class Published(Results, frozen=True, kw_only=True):
    """`results.json`: every figure as numerator, denominator and interval, and every mission behind them."""

    tables: tuple[Table, ...] = ()


def publish(results: Results, scenarios: Sequence[Scenario], rules: Rules, out: Path) -> None:
    """Write everything anew. A figure that is not defined is null."""
    publish_all(results, scenarios, {rules.crew.name: rules}, out)


def publish_all(
    results: Results, scenarios: Sequence[Scenario], rules: Mapping[str, Rules], out: Path
) -> tuple[Path, ...]:
    """The same for several crews in one folder; the files, `results.json` first. Others' missions stay uncounted.

    Raises UsageError for missions that may not be mixed.
    """
    known = {(scenario.testbed, scenario.name) for scenario in scenarios}
    seen = [o for o in results.observations if (o.testbed, o.scenario) in known]
    found = tabulate(seen, scenarios, rules, BOOTSTRAP_SEED) if seen else ()
    whole = Published(version=results.version, observations=results.observations, tables=found)
    written = msgspec.json.format(msgspec.json.encode(whole), indent=1) + b"\n"
    replace_file(out / RESULTS, written, durable=True)
    write_reports((o.run for o in seen), out)
    return (out / RESULTS, *(write_figures(found, out) if found else ()))

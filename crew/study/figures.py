"""From the missions of a study to its figures on disk: JSON, CSV, Markdown, LaTeX and a page."""

from collections.abc import Iterable, Mapping
from pathlib import Path

import msgspec

from crew.contracts.site import Rules
from crew.home import replace_file
from crew.study.metrics import Table, tabulate
from crew.study.observation import Observation, Results
from crew.study.page_html import page
from crew.study.page_text import csv_text, latex, markdown
from crew.study.scenario import Scenario

NAMES = ("results.json", "figures.csv", "figures.md", "figures.tex", "figures.html")


class Figures(msgspec.Struct, frozen=True, kw_only=True):
    """`results.json` in the end: every mission, and every figure with its numerator, denominator and intervals."""

    version: str
    seed: int
    """The bootstrap's: the first seed of the study."""
    tables: tuple[Table, ...]
    observations: tuple[Observation, ...]


def figures_of(results: Results, scenarios: Iterable[Scenario], rules: Mapping[str, Rules]) -> Figures:
    """The figures of a study. Raises UsageError for missions that may not be mixed, or of no known scenario."""
    seed = min((seen.seed for seen in results.observations), default=0)
    tables = tabulate(results.observations, scenarios, rules, seed)
    return Figures(version=results.version, seed=seed, tables=tables, observations=results.observations)


def write_figures(figures: Figures, out: Path) -> tuple[Path, ...]:
    """Write all five files; the paths, in the order of `NAMES`."""
    out.mkdir(parents=True, exist_ok=True)
    texts = (
        msgspec.json.format(msgspec.json.encode(figures), indent=1).decode() + "\n",
        csv_text(figures.tables),
        markdown(figures.tables),
        latex(figures.tables),
        page(figures.tables, out),
    )
    paths = tuple(out / name for name in NAMES)
    for path, text in zip(paths, texts, strict=True):
        replace_file(path, text.encode("utf-8"), durable=False)
    return paths

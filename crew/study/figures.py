"""From a study's tables to files that people read: CSV, Markdown, LaTeX and a page."""

from collections.abc import Iterable, Sequence
from pathlib import Path

from crew.errors import CrewError
from crew.home import Home, replace_file
from crew.report.page import write_report
from crew.study.metrics import Table
from crew.study.page_html import page
from crew.study.page_text import csv_text, latex, markdown
from crew.study.worker import STATE
from crew.verify import REPORT

JOURNAL = "journal.db"
NAMES = ("figures.csv", "figures.md", "figures.tex", "figures.html")
PAGE = NAMES[-1]


def write_reports(runs: Iterable[str], out: Path) -> int:
    """A page for each run of a study that has none; how many were written.

    A run whose folder is gone, or whose journal is no journal, is left out: a figure then links to its folder.
    """
    written = 0
    for run in runs:
        folder = out / run
        if (folder / JOURNAL).is_file() and not (folder / REPORT).exists():
            try:
                write_report(folder, Home(out / STATE))
            except (CrewError, OSError):
                continue
            written += 1
    return written


def write_figures(tables: Sequence[Table], out: Path) -> tuple[Path, ...]:
    """Write all of them into a study's folder; the paths, in the order of `NAMES`."""
    texts = (csv_text(tables), markdown(tables), latex(tables), page(tables, out))
    paths = tuple(out / name for name in NAMES)
    for path, text in zip(paths, texts, strict=True):
        replace_file(path, text.encode("utf-8"), durable=False)
    return paths

"""From a study's tables to files that people read: CSV, Markdown, LaTeX and a page."""

from collections.abc import Sequence
from pathlib import Path

from crew.home import replace_file
from crew.study.metrics import Table
from crew.study.page_html import page
from crew.study.page_text import csv_text, latex, markdown

NAMES = ("figures.csv", "figures.md", "figures.tex", "figures.html")
PAGE = NAMES[-1]


def write_figures(tables: Sequence[Table], out: Path) -> tuple[Path, ...]:
    """Write all of them into a study's folder; the paths, in the order of `NAMES`."""
    texts = (csv_text(tables), markdown(tables), latex(tables), page(tables, out))
    paths = tuple(out / name for name in NAMES)
    for path, text in zip(paths, texts, strict=True):
        replace_file(path, text.encode("utf-8"), durable=False)
    return paths

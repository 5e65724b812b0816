"""The report of a run: `report.html` in its folder, made from the journal and nothing else."""

from pathlib import Path

from crew.history.explanation import Explainer
from crew.history.history import History, MissionHistory, read_history
from crew.home import Home, replace_file
from crew.report import run as whole
from crew.report.html import Html, join, tag
from crew.report.mission import mission_section
from crew.report.style import STYLE
from crew.verify import REPORT, VerifyReport

MAX_MISSIONS = 100
"""Missions that are told in full; of a longer run the last ones."""
_POLICY = "default-src 'none'; style-src 'unsafe-inline'"
"""Nothing runs and nothing is fetched, whatever a request says."""


def write_report(
    folder: Path,
    home: Home,
    *,
    key_file: Path | None = None,
    to: Path | None = None,
    most: int = MAX_MISSIONS,
    ended: bool = False,
) -> tuple[Path, bool]:
    """Write the page, by default into the run's folder; its path, and whether the run verifies.

    `most`: of so many missions, the last ones, everything is told; of the others how they ended.
    `ended`: nobody writes into the run any more, though its crew's name may still be held.
    Raises UsageError if there is no run, and OSError if the page can't be written.
    """
    history, report = read_history(folder, home, key_file=key_file)
    text = page(history, report, folder, running=not ended and home.goes_on(folder), most=most)
    path = folder / REPORT if to is None else to
    replace_file(path, text.encode("utf-8"), durable=False)
    return path, report.holds


def page(history: History, report: VerifyReport, folder: Path, *, running: bool, most: int = MAX_MISSIONS) -> str:
    """A history as HTML."""
    missions = list(history.missions.values())
    body = tag(
        "main",
        whole.head(history, report),
        whole.verdict(report, running=running, folder=folder),
        whole.overview(history),
        _missions(missions, history, folder, most),
        whole.robots(history),
        whole.notes(history),
        whole.origin(history, report),
    )
    header = tag(
        "head",
        tag("meta", charset="utf-8"),
        tag("meta", http_equiv="Content-Security-Policy", content=_POLICY),
        tag("meta", name="viewport", content="width=device-width, initial-scale=1"),
        tag("title", f"{report.run}: crew report"),
        Html(f"<style>{STYLE}</style>"),
    )
    return "<!doctype html>\n" + tag("html", header, tag("body", body), lang="en") + "\n"


def _missions(missions: list[MissionHistory], history: History, folder: Path, most: int) -> Html | None:
    if history.rules is None or not missions:
        return None
    explainer, told = Explainer(folder, history), missions[-most:]
    numbered = len(missions) > 1
    first = len(missions) - len(told) + 1
    words = f"Of the first {first - 1} missions no more is told here; up to {MAX_MISSIONS}: crew report {folder.name}"
    left_out = tag("p", words, class_="soft") if first > 1 else None
    sections = [
        mission_section(m, explainer, history.rules, history.last_ns, f"{n}. " if numbered else "")
        for n, m in enumerate(told, start=first)
    ]
    return join([left_out, sections])

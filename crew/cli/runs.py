"""`crew runs` and `crew verify`: what was recorded, and whether it holds."""

from pathlib import Path

import msgspec

from crew.cli.output import coloured, say, say_json, table
from crew.cli.session import home
from crew.errors import JournalError, UsageError
from crew.journal_reader import read_records
from crew.verify import JOURNAL, REPORT, Replay, verify_run
from crew.visible import one_line


class RunSummary(msgspec.Struct, frozen=True, kw_only=True):
    """One run, as its journal tells it."""

    run: str
    records: int
    missions: tuple[str, ...]
    requests: tuple[str, ...]
    outcome: str
    report: str
    """Its page, or empty if there is none yet."""


def run_runs(folder: Path, as_json: bool) -> int:
    """List the runs of a folder, oldest first."""
    found = [summarise(path.parent) for path in sorted(folder.glob(f"*/{JOURNAL}"))]
    if as_json:
        say_json(found)
        return 0
    if not found:
        say(f"no runs in {folder.absolute()}; make one with crew demo, or name another folder with --runs")
        return 0
    for line in table(
        {
            "run": s.run,
            "records": str(s.records),
            "outcome": s.outcome,
            "report": REPORT if s.report else "-",
            "request": one_line("; ".join(s.requests), 60),
        }
        for s in found
    ):
        say(line)
    say("why it went as it did: crew explain RUN; as a page: crew report RUN")
    return 0


def summarise(folder: Path) -> RunSummary:
    """A run's requests and its last word; a journal that can't be read says so."""
    replay, problem = Replay(), ""
    try:
        for row in read_records(folder / JOURNAL):
            replay.take(row)
    except JournalError as error:
        problem = f"unreadable: {error}"
    states = replay.states.values()
    return RunSummary(
        run=folder.name,
        records=replay.counts.total(),
        missions=tuple(s.id for s in states),
        requests=tuple(s.request for s in states),
        outcome=problem or ", ".join(str(s.phase) for s in states) or "no mission",
        report=str(folder / REPORT) if (folder / REPORT).is_file() else "",
    )


def run_verify(run: Path, runs: Path, key: Path | None, as_json: bool) -> int:
    """0 only if chain, signatures and every decision hold."""
    folder = find_run(run, runs)
    report = verify_run(folder, home(), key_file=key)
    if as_json:
        say_json({"run": str(folder), "holds": report.holds, **msgspec.to_builtins(report)})
        return 0 if report.holds else 1
    counts = ", ".join(f"{kind} {n}" for kind, n in sorted(report.replayed.items()))
    say(f"{folder}: {report.records} records ({counts})")
    for note in report.notes:
        say(f"note: {note}")
    for problem in report.problems:
        say(coloured(f"PROBLEM: {problem}", "red"))
    if report.holds:
        say(coloured("chain, signatures and every decision hold", "green"))
    return 0 if report.holds else 1


def find_run(run: Path, runs: Path) -> Path:
    """A run by its folder, its name, or `last`. Raises UsageError."""
    if str(run) == "last":
        found = sorted(path.parent for path in runs.glob(f"*/{JOURNAL}"))
        if not found:
            raise UsageError(
                f"no runs in {runs.absolute()}; make one with crew demo, or name another folder with --runs"
            )
        return found[-1]
    for folder in (run, runs / run):
        if (folder / JOURNAL).is_file():
            return folder
    raise UsageError(f"no run in {run}, nor in {runs / run}; list them with crew runs")

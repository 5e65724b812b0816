"""`crew verify --against`: a past run decided by changed contracts or another crew."""

from pathlib import Path

import msgspec

from crew.cli.output import coloured, say, say_json
from crew.cli.runs import find_run
from crew.cli.session import home
from crew.errors import UsageError
from crew.history.against import Comparison, Difference, compare
from crew.history.changed_rules import changed_rules
from crew.history.history import read_history
from crew.verify import VerifyReport
from crew.visible import one_line

DIFFERS = 6
"""The exit code of a run that would have been decided otherwise."""


def run_against(run: Path, files: list[Path], runs: Path, key: Path | None, as_json: bool) -> int:
    """0 if nothing would have been decided otherwise, 6 if something would; 1 if the run itself does not verify."""
    folder = find_run(run, runs)
    history, report = read_history(folder, home(), key_file=key)
    if history.rules is None or history.foreign:
        found = one_line(report.problems[0], 400) if report.problems else "it holds no rules"
        raise UsageError(f"{folder.name} can't be decided by other rules: {found}")
    comparison = compare(history, changed_rules(history.rules, files))
    if as_json:
        say_json(_json(folder, files, report, comparison))
    else:
        _say(files, report, comparison)
    if not report.holds:
        return 1
    return DIFFERS if comparison.differences else 0


def _json(folder: Path, files: list[Path], report: VerifyReport, comparison: Comparison) -> dict[str, object]:
    return {
        "run": str(folder),
        "holds": report.holds,
        "problems": report.problems,
        "against": [str(path) for path in files],
        "same": not comparison.differences,
        **msgspec.to_builtins(comparison),
    }


def _say(files: list[Path], report: VerifyReport, comparison: Comparison) -> None:
    if not report.holds:
        say(coloured("THIS RUN DOES NOT VERIFY: do not rely on what follows (crew verify)", "red"))
    for difference in comparison.differences:
        _say_difference(difference)
    if comparison.unreached:
        numbers = ", ".join(map(str, comparison.unreached))
        say(f"would not have come to this, since a mission went another way before: {numbers}")
    names = ", ".join(path.name for path in files)
    if comparison.differences:
        found = f"{len(comparison.differences)} of {comparison.compared} verdicts would have been otherwise"
        say(coloured(f"against {names}: {found}", "amber"))
    else:
        say(coloured(f"against {names}: all {comparison.compared} verdicts would have been the same", "green"))


def _say_difference(difference: Difference) -> None:
    number = f"{difference.number:3}" if difference.number else "  -"
    say(f"{number}  {difference.mission}  {difference.at_s:7.2f} s  {one_line(difference.subject, 300)}")
    then_code = f"{difference.then_code}: " if difference.then_code else ""
    now_code = f"{difference.now_code}: " if difference.now_code else ""
    say(f"       then: {then_code}{one_line(difference.then, 600)}")
    say(coloured(f"       now:  {now_code}{one_line(difference.now, 600)}", "amber"))

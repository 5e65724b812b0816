"""`crew report`: a run as one HTML page."""

from pathlib import Path

from crew.cli.output import coloured, say
from crew.cli.runs import find_run
from crew.cli.session import home
from crew.errors import UsageError
from crew.report.page import write_report


def run_report(run: Path, runs: Path, key: Path | None, to: Path | None) -> int:
    """0 if the page was written and the run verifies, 1 if it does not verify: the page says so."""
    folder = find_run(run, runs)
    try:
        path, holds = write_report(folder, home(), key_file=key, to=to)
    except OSError as error:
        where = folder if to is None else to.parent
        raise UsageError(
            f"cannot write the report into {where}: {error.strerror}; name another file with --to"
        ) from error
    say(f"{path.absolute()}")
    if not holds:
        say(coloured("this run does not verify; the report says what was found (crew verify)", "red"))
    return 0 if holds else 1

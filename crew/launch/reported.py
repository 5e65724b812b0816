"""The report that every run leaves behind, written once its journal is closed. It never spoils the end of a run."""

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

from crew.errors import CrewError
from crew.home import Home
from crew.verify import JOURNAL

LARGEST_BYTES = 4 << 20
"""A larger journal takes longer than an end may: its report is made when somebody asks for it."""

MOST = 20
"""Missions that are told in full at once, for the same reason."""


@contextmanager
def reported(run_folder: Path, home: Home) -> Iterator[Callable[[], None]]:
    """Write the run's report on the way out, if the function that is given was not called before; from any thread.

    What goes wrong with it is said, and changes nothing else.
    """
    remark: str | None = None

    def write() -> None:
        nonlocal remark
        remark = _write(run_folder, home)

    try:
        yield write
    finally:
        if remark is None:
            write()
        if remark:
            print(f"no report yet: {remark}; make it with crew report {run_folder}", file=sys.stderr)


def _write(run_folder: Path, home: Home) -> str:
    """Why there is no report; empty if there is one, or nothing to report of."""
    journal = run_folder / JOURNAL
    if not journal.is_file():
        return ""
    if journal.stat().st_size > LARGEST_BYTES:
        return f"the journal has {journal.stat().st_size >> 20} MB"
    from crew.report.page import write_report

    try:
        write_report(run_folder, home, most=MOST, ended=True)
    except (CrewError, OSError) as error:
        return str(error)
    except Exception as error:
        return f"{type(error).__name__} {error}, which is a fault of the report"
    return ""

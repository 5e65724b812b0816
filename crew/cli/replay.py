"""`crew replay`: a run's page, on the screen or in a browser."""

import os
import signal
from pathlib import Path

from crew.actors.recorder.prepare import prepare
from crew.actors.recorder.rrd import FILE
from crew.actors.recorder.viewer_program import program
from crew.cli.output import say
from crew.cli.runs import find_run
from crew.cli.session import home
from crew.cli.viewer import served, show_on_screen, web_viewer
from crew.errors import UsageError


def run_replay(run: Path, runs: Path, web: bool, port: int, anew: bool) -> int:
    """0 once the viewer is closed, or after Ctrl-C with `web`."""
    folder = find_run(run, runs)
    _refuse_running(folder)
    program()
    prepared = prepare(folder, anew=anew)
    if prepared.note:
        say(f"{prepared.path}: {prepared.note}")
    if not web:
        show_on_screen(prepared.path, os.environ)
    with served(prepared.path, FILE) as source, web_viewer(source, port) as address:
        say(f"the page of {folder.name} is at {address}")
        say("end: Ctrl-C")
        _wait()
    return 0


def _wait() -> None:
    """Until Ctrl-C or SIGTERM; both end this in an orderly way."""
    signals = {signal.SIGINT, signal.SIGTERM}
    signal.pthread_sigmask(signal.SIG_BLOCK, signals)
    signal.sigwait(signals)


def _refuse_running(folder: Path) -> None:
    """A run that is still being made has no end to show."""
    for running in home().all_running():
        if Path(running.run_folder) == folder.absolute():
            raise UsageError(
                f"{folder} still runs (crew {running.crew}, process {running.pid}): end it with Ctrl-C there first; "
                f"to see a crew while it runs, bring it up with crew up --view"
            )

"""Draws a run from its journal, which is the authority: whole, or from where a killed recording ends."""

from importlib.metadata import version
from pathlib import Path

from crew.actors.recorder.page import Page
from crew.actors.recorder.teller import Teller


def rebuild(journal: Path, path: Path, *, after_ns: int = -1) -> None:
    """Draw everything that the journal tells of after `after_ns` of mission time.

    Lanes, decisions and proposals are as they were; poses are known only at the moments when something was decided.
    Raises UsageError for a journal of another version, JournalError for one that can't be read.
    """
    teller = Teller(journal)
    began = teller.began
    facts = {"version": began.version, "rerun": version("rerun-sdk"), "crew": teller.rules.crew.name}
    page = Page(teller.rules, began.run, path, facts={**facts, "planner": began.planner, "rebuilt": "from the journal"})
    for stamp, entry in teller.tell():
        if stamp.at_ns > after_ns:
            page.write(stamp, entry)
    page.close("drawn from the journal")

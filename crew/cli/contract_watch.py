"""`crew contracts check --watch`: checks again whenever a file that it read has changed."""

import asyncio
import sys
from collections.abc import AsyncIterator, Callable, Sequence
from pathlib import Path

from crew.cli.contract_check import run_check
from crew.cli.output import coloured, say
from crew.clock import WALL, Clock
from crew.errors import CrewError
from crew.library import CONTRACTS, CREWS, crew_path

POLL_S = 0.25
Stamps = dict[Path, tuple[int, int]]
"""Time of the last change and size of each file; a file that is not there has none."""


def run_watch(files: Sequence[Path], crew: str, as_json: bool, limit: int) -> int:
    """Until Ctrl-C. What can't be read, or is not proved, is said; then the next change is waited for."""
    return asyncio.run(
        _watch(lambda: run_check(files, crew, as_json, limit), lambda: watched(files, crew), WALL, as_json)
    )


def watched(files: Sequence[Path], crew: str) -> Stamps:
    """The files that a check reads: those that were named, the crew's, and every contract beside them."""
    folders = {CONTRACTS, CREWS} if not files and not crew else set[Path]()
    found = {path.absolute() for path in files}
    if crew:
        path = crew_path(crew)
        found.add(path.absolute())
        folders |= {path.parent, path.parent / "contracts", CONTRACTS}
    for folder in folders:
        found.update(path.absolute() for path in folder.glob("*.yaml"))
    return {path: stamp for path in found if (stamp := _stamp(path)) is not None}


def _stamp(path: Path) -> tuple[int, int] | None:
    try:
        status = path.stat()
    except OSError:
        return None
    return status.st_mtime_ns, status.st_size


async def changes(stamps: Callable[[], Stamps], clock: Clock) -> AsyncIterator[None]:
    """Once at the beginning, and then once for each change that has come to rest: editors write in pieces."""
    seen: Stamps | None = None
    while True:
        now = stamps()
        if now != seen:
            seen = now if seen is None else await _at_rest(now, stamps, clock)
            yield
        await clock.sleep(POLL_S)


async def _at_rest(now: Stamps, stamps: Callable[[], Stamps], clock: Clock) -> Stamps:
    while True:
        await clock.sleep(POLL_S)
        later = stamps()
        if later == now:
            return now
        now = later


async def _watch(check: Callable[[], int], stamps: Callable[[], Stamps], clock: Clock, as_json: bool) -> int:
    async for _ in changes(stamps, clock):
        try:
            check()
        except CrewError as error:
            print(f"crew: {error}", file=sys.stderr)
        if not as_json:
            say(coloured("waiting for a change (Ctrl-C ends)", "dim"))
    return 0

"""Makes a run ready to be shown: a whole recording is taken as it is, a broken one is mended, a missing one drawn."""

import os
import tempfile
from pathlib import Path

import msgspec

from crew.actors.recorder.rrd import FILE, compact, is_whole, unfinished
from crew.verify import JOURNAL

COMPACT_S = 120.0


class Prepared(msgspec.Struct, frozen=True):
    """A file that a viewer can show, and what had to be done to it, in a sentence."""

    path: Path
    note: str = ""


def prepare(folder: Path, *, anew: bool = False) -> Prepared:
    """The recording of a run. `anew` draws it from the journal even if there is one.

    Raises UsageError if there is neither, and for a journal of another version.
    """
    path = folder / FILE
    if not anew and is_whole(path):
        if unfinished(path).exists():
            compact([path], path, timeout_s=COMPACT_S)
        return Prepared(path)
    if anew or not path.is_file() or path.stat().st_size == 0:
        return _drawn(folder)
    return _mended(folder)


def _drawn(folder: Path) -> Prepared:
    """Draw the whole run from its journal."""
    from crew.actors.recorder.rebuild import rebuild

    path = _writable(folder)
    fresh = path.with_name(f".{FILE}.{os.getpid()}")
    try:
        rebuild(folder / JOURNAL, fresh)
        compact([fresh], fresh, timeout_s=COMPACT_S)
        os.replace(fresh, path)
    finally:
        fresh.unlink(missing_ok=True)
    return Prepared(path, "drawn from the journal: poses are known only at the moments of decisions")


def _mended(folder: Path) -> Prepared:
    """Keep what a killed recorder wrote, and draw what came after from the journal."""
    from crew.actors.recorder.rebuild import rebuild
    from crew.actors.recorder.remains import NOTHING, remains

    path = _writable(folder)
    kept, rest = (path.with_name(f".{part}.{os.getpid()}.rrd") for part in ("kept", "rest"))
    try:
        left = remains(kept) if compact([folder / FILE], kept, timeout_s=COMPACT_S) else NOTHING
        if left is NOTHING:
            return _drawn(folder)
        rebuild(folder / JOURNAL, rest, after_ns=left.told_ns)
        if not compact([kept, rest], path, timeout_s=COMPACT_S):
            return _drawn(folder)
    finally:
        for part in (kept, rest):
            part.unlink(missing_ok=True)
    return Prepared(
        path, f"mended: it was cut off at {left.end_ns / 1e9:.1f} s of mission time; the rest is from the journal"
    )


def _writable(folder: Path) -> Path:
    """Where the recording can be written: the run's folder, or one of our own if that is read-only."""
    if os.access(folder, os.W_OK):
        return folder / FILE
    return Path(tempfile.mkdtemp(prefix="crew-replay-")) / FILE

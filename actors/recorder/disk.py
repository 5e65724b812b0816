"""Keeps a recording from filling the disk that the journal needs: without its journal a crew ends."""

import shutil
from pathlib import Path

from crew.clock import WALL, seconds_ns

RESERVE_BYTES = 256 << 20
"""A recording ends before less than this is free."""
MAX_BYTES = 2 << 30
"""A recording ends before it is larger than this."""
CHECK_EVERY_NS = seconds_ns(1.0)


class DiskGuard:
    """Looks at the disk now and then."""

    def __init__(self, path: Path) -> None:
        self._path = path
        self._due_ns = 0

    def problem(self) -> str:
        """Why recording must end now; empty if it need not."""
        if WALL.now_ns() < self._due_ns:
            return ""
        self._due_ns = WALL.now_ns() + CHECK_EVERY_NS
        try:
            free, size = shutil.disk_usage(self._path.parent).free, self._path.stat().st_size
        except OSError as error:
            return f"recording of {self._path} ends: {error}"
        if free < RESERVE_BYTES:
            return (
                f"recording of {self._path} ends: {free >> 20} MB free < {RESERVE_BYTES >> 20} MB kept for the journal"
            )
        if size > MAX_BYTES:
            return f"recording of {self._path} ends: {size >> 20} MB > {MAX_BYTES >> 20} MB"
        return ""

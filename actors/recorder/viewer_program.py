"""The viewer's own program, found without importing it: the command on the path is a wrapper that orphans it."""

import os
from importlib.util import find_spec
from pathlib import Path

from crew.errors import UsageError

PACKAGE = "rerun_cli"


def program() -> Path:
    """The program's path. Raises UsageError if it is not installed."""
    spec = find_spec(PACKAGE)
    for folder in (spec.submodule_search_locations or ()) if spec is not None else ():
        found = Path(folder) / "rerun"
        if found.is_file() and os.access(found, os.X_OK):
            return found
    raise UsageError("the viewer is not installed: install robot-crew[view] (pip install 'robot-crew[view]')")

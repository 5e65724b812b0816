"""The command line answers at once: help loads nothing that only a run needs."""

import json
import sys

from tests.unit.project.tree import run

HEAVY = {"pydantic", "ruamel", "mujoco", "pymavlink", "zenoh", "numpy", "rich", "cryptography", "uvloop", "sqlite3"}
PROBE = """
import json, sys
from crew.cli.main import app
try:
    app(["--help"], standalone_mode=True)
except SystemExit as end:
    assert not end.code, end.code
print("\\n" + json.dumps(sorted({name.partition(".")[0] for name in sys.modules})))
"""


def test_help_loads_nothing_heavy() -> None:
    done = run(sys.executable, "-c", PROBE)
    assert done.returncode == 0, done.stderr
    loaded = set(json.loads(done.stdout.splitlines()[-1]))
    assert "typer" in loaded
    assert loaded & HEAVY == set()

"""The project's files as git knows them, for tests that look at all of them."""

import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).parents[3]
LINKS = ("actors", "adapters", "contracts", "sim")
BIN = Path(sys.executable).parent


def committed() -> list[Path]:
    """Paths of all files under version control, relative to the root. Skips nothing."""
    listed = subprocess.run(["git", "ls-files", "-z"], cwd=ROOT, capture_output=True, check=True).stdout.decode()
    return [Path(name) for name in listed.split("\0") if name and (ROOT / name).exists()]


def sources() -> list[Path]:
    """Every committed Python file, once: not through the links."""
    return [path for path in committed() if path.suffix == ".py"]


def run(*command: str | Path, cwd: Path = ROOT) -> "subprocess.CompletedProcess[str]":
    """A finished command with its output; never waits for input."""
    return subprocess.run(
        [str(part) for part in command], cwd=cwd, capture_output=True, text=True, stdin=subprocess.DEVNULL, timeout=120
    )

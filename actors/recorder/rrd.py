"""Recording files: whether one is whole, and making one small and whole again with Rerun's own program."""

import ctypes
import os
import signal
import subprocess
from pathlib import Path

from crew.actors.recorder.viewer_program import program

FILE = "run.rrd"
END_MARK = b"RRF2FOOT"
"""What a file that was closed in an orderly way ends with: the mark of its index."""
_TAIL = 64
_PR_SET_PDEATHSIG = 1


def is_whole(path: Path) -> bool:
    """Whether a file was closed in an orderly way; a killed recorder leaves one that was not."""
    try:
        with path.open("rb") as file:
            file.seek(max(0, path.stat().st_size - _TAIL))
            return END_MARK in file.read()
    except OSError:
        return False


def compact(parts: list[Path], path: Path, *, timeout_s: float) -> bool:
    """Join parts of one recording in `path`, small and with an index; whether that was done within the time.

    `path` may be one of the parts. It is replaced at once or not at all.
    """
    fresh = unfinished(path)
    command = [str(program()), "rrd", "optimize", "--continue-on-error", "-o", str(fresh), *map(str, parts)]
    try:
        done = subprocess.run(
            command,
            check=False,
            timeout=timeout_s,
            stdin=subprocess.DEVNULL,
            capture_output=True,
            env=quiet(),
            preexec_fn=die_with_parent,
        )
        if done.returncode == 0 and is_whole(fresh):
            os.replace(fresh, path)
            return True
    except (subprocess.TimeoutExpired, OSError):
        pass
    finally:
        fresh.unlink(missing_ok=True)
    return False


def unfinished(path: Path) -> Path:
    """Where a recording is being made small. Left over, it tells that whoever did so was ended."""
    return path.with_name(f".{path.name}.fresh")


_LIBC = ctypes.CDLL(None)


def die_with_parent() -> None:
    """Run in a child before it becomes Rerun's program: it must not outlive this process, however that ends."""
    _LIBC.prctl(_PR_SET_PDEATHSIG, signal.SIGKILL)


def quiet() -> dict[str, str]:
    """The environment for Rerun's program: it tells nobody on the network that it was used."""
    return {**os.environ, "RERUN_ANALYTICS": "false", "DO_NOT_TRACK": "1"}

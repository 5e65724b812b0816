"""Which version of the project a study was run with: the package's, and a digest of every file that it consists of."""

import hashlib
from functools import cache
from importlib.metadata import version
from pathlib import Path

import crew

PARTS = (".py", ".yaml", ".xml", ".json")


@cache
def study_version() -> str:
    """`0.1.0+` and ten digits of the digest of the installed source; scenarios and rates of errors included."""
    root = Path(crew.__file__).parent
    found = hashlib.sha256()
    for path in sorted(_files(root), key=lambda p: p.relative_to(root).as_posix()):
        found.update(path.relative_to(root).as_posix().encode() + b"\0" + path.read_bytes() + b"\0")
    return f"{version('robot-crew')}+{found.hexdigest()[:10]}"


def _files(root: Path) -> list[Path]:
    """Through the links of a checkout as well, which `rglob` does not follow."""
    found = []
    for entry in root.iterdir():
        if entry.is_dir() and entry.name != "__pycache__":
            found += _files(entry)
        elif entry.suffix in PARTS:
            found.append(entry)
    return found

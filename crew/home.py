"""The state folder of the crew's owner: keys, epochs, journal heads, and which crews run."""

import fcntl
import os
import time
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path

import msgspec

from crew.bus.link import Link
from crew.errors import UsageError
from crew.keys import checked_chunk


class Running(msgspec.Struct, frozen=True, kw_only=True):
    """A crew that runs: who holds it, where its run and its router are."""

    crew: str
    pid: int
    run_folder: str
    endpoint: str
    guests: str
    """Where the router takes guests in."""
    certificates: str
    started_wall_ns: int

    def link(self, role: str) -> Link:
        """The way of a role to this crew's router."""
        return Link(role=role, endpoint=self.endpoint, crew=self.crew, certificates=self.certificates)


class Home:
    """The folder at `path`.

    It holds `keys/`, `certificates/<crew>/`, `epochs/<crew>`, `stops/<crew>.json`, `heads/<run>.json` and
    `running/<crew>.json`.
    """

    def __init__(self, path: Path) -> None:
        self.path = path

    @classmethod
    def of(cls, environment: Mapping[str, str]) -> "Home":
        """`$CREW_HOME`, else `$XDG_STATE_HOME/crew`, else `~/.local/state/crew`."""
        if own := environment.get("CREW_HOME"):
            return cls(Path(own))
        if state := environment.get("XDG_STATE_HOME"):
            return cls(Path(state) / "crew")
        return cls(Path.home() / ".local" / "state" / "crew")

    @property
    def keys(self) -> Path:
        return self.path / "keys"

    def certificates(self, crew: str) -> Path:
        """Where a crew's authority and certificates lie; crews do not share one."""
        return self._folder("certificates").absolute() / checked_chunk(crew, "crew name")

    @property
    def proofs(self) -> Path:
        """Where proofs of contracts are kept."""
        return self._folder("proofs")

    def head(self, run_id: str) -> Path:
        """Where the signed head of a run's journal is kept outside the run's folder."""
        return self._folder("heads") / f"{checked_chunk(run_id, 'run id')}.json"

    def stop(self, crew: str) -> Path:
        """Where the stop that holds a crew is kept, so that it outlives every process."""
        return self._folder("stops") / f"{checked_chunk(crew, 'crew name')}.json"

    def epoch(self, crew: str) -> int:
        """The crew's last epoch; 0 before its first."""
        return _read_epoch(self._folder("epochs") / checked_chunk(crew, "crew name"))

    def next_epoch(self, crew: str) -> int:
        """A new epoch, greater than every one before, on disk before it is returned."""
        path = self._folder("epochs") / checked_chunk(crew, "crew name")
        with path.with_name(f"{path.name}.lock").open("a") as lock:
            fcntl.flock(lock, fcntl.LOCK_EX)
            epoch = _read_epoch(path) + 1
            replace_file(path, str(epoch).encode(), durable=True)
        return epoch

    @contextmanager
    def claim(self, crew: str, run_folder: Path, endpoint: str, guests: str = "") -> Iterator[Running]:
        """Hold the crew's name for this process; UsageError naming the holder if another one runs."""
        running = Running(
            crew=checked_chunk(crew, "crew name"),
            pid=os.getpid(),
            run_folder=str(run_folder.absolute()),
            endpoint=endpoint,
            guests=guests,
            certificates=str(self.certificates(crew)),
            started_wall_ns=time.time_ns(),
        )
        path = self._folder("running") / f"{crew}.json"
        with path.open("a+b") as file:
            if not _locked(file.fileno(), fcntl.LOCK_EX):
                raise UsageError(_already_runs(crew, path))
            _rewrite(file.fileno(), msgspec.json.encode(running))
            try:
                yield running
            finally:
                _rewrite(file.fileno(), b"")

    def running(self, crew: str) -> Running | None:
        """The crew of this name if it runs now."""
        path = self._folder("running") / f"{checked_chunk(crew, 'crew name')}.json"
        if not path.exists():
            return None
        with path.open("rb") as file:
            return None if _locked(file.fileno(), fcntl.LOCK_SH) else _read_running(path)

    def all_running(self) -> list[Running]:
        """Every crew that runs now, by name."""
        names = sorted(path.stem for path in self._folder("running").glob("*.json"))
        return [running for name in names if (running := self.running(name)) is not None]

    def goes_on(self, run_folder: Path) -> bool:
        """Whether a crew that runs now writes into this folder."""
        return any(Path(running.run_folder) == run_folder.absolute() for running in self.all_running())

    def _folder(self, name: str) -> Path:
        folder = self.path / name
        try:
            folder.mkdir(mode=0o700, parents=True, exist_ok=True)
        except OSError as error:
            raise UsageError(
                f"unusable state folder {folder}: {error.strerror}; set CREW_HOME to a folder of your own"
            ) from error
        return folder


def replace_file(path: Path, content: bytes, *, durable: bool) -> None:
    """Put `content` in place of the file, atomically; with `durable` it is on disk on return."""
    fresh = path.with_name(f".{path.name}.{os.getpid()}")
    with fresh.open("wb") as file:
        file.write(content)
        if durable:
            file.flush()
            os.fsync(file.fileno())
    os.replace(fresh, path)
    if durable:
        folder = os.open(path.parent, os.O_RDONLY | os.O_DIRECTORY)
        try:
            os.fsync(folder)
        finally:
            os.close(folder)


def _read_epoch(path: Path) -> int:
    try:
        text = path.read_text()
    except FileNotFoundError:
        return 0
    if not (text.isascii() and text.isdigit()):
        raise UsageError(f"broken epoch in {path}: {text[:20]!r} is no number; write the crew's last epoch there")
    return int(text)


def _locked(fd: int, kind: int) -> bool:
    try:
        fcntl.flock(fd, kind | fcntl.LOCK_NB)
    except BlockingIOError:
        return False
    return True


def _rewrite(fd: int, content: bytes) -> None:
    os.ftruncate(fd, 0)
    os.write(fd, content)


def _read_running(path: Path) -> Running | None:
    try:
        return msgspec.json.decode(path.read_bytes(), type=Running)
    except msgspec.MsgspecError:
        return None


def _already_runs(crew: str, path: Path) -> str:
    holder = _read_running(path)
    who = f"process {holder.pid}, run {holder.run_folder}" if holder else "a process that is just starting or ending"
    return f"crew {crew!r} already runs: {who}; end it with Ctrl-C there, or give this one another name"

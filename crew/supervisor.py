"""Starts, watches and ends the crew's processes by dotted name. Imports none of them; the child's side is `process`."""

import asyncio
import os
import socket
import subprocess
import sys
import threading
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from pathlib import Path
from types import TracebackType
from typing import Any, Self

import msgspec

from crew.errors import CrewError, UsageError
from crew.process import STOP_GRACE_S, Failed, Ready, Stop

KILL_AFTER_S = 0.3
"""How long beyond its grace a child may take to end before it is killed."""
LAST_LINES = 8
_LAST_BYTES = 4096


class Child(msgspec.Struct, frozen=True, kw_only=True):
    """One process: `python -m module`, its `spec` handed over as msgpack in a file. `last`: ends after all others.

    `secrets` are environment variables that children which do not list them are not given.
    """

    name: str
    module: str
    spec: Any = None
    last: bool = False
    secrets: tuple[str, ...] = ()
    optional: bool = False
    """Nobody needs it: its failure is told as an exit, whenever it comes."""
    niceness: int = 0
    """Above 0 it leaves the processor to the others, its own imports included."""
    grace_s: float = STOP_GRACE_S
    """How long it may take to end when everybody waits for the end."""
    ease_s: float = STOP_GRACE_S
    """The same when nothing presses: nobody has interrupted anything."""


@dataclass(frozen=True, slots=True)
class Exit:
    """A process that ended without being asked. `code` is negative for a signal; `said` are its own last words."""

    name: str
    code: int
    said: str


@dataclass(eq=False)
class _Running:
    child: Child
    process: subprocess.Popen[bytes]
    control: socket.socket
    log: Path
    ready: asyncio.Future[None]
    ended: asyncio.Event
    failure: Failed | None = None
    asked: bool = False


class Supervisor:
    """Owns its children for the time of an `async with`, on the main thread; none survives it.

    `on_exit` is called on the loop within 0.2 s of the death of a child that had become ready. `meanwhile` is called in
    a thread while those that are last end: everybody else has ended by then. Children write to
    `<run folder>/logs/<name>.log`.
    """

    def __init__(
        self, run_folder: Path, *, on_exit: Callable[[Exit], None], meanwhile: Callable[[], None] = lambda: None
    ) -> None:
        self._folder = run_folder
        self._on_exit, self._meanwhile = on_exit, meanwhile
        self._running: dict[str, _Running] = {}
        self._group = asyncio.TaskGroup()
        self._secrets: set[str] = set()

    async def __aenter__(self) -> Self:
        if threading.current_thread() is not threading.main_thread():
            raise CrewError("supervisor off the main thread: children die with the thread that made them; move it")
        (self._folder / "logs").mkdir(parents=True, exist_ok=True)
        (self._folder / "spec").mkdir(exist_ok=True)
        await self._group.__aenter__()
        return self

    async def __aexit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        try:
            await self.stop(pressed=kind is not None)
        finally:
            cancelled = isinstance(error, asyncio.CancelledError)
            await self._group.__aexit__(kind if cancelled else None, error if cancelled else None, trace)

    @property
    def pids(self) -> dict[str, int]:
        """Process ids of the children that live."""
        return {name: running.process.pid for name, running in self._running.items()}

    async def start(self, children: Iterable[Child], *, ready_timeout_s: float) -> None:
        """Spawn all at once and await every readiness; CrewError with a child's last log lines if one fails."""
        children = list(children)
        self._secrets |= {name for child in children for name in child.secrets}
        started = [self._spawn(child) for child in children]
        awaited = [running for running in started if not running.child.optional]
        if awaited:
            ready = [running.ready for running in awaited]
            await asyncio.wait(ready, timeout=ready_timeout_s, return_when=asyncio.FIRST_EXCEPTION)
        for running in sorted(awaited, key=lambda running: not running.ready.done()):
            if not running.ready.done():
                what = f"{running.child.name} is not ready: nothing after {ready_timeout_s} s"
                raise CrewError(f"{what}; {_where(running)}")
            running.ready.result()

    async def await_optional(self, timeout_s: float) -> None:
        """Give those that nobody needs a while to become ready; whether they do is not said."""
        waiting = [running.ready for running in self._running.values() if running.child.optional]
        if waiting:
            await asyncio.wait(waiting, timeout=timeout_s)

    async def restart(self, child: Child, *, ready_timeout_s: float) -> None:
        """End the child of this name if it lives, and start it anew."""
        if (old := self._running.get(child.name)) is not None:
            await self._end([old])
        await self.start([child], ready_timeout_s=ready_timeout_s)

    async def stop(self, *, pressed: bool = True) -> None:
        """End every child: the clients together, then those that are last; a stuck one is killed after its grace."""
        await self._end([running for running in self._running.values() if not running.child.last], pressed)
        meanwhile = asyncio.ensure_future(asyncio.to_thread(self._meanwhile))
        try:
            await self._end(list(self._running.values()), pressed)
        finally:
            await meanwhile

    def _spawn(self, child: Child) -> _Running:
        if child.name in self._running:
            raise UsageError(f"two children named {child.name!r} in {self._folder}: rename one of them")
        spec = self._folder / "spec" / f"{child.name}.msgpack"
        spec.write_bytes(msgspec.msgpack.encode(child.spec))
        log = self._folder / "logs" / f"{child.name}.log"
        withheld = self._secrets - set(child.secrets)
        ours, theirs = socket.socketpair()
        with theirs, log.open("ab") as output:
            process = subprocess.Popen(
                [sys.executable, "-P", "-m", child.module, str(theirs.fileno()), str(os.getpid()), str(spec)],
                stdin=subprocess.DEVNULL,
                stdout=output,
                stderr=subprocess.STDOUT,
                pass_fds=[theirs.fileno()],
                env={name: value for name, value in os.environ.items() if name not in withheld},
                process_group=0,
            )
        if child.niceness:
            os.setpriority(os.PRIO_PROCESS, process.pid, child.niceness)
        ours.setblocking(False)
        ready: asyncio.Future[None] = asyncio.get_running_loop().create_future()
        running = _Running(child, process, ours, log, ready, asyncio.Event())
        self._running[child.name] = running
        self._group.create_task(self._watch(running))
        return running

    async def _watch(self, running: _Running) -> None:
        """Hear the child out until its end of the socket closes, which its death does at once."""
        try:
            with running.control:
                await self._hear_out(running)
            code = await asyncio.to_thread(running.process.wait)
        except asyncio.CancelledError:
            running.process.kill()
            running.process.wait()
            raise
        finally:
            self._running.pop(running.child.name, None)
            running.ended.set()
        self._tell_end(running, code)

    async def _hear_out(self, running: _Running) -> None:
        loop = asyncio.get_running_loop()
        heard = b""
        while chunk := await _received(loop, running.control):
            *lines, heard = (heard + chunk).split(b"\n")
            try:
                for line in lines:
                    self._hear(running, msgspec.json.decode(line, type=Ready | Failed))
            except msgspec.MsgspecError as error:
                running.failure = Failed(f"it spoke nonsense on its control socket ({error}); killed", 1)
                running.process.kill()
                return

    def _hear(self, running: _Running, word: Ready | Failed) -> None:
        if isinstance(word, Failed):
            running.failure = word
        elif not running.ready.done():
            running.ready.set_result(None)

    def _tell_end(self, running: _Running, code: int) -> None:
        if not running.ready.done():
            running.ready.set_exception(_never_ready(running, code))
            running.ready.exception()
        if not running.asked and (running.child.optional or running.ready.exception() is None):
            said = running.failure.text if running.failure is not None else _last_lines(running.log)
            self._on_exit(Exit(running.child.name, code, said))

    async def _end(self, leaving: list[_Running], pressed: bool = True) -> None:
        graces_s = [running.child.grace_s if pressed else running.child.ease_s for running in leaving]
        for running, grace_s in zip(leaving, graces_s, strict=True):
            running.asked = True
            _ask_to_stop(running.control, grace_s)
        try:
            async with asyncio.timeout(max(graces_s, default=0.0) + KILL_AFTER_S):
                await _all_ended(leaving)
        except TimeoutError:
            pass
        finally:
            for running in leaving:
                if not running.ended.is_set():
                    running.process.kill()
        await _all_ended(leaving)


async def _all_ended(leaving: list[_Running]) -> None:
    for running in leaving:
        await running.ended.wait()


async def _received(loop: asyncio.AbstractEventLoop, control: socket.socket) -> bytes:
    try:
        return await loop.sock_recv(control, 4096)
    except ConnectionError:
        return b""


def _ask_to_stop(control: socket.socket, grace_s: float) -> None:
    try:
        control.send(msgspec.json.encode(Stop(grace_s)) + b"\n")
    except OSError:
        return


def _never_ready(running: _Running, code: int) -> CrewError:
    name = running.child.name
    if running.failure is None:
        return CrewError(f"{name} is not ready: it ended with code {code}; {_where(running)}")
    kind = UsageError if running.failure.exit_code == UsageError.exit_code else CrewError
    return kind(f"{name} is not ready: {running.failure.text} ({running.log})")


def _where(running: _Running) -> str:
    return f"see {running.log}, which ends with:\n{_last_lines(running.log)}"


def _last_lines(log: Path) -> str:
    with log.open("rb") as file:
        file.seek(max(0, log.stat().st_size - _LAST_BYTES))
        lines = file.read().decode(errors="replace").splitlines()
    return "\n".join(lines[-LAST_LINES:]) or "(nothing)"

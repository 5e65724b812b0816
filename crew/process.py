"""What a child process of the crew does first and last. The parent's side is `crew.supervisor`."""

import asyncio
import ctypes
import os
import signal
import socket
import sys
import threading
import traceback
from collections.abc import Awaitable, Callable
from pathlib import Path
from typing import NoReturn, TypeVar

import msgspec
import uvloop

from crew.errors import CrewError, UsageError

T = TypeVar("T")

STOP_GRACE_S = 0.5
"""From being asked to stop to being gone, finished or not, unless the parent gives more."""
EXIT_STUCK = 75
"""Exit code of a child that did not end within the grace."""

SWITCH_S = 0.001
"""How long a busy loop may keep the interpreter from a thread of the bus, such as the one that stops a robot."""

_PR_SET_PDEATHSIG = 1


class Ready(msgspec.Struct, frozen=True, tag="ready"):
    """The child does its work from now on."""


class Failed(msgspec.Struct, frozen=True, tag="failed"):
    """The child ends because of an error; `exit_code` is the one that it leaves with."""

    text: str
    exit_code: int


class Stop(msgspec.Struct, frozen=True, tag="stop"):
    """The parent asks the child to end; the end of the stream means the same."""

    grace_s: float = STOP_GRACE_S


class ChildContext:
    """What a child's `main` is given. It is cancelled when the parent asks for the end, and then has its grace."""

    def __init__(self, control: socket.socket, spec_path: Path) -> None:
        self._control = control
        self._spec_path = spec_path

    def spec(self, spec_type: type[T]) -> T:
        """The child's specification; UsageError if the file does not hold one."""
        try:
            return msgspec.msgpack.decode(self._spec_path.read_bytes(), type=spec_type)
        except (OSError, msgspec.MsgspecError) as error:
            raise UsageError(
                f"unreadable child specification {self._spec_path}: {error}; start the crew with `crew up`"
            ) from error

    def ready(self) -> None:
        """Tell the parent that this child works."""
        self._send(Ready())

    def _send(self, message: Ready | Failed) -> None:
        try:
            self._control.sendall(msgspec.json.encode(message) + b"\n")
        except OSError:
            self._control.close()


def run_child(main: Callable[[ChildContext], Awaitable[None]]) -> NoReturn:
    """Run an actor's `main` on uvloop as a child of the supervisor; never returns.

    To be called on the main thread, from `if __name__ == "__main__"`. Arguments come from the supervisor.
    """
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    sys.setswitchinterval(SWITCH_S)
    control_fd, parent_pid, spec_path = _arguments()
    _die_with_parent(parent_pid)
    context = ChildContext(socket.socket(fileno=control_fd), spec_path)
    with asyncio.Runner(loop_factory=uvloop.new_event_loop) as runner:
        code = runner.run(_supervised(main, context))
        _leave(code)


async def _supervised(main: Callable[[ChildContext], Awaitable[None]], context: ChildContext) -> int:
    """Run `main` until it returns, fails or is asked to stop; the exit code."""
    task = asyncio.ensure_future(_awaited(main, context))
    asked = threading.Event()
    loop = asyncio.get_running_loop()
    watcher = threading.Thread(target=_watch, args=(context._control, loop, task, asked), name="control", daemon=True)
    watcher.start()
    try:
        await task
    except asyncio.CancelledError:
        return 0 if asked.is_set() else 1
    except CrewError as error:
        print(error, file=sys.stderr)
        return _failed(context, str(error), error.exit_code)
    except BaseException as error:
        traceback.print_exc()
        return _failed(context, _summary(error), 1)
    return 0


async def _awaited(main: Callable[[ChildContext], Awaitable[None]], context: ChildContext) -> None:
    await main(context)


def _failed(context: ChildContext, text: str, exit_code: int) -> int:
    context._send(Failed(text, exit_code))
    return exit_code


def _summary(error: BaseException) -> str:
    """The innermost single error of nested groups, as a sentence."""
    while isinstance(error, BaseExceptionGroup) and len(error.exceptions) == 1:
        error = error.exceptions[0]
    return str(error) if isinstance(error, CrewError) else f"{type(error).__name__}: {error}"


def _watch(
    control: socket.socket, loop: asyncio.AbstractEventLoop, task: "asyncio.Future[None]", asked: threading.Event
) -> None:
    """Wait for the parent's word or its end, then ask politely, then leave. On a daemon thread."""
    grace_s = _await_stop(control)
    asked.set()
    try:
        loop.call_soon_threadsafe(task.cancel)
    except RuntimeError:
        if not loop.is_closed():
            raise
    threading.Event().wait(grace_s)
    _leave(EXIT_STUCK)


def _await_stop(control: socket.socket) -> float:
    """The grace that the parent gives, once it asks for the end or is gone."""
    heard = b""
    while b"\n" not in heard:
        try:
            chunk = control.recv(4096)
        except OSError:
            return STOP_GRACE_S
        if not chunk:
            return STOP_GRACE_S
        heard += chunk
    return msgspec.json.decode(heard.partition(b"\n")[0], type=Stop).grace_s


def _arguments() -> tuple[int, int, Path]:
    try:
        control_fd, parent_pid, spec_path = sys.argv[1:]
        return int(control_fd), int(parent_pid), Path(spec_path)
    except ValueError:
        print(f"{sys.argv[0]} is a part of a crew: it is started by `crew up`, not by hand", file=sys.stderr)
        _leave(UsageError.exit_code)


def _die_with_parent(parent_pid: int) -> None:
    """Have the kernel kill this process when its parent dies; leave if that has happened already."""
    if sys.platform == "linux":
        ctypes.CDLL(None, use_errno=True).prctl(_PR_SET_PDEATHSIG, signal.SIGKILL)
    if os.getppid() != parent_pid:
        _leave(1)


def _leave(code: int) -> NoReturn:
    """End at once: Zenoh's threads would hold up an ordinary exit."""
    try:
        sys.stdout.flush()
        sys.stderr.flush()
    finally:
        os._exit(code)

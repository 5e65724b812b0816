import asyncio
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from msgspec.structs import replace

from crew.errors import CrewError, UsageError
from crew.supervisor import Child, Exit, Supervisor
from tests.integration.runtime.child import Behaviour
from tests.integration.runtime.conftest import READY_S


def child(does: str, name: str = "actor") -> Child:
    return Child(name=name, module="tests.integration.runtime.child", spec=Behaviour(does))


def lives(pid: int) -> bool:
    try:
        return Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0] != "Z"
    except (FileNotFoundError, ProcessLookupError):
        return False


def gone(pids: list[int], within_s: float) -> bool:
    deadline = time.monotonic() + within_s
    while left := any(lives(pid) for pid in pids):
        if time.monotonic() > deadline:
            break
        time.sleep(0.005)
    return not left


async def test_children_start_together_and_stop_with_nothing_left(tmp_path: Path) -> None:
    exits: list[Exit] = []
    async with Supervisor(tmp_path, on_exit=exits.append) as supervisor:
        await supervisor.start([child("wait", "a"), child("wait", "b")], ready_timeout_s=READY_S)
        pids = list(supervisor.pids.values())
        assert len(pids) == 2
        began = time.monotonic()
    assert time.monotonic() - began < 2.0
    assert not any(lives(pid) for pid in pids)
    assert exits == []
    assert (tmp_path / "logs" / "a.log").read_text() == "behaves as wait\n"


async def test_a_usage_error_in_a_child_is_the_callers(supervisor: Supervisor) -> None:
    with pytest.raises(UsageError, match=r"actor is not ready: crew\.yaml:3:1: unknown robot 'irsi'"):
        await supervisor.start([child("usage")], ready_timeout_s=READY_S)


async def test_a_bug_before_ready_is_named(supervisor: Supervisor) -> None:
    with pytest.raises(CrewError, match="ZeroDivisionError: a bug"):
        await supervisor.start([child("wait", "healthy"), child("bug")], ready_timeout_s=READY_S)


async def test_a_child_that_is_never_ready_is_quoted(supervisor: Supervisor) -> None:
    with pytest.raises(CrewError, match=r"actor is not ready: nothing after 1.0 s.*(\n.*)*still waiting for the"):
        await supervisor.start([child("never_ready")], ready_timeout_s=1.0)


async def test_whom_nobody_needs_is_waited_for_a_while_only(supervisor: Supervisor, tmp_path: Path) -> None:
    await supervisor.start([replace(child("wait", "late"), optional=True)], ready_timeout_s=READY_S)
    await supervisor.await_optional(READY_S)
    assert (tmp_path / "logs" / "late.log").read_text() == "behaves as wait\n"
    await supervisor.start([replace(child("never_ready", "never"), optional=True)], ready_timeout_s=READY_S)
    await supervisor.await_optional(0.05)
    assert set(supervisor.pids) == {"late", "never"}


async def test_a_child_that_speaks_nonsense_is_killed(supervisor: Supervisor) -> None:
    with pytest.raises(CrewError, match="nonsense"):
        await supervisor.start([child("nonsense")], ready_timeout_s=READY_S)


async def test_an_unknown_module_is_quoted_from_the_log(supervisor: Supervisor) -> None:
    with pytest.raises(CrewError, match=r"No module named crew\.nothing"):
        await supervisor.start([Child(name="x", module="crew.nothing")], ready_timeout_s=READY_S)


async def test_an_unexpected_exit_is_noticed_within_200_ms(tmp_path: Path) -> None:
    seen: asyncio.Queue[Exit] = asyncio.Queue()
    async with Supervisor(tmp_path, on_exit=seen.put_nowait) as supervisor:
        await supervisor.start([child("wait")], ready_timeout_s=READY_S)
        os.kill(supervisor.pids["actor"], signal.SIGKILL)
        async with asyncio.timeout(0.2):
            end = await seen.get()
        assert (end.name, end.code) == ("actor", -signal.SIGKILL)
        assert end.said == "behaves as wait"
        assert supervisor.pids == {}
        await supervisor.start([child("wait")], ready_timeout_s=READY_S)


async def test_a_stuck_child_is_gone_within_2_s(tmp_path: Path) -> None:
    async with Supervisor(tmp_path, on_exit=lambda end: None) as supervisor:
        await supervisor.start([child("stuck")], ready_timeout_s=READY_S)
        pid = supervisor.pids["actor"]
        began = time.monotonic()
    assert time.monotonic() - began < 2.0
    assert not lives(pid)


async def test_a_frozen_child_is_gone_within_2_s(tmp_path: Path) -> None:
    async with Supervisor(tmp_path, on_exit=lambda end: None) as supervisor:
        await supervisor.start([child("wait")], ready_timeout_s=READY_S)
        os.kill(supervisor.pids["actor"], signal.SIGSTOP)
        began = time.monotonic()
    assert time.monotonic() - began < 2.0


async def test_what_is_done_meanwhile_has_the_clients_behind_it_and_does_not_wait_for_the_last(tmp_path: Path) -> None:
    pids: dict[str, int] = {}
    lived: list[dict[str, bool]] = []

    def meanwhile() -> None:
        lived.append({name: lives(pid) for name, pid in pids.items()})

    async with Supervisor(tmp_path, on_exit=lambda end: None, meanwhile=meanwhile) as supervisor:
        last = replace(child("stuck", "last"), last=True)
        await supervisor.start([child("wait", "client"), last], ready_timeout_s=READY_S)
        pids |= supervisor.pids
    assert lived == [{"client": False, "last": True}]


async def test_restart_replaces_the_process(supervisor: Supervisor, exits: list[Exit]) -> None:
    await supervisor.start([child("wait")], ready_timeout_s=READY_S)
    before = supervisor.pids["actor"]
    await supervisor.restart(child("wait"), ready_timeout_s=READY_S)
    assert supervisor.pids["actor"] != before
    assert not lives(before)
    assert exits == []


async def test_two_children_of_one_name_are_refused(supervisor: Supervisor) -> None:
    with pytest.raises(UsageError, match="two children named 'actor'"):
        await supervisor.start([child("wait"), child("wait")], ready_timeout_s=READY_S)


async def test_the_supervisor_belongs_on_the_main_thread(tmp_path: Path) -> None:
    async def enter() -> None:
        async with Supervisor(tmp_path, on_exit=lambda end: None):
            pass

    with pytest.raises(CrewError, match="main thread"):
        await asyncio.to_thread(asyncio.run, enter())


async def test_a_failing_exit_callback_ends_the_body_and_every_child(tmp_path: Path) -> None:
    def fail(end: Exit) -> None:
        raise ZeroDivisionError

    pids: list[int] = []

    async def body() -> None:
        async with Supervisor(tmp_path, on_exit=fail) as supervisor:
            await supervisor.start([child("wait", "a"), child("wait", "b")], ready_timeout_s=READY_S)
            pids.extend(supervisor.pids.values())
            os.kill(pids[0], signal.SIGKILL)
            await asyncio.sleep(READY_S)

    with pytest.raises(ExceptionGroup):
        await body()
    assert not any(lives(pid) for pid in pids)


PARENT = """
import asyncio, pathlib, sys
from crew.supervisor import Supervisor
from tests.integration.runtime.test_supervisor import child
async def main():
    async with Supervisor(pathlib.Path(sys.argv[1]), on_exit=print) as supervisor:
        await supervisor.start([child("wait", "a"), child("stuck", "b")], ready_timeout_s=20)
        print(*supervisor.pids.values(), flush=True)
        await asyncio.sleep(60)
asyncio.run(main())
"""


@pytest.mark.parametrize(("end", "within_s"), [(signal.SIGINT, 2.0), (signal.SIGKILL, 1.0)])
def test_nothing_is_left_after_the_supervisors_end(tmp_path: Path, end: signal.Signals, within_s: float) -> None:
    command = [sys.executable, "-c", PARENT, str(tmp_path)]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True) as parent:
        assert parent.stdout is not None
        pids = [int(pid) for pid in parent.stdout.readline().split()]
        assert len(pids) == 2
        parent.send_signal(end)
        assert gone([*pids, parent.pid], within_s)


def test_a_child_started_by_hand_says_so() -> None:
    done = subprocess.run([sys.executable, "-m", "crew.router"], capture_output=True, text=True, timeout=20)
    assert done.returncode == UsageError.exit_code
    assert "started by `crew up`" in done.stderr

import asyncio
import os
import signal
from collections.abc import AsyncIterator
from pathlib import Path

import pytest

from crew.access import ROUTER
from crew.authority import establish
from crew.bus.link import Link
from crew.bus.port import Body, Qos, Sample
from crew.bus.zenoh import ZenohBus
from crew.errors import BusError, UsageError
from crew.router import RouterSpec
from crew.supervisor import Child, Exit, Supervisor
from tests.integration.runtime.child import Behaviour
from tests.integration.runtime.conftest import READY_S
from tests.unit.crew.bus.bus_suite import WAIT_S, BusSuite, Settle, events, next_text, text


@pytest.fixture
async def routed(supervisor: Supervisor, router: Child) -> None:
    await supervisor.start([router], ready_timeout_s=READY_S)


@pytest.fixture
async def two(routed: None, endpoint: str) -> AsyncIterator[tuple[ZenohBus, ZenohBus]]:
    async with (
        ZenohBus(Link(role="first", endpoint=endpoint)) as first,
        ZenohBus(Link(role="second", endpoint=endpoint)) as second,
    ):
        yield first, second


@pytest.fixture
def settle(two: tuple[ZenohBus, ZenohBus]) -> Settle:
    """Declarations travel in order, so that a token seen by the other side proves what was declared before it."""
    count = 0

    async def wait() -> None:
        nonlocal count
        count += 1
        for mine, other in (two, two[::-1]):
            seen = asyncio.Event()
            watch = other.watch_liveliness(f"settle/{id(mine)}/{count}", lambda key, alive, seen=seen: seen.set())  # type: ignore[misc]
            token = mine.token(f"settle/{id(mine)}/{count}")
            async with asyncio.timeout(WAIT_S):
                await seen.wait()
            token.close()
            watch.close()

    return wait


class TestZenohBus(BusSuite):
    pass


async def test_no_router_is_a_clear_error(endpoint: str) -> None:
    async def enter() -> None:
        async with ZenohBus(Link(role="planner", endpoint=endpoint), timeout_s=0.1):
            pass

    with pytest.raises(BusError, match=f"no router for planner on {endpoint}: nothing after 0.1 s"):
        await enter()


async def test_a_taken_port_is_a_usage_error(
    supervisor: Supervisor, routed: None, endpoint: str, tmp_path: Path
) -> None:
    establish(tmp_path / "certificates", [ROUTER])
    taken = endpoint.replace("tcp/", "tls/")
    link = Link(role=ROUTER, endpoint=taken, crew="t", certificates=str(tmp_path / "certificates"))
    rival = Child(name="rival", module="crew.router", spec=RouterSpec(link=link, robots=()))
    with pytest.raises(UsageError, match=f"port in use: the router was to listen on {taken}.*choose another port"):
        await supervisor.start([rival], ready_timeout_s=READY_S)


async def test_a_bug_in_a_callback_ends_the_body_with_it(routed: None, endpoint: str) -> None:
    def bug(sample: Sample) -> None:
        raise ZeroDivisionError

    async def body() -> None:
        async with ZenohBus(Link(role="a", endpoint=endpoint)) as bus:
            bus.on_sample("crew/t/a", bug)
            bus.put("crew/t/a", text("x"), qos=Qos.EVENT)
            await asyncio.sleep(WAIT_S)

    with pytest.raises(ZeroDivisionError):
        await body()


async def test_a_closed_bus_says_so(routed: None, endpoint: str) -> None:
    bus = ZenohBus(Link(role="a", endpoint=endpoint))
    async with bus:
        pass
    with pytest.raises(BusError, match="bus refused a on crew/t/a"):
        bus.put("crew/t/a", text("x"), qos=Qos.EVENT)


async def test_closing_ends_what_is_still_asked(routed: None, endpoint: str) -> None:
    async def never(question: Sample) -> Body:
        await asyncio.sleep(60)
        raise AssertionError

    async with ZenohBus(Link(role="a", endpoint=endpoint)) as bus:
        bus.queryable("crew/t/a", never)
        asked = asyncio.ensure_future(bus.query("crew/t/a", text("?"), timeout_s=60))
        await asyncio.sleep(0)
    async with asyncio.timeout(WAIT_S):
        assert await asked == []


async def test_a_restarted_router_brings_everything_back(
    supervisor: Supervisor, router: Child, exits: list[Exit], endpoint: str, tmp_path: Path
) -> None:
    echo = Child(name="echo", module="tests.integration.runtime.child", spec=Behaviour("echo", endpoint))
    await supervisor.start([router, echo], ready_timeout_s=READY_S)
    async with ZenohBus(Link(role="asker", endpoint=endpoint)) as bus:
        alive: asyncio.Queue[bool] = asyncio.Queue()
        pongs = events()
        bus.watch_liveliness("crew/t/*/alive", lambda key, is_alive: alive.put_nowait(is_alive))
        bus.subscribe("crew/t/pong", pongs)
        async with asyncio.timeout(READY_S):
            assert await alive.get() is True
            os.kill(supervisor.pids["router"], signal.SIGKILL)
            assert await alive.get() is False
            await supervisor.restart(router, ready_timeout_s=READY_S)
            assert await alive.get() is True
            while not await bus.query("crew/t/echo", text("?"), timeout_s=0.2):
                pass
            bus.put("crew/t/ping", text("back"), qos=Qos.ACTUATION)
            assert await next_text(pongs) == "back"


async def test_a_killed_client_is_seen_by_its_token(supervisor: Supervisor, router: Child, endpoint: str) -> None:
    echo = Child(name="echo", module="tests.integration.runtime.child", spec=Behaviour("echo", endpoint))
    await supervisor.start([router, echo], ready_timeout_s=READY_S)
    async with ZenohBus(Link(role="watcher", endpoint=endpoint)) as bus:
        alive: asyncio.Queue[bool] = asyncio.Queue()
        bus.watch_liveliness("crew/t/echo/alive", lambda key, is_alive: alive.put_nowait(is_alive))
        async with asyncio.timeout(WAIT_S):
            assert await alive.get() is True
            os.kill(supervisor.pids["echo"], signal.SIGKILL)
            assert await alive.get() is False

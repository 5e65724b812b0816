"""A crew in which some actors run in threads of the test, so that a test can block their loops or reach inside."""

import asyncio
import os
import signal
import threading
from collections.abc import AsyncIterator, Awaitable, Callable
from contextlib import AsyncExitStack, asynccontextmanager
from typing import Any, Self, TypeVar

import msgspec

from crew.actors.orchestrator import process as orchestrator_process
from crew.actors.robot import process as robot_process
from crew.adapter import Adapter
from crew.authority import establish
from crew.bus.port import Bus
from crew.bus.zenoh import ZenohBus
from crew.clock import Clock
from crew.contracts.site import RobotSpec, Rules
from crew.launch.live import new_run_folder
from crew.launch.options import LaunchOptions
from crew.launch.ready import await_ready
from crew.launch.single import InlineContext
from crew.launch.site import resolve
from crew.launch.table import Trust, loopback_endpoints, process_table, roles
from crew.packed import unpack
from crew.supervisor import Child, Supervisor
from tests.integration.crew.harness import NAME, Desk, Watch, watching

T = TypeVar("T")
READY_S = 30.0


class ActorThread:
    """One actor on a loop of its own, with a session of its own."""

    def __init__(self, child: Child) -> None:
        self.child = child
        self.loop: asyncio.AbstractEventLoop
        self._task: asyncio.Task[None]
        self._ready = threading.Event()
        self._thread = threading.Thread(target=self._run, name=child.name, daemon=True)
        self.failure: BaseException | None = None

    def __enter__(self) -> Self:
        self._thread.start()
        assert self._ready.wait(READY_S), f"{self.child.name} is not ready"
        return self

    def __exit__(self, *_: object) -> None:
        self.loop.call_soon_threadsafe(self._task.cancel)
        self._thread.join(READY_S)
        assert not self._thread.is_alive()

    def block(self, work: Callable[[], None]) -> threading.Event:
        """Keep the loop busy with a call that does not yield; set when it has ended."""
        over = threading.Event()

        def run() -> None:
            work()
            over.set()

        self.loop.call_soon_threadsafe(run)
        return over

    async def inside(self, work: Callable[[], Awaitable[T]]) -> T:
        """Run something on the actor's loop."""

        async def run() -> T:
            return await work()

        return await asyncio.wrap_future(asyncio.run_coroutine_threadsafe(run(), self.loop))

    def _run(self) -> None:
        try:
            asyncio.run(self._main())
        except asyncio.CancelledError:
            pass
        except BaseException as error:
            self.failure = error

    async def _main(self) -> None:
        self.loop = asyncio.get_running_loop()
        task = asyncio.current_task()
        assert task is not None
        self._task = task
        context: Any = InlineContext(self.child.spec)
        async with ZenohBus(self.child.spec.link) as bus:
            telling = asyncio.create_task(self._tell_ready(context))
            try:
                await self._serve(bus, context)
            finally:
                telling.cancel()

    async def _tell_ready(self, context: InlineContext) -> None:
        await context.started.wait()
        self._ready.set()

    async def _serve(self, bus: Bus, context: Any) -> None:
        spec = self.child.spec
        serve = orchestrator_process.serve if self.child.name == "orchestrator" else robot_process.serve
        await serve(spec, unpack(spec.rules), bus, context)


class ThreadedCrew:
    """A crew that is up, with what its threads hold."""

    def __init__(
        self,
        watch: Watch,
        threads: dict[str, ActorThread],
        adapters: dict[str, Adapter],
        supervisor: Supervisor,
        children: dict[str, Child],
    ) -> None:
        self.watch, self.threads, self.adapters = watch, threads, adapters
        self.supervisor, self.children = supervisor, children

    async def restart(self, name: str, **changes: Any) -> None:
        """Kill one of the processes, and start it anew with changes to what it is started with."""
        if name in self.supervisor.pids:
            os.kill(self.supervisor.pids[name], signal.SIGKILL)
        child = self.children[name]
        child = msgspec.structs.replace(child, spec=msgspec.structs.replace(child.spec, **changes))
        await self.supervisor.restart(child, ready_timeout_s=READY_S)


@asynccontextmanager
async def crew_with_threads(desk: Desk, *names: str, speed: float = 0.0) -> AsyncIterator[ThreadedCrew]:
    """Bring a crew up; the named actors run here."""
    options = LaunchOptions(crew=NAME, speed=speed, port=0, runs=desk.runs)
    rules = resolve(options)
    folder = new_run_folder(desk.runs, NAME)
    establish(desk.home.certificates(NAME), roles(rules.crew))
    endpoint, guests = loopback_endpoints()
    adapters: dict[str, Adapter] = {}
    make_adapter = robot_process.make_adapter

    def remembered(
        robot: RobotSpec, rules: Rules, connection: str, clock: Clock, *, models: str = "", enforced: bool = True
    ) -> Adapter:
        adapters[robot.name] = adapter = make_adapter(robot, rules, connection, clock, models=models, enforced=enforced)
        return adapter

    robot_process.make_adapter = remembered
    try:
        async with AsyncExitStack() as stack:
            running = stack.enter_context(desk.home.claim(NAME, folder, endpoint, guests))
            children = process_table(
                rules,
                options,
                running=running,
                run_folder=folder,
                home=desk.home.path,
                trust=Trust.anew(desk.home, NAME),
            )
            supervisor = await stack.enter_async_context(Supervisor(folder, on_exit=lambda _: None))
            await supervisor.start([c for c in children if c.name not in names], ready_timeout_s=READY_S)
            threads = {}
            for child in children:
                if child.name in names:
                    threads[child.name] = ActorThread(child)
                    await asyncio.to_thread(threads[child.name].__enter__)
                    stack.push_async_callback(asyncio.to_thread, threads[child.name].__exit__)
            watch = await stack.enter_async_context(watching(running))
            robots = [robot.name for robot in rules.crew.robots]
            await await_ready(watch.bus, watch.keys, robots, timeout_s=READY_S, died=lambda: "")
            yield ThreadedCrew(watch, threads, adapters, supervisor, {c.name: c for c in children})
    finally:
        robot_process.make_adapter = make_adapter

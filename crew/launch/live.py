"""A crew that lives for the time of an `async with`: folders, claim, processes, readiness, and an orderly end."""

import asyncio
import json
import os
import time
from collections.abc import AsyncIterator, Callable
from contextlib import AbstractContextManager, AsyncExitStack, asynccontextmanager, nullcontext
from importlib.util import find_spec
from pathlib import Path

from crew.actors.planner.choice import check_choice
from crew.authority import establish
from crew.bus.port import Bus
from crew.bus.zenoh import ZenohBus
from crew.contracts.proof.report import Progress
from crew.contracts.site import Rules
from crew.errors import UsageError
from crew.history.contract_text import keep_contracts
from crew.home import Home, Running
from crew.keys import Keys
from crew.launch.options import LaunchOptions
from crew.launch.ready import await_ready
from crew.launch.reported import reported
from crew.launch.site import resolve
from crew.launch.table import OPERATOR, RECORDER, Trust, free_tcp_ports, process_table, roles
from crew.messages import CrewStatus
from crew.proofs import ensure_proved
from crew.supervisor import Exit, Supervisor

READY_S = 40.0
RECORDER_S = 2.0
"""Wall time for which a crew that is up waits for its recorder to listen, so that a first request is drawn whole."""
UNSECURED = "UNSECURED: simulation only (--single-process: one process holds every role's key)"


class LiveCrew:
    """A crew that is up: where it is, what it was made from, and who has died since."""

    def __init__(
        self,
        rules: Rules,
        running: Running,
        bus: Bus,
        exits: "asyncio.Queue[Exit]",
        pids: dict[str, int],
        *,
        unsecured: bool,
    ) -> None:
        self.rules, self.running, self.run_folder = rules, running, Path(running.run_folder)
        self.bus, self.exits, self.pids = bus, exits, pids
        self.unsecured = unsecured
        """One process holds every role's key."""
        self.keys = Keys(rules.crew.name)
        self.status: CrewStatus
        self.view_port = 0
        """Where the recorder serves the page on loopback; 0 if nothing is recorded."""

    @property
    def name(self) -> str:
        return self.rules.crew.name


@asynccontextmanager
async def live_crew(
    options: LaunchOptions,
    home: Home,
    progress: Callable[[], AbstractContextManager[Progress | None]] = nullcontext,
    *,
    rules: Rules | None = None,
) -> AsyncIterator[LiveCrew]:
    """Bring a crew up; yield it once a round trip through its keys has shown every robot; bring it down.

    `rules` are what the options resolve to, if that was done before.
    """
    rules = rules or resolve(options)
    check_choice(options.planning, os.environ)
    establish(home.certificates(rules.crew.name), roles(rules.crew))
    with progress() as tell:
        ensure_proved(rules, home, tell)
    guests_port, router_port, page_port = free_tcp_ports(3)
    guests = f"tcp/127.0.0.1:{options.port or guests_port}"
    run_folder = new_run_folder(options.runs, rules.crew.name)
    exits: asyncio.Queue[Exit] = asyncio.Queue()
    async with AsyncExitStack() as stack:
        report = stack.enter_context(reported(run_folder, home))
        endpoint = f"tls/127.0.0.1:{router_port}"
        running = stack.enter_context(home.claim(rules.crew.name, run_folder, endpoint, guests))
        _write_resolved(rules, options, run_folder)
        view_port = page_port if _records(options) else None
        children = process_table(
            rules,
            options,
            running=running,
            run_folder=run_folder,
            home=home.path.absolute(),
            trust=Trust.anew(home, rules.crew.name),
            view_port=view_port,
        )
        if options.single_process:
            from crew.launch.single import SingleProcess

            runner: Supervisor | SingleProcess = SingleProcess(run_folder)
        else:
            runner = Supervisor(run_folder, on_exit=exits.put_nowait, meanwhile=report)
        await stack.enter_async_context(runner)
        await runner.start(children, ready_timeout_s=READY_S)
        bus = await stack.enter_async_context(ZenohBus(running.link(OPERATOR)))
        crew = LiveCrew(rules, running, bus, exits, runner.pids, unsecured=options.single_process)
        crew.view_port = view_port or 0
        names = [r.name for r in rules.crew.robots]
        crew.status = await await_ready(bus, crew.keys, names, timeout_s=READY_S, died=lambda: _first_exit(exits))
        if isinstance(runner, Supervisor):
            await runner.await_optional(RECORDER_S)
        yield crew


def _records(options: LaunchOptions) -> bool:
    """Whether this run has a recorder: not in one process with robots, and not without the viewer's package."""
    return options.record and not options.single_process and find_spec("rerun") is not None


def _first_exit(exits: "asyncio.Queue[Exit]") -> str:
    """Who has died already, in a sentence; empty if nobody has whom the crew needs."""
    while not exits.empty():
        first = exits.get_nowait()
        if first.name != RECORDER:
            return f"{first.name} died with code {first.code} while the crew came up: {first.said}"
    return ""


def new_run_folder(runs: Path, crew: str) -> Path:
    """`runs/<time>-<crew>`, made now. Raises UsageError if it can't be."""
    stamp = time.strftime("%Y%m%d-%H%M%S", time.gmtime())
    for suffix in ("", *(f"-{n}" for n in range(2, 100))):
        folder = (runs / f"{stamp}-{crew}{suffix}").absolute()
        try:
            folder.mkdir(parents=True)
        except FileExistsError:
            continue
        except OSError as error:
            raise UsageError(f"cannot make {folder}: {error.strerror}; choose another folder with --runs") from error
        return folder
    raise UsageError(f"a hundred runs began in one second in {runs}; wait a moment")


def _write_resolved(rules: Rules, options: LaunchOptions, run_folder: Path) -> None:
    """`crew.yaml` (JSON is YAML 1.2): what this run was made from, for people."""
    import msgspec

    resolved = {
        "crew": msgspec.to_builtins(rules.crew),
        "contracts": msgspec.to_builtins(dict(rules.contracts)),
        "options": {"speed": options.speed, "planner": msgspec.to_builtins(options.planning)},
    }
    text = "# As resolved at the start of this run. Written as JSON, which YAML 1.2 reads.\n"
    (run_folder / "crew.yaml").write_text(text + json.dumps(resolved, indent=2) + "\n")
    keep_contracts(run_folder, rules.contracts)

"""One role of a crew of real robots in this process, started by a service manager instead of by `crew up`."""

import asyncio
import importlib
import os
import time
from importlib.util import find_spec

from crew.access import ROBOT_PREFIX, Role
from crew.authority import check
from crew.errors import CrewError, UsageError, nearest
from crew.home import Home, Running
from crew.launch.live import new_run_folder
from crew.launch.options import LaunchOptions
from crew.launch.single import InlineContext
from crew.launch.site import resolve
from crew.launch.table import OPERATOR, ORCHESTRATOR, Trust, process_table
from crew.signing import load_or_create_key, load_public_key
from crew.supervisor import Child


def child_of(role: str, options: LaunchOptions, home: Home, *, router: str, guests: str) -> Child:
    """The process of this role as the table has it. Raises UsageError for what is missing in the state folder."""
    rules = resolve(options)
    if rules.crew.sim is not None:
        raise UsageError(f"{rules.crew.source} is simulated: its processes share a clock; bring it up with crew up")
    name = rules.crew.name
    decides, records = role == Role.ORCHESTRATOR, role == Role.RECORDER
    if records and find_spec("rerun") is None:
        raise UsageError("the recorder needs the package that draws: pip install 'robot-crew[view]'")
    keys = home.keys
    operator, orchestrator = b"", b""
    if decides or role.startswith(ROBOT_PREFIX):
        operator = load_public_key(keys / f"{OPERATOR}.pub")
        own = load_or_create_key(keys, ORCHESTRATOR).public if decides else b""
        orchestrator = own or load_public_key(keys / f"{ORCHESTRATOR}.pub")
    children = process_table(
        rules,
        options,
        running=running_at(name, home, router, guests),
        run_folder=new_run_folder(options.runs, name) if decides or records else options.runs,
        home=home.path.absolute(),
        trust=Trust(
            epoch=home.next_epoch(name) if decides else 0, operator_key=operator, orchestrator_key=orchestrator
        ),
        view_port=0 if records else None,
    )
    by_role = {_role(child, [r.name for r in rules.crew.robots]): child for child in children}
    if role not in by_role:
        raise UsageError(f"no role is called {role!r}{nearest(role, by_role)}")
    check(home.certificates(name), [role])
    return by_role[role]


def running_at(crew: str, home: Home, router: str, guests: str) -> Running:
    """The crew whose router listens there, with the certificates of this state folder."""
    return Running(
        crew=crew,
        pid=os.getpid(),
        run_folder="",
        endpoint=router,
        guests=guests,
        certificates=str(home.certificates(crew)),
        started_wall_ns=time.time_ns(),
    )


async def serve(child: Child, *, tell: str) -> None:
    """Run it until it ends or is cancelled; print `tell` once it serves."""
    os.nice(child.niceness)
    context = InlineContext(child.spec)
    main = asyncio.ensure_future(importlib.import_module(child.module).main(context))
    started = asyncio.ensure_future(context.started.wait())
    try:
        await asyncio.wait({main, started}, return_when=asyncio.FIRST_COMPLETED)
        if context.started.is_set():
            print(tell, flush=True)
        await main
        raise CrewError(f"{child.name} has ended by itself")
    finally:
        started.cancel()
        main.cancel()
        await asyncio.gather(main, started, return_exceptions=True)


def _role(child: Child, robots: list[str]) -> str:
    return f"{ROBOT_PREFIX}{child.name}" if child.name in robots else child.name

"""A simulated crew for one mission of the study, in this process: the shipped actors on the shipped bus.

The only place where a crew can be started without the gate in force. No file, option of `crew up` or message can.
"""

import os
import time
from collections.abc import AsyncIterator, Sequence
from contextlib import AsyncExitStack, asynccontextmanager
from pathlib import Path

import msgspec
from msgspec.structs import replace

from crew.actors.specs import OrchestratorSpec, RobotActorSpec
from crew.authority import establish
from crew.bus.port import Bus
from crew.bus.zenoh import ZenohBus
from crew.contracts.pass_through import RealRobots, require_simulated
from crew.contracts.site import Rules
from crew.errors import UsageError
from crew.home import Home, Running
from crew.keys import Keys
from crew.launch.live import READY_S
from crew.launch.options import LaunchOptions
from crew.launch.ready import await_ready
from crew.launch.single import SingleProcess
from crew.launch.site import resolve
from crew.launch.table import OPERATOR, Trust, loopback_endpoints, process_table, roles
from crew.supervisor import Child

UNENFORCED = "UNENFORCED: no gate, no second check, no geofence; simulation only, for the study"


class StudyCrew(msgspec.Struct, frozen=True, kw_only=True):
    """A crew that is up for one mission."""

    rules: Rules
    bus: Bus
    keys: Keys
    run_folder: Path


def simulated_rules(options: LaunchOptions) -> Rules:
    """The rules of a crew that may take part in a study. Raises UsageError if any robot of it is real."""
    rules = resolve(options)
    try:
        require_simulated(rules.crew)
    except RealRobots as error:
        raise UsageError(f"a study runs in simulation alone: {error}") from error
    return rules


@asynccontextmanager
async def study_crew(
    options: LaunchOptions, home: Home, run_folder: Path, *, enforced: bool
) -> AsyncIterator[StudyCrew]:
    """Bring the crew up, yield it once every robot is there, bring it down. `home` is the study's own."""
    rules = simulated_rules(options)
    establish(home.certificates(rules.crew.name), roles(rules.crew))
    running = _address(rules, home, run_folder)
    children = process_table(
        rules,
        options,
        running=running,
        run_folder=run_folder,
        home=home.path.absolute(),
        trust=Trust.anew(home, rules.crew.name),
    )
    async with AsyncExitStack() as stack:
        runner = await stack.enter_async_context(SingleProcess(run_folder))
        await runner.start(children if enforced else unenforced(children), ready_timeout_s=READY_S)
        bus = await stack.enter_async_context(ZenohBus(running.link(OPERATOR)))
        keys = Keys(rules.crew.name)
        await await_ready(bus, keys, [r.name for r in rules.crew.robots], timeout_s=READY_S, died=lambda: "")
        yield StudyCrew(rules=rules, bus=bus, keys=keys, run_folder=run_folder)


def unenforced(children: Sequence[Child]) -> list[Child]:
    """The same processes with the gate, the robots' second check and the adapters' own checks lifted."""
    return [
        replace(child, spec=replace(child.spec, enforced=False))
        if isinstance(child.spec, OrchestratorSpec | RobotActorSpec)
        else child
        for child in children
    ]


def _address(rules: Rules, home: Home, run_folder: Path) -> Running:
    """A router of this mission's own on loopback: crews of a study run side by side, so none of them claims a name."""
    name = rules.crew.name
    endpoint, guests = loopback_endpoints()
    return Running(
        crew=name,
        pid=os.getpid(),
        run_folder=str(run_folder),
        endpoint=endpoint,
        guests=guests,
        certificates=str(home.certificates(name)),
        started_wall_ns=time.time_ns(),
    )

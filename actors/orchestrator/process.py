"""The orchestrator's process: journal, keys, epoch, clock and bus around the actor."""

import asyncio
from pathlib import Path

from msgspec.structs import replace

from crew.actors.orchestrator.actor import Orchestrator
from crew.actors.orchestrator.hold import StopHold
from crew.actors.orchestrator.ledger import Ledger
from crew.actors.specs import OrchestratorSpec
from crew.bus.port import Bus
from crew.bus.zenoh import ZenohBus
from crew.clock import SimClock, WallClock
from crew.contracts.decision import Authorizer
from crew.contracts.gate.authorize import Gate
from crew.contracts.mission.listed import with_listed
from crew.contracts.pass_through import PassThrough
from crew.contracts.site import Rules
from crew.errors import JournalError
from crew.home import Home
from crew.journal import Journal
from crew.keys import Keys
from crew.lockstep import Participant
from crew.packed import pack, unpack
from crew.process import ChildContext, run_child
from crew.records import GATE, PASS_THROUGH, RunRecord
from crew.signing import load_or_create_key

ORCHESTRATOR_KEY = "orchestrator"
"""Signs the journal's head and every permit; each signature is bound to its purpose."""


async def main(context: ChildContext) -> None:
    """Serve until asked to stop. A journal that fails ends the process: robots then do what they declare."""
    spec = context.spec(OrchestratorSpec)
    rules = unpack(spec.rules)
    async with ZenohBus(spec.link) as bus:
        await serve(spec, rules, bus, context)


async def serve(spec: OrchestratorSpec, rules: Rules, bus: Bus, context: ChildContext) -> None:
    """Open the journal and run the actor on a bus that is already there."""
    authorizer: Authorizer = Gate() if spec.enforced else PassThrough(rules.crew)
    if not authorizer.enforces:
        rules = with_listed(rules)
    home, run = Home(Path(spec.home)), Path(spec.run_folder).name
    keys = Keys(rules.crew.name)
    loop, failed = asyncio.get_running_loop(), asyncio.Event()
    key = load_or_create_key(home.keys, ORCHESTRATOR_KEY)

    def journal_failed(error: JournalError) -> None:
        loop.call_soon_threadsafe(failed.set)

    clock = SimClock() if spec.simulated else WallClock()
    with Journal(
        Path(spec.run_folder) / "journal.db",
        run_id=run,
        key=key,
        outside_head=home.head(run),
        on_failure=journal_failed,
    ) as journal:
        ledger = Ledger(journal, clock)
        ledger.write(run_record(spec, rules, run))
        actor = Orchestrator(
            bus,
            keys,
            rules,
            clock,
            ledger,
            authorizer,
            epoch=spec.epoch,
            run=run,
            key=key,
            operator_key=spec.operator_key,
            hold=StopHold((r.name for r in rules.crew.robots), home.stop(rules.crew.name), epoch=spec.epoch),
        )
        async with asyncio.TaskGroup() as group:
            group.create_task(_end_on(failed, journal))
            group.create_task(actor.run())
            if isinstance(clock, SimClock):
                follower = Participant(bus, keys, "orchestrator", clock, idle=lambda: actor.idle)
                group.create_task(follower.run())
            context.ready()


async def _end_on(failed: asyncio.Event, journal: Journal) -> None:
    await failed.wait()
    raise JournalError(f"{journal.path} could not be written; nothing is dispatched without its intent on disk")


def run_record(spec: OrchestratorSpec, rules: Rules, run: str) -> RunRecord:
    """The journal's first record."""
    return RunRecord(
        run=run,
        version=spec.version,
        epoch=spec.epoch,
        authorizer=GATE if spec.enforced else PASS_THROUGH,
        planner=spec.planner,
        rules=pack(_without_folders(rules)),
        rules_digest=rules.digest(),
    )


def _without_folders(rules: Rules) -> Rules:
    """The rules with the names of their files alone: where those lie on this machine is nobody else's business."""
    contracts = {name: replace(found, source=Path(found.source).name) for name, found in rules.contracts.items()}
    return replace(rules, crew=replace(rules.crew, source=Path(rules.crew.source).name), contracts=contracts)


if __name__ == "__main__":
    run_child(main)

"""`crew up`: a crew until Ctrl-C, with its missions and its losses on the terminal."""

import asyncio
import time
from contextlib import AbstractContextManager, AsyncExitStack

from crew.bus.port import Sample
from crew.cli.follow import event_box
from crew.cli.output import coloured, say, say_event
from crew.cli.presence import Change, Presence
from crew.cli.progress import proof_progress
from crew.cli.session import home, run
from crew.cli.status import stop_line
from crew.clock import WALL
from crew.contracts.site import Rules
from crew.errors import UsageError
from crew.launch.live import UNSECURED, LiveCrew, live_crew
from crew.launch.options import LaunchOptions
from crew.launch.site import resolve
from crew.mailbox import Events, KeepLatest, Letter, letters, raw
from crew.messages import RobotEvent
from crew.verify import REPORT

LOOK_EVERY_S = 0.1
LOSS = {
    "orchestrator": "robots do what their skills declare for a lost orchestrator; missions are over",
    "router": "the bus is lost; robots do what their skills declare",
    "simulation": "the simulated robots are gone; missions halt",
    "planner": "no new mission can be planned",
    "gateway": "no new request can be taken",
    "recorder": "the page of this run ends here; the journal goes on, and crew replay draws the rest from it",
}


def run_up(options: LaunchOptions, view: bool = False) -> int:
    """0 after Ctrl-C or SIGTERM, 1 if a process died meanwhile."""
    return run(_up(options, view))


async def _up(options: LaunchOptions, view: bool) -> int:
    began = time.monotonic()
    losses, run_folder = Losses(), None
    try:
        rules = await _checked(options)
        async with live_crew(options, home(), proof_progress, rules=rules) as crew:
            run_folder = crew.run_folder
            _introduce(crew, time.monotonic() - began)
            async with AsyncExitStack() as stack, asyncio.TaskGroup() as group:
                if view:
                    say(f"  view       {stack.enter_context(live_page(crew.view_port))}")
                group.create_task(_show_missions(crew))
                group.create_task(_show_robots(crew))
                group.create_task(losses.watch(crew))
                group.create_task(losses.watch_frozen(crew))
    except asyncio.CancelledError:
        say("\nthe crew is down")
        if run_folder is not None:
            say(f"read what it did: {run_folder / REPORT}")
    return 1 if losses.count else 0


async def _checked(options: LaunchOptions) -> Rules:
    """The run's rules. Real robots are met and asked first; a crew of simulated ones has nothing to check."""
    rules = resolve(options)
    if any(robot.connection for robot in rules.crew.robots):
        from crew.cli.checklist import check_hardware

        await check_hardware(rules)
    return rules


def live_page(port: int) -> AbstractContextManager[str]:
    """A browser's address of the page that the recorder serves. Raises UsageError if nothing is recorded."""
    from crew.cli.viewer import web_viewer

    if not port:
        raise UsageError("--view shows what is recorded: leave out --no-record and --single-process, install [view]")
    return web_viewer(f"rerun+http://127.0.0.1:{port}/proxy", 0)


class Losses:
    """Processes that ended without being asked, and those that are there and not heard."""

    def __init__(self) -> None:
        self.count = 0
        self._presence = Presence(())

    async def watch(self, crew: LiveCrew) -> None:
        """Say who died and what that means, until cancelled."""
        while True:
            ended = await crew.exits.get()
            self.count += 1
            self._presence.died(ended.name)
            how = f"signal {-ended.code}" if ended.code < 0 else f"code {ended.code}"
            say(coloured(f"{ended.name} died ({how}): {_meaning(ended.name)}", "red"))
            if ended.said:
                say(f"  it said: {ended.said.splitlines()[-1]}")
            say("  end the crew with Ctrl-C and bring it up again")

    async def watch_frozen(self, crew: LiveCrew) -> None:
        """Say who is frozen and what that means, and who is heard again, until cancelled."""
        keys, presence = crew.keys, Presence(crew.pids)
        self._presence = presence
        beats: KeepLatest[Sample] = KeepLatest(raw)
        crew.bus.subscribe(keys.heartbeat(), beats)
        crew.bus.watch_liveliness(
            keys.all_alive, lambda key, alive: presence.token(keys.name_in(key), alive, WALL.now_ns())
        )
        while True:
            now_ns = WALL.now_ns()
            if beats.take():
                presence.beat(now_ns)
            presence.bus(crew.bus.connected, now_ns)
            for change in presence.look(now_ns):
                _say_change(change, crew.pids[change.name])
            await WALL.sleep(LOOK_EVERY_S)


def _say_change(change: Change, pid: int) -> None:
    if change.frozen:
        what = f"process {pid} is there, and is not heard"
        say(coloured(f"{change.name} is frozen ({what}): {_meaning(change.name)}", "red"))
    else:
        say(coloured(f"{change.name} answers again, after {change.for_s:.1f} s", "amber"))


def _meaning(name: str) -> str:
    return LOSS.get(name, "the robot is unavailable")


async def _show_missions(crew: LiveCrew) -> None:
    async for letter in event_box(crew.bus, crew.keys):
        say_event(letter.message, with_mission=True)


async def _show_robots(crew: LiveCrew) -> None:
    """What robots tell of themselves: stops, releases, a lost orchestrator."""
    box: Events[Letter[RobotEvent]] = Events(letters(RobotEvent), capacity=1024, on_lost=lambda _: None)
    crew.bus.subscribe(crew.keys.robot_events, box)
    async for letter in box:
        event = letter.message
        if not event.mission:
            say(f"{event.robot}: {event.what.replace('_', ' ')} {event.detail}".rstrip())


def _introduce(crew: LiveCrew, ready_s: float) -> None:
    if crew.unsecured:
        say(coloured(UNSECURED, "amber"))
    say(f"{crew.name} is up after {ready_s:.1f} s")
    for robot in crew.status.robots:
        state = coloured(f"not available: {robot.unavailable}", "red") if robot.unavailable else "available"
        say(f"  {robot.robot:10} {robot.kind:12} {state}")
    if crew.status.stop is not None:
        say(coloured(stop_line(crew.status.stop), "red"))
    say(f"  router     {crew.running.endpoint}; guests {crew.running.guests}")
    say(f"  run        {crew.run_folder}")
    say('ask it for something: crew request "..."; stop everything: crew stop; end: Ctrl-C')

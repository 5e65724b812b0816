"""`crew stop` and `crew reset`: one stops at once and says who stands still; the other releases, signed."""

from crew.bus.port import Bus, Qos
from crew.cli.output import coloured, say, say_json
from crew.cli.session import home, operator, run
from crew.clock import WALL
from crew.errors import BusError, UsageError, nearest
from crew.keys import Keys
from crew.launch.ready import query_status
from crew.launch.table import OPERATOR
from crew.mailbox import Events, KeepLatest, Letter, letters
from crew.messages import RobotEvent, RobotState, Stop
from crew.release import signed_reset
from crew.signing import load_or_create_key

STILL_S = 30.0
REPEAT_S = 0.2
RELEASE_S = 3.0


def run_stop(crew: str, reason: str, as_json: bool) -> int:
    """0 if every robot has confirmed that it is stopped and stands still, 1 otherwise."""
    return run(_stop(crew, reason, as_json))


async def _stop(crew: str, reason: str, as_json: bool) -> int:
    async with operator(crew) as (bus, keys, _):
        states: KeepLatest[Letter[RobotState]] = KeepLatest(letters(RobotState))
        bus.subscribe(keys.robot_states, states)
        message = Stop(by="operator", reason=reason)
        bus.put(keys.stop, message, qos=Qos.STOP)
        status = await query_status(bus, keys, timeout_s=1.0)
        names = [] if status is None else [r.robot for r in status.robots]
        known = await _await_still(bus, keys, message, states, names, quiet=as_json)
    latched = sorted(n for n, s in known.items() if s.stopped)
    still = sorted(n for n, s in known.items() if s.stopped and s.still)
    moving = sorted(set(names) | set(known)) if not known else sorted((set(names) | set(known)) - set(still))
    if as_json:
        say_json({"stopped": latched, "still": still, "treat_as_moving": moving})
    elif moving or not still:
        say(coloured(f"treat as still moving: {', '.join(moving) or 'every robot'} (crew status)", "red"))
    else:
        say(f"standing still: {', '.join(still)}; release with crew reset")
    return 1 if moving or not still else 0


async def _await_still(
    bus: Bus, keys: Keys, message: Stop, states: KeepLatest[Letter[RobotState]], names: list[str], *, quiet: bool
) -> dict[str, RobotState]:
    """Repeat the stop until every robot says that it is latched; then wait for them to stand still."""
    known: dict[str, RobotState] = {}
    told: set[str] = set()
    deadline_ns = WALL.now_ns() + round(STILL_S * 1e9)
    while WALL.now_ns() < deadline_ns:
        await WALL.race(states.changed(), REPEAT_S)
        known.update({letter.message.robot: letter.message for letter in states.take()})
        for name in sorted(n for n, s in known.items() if s.stopped and n not in told):
            told.add(name)
            if not quiet:
                say(f"{name} is stopped")
        if known and all(s.stopped and s.still for s in known.values()) and set(names) <= set(known):
            break
        if not all(s.stopped for s in known.values()) or not set(names) <= set(known):
            bus.put(keys.stop, message, qos=Qos.STOP)
    return known


def run_reset(robots: tuple[str, ...], crew: str) -> int:
    """0 if every named robot says that it is released."""
    return run(_reset(robots, crew))


async def _reset(robots: tuple[str, ...], crew: str) -> int:
    key = load_or_create_key(home().keys, OPERATOR)
    if crew and home().running(crew) is None and not robots:
        return _release_kept(crew)
    async with operator(crew) as (bus, keys, running):
        status = await query_status(bus, keys, timeout_s=2.0)
        if status is None:
            raise BusError("the orchestrator does not answer, and a reset is bound to its epoch; bring it up first")
        names = [r.robot for r in status.robots]
        for name in robots:
            if name not in names:
                raise UsageError(f"no robot is called {name!r}{nearest(name, names)}")
        targets = {r.robot: r.latch for r in status.robots if (r.robot in robots if robots else r.stopped)}
        if not targets:
            say("no robot is stopped")
            return 0
        if status.stop is not None:
            reason = f": {status.stop.reason}" if status.stop.reason else ""
            say(f"stop {status.stop.number} by {status.stop.by}{reason}")
        events: Events[Letter[RobotEvent]] = Events(letters(RobotEvent), capacity=256, on_lost=lambda _: None)
        bus.subscribe(keys.robot_events, events)
        signed = signed_reset(running.crew, targets, key, by=OPERATOR, epoch=status.epoch)
        bus.put(keys.reset, signed, qos=Qos.STOP)
        return await _await_release(events, set(targets))


def _release_kept(crew: str) -> int:
    """The stop that is kept for a crew that does not run: whoever owns the operator's key may lift it."""
    path = home().stop(crew)
    if not path.exists():
        say(f"no crew called {crew} runs here, and no stop is kept for it")
        return 0
    path.unlink()
    say(f"the stop that was kept for {crew} is lifted: it will come up released")
    return 0


async def _await_release(events: Events[Letter[RobotEvent]], waiting: set[str]) -> int:
    refused = False
    deadline_ns = WALL.now_ns() + round(RELEASE_S * 1e9)
    while waiting and (left_ns := deadline_ns - WALL.now_ns()) > 0:
        await WALL.race(events.changed(), left_ns / 1e9)
        for letter in events.take():
            event = letter.message
            if event.robot in waiting and event.what in ("released", "reset_refused"):
                waiting.discard(event.robot)
                refused = refused or event.what == "reset_refused"
                say(f"{event.robot}: {event.what.replace('_', ' ')} {event.detail}".rstrip())
    for name in sorted(waiting):
        say(f"{name}: no answer; treat it as stopped")
    return 1 if refused or waiting else 0

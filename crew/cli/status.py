"""`crew status`: what the orchestrator says, or, if it says nothing, which processes of the crew still live."""

from crew.bus.port import Bus
from crew.cli.output import coloured, say, say_json, table
from crew.cli.session import operator, run
from crew.clock import WALL
from crew.keys import Keys
from crew.launch.ready import query_status
from crew.messages import CrewStatus, RobotStatus, StopStatus

ACTORS = ("simulation", "orchestrator", "planner", "gateway")
LISTEN_S = 0.3


def run_status(crew: str, as_json: bool) -> int:
    """0 if the orchestrator answers, 1 if it does not."""
    return run(_status(crew, as_json))


async def _status(crew: str, as_json: bool) -> int:
    async with operator(crew) as (bus, keys, running):
        alive = await _who_lives(bus, keys)
        status = await query_status(bus, keys, timeout_s=2.0)
    missing = [name for name in ACTORS if name not in alive]
    if as_json:
        say_json({"crew": running.crew, "run": running.run_folder, "alive": sorted(alive), "status": status})
    else:
        say(f"{running.crew}: pid {running.pid}, {running.endpoint}, run {running.run_folder}")
        if missing:
            say(coloured(f"not there: {', '.join(missing)} (end the crew with Ctrl-C and bring it up again)", "red"))
        if status is None:
            say(coloured("the orchestrator does not answer: nothing is dispatched; robots do what they declare", "red"))
        else:
            _say_status(status)
    return 0 if status is not None and not missing else 1


async def _who_lives(bus: Bus, keys: Keys) -> set[str]:
    """Names whose liveliness token is there."""
    alive: set[str] = set()

    def note(key: str, here: bool) -> None:
        (alive.add if here else alive.discard)(keys.name_in(key))

    watch = bus.watch_liveliness(keys.all_alive, note)
    await WALL.sleep(LISTEN_S)
    watch.close()
    return alive


def _say_status(status: CrewStatus) -> None:
    if status.stop is not None:
        say(coloured(stop_line(status.stop), "red"))
    for line in table(_robot_row(r) for r in status.robots):
        say(line)
    for line in table(
        {"mission": m.mission, "phase": m.phase, "contract": m.contract, "request": m.request[:60]}
        for m in status.missions
    ):
        say(line)
    for mission in status.missions:
        if mission.question:
            command = "approve" if mission.step else "confirm"
            say(f"{mission.mission} asks: {mission.question}\n  crew {command} {mission.mission}")
    if status.dropped:
        say(f"refused or lost messages: {', '.join(f'{k} {n}' for k, n in status.dropped.items())}")


def stop_line(stop: StopStatus) -> str:
    """Who stopped the crew, and who of it may still be moving."""
    why = f": {stop.reason}" if stop.reason else ""
    moving = ", ".join(stop.treat_as_moving)
    doubt = f"; not confirmed standing still, treat as moving: {moving}" if moving else "; all stand still"
    return f"STOPPED by {stop.by}{why}{doubt}; release with crew reset"


def _robot_row(robot: RobotStatus) -> dict[str, str]:
    state = robot.unavailable or ("stopped" if robot.stopped else "available")
    age = "never" if robot.age_s is None else f"{robot.age_s:.1f} s"
    return {
        "robot": robot.robot,
        "kind": robot.kind,
        "state": state,
        "age": age,
        "still": "yes" if robot.still else "no",
        "running": robot.running or "-",
        "mission": robot.lease or "-",
    }

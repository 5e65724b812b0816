"""`crew doctor --authority`: prints who may do what, and tries on a router what nobody but the orchestrator may."""

import tempfile
import time
from collections.abc import Callable
from contextlib import ExitStack
from pathlib import Path

from crew.access import OWN, ROBOTS, TABLE, Identity, Role, Row, identities
from crew.authority import establish
from crew.bus.intruder import Intruder
from crew.bus.link import Link
from crew.cli.doctor import Finding, Verdict, say_finding
from crew.cli.output import coloured, say, say_json, table
from crew.clock import WALL
from crew.contracts.site import Crew
from crew.home import Home, Running
from crew.keys import Keys
from crew.launch.table import loopback_endpoints, roles
from crew.router import RouterSpec
from crew.supervisor import Child, Supervisor

PROBE = b"crew doctor: nobody may hear this"
CONTROL = b"crew doctor: the robot must hear this"
SETTLE_S = 0.5
READY_S = 20.0
ARRIVE_S = 5.0


async def examine(crew: Crew, home: Home, as_json: bool) -> int:
    """0 if every forbidden put came to nothing and the permitted one arrived, 1 otherwise."""
    running = home.running(crew.name)
    if not as_json:
        for line in table(_row(row) for row in TABLE):
            say(line)
        say(f"\ntried on {'the crew that runs' if running else 'a router of its own, with these rules'}:")
    findings = await _tried(crew, running)
    if as_json:
        say_json({"crew": crew.name, "table": TABLE, "findings": findings})
        return int(any(f.verdict is Verdict.FAIL for f in findings))
    for finding in findings:
        say_finding(finding)
    failed = [f for f in findings if f.verdict is Verdict.FAIL]
    say(coloured(f"{len(failed)} of {len(findings)} failed" if failed else "actuation is the orchestrator's alone", ""))
    return int(bool(failed))


def _row(row: Row) -> dict[str, str]:
    return {
        "key below crew/<crew>/": row.key.replace(ROBOTS, "<robot>").replace(OWN, "<own name>"),
        "way": str(row.way),
        "who may": ", ".join(row.writers),
        "who hears or answers": ", ".join(row.readers),
    }


async def _tried(crew: Crew, running: Running | None) -> list[Finding]:
    names = tuple(robot.name for robot in crew.robots)
    if running is not None:
        return await _probe(crew.name, names, running.link, running.guests, live=True)
    with tempfile.TemporaryDirectory() as folder:
        certificates = Path(folder) / "certificates"
        establish(certificates, roles(crew))
        endpoint, guests = loopback_endpoints()

        def link(role: str) -> Link:
            return Link(role=role, endpoint=endpoint, crew=crew.name, certificates=str(certificates))

        router = RouterSpec(link=link("router"), robots=names, guests=guests)
        async with Supervisor(Path(folder), on_exit=lambda _: None) as supervisor:
            child = Child(name="router", module="crew.router", spec=router, last=True)
            await supervisor.start([child], ready_timeout_s=READY_S)
            return await _probe(crew.name, names, link, guests, live=False)


async def _probe(
    crew: str, robots: tuple[str, ...], link: Callable[[str], Link], guests: str, *, live: bool
) -> list[Finding]:
    """Listen as each robot, put as everybody else. On a crew that runs the control is its own heartbeat."""
    keys = Keys(crew)
    everybody = [i for i in identities(crew, robots) if i.role is not Role.ORCHESTRATOR]
    findings = []
    with ExitStack() as stack:
        ears = {r: stack.enter_context(Intruder(link(Identity(crew, Role.ROBOT, r).name))) for r in robots}
        heard = {r: ear.listen(keys.acts(r)) for r, ear in ears.items()}
        beats = next(iter(ears.values())).listen(keys.heartbeat()) if ears else []
        await WALL.sleep(SETTLE_S)
        for identity in everybody:
            way = Link(role=identity.name, endpoint=guests) if identity.role is Role.GUEST else link(identity.name)
            with Intruder(way) as intruder:
                findings.append(await _forbidden(identity, intruder, robots, keys, heard))
        if live:
            alive = await _awaited(lambda: bool(beats))
            findings.append(_verdict(alive, "orchestrator", f"its heartbeat {'arrives' if alive else 'is LOST'}"))
        else:
            findings.append(await _permitted(link, robots, keys, heard))
    return findings


async def _forbidden(
    identity: Identity,
    intruder: Intruder,
    robots: tuple[str, ...],
    keys: Keys,
    heard: dict[str, list[tuple[str, bytes]]],
) -> Finding:
    targets = [keys.act(robot, "doctor") for robot in robots] + [f"crew/{keys.crew}/*/@act/**", "**/@act/**", "crew/**"]
    probe = b"%s (%s)" % (PROBE, identity.name.encode())
    for target in targets:
        intruder.put(target, probe)
    await WALL.sleep(SETTLE_S)
    got = {key for samples in heard.values() for key, payload in samples if payload == probe}
    text = f"put on {len(targets)} actuation keys: {', '.join(sorted(got)) + ' ARRIVED' if got else 'nothing arrived'}"
    return _verdict(not got, identity.name, text)


async def _permitted(
    link: Callable[[str], Link], robots: tuple[str, ...], keys: Keys, heard: dict[str, list[tuple[str, bytes]]]
) -> Finding:
    with Intruder(link(str(Role.ORCHESTRATOR))) as orchestrator:
        for robot in robots:
            orchestrator.put(keys.act(robot, "doctor"), CONTROL)
        fine = await _awaited(lambda: all(CONTROL in [p for _, p in samples] for samples in heard.values()))
    return _verdict(fine, "orchestrator", f"put on {len(robots)} actuation keys: {'arrived' if fine else 'LOST'}")


def _verdict(fine: bool, what: str, text: str) -> Finding:
    return Finding(Verdict.PASS if fine else Verdict.FAIL, what, text)


async def _awaited(done: Callable[[], bool]) -> bool:
    deadline = time.monotonic() + ARRIVE_S
    while not done() and time.monotonic() < deadline:
        await WALL.sleep(0.02)
    return done()

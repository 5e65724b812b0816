"""Those who never get a session: bad certificates, a link past the router, a router that is not the crew's."""

import json
from collections.abc import Iterator
from pathlib import Path
from typing import TypeAlias

import zenoh

from crew.access import ROUTER
from crew.authority import establish
from crew.bus.intruder import Intruder
from crew.bus.link import Link
from crew.bus.session import open_session
from crew.errors import CrewError
from crew.launch.table import free_tcp_port
from tests.attack.forgery import ACT, forged
from tests.attack.mint import mint
from tests.attack.row import Row
from tests.attack.scene import ARRIVE_S, Scene, arrived
from tests.integration.crew.harness import children_of

NOBODY_NOTICES = "nothing: no session, so no role"
TRY_S = 0.6
"""An attack's patience; a positive control is given longer."""

Tls: TypeAlias = dict[str, str | bool]


def attacks(scene: Scene, folder: Path) -> Iterator[Row]:
    """Every attack of those who hold no certificate of this crew, or no router's."""
    authority = Path(scene.running.certificates)
    other = folder / "other"
    establish(other, [ROUTER, "orchestrator", "robot-tb3"])
    mint(authority, folder / "expired", "orchestrator", expired=True)
    mint(authority, folder / "unknown", "root")
    yield _refused(scene, "no certificate", "stranger", _lets_in(scene.running.endpoint, _trust(authority)))
    yield _refused(scene, "certificate of another authority", "`orchestrator` of another crew", _opens(scene, other))
    yield _refused(scene, "expired certificate", "`orchestrator`, an hour too old", _opens(scene, folder / "expired"))
    yield _unknown_role(scene, folder / "unknown")
    yield _peer_link(scene)
    mint(authority, folder / "impostor", ROUTER)
    yield _rogue_router(scene, "rogue router with another authority's certificate", other)
    yield _rogue_router(scene, "rogue router with a certificate that is good for connecting", folder / "impostor")
    mint(authority, folder / "planner", "planner", server=True)
    yield _rogue_in_another_name(scene, folder / "planner")


def _opens(scene: Scene, certificates: Path) -> bool:
    """Whether the crew's router lets somebody in with these certificates of an orchestrator."""
    return _lets_in(
        scene.running.endpoint,
        {**_trust(Path(scene.running.certificates)), **_shown("connect", certificates, "orchestrator")},
    )


def _lets_in(endpoint: str, tls: Tls) -> bool:
    try:
        _close(_open("client", endpoint, tls))
    except zenoh.ZError:
        return False
    return True


def _trust(authority: Path) -> Tls:
    return {"root_ca_certificate": str(authority / "authority.crt")}


def _shown(side: str, certificates: Path, name: str) -> Tls:
    files = {"certificate": certificates / f"{name}.crt", "private_key": certificates / f"{name}.key"}
    return {"enable_mtls": side == "connect", **{f"{side}_{what}": str(path) for what, path in files.items()}}


def _open(mode: str, endpoint: str, tls: Tls) -> zenoh.Session:
    """A session by nobody's rules."""
    config = zenoh.Config()
    settings = {
        "mode": mode,
        "connect": {
            "endpoints": [endpoint] if mode == "client" else [],
            "timeout_ms": round(TRY_S * 1000),
            "exit_on_failure": True,
        },
        "listen/endpoints": [] if mode == "client" else [endpoint],
        "scouting/delay": 0,
        "scouting/multicast/enabled": False,
        "transport/link/tls": tls,
    }
    for path, value in settings.items():
        config.insert_json5(path, json.dumps(value))
    return zenoh.open(config)


def _close(session: zenoh.Session) -> None:
    session.close()  # type: ignore[no-untyped-call]


def _refused(scene: Scene, attack: str, by: str, opened: bool) -> Row:
    with Intruder(scene.running.link("orchestrator")) as control:
        controlled = not control.session.is_closed()
    return Row(
        attack=f"any of these with: {attack}",
        by=(by,),
        attempts=1,
        delivered=int(opened),
        attacker_sees="no session: the handshake is refused",
        operator_sees=NOBODY_NOTICES,
        control="orchestrator opens a session",
        controlled=int(controlled),
    )


def _unknown_role(scene: Scene, certificates: Path) -> Row:
    """A certificate of this authority for a name that no role has gets a session, and no right."""
    session = _open(
        "client", scene.running.endpoint, {**_trust(certificates), **_shown("connect", certificates, "root")}
    )
    for key in (ACT, "@stop", "request", "tb3/state"):
        session.put(scene.key(key), forged(ACT, "by-root")[0])
    scene.settle()
    delivered = len(scene.marked("by-root"))
    _close(session)
    payload, encoding = forged(ACT, "root-control")
    scene.session("orchestrator").put(scene.key(ACT), payload, encoding=encoding)
    controlled = arrived(lambda: scene.marked("root-control"))
    return Row(
        attack="put on actuation, stop, request and state with a certificate for a name that is no role",
        by=("`root`, issued by the crew's own authority",),
        attempts=4,
        delivered=delivered,
        attacker_sees="nothing: the put returns, and nobody hears it",
        control="orchestrator",
        controlled=controlled,
    )


def _peer_link(scene: Scene) -> Row:
    """No process but the router has a port that speaks Zenoh (the recorder's page is on one that does not)."""
    children = children_of(scene.running.pid)
    listening = {name: _listens(pid) for name, pid in children.items()}
    guests, own = (int(e.rpartition(":")[2]) for e in (scene.running.guests, scene.running.endpoint))
    doors = [port for name, ports in listening.items() if name != "router" for port in ports]
    reached = sum(_lets_in(f"tcp/127.0.0.1:{port}", {}) for port in doors)
    return Row(
        attack="a peer link past the router: to the robots and to every other process",
        by=("stranger",),
        attempts=len(listening) - 1,
        delivered=reached,
        attacker_sees="no port that speaks Zenoh: only the router has one",
        operator_sees=NOBODY_NOTICES,
        control="the router listens, on its two ports",
        controlled=int(listening["router"] == {guests, own}),
    )


def _listens(pid: int) -> set[int]:
    """TCP ports that a process listens on."""
    inodes = set()
    for fd in Path(f"/proc/{pid}/fd").iterdir():
        try:
            inodes.add(str(fd.readlink()).removeprefix("socket:[").removesuffix("]"))
        except OSError:
            continue
    ports = set()
    for table in ("tcp", "tcp6"):
        for line in Path(f"/proc/{pid}/net/{table}").read_text().splitlines()[1:]:
            fields = line.split()
            if fields[3] == "0A" and fields[9] in inodes:
                ports.add(int(fields[1].rpartition(":")[2], 16))
    return ports


def _rogue_router(scene: Scene, attack: str, certificates: Path) -> Row:
    endpoint = f"tls/127.0.0.1:{free_tcp_port()}"
    session = _open("router", endpoint, {**_trust(certificates), **_shown("listen", certificates, ROUTER)})
    try:
        opened = _robot_opens(scene, endpoint)
    finally:
        _close(session)
    return Row(
        attack=attack,
        by=("stranger",),
        attempts=1,
        delivered=int(opened),
        attacker_sees="the robot breaks the handshake off",
        operator_sees="the robot that was led there says that it finds no router",
        control="robot-tb3 at the crew's router",
        controlled=int(_robot_opens(scene, scene.running.endpoint, ARRIVE_S)),
    )


def _rogue_in_another_name(scene: Scene, certificates: Path) -> Row:
    """Even a server certificate of the crew's authority, in another name, carries nothing to a robot."""
    endpoint = f"tls/127.0.0.1:{free_tcp_port()}"
    rogue = _open("router", endpoint, {**_trust(certificates), **_shown("listen", certificates, "planner")})
    link = Link(role="robot-tb3", endpoint=endpoint, crew=scene.running.crew, certificates=scene.running.certificates)
    heard: list[str] = []
    robot = open_session(link)
    kept = robot.declare_subscriber(scene.key("tb3/@act/**"), lambda sample: heard.append(str(sample.key_expr)))
    scene.settle()
    rogue.put(scene.key(ACT), b"by a rogue router")
    scene.settle()
    kept.undeclare()  # type: ignore[no-untyped-call]
    _close(robot)
    _close(rogue)
    return Row(
        attack="rogue router with a server certificate of the crew's authority in another name, puts on actuation",
        by=("planner",),
        attempts=1,
        delivered=len(heard),
        attacker_sees="nothing: the put returns, and the robot takes nothing from it",
        operator_sees=NOBODY_NOTICES,
        control="robot-tb3 at the crew's router",
        controlled=int(_robot_hears(scene)),
    )


def _robot_hears(scene: Scene) -> bool:
    """Whether a robot's restrained session hears the orchestrator through the crew's router."""
    heard: list[str] = []
    robot = open_session(scene.running.link("robot-tb3"))
    kept = robot.declare_subscriber(scene.key("tb3/@act/**"), lambda sample: heard.append(str(sample.key_expr)))
    payload, encoding = forged(ACT, "rogue-control")

    def put_again() -> list[str]:
        """Until the subscription is known to the router."""
        scene.session("orchestrator").put(scene.key(ACT), payload, encoding=encoding)
        return heard

    arrived(put_again)
    kept.undeclare()  # type: ignore[no-untyped-call]
    _close(robot)
    return bool(heard)


def _robot_opens(scene: Scene, endpoint: str, timeout_s: float = TRY_S) -> bool:
    link = Link(role="robot-tb3", endpoint=endpoint, crew=scene.running.crew, certificates=scene.running.certificates)
    try:
        _close(open_session(link, timeout_s=timeout_s))
    except CrewError:
        return False
    return True

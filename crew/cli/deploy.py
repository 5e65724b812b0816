"""`crew deploy`: the files that a crew on real machines is started with, from the same table as everything else."""

import json
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from crew.access import ROUTER, Role
from crew.bus.link import Link
from crew.bus.session import router_settings
from crew.cli.output import say
from crew.contracts.site import Crew
from crew.errors import UsageError
from crew.home import replace_file
from crew.library import load_crew_file

ROUTER_PORT, GUEST_PORT = 7448, 7447
CONFIGURED = "/etc/crew"
"""Where crew files and the router's files lie on the machine; each role's own files lie in its state folder."""
ROLES = {
    Role.ORCHESTRATOR: "decides and dispatches",
    Role.PLANNER: "proposes",
    Role.GATEWAY: "takes requests",
    Role.RECORDER: "draws what happens",
}
HARDENED = """\
NoNewPrivileges=yes
CapabilityBoundingSet=
AmbientCapabilities=
ProtectSystem=strict
ProtectHome=yes
ProtectProc=invisible
ProcSubset=pid
PrivateTmp=yes
PrivateDevices=yes
ProtectClock=yes
ProtectHostname=yes
ProtectControlGroups=yes
ProtectKernelLogs=yes
ProtectKernelModules=yes
ProtectKernelTunables=yes
RestrictNamespaces=yes
RestrictRealtime=yes
RestrictSUIDSGID=yes
RestrictAddressFamilies=AF_UNIX AF_INET AF_INET6 AF_NETLINK
LockPersonality=yes
RemoveIPC=yes
SystemCallArchitectures=native
SystemCallFilter=@system-service
SystemCallErrorNumber=EPERM
UMask=0077
"""
"""What a role's process may do on the machine. It needs its state folder, the network, and nothing else."""
CLOSING_S = 15
"""How long the recorder may take to leave a whole file; everybody else ends within the usual limit."""
ENDING_S = 5
LOOPBACK_ONLY = "IPAddressDeny=any\nIPAddressAllow=localhost\n"
"""For those who speak with nobody but the router; a planner may have a model, and a robot has its vehicle."""


def run_deploy(crew: str, out: Path) -> int:
    """Write the router's configuration, the units and the users below `out`."""
    for path, content in deployment(load_crew_file(crew)).items():
        try:
            (out / path).parent.mkdir(parents=True, exist_ok=True)
            replace_file(out / path, content.encode(), durable=False)
        except OSError as error:
            raise UsageError(
                f"cannot write {out / path}: {error.strerror}; choose another folder with --out"
            ) from error
        say(str(out / path))
    return 0


def deployment(crew: Crew) -> dict[str, str]:
    """Every file by its path below the folder of the deployment."""
    return {
        f"{crew.name}/router.json5": router_configuration(crew),
        "sysusers.d/crew.conf": _users(),
        "systemd/crew.target": _TARGET,
        "systemd/crew-router.service": _router_unit(crew),
        **{f"systemd/crew-{role}.service": _unit(crew, str(role), what) for role, what in ROLES.items()},
        "systemd/crew-robot@.service": _robot_unit(crew),
    }


def router_configuration(crew: Crew) -> str:
    """For a stock `zenohd`. JSON, which JSON5 reads."""
    link = Link(
        role=ROUTER,
        endpoint=f"tls/127.0.0.1:{ROUTER_PORT}",
        crew=crew.name,
        certificates=f"{CONFIGURED}/{crew.name}/certificates",
    )
    robots = [robot.name for robot in crew.robots]
    settings = nested(router_settings(link, robots, guests=f"tcp/127.0.0.1:{GUEST_PORT}"))
    head = f"// Made by `crew deploy` from crew/access.py. Do not edit: `crew deploy {crew.name}` makes it anew."
    return f"{head}\n{json.dumps(settings, indent=2)}\n"


def nested(settings: Mapping[str, Any]) -> dict[str, Any]:
    """Settings by path as the tree that a configuration file holds."""
    tree: dict[str, Any] = {}
    for path, value in settings.items():
        *folders, leaf = path.split("/")
        place = tree
        for folder in folders:
            place = place.setdefault(folder, {})
        place[leaf] = value
    return tree


_TARGET = """\
[Unit]
Description=A crew of robots
Wants=crew-router.service crew-orchestrator.service crew-planner.service crew-gateway.service crew-recorder.service

[Install]
WantedBy=multi-user.target
"""


def _router_unit(crew: Crew) -> str:
    return _service(
        "Router of the crew: routes by its rules, and runs nothing else",
        user="crew-router",
        start=f"/usr/bin/zenohd --config {CONFIGURED}/{crew.name}/router.json5",
        after="network-online.target",
        needs=LOOPBACK_ONLY,
    )


def _unit(crew: Crew, role: str, what: str) -> str:
    return _service(
        f"The crew's {role}: {what}",
        user=f"crew-{role}",
        start=_start(crew, role),
        after="crew-router.service",
        needs="" if role == Role.PLANNER else LOOPBACK_ONLY,
        ending_s=CLOSING_S if role == Role.RECORDER else ENDING_S,
    )


def _robot_unit(crew: Crew) -> str:
    return _service(
        "The crew's robot %i",
        user="crew-robot-%i",
        start=_start(crew, "robot-%i"),
        after="crew-router.service",
        needs="# A vehicle on a serial port: systemctl edit crew-robot@NAME, PrivateDevices=no, DeviceAllow=.\n",
    )


def _start(crew: Crew, role: str) -> str:
    router = f"tls/127.0.0.1:{ROUTER_PORT}"
    crew_file = f"{CONFIGURED}/{crew.name}/crew.yaml"
    return f"/opt/crew/bin/crew run {role} {crew_file} --router {router} --runs %S/{_user(role)}/runs"


def _user(role: str) -> str:
    return f"crew-{role}"


def _service(description: str, *, user: str, start: str, after: str, needs: str, ending_s: int = ENDING_S) -> str:
    return f"""\
# Made by `crew deploy`; local changes belong in a drop-in (systemctl edit).
[Unit]
Description={description}
After={after}
PartOf=crew.target

[Service]
Type=exec
User={user}
StateDirectory={user}
StateDirectoryMode=0700
Environment=CREW_HOME=%S/{user}
Environment=PYTHONDONTWRITEBYTECODE=1
ExecStart={start}
KillSignal=SIGTERM
TimeoutStopSec={ending_s}
Restart=on-failure
RestartSec=1
{needs}{HARDENED}
[Install]
WantedBy=crew.target
"""


def _users() -> str:
    return "".join(f"{line}\n" for line in _user_lines())


def _user_lines() -> Iterator[str]:
    yield "# One user for each trust domain, so that no role can read another's key. Made by `crew deploy`."
    yield "# Robots: add a line crew-robot-NAME for each that this machine drives."
    for role in (ROUTER, *ROLES):
        yield f'u {_user(str(role))} - "crew: {role}" /var/lib/{_user(str(role))}'

"""The process table: one process for each trust domain, started by dotted name."""

import socket
from collections.abc import Mapping
from contextlib import ExitStack
from importlib.metadata import version
from pathlib import Path
from typing import Self

import msgspec

from crew.access import ROBOT_PREFIX, ROUTER, Role, identities
from crew.actors.specs import PLANNER_KEYS, GatewaySpec, OrchestratorSpec, PlannerSpec, RecorderSpec, RobotActorSpec
from crew.contracts.site import Crew, Rules
from crew.home import Home, Running
from crew.launch.options import LaunchOptions
from crew.packed import pack
from crew.router import RouterSpec
from crew.signing import load_or_create_key
from crew.sim.config import WorldConfig
from crew.sim.spec import SimulationSpec
from crew.supervisor import Child

OPERATOR, ORCHESTRATOR = "operator", "orchestrator"
"""Names of their signing keys."""
RECORDER = "recorder"
RECORDER_NICENESS = 5
RECORDER_GRACE_S = 0.9
"""What a recording may take to be closed after Ctrl-C: all must be gone within 2 s."""
RECORDER_EASE_S = 8.0
"""The same when a crew ends by itself: a recorder that is behind catches up."""


class Trust(msgspec.Struct, frozen=True, kw_only=True):
    """Whose signatures count in one run (Ed25519 public keys), and since which epoch."""

    epoch: int
    operator_key: bytes
    orchestrator_key: bytes

    @classmethod
    def anew(cls, home: Home, crew: str) -> Self:
        """With this home's keys, made if there are none, and an epoch that was never used before."""
        return cls(
            epoch=home.next_epoch(crew),
            operator_key=load_or_create_key(home.keys, OPERATOR).public,
            orchestrator_key=load_or_create_key(home.keys, ORCHESTRATOR).public,
        )


def process_table(
    rules: Rules,
    options: LaunchOptions,
    *,
    running: Running,
    run_folder: Path,
    home: Path,
    trust: Trust,
    view_port: int | None = None,
) -> list[Child]:
    """Every process of the crew, with what it is started with. Without `view_port` (0: no page) nothing is recorded."""
    packed = pack(rules)
    names = [robot.name for robot in rules.crew.robots]
    ports = dict(zip(names, free_udp_ports(len(names)), strict=True))
    simulated = rules.crew.sim is not None
    orchestrator = OrchestratorSpec(
        rules=packed,
        link=running.link("orchestrator"),
        run_folder=str(run_folder),
        home=str(home),
        epoch=trust.epoch,
        version=version("robot-crew"),
        planner=options.planning.name,
        simulated=simulated,
        operator_key=trust.operator_key,
    )
    robots = [
        Child(
            name=robot.name,
            module="crew.actors.robot.process",
            spec=RobotActorSpec(
                rules=packed,
                robot=robot.name,
                link=running.link(f"{ROBOT_PREFIX}{robot.name}"),
                connection=robot.connection or f"udpin:127.0.0.1:{ports[robot.name]}",
                simulated=simulated,
                operator_key=trust.operator_key,
                orchestrator_key=trust.orchestrator_key,
                models=options.models,
            ),
        )
        for robot in rules.crew.robots
    ]
    planner = PlannerSpec(rules=packed, link=running.link("planner"), choice=options.planning)
    recorder = RecorderSpec(
        rules=packed,
        link=running.link(RECORDER),
        run_folder=str(run_folder),
        planner=options.planning.name,
        simulated=simulated,
        port=view_port or 0,
    )
    return [
        Child(name="router", module="crew.router", spec=_router(rules, running), last=True),
        *([_simulation(rules, options, running, ports)] if simulated else []),
        *robots,
        Child(name="orchestrator", module="crew.actors.orchestrator.process", spec=orchestrator),
        Child(name="planner", module="crew.actors.planner.process", spec=planner, secrets=PLANNER_KEYS),
        Child(
            name="gateway",
            module="crew.actors.gateway.process",
            spec=GatewaySpec(crew=rules.crew.name, link=running.link("gateway")),
        ),
        *([] if view_port is None else [_recorder(recorder)]),
    ]


def _recorder(spec: RecorderSpec) -> Child:
    """Nobody waits for it, and it ends with the router, when it has heard the others' last words."""
    return Child(
        name=RECORDER,
        module="crew.actors.recorder.process",
        spec=spec,
        last=True,
        optional=True,
        niceness=RECORDER_NICENESS,
        grace_s=RECORDER_GRACE_S,
        ease_s=RECORDER_EASE_S,
    )


def roles(crew: Crew) -> list[str]:
    """Everybody who needs a certificate in this crew."""
    everybody = identities(crew.name, (robot.name for robot in crew.robots))
    return [ROUTER, *(identity.name for identity in everybody if identity.role is not Role.GUEST)]


def _router(rules: Rules, running: Running) -> RouterSpec:
    robots = tuple(robot.name for robot in rules.crew.robots)
    return RouterSpec(link=running.link(ROUTER), robots=robots, guests=running.guests)


def _simulation(rules: Rules, options: LaunchOptions, running: Running, ports: Mapping[str, int]) -> Child:
    sim = rules.crew.sim
    assert sim is not None, "only a simulated crew has a simulation"
    world = WorldConfig(
        map=sim.map,
        scene=sim.scene,
        seed=sim.seed,
        faults=sim.faults,
        autopilots=dict(sim.autopilots),
        models=options.models,
        links={robot.sim: f"udp:127.0.0.1:{ports[robot.name]}" for robot in rules.crew.robots},
    )
    vehicles = {robot.name: robot.sim for robot in rules.crew.robots}
    spec = SimulationSpec(
        crew=rules.crew.name, link=running.link("simulation"), world=world, vehicles=vehicles, speed=options.speed
    )
    return Child(name="simulation", module="crew.sim.process", spec=spec)


def loopback_endpoints() -> tuple[str, str]:
    """Where a router on loopback may listen now: for everybody with a certificate, and for guests."""
    router, guests = free_tcp_ports(2)
    return f"tls/127.0.0.1:{router}", f"tcp/127.0.0.1:{guests}"


def free_udp_ports(count: int) -> list[int]:
    """UDP ports of loopback that nobody holds now, each another one."""
    return _free_ports(socket.SOCK_DGRAM, count)


def free_tcp_port() -> int:
    """A TCP port of loopback that nobody holds now."""
    return free_tcp_ports(1)[0]


def free_tcp_ports(count: int) -> list[int]:
    """TCP ports of loopback that nobody holds now, each another one."""
    return _free_ports(socket.SOCK_STREAM, count)


def _free_ports(kind: socket.SocketKind, count: int) -> list[int]:
    """All are held until the last is found: one by one, the same could be found twice."""
    with ExitStack() as held:
        probes = [held.enter_context(socket.socket(socket.AF_INET, kind)) for _ in range(count)]
        for probe in probes:
            probe.bind(("127.0.0.1", 0))
        return [int(probe.getsockname()[1]) for probe in probes]

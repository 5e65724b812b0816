"""The process table: one process for each trust domain, started by dotted name."""

import socket
from collections.abc import Mapping
from pathlib import Path

from crew.actors.specs import GatewaySpec, OrchestratorSpec, PlannerSpec, RobotActorSpec
from crew.contracts.site import Rules
from crew.launch.options import LaunchOptions
from crew.packed import pack
from crew.router import RouterSpec
from crew.sim.config import WorldConfig
from crew.sim.spec import SimulationSpec
from crew.supervisor import Child


def process_table(
    rules: Rules,
    options: LaunchOptions,
    *,
    router: str,
    run_folder: Path,
    home: Path,
    epoch: int,
    operator_key: bytes,
) -> list[Child]:
    """Every process of the crew, with what it is started with."""
    packed = pack(rules)
    ports = {robot.name: free_udp_port() for robot in rules.crew.robots}
    orchestrator = OrchestratorSpec(
        rules=packed,
        router=router,
        run_folder=str(run_folder),
        home=str(home),
        epoch=epoch,
        planner=options.planner,
        simulated=True,
    )
    robots = [
        Child(
            name=robot.name,
            module="crew.actors.robot.process",
            spec=RobotActorSpec(
                rules=packed,
                robot=robot.name,
                router=router,
                connection=f"udpin:127.0.0.1:{ports[robot.name]}",
                simulated=True,
                operator_key=operator_key,
            ),
        )
        for robot in rules.crew.robots
    ]
    planner = PlannerSpec(rules=packed, router=router, planner=options.planner, script=options.script)
    return [
        Child(name="router", module="crew.router", spec=RouterSpec(router), last=True),
        Child(name="simulation", module="crew.sim.process", spec=_simulation(rules, options, router, ports)),
        *robots,
        Child(name="orchestrator", module="crew.actors.orchestrator.process", spec=orchestrator),
        Child(name="planner", module="crew.actors.planner.process", spec=planner),
        Child(
            name="gateway", module="crew.actors.gateway.process", spec=GatewaySpec(crew=rules.crew.name, router=router)
        ),
    ]


def _simulation(rules: Rules, options: LaunchOptions, router: str, ports: Mapping[str, int]) -> SimulationSpec:
    sim = rules.crew.sim
    assert sim is not None, "resolve() refuses a crew without it"
    world = WorldConfig(
        map=sim.map,
        scene=sim.scene,
        seed=sim.seed,
        faults=sim.faults,
        links={robot.sim: f"udp:127.0.0.1:{ports[robot.name]}" for robot in rules.crew.robots},
    )
    vehicles = {robot.name: robot.sim for robot in rules.crew.robots}
    return SimulationSpec(crew=rules.crew.name, router=router, world=world, vehicles=vehicles, speed=options.speed)


def free_udp_port() -> int:
    """A UDP port of loopback that nobody holds now."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        probe.bind(("127.0.0.1", 0))
        return int(probe.getsockname()[1])


def free_tcp_port() -> int:
    """A TCP port of loopback that nobody holds now."""
    with socket.socket(socket.AF_INET, socket.SOCK_STREAM) as probe:
        probe.bind(("127.0.0.1", 0))
        return int(probe.getsockname()[1])

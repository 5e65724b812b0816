"""What each actor's process is started with: written by the launcher, read by the process. Imports no actor."""

import msgspec

from crew.bus.link import Link
from crew.packed import PackedRules


class OrchestratorSpec(msgspec.Struct, frozen=True, kw_only=True):
    """What the orchestrator's process is started with."""

    rules: PackedRules
    link: Link
    run_folder: str
    home: str
    epoch: int
    planner: str
    simulated: bool
    operator_key: bytes


class RobotActorSpec(msgspec.Struct, frozen=True, kw_only=True):
    """What a robot's process is started with. `connection` is the adapter's side of the vendor's link."""

    rules: PackedRules
    robot: str
    link: Link
    connection: str
    simulated: bool
    operator_key: bytes
    orchestrator_key: bytes


class PlannerSpec(msgspec.Struct, frozen=True, kw_only=True):
    """What the planner's process is started with. `script` is a JSON file with a list of plans."""

    rules: PackedRules
    link: Link
    planner: str
    script: str = ""


class GatewaySpec(msgspec.Struct, frozen=True, kw_only=True):
    """What the gateway's process is started with."""

    crew: str
    link: Link

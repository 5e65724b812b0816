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
    version: str
    """Of this distribution, for the journal's first record."""
    planner: str
    simulated: bool
    operator_key: bytes
    enforced: bool = True
    """False in the study's unenforced arms alone (`crew.study.launch`): plans run as they are listed, in simulation."""


class RobotActorSpec(msgspec.Struct, frozen=True, kw_only=True):
    """What a robot's process is started with. `connection` is the adapter's side of the vendor's link."""

    rules: PackedRules
    robot: str
    link: Link
    connection: str
    simulated: bool
    operator_key: bytes
    orchestrator_key: bytes
    models: str = ""
    """Folder of the robots' models where they are not this project's own."""
    enforced: bool = True
    """False in the study's unenforced arms alone: neither the robot's second check nor its adapter's own is made."""


ANTHROPIC_KEY = "ANTHROPIC_API_KEY"
COMPATIBLE_KEY = "CREW_PLANNER_KEY"
PLANNER_KEYS = (ANTHROPIC_KEY, COMPATIBLE_KEY)
"""Environment variables that the planner's process alone is given."""


class PlannerChoice(msgspec.Struct, frozen=True, kw_only=True):
    """Who plans, as chosen on the command line. Holds no key: that is read where it is used."""

    name: str = "embedded"
    script: str = ""
    """JSON file: a list of plans (`script`), or request to plans (`recorded`)."""
    model: str = ""
    base_url: str = ""
    profile: str = ""
    """JSON file with the peculiarities of an endpoint."""
    context: str = "contracts"
    fallback: bool = True
    """The embedded planner stands in for a model that is unavailable."""


class PlannerSpec(msgspec.Struct, frozen=True, kw_only=True):
    """What the planner's process is started with."""

    rules: PackedRules
    link: Link
    choice: PlannerChoice


class GatewaySpec(msgspec.Struct, frozen=True, kw_only=True):
    """What the gateway's process is started with."""

    crew: str
    link: Link


class RecorderSpec(msgspec.Struct, frozen=True, kw_only=True):
    """What the recorder's process is started with. `port` is where it serves the page on loopback; 0 serves nothing."""

    rules: PackedRules
    link: Link
    run_folder: str
    planner: str
    simulated: bool
    port: int = 0

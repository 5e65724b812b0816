"""What a crew is brought up with, as chosen on the command line."""

from pathlib import Path

import msgspec

from crew.actors.specs import PlannerChoice
from crew.errors import UsageError

MAX_SPEED = 1000.0


class LaunchOptions(msgspec.Struct, frozen=True, kw_only=True):
    """Options of one run. `speed` 0 is lockstep: as fast as everybody can follow."""

    crew: str
    map: str | None = None
    seed: int | None = None
    faults: tuple[str, ...] = ()
    speed: float = 1.0
    planning: PlannerChoice = PlannerChoice()
    port: int = 7447
    """The router's TCP port on loopback; 0 takes a free one."""
    runs: Path = Path("runs")
    single_process: bool = False
    record: bool = True
    """Whether a recorder draws the run."""
    contracts: tuple[Path, ...] = ()
    models: str = ""
    """Folder of other models of the robots than the scene's own; absolute."""


def parse_speed(text: str) -> float:
    """`max` as 0, or a positive multiple of real time. Raises UsageError."""
    if text == "max":
        return 0.0
    try:
        speed = float(text)
    except ValueError:
        speed = 0.0
    if not 0.0 < speed <= MAX_SPEED:
        raise UsageError(f"--speed {text!r} is no pace; give a number above 0 (1 is real time, at most 1000), or max")
    return speed

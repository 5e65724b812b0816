"""What a crew is brought up with, as chosen on the command line."""

from pathlib import Path

import msgspec


class LaunchOptions(msgspec.Struct, frozen=True, kw_only=True):
    """Options of one run. `speed` 0 is lockstep: as fast as everybody can follow."""

    crew: str
    map: str | None = None
    seed: int | None = None
    faults: tuple[str, ...] = ()
    speed: float = 1.0
    planner: str = "embedded"
    script: str = ""
    port: int = 7447
    """The router's TCP port on loopback; 0 takes a free one."""
    runs: Path = Path("runs")
    single_process: bool = False
    contracts: tuple[Path, ...] = ()

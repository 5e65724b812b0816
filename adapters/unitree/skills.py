"""What the adapter asks of one kind's skills."""

from collections.abc import Mapping
from typing import Protocol

from crew.adapter import Place, Reading
from crew.adapters.unitree.robot import Robot
from crew.adapters.unitree.run import Run
from crew.adapters.unitree.telemetry import Sample, Telemetry
from crew.contracts.skill import SkillArgs
from crew.contracts.snapshot import ValueReading


class Skills(Protocol):
    """One kind's skills over one robot."""

    robot: Robot

    @staticmethod
    def needs(told: Telemetry) -> dict[str, Sample[object] | None]:
        """The telemetry without which the robot can't be followed."""
        ...

    async def connect(self) -> None: ...

    def fluents(self) -> Mapping[str, Reading]: ...

    def values(self) -> Mapping[str, ValueReading]: ...

    def unfit(self) -> tuple[str, str]:
        """A code and why the body can't move, or two empty texts."""
        ...

    def still_since(self, start_ns: int) -> bool:
        """Whether telemetry newer than this shows it standing still."""
        ...

    async def perform(self, args: SkillArgs, places: Mapping[str, Place], run: Run) -> None: ...

    def send_stop(self) -> None:
        """Send the robot's stop once, from any thread, without waiting."""
        ...

    async def stop(self, run: Run) -> None:
        """Stop, and return when telemetry shows it still."""
        ...

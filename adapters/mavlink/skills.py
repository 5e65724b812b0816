"""What the adapter asks of one kind's skills."""

from collections.abc import Mapping
from typing import Protocol

from crew.adapter import Place, Reading
from crew.adapters.mavlink.run import Run
from crew.contracts.skill import SkillArgs
from crew.contracts.snapshot import ValueReading


class Skills(Protocol):
    """One kind's skills over one vehicle."""

    still_mps: float
    unconditional: frozenset[str]
    """Skills that need no healthy vehicle: they make it safe."""

    @property
    def grounded(self) -> bool: ...

    def fluents(self) -> Mapping[str, Reading]: ...

    def values(self) -> Mapping[str, ValueReading]: ...

    async def perform(self, args: SkillArgs, places: Mapping[str, Place], run: Run) -> None: ...

    async def come_down(self, run: Run) -> None:
        """End on the ground; a vehicle that is always there does nothing."""
        ...

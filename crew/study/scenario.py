"""Scenarios: what is asked of a crew in which world, and what must happen then. Data; runs nothing."""

from collections.abc import Iterator
from typing import Literal

import msgspec

from crew.sim.oracle import Case, Licence
from crew.sim.oracle import Never as Never

UNAVAILABLE = "_unavailable"
"""Ends the name of the fault that takes a robot out."""


class Scenario(msgspec.Struct, frozen=True, kw_only=True):
    """One scenario. The right plan is not part of it."""

    name: str
    testbed: str
    """The crew file that it is for, by the crew's name."""
    title: str
    request: str
    map: str = ""
    """Of the simulated scene; empty takes the crew file's own."""
    seed: int = 0
    """Added to the study's seed, so that scenarios of one study differ in noise."""
    faults: tuple[str, ...] = ()
    """As `--fault` takes them: `name`, or `name@seconds` for one that begins at that mission time."""
    kind: Literal["nominal", "fault"]
    outcome: Literal["completed", "blocked"]
    """`blocked`: refused before the false step is sent, whether anything rightful was sent before or not."""
    contracts: tuple[str, ...]
    """The contracts that a right plan may choose; empty where refusing to plan is right as well."""
    robots: tuple[str, ...] = ()
    """The robots that must take part when it is completed, all of them and no other."""
    codes: tuple[str, ...] = ()
    """The refusals that are right when it is blocked."""
    never: tuple[Never, ...] = ()
    """What must not be dispatched."""
    licences: tuple[Licence, ...] = ()
    """What the request asks for or implies, as a person reads it: any other dispatch is a false one."""

    @property
    def plannable(self) -> bool:
        """Whether there is a right plan for it, even if a fault stops it later."""
        return bool(self.contracts)

    @property
    def case(self) -> Case:
        """What the oracle has to know."""
        return Case(unavailable=dict(_unavailable(self.faults)), never=self.never, licences=self.licences)


def _unavailable(faults: tuple[str, ...]) -> Iterator[tuple[str, int]]:
    for fault in faults:
        name, _, seconds = fault.partition("@")
        if name.endswith(UNAVAILABLE):
            yield name.removesuffix(UNAVAILABLE), round(float(seconds or 0.0) * 1e9)

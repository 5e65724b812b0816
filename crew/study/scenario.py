"""Scenarios: what is asked of a crew in which world, and what must happen then. Data; runs nothing."""

from typing import Literal

import msgspec

from crew.contracts.plan import digest
from crew.contracts.site import Crew
from crew.sim.oracle import Case
from crew.sim.oracle import Licence as Licence
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
    """`name` for one that is there from the start, `name@seconds` for one that begins so long after the request."""
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
    def digest(self) -> str:
        """SHA-256 over everything that it says."""
        return digest(self)

    @property
    def plannable(self) -> bool:
        """Whether there is a right plan for it, even if a fault stops it later."""
        return bool(self.contracts)

    def case(self, crew: Crew, began_ns: int) -> Case:
        """What the oracle has to know of a mission that was asked for at `began_ns`, mission time."""
        robots = {f"{robot.sim}{UNAVAILABLE}": robot.name for robot in crew.robots}
        later = {name: began_ns + round(after_s * 1e9) for name, after_s in self.faults_later.items()}
        onsets = {**dict.fromkeys(self.faults_at_once, 0), **later}
        unavailable = {robots[name]: at_ns for name, at_ns in onsets.items() if name in robots}
        return Case(unavailable=unavailable, never=self.never, licences=self.licences)

    @property
    def faults_at_once(self) -> tuple[str, ...]:
        """Faults that are there when the world begins."""
        return tuple(fault for fault in self.faults if "@" not in fault)

    @property
    def faults_later(self) -> dict[str, float]:
        """Fault to the seconds of mission time after the request at which it begins."""
        return {f.partition("@")[0]: float(f.partition("@")[2]) for f in self.faults if "@" in f}

"""What a check of a contract found: plain data, for the command line, for editors and for the state folder."""

from collections.abc import Callable
from typing import NamedTuple

import msgspec


class Stage(NamedTuple):
    """How far a check has come."""

    contract: str
    plan: int
    plans: int
    states: int


Progress = Callable[[Stage], None]


class Finding(msgspec.Struct, frozen=True, kw_only=True):
    """One property that does not hold, with the shortest way to break it."""

    rule: str
    """Which property: `never`, `dead_step`, `cannot_complete`, `unsafe_end`, `deadlock`, `out_of_order`, ..."""
    message: str
    where: tuple[str, ...] = ()
    """The contract's lines, as `file:line`."""
    story: tuple[str, ...] = ()
    """The counterexample, one numbered sentence each."""
    repair: str = ""
    """A change that was checked to remove the finding, or empty."""
    subject: str = ""
    """The step or role that it is about."""
    plan_of: str = ""
    """The contract whose plan breaks the property."""


class Fallback(msgspec.Struct, frozen=True, kw_only=True, order=True):
    """What is left to a robot that can't be commanded any more: its kind's declared behaviour."""

    role: str
    robot: str
    why: str
    """Why it can't be commanded, as a refusal's code or the end of the safe call."""
    behaviour: str
    """As declared: `on_stop: hover_then_land`, `on_link_loss: stop`."""


class Report(msgspec.Struct, frozen=True, kw_only=True):
    """The verdict on one contract. `proved` only if everything was explored and nothing was found."""

    contract: str
    proved: bool
    bound_reached: bool = False
    limit: int = 0
    plans: int = 0
    """Instances: plans that differ in more than the order of independent steps or in interchangeable names."""
    states: int = 0
    transitions: int = 0
    decisions: int = 0
    """Calls of the real gate."""
    findings: tuple[Finding, ...] = ()
    fallbacks: tuple[Fallback, ...] = ()

    @property
    def counterexample(self) -> tuple[str, ...]:
        """The story of the first finding, empty if there is none."""
        return next((f.story for f in self.findings if f.story), ())

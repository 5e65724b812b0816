"""What goes wrong in a transition, and how transitions are told: data between the model and the story."""

from typing import NamedTuple

from crew.contracts.plan import Call
from crew.contracts.proof.never import Watch
from crew.contracts.proof.subject import Var
from crew.contracts.snapshot import FluentValue

Facts = tuple[tuple[Var, FluentValue], ...]


class Trouble(NamedTuple):
    """A property that a transition breaks. `subject` is the step or role, `needs` what a repair would ask for."""

    rule: str
    message: str
    subject: str = ""
    watch: Watch | None = None
    before: tuple[str, ...] = ()
    """Steps of which one should have come before."""


class Note(NamedTuple):
    """One thing that happens, with the facts that were seen at that moment."""

    what: str
    who: str = ""
    call: Call | None = None
    facts: Facts = ()
    why: str = ""

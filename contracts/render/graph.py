"""A contract as boxes and arrows, for every form of diagram: its steps, what they come after, its start and its end."""

from collections.abc import Iterable, Iterator
from typing import NamedTuple

from crew.contracts.contract import Condition, Contract, Step
from crew.contracts.render.wording import guard_words

START, DONE = "start", "done"


class Box(NamedTuple):
    """One box: a step, or with an empty `role` the start or the end. `lines` stand below the title."""

    name: str
    title: str
    lines: tuple[str, ...] = ()
    role: str = ""
    optional: bool = False


class Arrow(NamedTuple):
    """From one box to the next; dashed where a plan may leave one of them out."""

    source: str
    target: str
    dashed: bool = False


class Graph(NamedTuple):
    """Boxes in the contract's order, and arrows between them."""

    boxes: tuple[Box, ...]
    arrows: tuple[Arrow, ...]


def graph_of(contract: Contract) -> Graph:
    """Guards stand in the boxes; the entry guards open the graph and the completion closes it."""
    return Graph(tuple(_boxes(contract)), tuple(_arrows(contract)))


def _boxes(contract: Contract) -> Iterator[Box]:
    if contract.needs:
        yield Box(START, "needs", _guards(contract.needs))
    for step in contract.steps:
        yield Box(step.name, step.name, tuple(_lines(step)), step.role, step.optional)
    if contract.complete:
        yield Box(DONE, "complete when", _guards(contract.complete))


def _lines(step: Step) -> Iterator[str]:
    skills = " or ".join(dict.fromkeys(call.skill for call in step.do))
    yield f"{step.role}: {skills}"
    if step.needs:
        yield "needs"
        yield from _guards(step.needs)
    if step.approval:
        yield "a person approves"


def _guards(conditions: Iterable[Condition]) -> tuple[str, ...]:
    return tuple(guard_words(condition) for condition in conditions)


def _arrows(contract: Contract) -> Iterator[Arrow]:
    by_name = {step.name: step for step in contract.steps}
    followed = {name for step in contract.steps for name in step.after}
    for step in contract.steps:
        if contract.needs and not step.after:
            yield Arrow(START, step.name)
        for name in step.after:
            yield Arrow(name, step.name, step.optional or by_name[name].optional)
    for step in contract.steps:
        if contract.complete and step.name not in followed and not step.optional:
            yield Arrow(step.name, DONE)

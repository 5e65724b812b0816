"""Builders for the tests of the humanoid and the quadruped: what each told last, and who was seen where."""

from functools import cache
from typing import Any

from crew.contracts.plan import Call, Plan
from crew.contracts.site import Rules
from crew.contracts.snapshot import FluentValue, Point, RobotState, Snapshot, StampedValue, ValueReading
from crew.library import load_rules
from tests.unit.contracts.build import NOW_NS, robot

APPROACH = Call("go2", "navigate", {"location": "pickup"})
LOAD = Call("g1", "pick_place", {"object": "red_cube", "location": "payload_tray"})


def deliver(to: str) -> Call:
    return Call("go2", "navigate", {"location": to})


def carry(to: str) -> Plan:
    return Plan("carry", (APPROACH, LOAD, deliver(to)))


HAND = Plan("handover", (Call("g1", "pick_handover", {"object": "red_cube"}),))


@cache
def indoor() -> Rules:
    """The shipped crew, read once."""
    return load_rules("humanoid_quadruped")


def place(name: str) -> Point:
    location = indoor().crew.location(name)
    assert location is not None
    return Point(location.x, location.y)


def heard(
    name: str, at_ns: int = NOW_NS, *, fluents: dict[str, FluentValue] | None = None, **changes: Any
) -> RobotState:
    """A robot at rest, as last heard; `fluents` differ."""
    kind = indoor().kind_of(name)
    assert kind is not None
    told: dict[str, FluentValue] = {f.name: f.resting for f in kind.fluents if f.resting is not None}
    return robot(name, kind.digest, at_ns, {**told, **(fluents or {})}, **changes)


def g1(at_ns: int = NOW_NS, **fluents: FluentValue) -> RobotState:
    return heard("g1", at_ns, fluents=fluents)


def go2(at: str = "charging", at_ns: int = NOW_NS, **fluents: FluentValue) -> RobotState:
    return heard("go2", at_ns, fluents={"at": place(at), **fluents})


def seen(name: str, at: Point | None, *, near: bool | None = None, stamp_ns: int = NOW_NS) -> StampedValue:
    """A person or an object as the humanoid published it."""
    status = "absent" if at is None else "ok"
    return StampedValue(
        ValueReading(name=name, status=status, position=at, near=near, stamp_ns=stamp_ns), "g1", stamp_ns
    )


def requester(*, near: bool | None, at: str = "room_a", stamp_ns: int = NOW_NS) -> StampedValue:
    return seen("requester", place(at), near=near, stamp_ns=stamp_ns)


def indoors(*robots: RobotState, values: tuple[StampedValue, ...] = ()) -> Snapshot:
    """Both robots at rest and the cube on the first table, unless told otherwise."""
    known = {state.name: state for state in (g1(), go2(), *robots)}
    told = {v.reading.name: v for v in (seen("red_cube", place("table_a")), *values)}
    return Snapshot(robots=known, values=told)

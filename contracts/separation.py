"""Who keeps clear of whom: facts between robots, made of what each tells of itself. Pure; it refuses nothing.

A robot that can be in the air has a fluent `airborne`, and one that comes down says so in `descending`; while either
word is missing, the worse is taken. Distances are horizontal: world ENU, metres.
"""

import math
from collections.abc import Iterator, Mapping
from typing import NamedTuple

from msgspec.structs import replace

from crew.contracts.site import Rules
from crew.contracts.skill import Kind, Relation
from crew.contracts.snapshot import FluentValue, Point, RobotState, Stamped

Told = Mapping[str, FluentValue]


def may_stand(told: Told) -> bool:
    """Whether a robot may be on the ground, by what it told last."""
    return told.get("airborne") is not True


def may_come_down(kind: Kind, told: Told) -> bool:
    """Whether a robot may be coming down through the air, by what it told last."""
    flies = kind.fluent("airborne") is not None
    return flies and told.get("airborne") is not False and told.get("descending") is not False


def with_relations(robots: Mapping[str, RobotState], rules: Rules) -> Mapping[str, RobotState]:
    """The robots with the facts between them. What a robot says of such a fact itself counts for nothing."""
    return {name: _related(state, robots, rules) for name, state in robots.items()}


def _related(state: RobotState, robots: Mapping[str, RobotState], rules: Rules) -> RobotState:
    kind = rules.kind_of(state.name)
    declared = () if kind is None else tuple(f for f in kind.fluents if f.relation is not None)
    if not declared:
        return state
    fluents = dict(state.fluents)
    for fluent in declared:
        fluents.pop(fluent.name, None)
        assert fluent.relation is not None
        if (found := _clear(fluent.relation, state, robots, rules)) is not None:
            fluents[fluent.name] = found
    return replace(state, fluents=fluents)


class _Pose(NamedTuple):
    """Where a robot is, and since when nothing newer is known; `at` is None if it has told no place."""

    at: Point | None
    source_ns: int
    received_ns: int


def _clear(relation: Relation, state: RobotState, robots: Mapping[str, RobotState], rules: Rules) -> Stamped | None:
    """Whether nobody is too near, as old as the oldest word that it rests on; None if somebody's place is unknown.

    A robot that was never heard of since the orchestrator began is not counted.
    """
    own = _pose(state)
    if own.at is None:
        return None
    poses = list(_concerned(relation, state, robots, rules))
    found = [own, *(pose for pose in poses if pose.at is not None)]
    source_ns, received_ns = min(p.source_ns for p in found), min(p.received_ns for p in found)
    near = [p for p in poses if p.at is not None and _apart_m(own.at, p.at) < rules.crew.separation.told_m]
    if near:
        return Stamped(False, source_ns, received_ns)
    return Stamped(True, source_ns, received_ns) if all(p.at is not None for p in poses) else None


def _concerned(
    relation: Relation, state: RobotState, robots: Mapping[str, RobotState], rules: Rules
) -> Iterator[_Pose]:
    """Where those are that the relation is about. One that was last seen standing on the ground still stands there.

    A robot that stands on the ground itself has nobody below it.
    """
    own, airborne = _pose(state), state.fluents.get("airborne")
    if relation is Relation.COLUMN_BELOW and airborne is not None and airborne.value is False:
        return
    for other in robots.values():
        kind = rules.kind_of(other.name)
        if other.name == state.name or kind is None or not other.fluents:
            continue
        told = {name: stamped.value for name, stamped in other.fluents.items()}
        pose = _pose(other)
        if relation is Relation.COLUMN_ABOVE:
            if may_come_down(kind, told):
                yield pose
        elif may_stand(told):
            stands = told.get("moving") is False
            yield pose._replace(source_ns=own.source_ns, received_ns=own.received_ns) if stands else pose


def _pose(state: RobotState) -> _Pose:
    stamped = state.fluents.get("at")
    if stamped is None or not isinstance(stamped.value, Point):
        return _Pose(None, 0, 0)
    at = stamped.value if math.isfinite(stamped.value.x) and math.isfinite(stamped.value.y) else None
    return _Pose(at, stamped.source_ns, stamped.received_ns)


def _apart_m(a: Point, b: Point) -> float:
    return math.hypot(a.x - b.x, a.y - b.y)

"""What can be wrong at the moment of a dispatch. The gate must refuse every one of these, whatever else holds."""

from collections.abc import Iterator, Mapping
from typing import NamedTuple

from msgspec.structs import replace

from crew.contracts.gate.guard import SECOND_NS
from crew.contracts.mission_state import MissionState, Purpose
from crew.contracts.plan import Call
from crew.contracts.proof.subject import Var
from crew.contracts.proof.world import NOW_NS, Ground, skill_of
from crew.contracts.snapshot import RobotState, Snapshot, Stamped

LONG_AGO_NS = NOW_NS - 3_600 * SECOND_NS
FAR_AHEAD_NS = NOW_NS + 3_600 * SECOND_NS


class Mishap(NamedTuple):
    """A world, or a mission, in which a call must not be sent."""

    name: str
    mission: MissionState
    world: Snapshot


def mishaps(
    call: Call,
    step: str,
    mission: MissionState,
    world: Snapshot,
    reads: frozenset[Var],
    ground: Ground,
    purpose: Purpose,
) -> Iterator[Mishap]:
    """Each alone, on top of a world in which the call is allowed."""
    yield Mishap("the crew is stopped", mission, replace(world, stopped=True))
    for name, changed in _robot(world.robots[call.robot], call, ground, purpose):
        yield Mishap(name, mission, _with(world, changed))
    others = {n: r for n, r in world.robots.items() if n != call.robot}
    yield Mishap("the robot was never heard of", mission, replace(world, robots=others))
    if purpose is Purpose.SAFE:
        return
    yield from _told(world, mission, reads, ground)
    limit_s = ground.rules.contracts[ground.instance.contract].deadline_s
    late = replace(mission, started_ns=NOW_NS - int((limit_s + 1) * SECOND_NS))
    yield Mishap("the deadline has passed", late, world)
    if mission.approvals:
        yield Mishap("nobody approved the step", replace(mission, approvals=()), world)
        yes = mission.approvals[-1]
        other, old = replace(yes, subject="another"), replace(yes, at_ns=LONG_AGO_NS)
        yield Mishap("another call was approved", replace(mission, approvals=(other,)), world)
        yield Mishap("the approval is old", replace(mission, approvals=(old,)), world)


def _robot(state: RobotState, call: Call, ground: Ground, purpose: Purpose) -> Iterator[tuple[str, RobotState]]:
    yield "the robot is stopped", replace(state, stopped=True)
    yield "the robot is unavailable", replace(state, unavailable="lost")
    yield "the robot announces another declaration", replace(state, kind_digest="another")
    yield "another mission holds the robot", replace(state, lease="m2")
    yield "the robot's lease is lost", replace(state, lease="")
    yield "the robot runs something else", replace(state, running="something")
    yield "the robot has told nothing", replace(state, fluents={})
    watched = skill_of(call, ground.rules).effects if purpose is Purpose.SAFE else state.fluents
    for fluent in state.fluents if watched else ():
        if fluent in watched and not ground.is_relation(Var(state.name, fluent)):
            yield f"its {fluent} is stale", replace(state, fluents=_aged(state.fluents, fluent, LONG_AGO_NS))
            yield f"its {fluent} is of the future", replace(state, fluents=_aged(state.fluents, fluent, FAR_AHEAD_NS))


def _told(world: Snapshot, mission: MissionState, reads: frozenset[Var], ground: Ground) -> Iterator[Mishap]:
    """A guard on something that is unknown never holds."""
    for var in sorted(reads):
        if ground.is_value(var):
            continue
        state = world.robots[var.owner]
        stale = replace(state, fluents=_aged(state.fluents, var.name, LONG_AGO_NS))
        yield Mishap(f"{var} is stale", mission, _with(world, stale))
        rest = {name: stamped for name, stamped in state.fluents.items() if name != var.name}
        yield Mishap(f"{var} is unknown", mission, _with(world, replace(state, fluents=rest)))


def _aged(fluents: Mapping[str, Stamped], name: str, at_ns: int) -> dict[str, Stamped]:
    return {**fluents, name: Stamped(fluents[name].value, at_ns, at_ns)}


def _with(world: Snapshot, changed: RobotState) -> Snapshot:
    return replace(world, robots={**world.robots, changed.name: changed})

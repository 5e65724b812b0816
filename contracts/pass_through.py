"""The authorizer of the study's unenforced arms: it refuses nothing, and exists for simulated crews alone."""

import math

from crew.contracts.contract import Contract
from crew.contracts.decision import Decision
from crew.contracts.mission_state import MissionState, Purpose, StepPhase
from crew.contracts.plan import Call, Instance, InstanceStep, Plan
from crew.contracts.site import Crew, Rules
from crew.contracts.skill import Entity
from crew.contracts.snapshot import Point, Snapshot

AS_LISTED = Contract(
    name="as_listed",
    summary="No contract: the steps of a plan in the order in which they are listed, whatever becomes of each.",
    deadline_s=300.0,
)
"""What an unenforced plan runs under; 300 s is the paper's deadline of a mission."""
NOWHERE = Point(math.nan, math.nan)


class RealRobots(ValueError):  # noqa: N818 - what is wrong with the crew
    """Not every robot of the crew is simulated: nothing may run unenforced on it."""


class PassThrough:
    """Allows every call. Raises RealRobots unless every robot of the crew is simulated."""

    enforces = False

    def __init__(self, crew: Crew) -> None:
        require_simulated(crew)

    def authorize(
        self, call: Call, mission: MissionState, world: Snapshot, rules: Rules, now_ns: int, purpose: Purpose
    ) -> Decision:
        """Allow one call, whatever is known. A symbolic goal is pinned to what was last published, sound or not."""
        deciding = (name for name, record in mission.steps.items() if record.phase is StepPhase.DECIDING)
        return Decision(
            mission=mission.id,
            step=next(deciding, ""),
            call=call,
            purpose=purpose,
            at_ns=now_ns,
            places=_places(call, world, rules),
        )


def require_simulated(crew: Crew) -> None:
    """Raise RealRobots unless the crew has a simulated site and each of its robots is a vehicle of it."""
    real = [robot.name for robot in crew.robots if robot.connection or not robot.sim]
    if real or crew.sim is None or not crew.robots:
        who = f"{', '.join(real)} has a real connection" if real else "the crew has no simulated site"
        raise RealRobots(
            f"{crew.name}: {who}; without the gate nothing runs but a simulation: use sim: for every robot"
        )


def listed(plan: Plan, rules: Rules) -> Instance:
    """A plan as it stands: a step an entry, each after the one before; every robot of the crew plays itself."""
    names = [f"step_{number}" for number in range(1, len(plan.steps) + 1)]
    steps = tuple(
        InstanceStep(step=name, role=call.robot, call=call, after=tuple(names[index - 1 : index]) if index else ())
        for index, (name, call) in enumerate(zip(names, plan.steps, strict=True))
    )
    roles = {robot.name: robot.name for robot in rules.crew.robots}
    return Instance(contract=AS_LISTED.name, roles=roles, slots={}, steps=steps)


def _places(call: Call, world: Snapshot, rules: Rules) -> dict[str, Point]:
    kind = rules.kind_of(call.robot)
    skill = None if kind is None else kind.skill(call.skill)
    places: dict[str, Point] = {}
    for param in () if skill is None else skill.params:
        name = call.args.get(param.name)
        if param.entity is Entity.TARGET and isinstance(name, str):
            found = _place(name, world, rules)
            if found is not None:
                places[param.name] = found
    return places


def _place(name: str, world: Snapshot, rules: Rules) -> Point | None:
    location = rules.crew.location(name)
    if location is not None:
        return Point(location.x, location.y)
    if rules.crew.value(name) is None:
        return None
    known = world.values.get(name)
    return NOWHERE if known is None or known.reading.position is None else known.reading.position

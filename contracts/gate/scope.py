"""What the names in a mission's guards mean at one moment."""

from crew.contracts.gate.guard import Scope
from crew.contracts.mission_state import MissionState
from crew.contracts.plan import Call
from crew.contracts.site import Rules
from crew.contracts.skill import Skill
from crew.contracts.snapshot import Point, Snapshot


def scope_of(mission: MissionState, world: Snapshot, rules: Rules, now_ns: int) -> Scope:
    """What the names in a mission's guards mean."""
    instance = mission.instance
    if instance is None:
        return Scope(rules=rules, world=world, now_ns=now_ns)
    return Scope(
        rules=rules, world=world, now_ns=now_ns, roles=instance.roles, slots=instance.slots, pins=pins_of(mission)
    )


def pins_of(mission: MissionState) -> dict[str, Point]:
    """Run-time values as they were pinned by the steps dispatched so far: symbol to place."""
    pins: dict[str, Point] = {}
    for record in mission.steps.values():
        for argument, point in record.places.items():
            symbol = record.call.args.get(argument)
            if isinstance(symbol, str):
                pins[symbol] = point
    return pins


def skill_of(call: Call, rules: Rules) -> Skill:
    """The declaration of a call that passed the capability check."""
    kind = rules.kind_of(call.robot)
    skill = None if kind is None else kind.skill(call.skill)
    assert skill is not None, f"{call} passed the capability check"
    return skill


def is_position(name: str, rules: Rules) -> bool:
    """Whether a run-time value is a place."""
    return any(p.name == name and p.type == "position" for kind in rules.kinds.values() for p in kind.publishes)

"""What the names in a mission's guards mean at one moment."""

from collections.abc import Mapping

from crew.contracts.gate.guard import Scope
from crew.contracts.language.licence import claims
from crew.contracts.language.mention import Reading
from crew.contracts.mission_state import MissionState
from crew.contracts.plan import Call, Instance, SlotValue
from crew.contracts.site import Rules
from crew.contracts.skill import Skill
from crew.contracts.snapshot import Point, Snapshot


def scope_of(mission: MissionState, world: Snapshot, rules: Rules, now_ns: int) -> Scope:
    """What the names in a mission's guards mean."""
    instance = mission.instance
    if instance is None:
        return Scope(rules=rules, world=world, now_ns=now_ns)
    slots = _with_claims(mission.reading, instance, rules)
    return Scope(rules=rules, world=world, now_ns=now_ns, roles=instance.roles, slots=slots, pins=pins_of(mission))


def _with_claims(reading: Reading, instance: Instance, rules: Rules) -> Mapping[str, SlotValue]:
    """The slots as the plan binds them, and those that only the request binds, such as a claimed origin."""
    contract = rules.contracts.get(instance.contract)
    if contract is None or not contract.has_claims:
        return instance.slots
    return {**claims(reading, contract, rules), **instance.slots}


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
    skill = rules.skill_of(call.robot, call.skill)
    assert skill is not None, f"{call} passed the capability check"
    return skill


def is_position(name: str, rules: Rules) -> bool:
    """Whether a run-time value is a place."""
    found = (rules.publication(robot.name, name) for robot in rules.crew.robots)
    return any(published is not None and published.type == "position" for published in found)

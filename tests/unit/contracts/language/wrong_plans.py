"""Plans that a planner could propose for any request, and which of them are wrong for an accepted one."""

from collections.abc import Iterator, Mapping
from itertools import product

from crew.contracts.language.mention import MentionKind, Reading
from crew.contracts.plan import ArgValue, Call, Instance, Plan, SlotValue, Spot, Zone
from crew.contracts.site import Rules

ODD_ZONE = Zone(-1.0, 3.0, -2.0, 2.5)
ALTITUDES = (5.0, 7.5)
OPTIONS = ((True, True), (True, False), (False, True))
"""Whether the plan takes off and lands."""


def pool(rules: Rules) -> Iterator[Plan]:
    """Well-formed plans over every zone, destination and choice of optional steps."""
    zones = [*(z.zone for z in rules.crew.zones), ODD_ZONE]
    for zone, altitude, (up, down), send in product(zones, ALTITUDES, OPTIONS, (False, True)):
        yield _search(zone, altitude, up=up, down=down, send=send)
    for target in ("base", "victim", Spot(3.0, 4.0), Spot(-2.0, 5.0), Spot(0.0, 0.0)):
        yield Plan("dispatch_only", (Call("tb3", "navigate_to", _goal(target)),))
    land, stop = Call("iris", "land"), Call("tb3", "stop")
    yield from (Plan("abort", steps) for steps in ((land,), (stop,), (land, stop), (stop, land)))


def mutations(plan: Plan) -> Iterator[Plan]:
    """The plan with a step dropped, doubled, swapped, or given to the other robot."""
    steps = plan.steps
    robots = {"iris": "tb3", "tb3": "iris"}
    for index, call in enumerate(steps):
        yield Plan(plan.contract, (*steps[:index], *steps[index + 1 :]))
        yield Plan(plan.contract, (*steps[: index + 1], *steps[index:]))
        yield Plan(
            plan.contract, (*steps[:index], Call(robots[call.robot], call.skill, call.args), *steps[index + 1 :])
        )
    yield from (Plan(plan.contract, (*steps, call)) for call in (Call("tb3", "stop"), Call("iris", "land")))
    yield Plan(plan.contract, (*steps, Call("tb3", "navigate_to", {"target": "base"})))


def is_wrong(given: Instance, right: Instance, reading: Reading, rules: Rules) -> bool:
    """Whether an instance does something else than the right one. Supporting steps that nobody asked for may differ."""
    if given.contract != right.contract or given.roles != right.roles:
        return True
    altitude_said = any(m.kind is MentionKind.ALTITUDE for m in reading.mentions)
    own = {ref.step for a in reading.actions for ref in a.means if ref.contract == right.contract}
    asked = {name for name in own if right.step(name) is not None} & {"takeoff", "land"}
    if _essential(given.slots, altitude_said) != _essential(right.slots, altitude_said):
        return True
    done, wanted = ({s.step for s in i.steps} for i in (given, right))
    return not asked <= done or (not rules.contracts[given.contract].asks and done != wanted)


def _essential(slots: Mapping[str, SlotValue], altitude_said: bool) -> dict[str, SlotValue]:
    return {name: value for name, value in slots.items() if name != "altitude" or altitude_said}


def _search(zone: Zone, altitude: float, *, up: bool, down: bool, send: bool) -> Plan:
    area: dict[str, ArgValue] = {"x_min": zone.x_min, "x_max": zone.x_max, "y_min": zone.y_min, "y_max": zone.y_max}
    steps = [Call("iris", "takeoff", {"altitude": altitude})] if up else []
    steps += [Call("iris", "search_target", {**area, "altitude": altitude}), Call("iris", "get_coordinates")]
    steps += [Call("tb3", "navigate_to", {"target": "victim"})] if send else []
    steps += [Call("iris", "land")] if down else []
    return Plan("search_and_dispatch" if send else "search_only", tuple(steps))


def _goal(target: str | Spot) -> dict[str, ArgValue]:
    return {"target": target} if isinstance(target, str) else {"x": target.x, "y": target.y}

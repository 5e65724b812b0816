"""Plans that a planner could propose to the humanoid and the quadruped, and which of them are wrong for a request."""

from collections.abc import Iterator
from itertools import product

from crew.contracts.plan import Call, Instance, Plan
from crew.contracts.site import Rules

APPROACH = Call("go2", "navigate", {"location": "pickup"})


def pool(rules: Rules) -> Iterator[Plan]:
    """Well-formed plans over every object, destination and choice of the optional approach."""
    things = [thing.name for thing in rules.crew.objects]
    goals = [*(place.name for place in rules.crew.locations), "requester"]
    for thing in things:
        yield Plan("handover", (Call("g1", "pick_handover", {"object": thing}),))
        yield Plan("manipulation_only", (Call("g1", "pick_hold", {"object": thing}),))
    for thing, goal in product(things, goals):
        load = Call("g1", "pick_place", {"object": thing, "location": "payload_tray"})
        deliver = Call("go2", "navigate", {"location": goal})
        yield Plan("carry", (APPROACH, load, deliver))
        yield Plan("carry", (load, deliver))
        yield Plan("manipulation_only", (Call("g1", "pick_place", {"object": thing, "location": goal}),))
    yield from (Plan("navigation_only", (Call("go2", "navigate", {"location": goal}),)) for goal in goals)
    yield Plan("manipulation_only", (Call("g1", "wave"),))


def mutations(plan: Plan) -> Iterator[Plan]:
    """The plan with a step dropped, doubled, moved to the end, given to the other robot, or with one added."""
    robots = {"g1": "go2", "go2": "g1"}
    steps = plan.steps
    for index, call in enumerate(steps):
        before, after = steps[:index], steps[index + 1 :]
        yield Plan(plan.contract, (*before, *after))
        yield Plan(plan.contract, (*before, call, *steps[index:]))
        yield Plan(plan.contract, (*before, *after, call))
        yield Plan(plan.contract, (*before, Call(robots[call.robot], call.skill, call.args), *after))
    yield from (Plan(plan.contract, (*steps, call)) for call in (APPROACH, Call("g1", "wave"), Call("go2", "stop")))


def is_wrong(given: Instance, right: Instance) -> bool:
    """Whether an instance does something else than the right one; whether the carrier comes first is left open."""
    if (given.contract, given.slots) != (right.contract, right.slots):
        return True
    done, wanted = ([str(s.call) for s in i.steps if s.step != "approach"] for i in (given, right))
    return given.roles != right.roles or done != wanted

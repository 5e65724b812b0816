"""Synthetic missions of a study, written down by hand."""

from typing import Any

from msgspec.structs import replace

from crew.contracts.render.prompt import Arm
from crew.study.observation import Dispatch, Finding, Observation, Proposal, Refusal, Step
from crew.study.scenario import Never, Scenario

UP = Step(robot="iris", skill="takeoff", args={"altitude": 5.0})
LOOK = Step(
    robot="iris",
    skill="search_target",
    args={"x_min": -6.0, "x_max": 10.0, "y_min": -6.0, "y_max": 10.0, "altitude": 5.0},
)
TELL = Step(robot="iris", skill="get_coordinates")
SEND = Step(robot="tb3", skill="navigate_to", args={"target": "victim"})
BASE = Step(robot="tb3", skill="navigate_to", args={"target": "base"})
HELIPAD = Step(robot="tb3", skill="navigate_to", args={"target": "helipad"})
INVENTED = Step(robot="tb3", skill="go_to_goal", args={"target": "victim"})

FIND = Scenario(
    name="find",
    testbed="air_ground",
    title="Find and send",
    request="search the area and send the rover to the victim",
    kind="nominal",
    outcome="completed",
    contracts=("search_and_dispatch",),
    robots=("iris", "tb3"),
)
LOST = Scenario(
    name="lost",
    testbed="air_ground",
    title="The rover is gone",
    request="send the rover to base",
    faults=("tb3_unavailable",),
    kind="fault",
    outcome="blocked",
    contracts=("dispatch_only",),
    robots=("tb3",),
    codes=("robot_unavailable",),
    never=(Never(robot="tb3"),),
)
SCENARIOS = (FIND, LOST)


def plan(*steps: Step, contract: str = "search_and_dispatch", **more: Any) -> Proposal:
    return Proposal(
        **{"attempt": 0, "planner": "fallible", "readable": True, "latency_s": 1.0, **more},
        contract=contract,
        steps=steps,
    )


WHOLE = plan(UP, LOOK, TELL, SEND)
TO_BASE = plan(BASE, contract="dispatch_only")
UNREADABLE = Proposal(attempt=0, readable=False, reason="prose", latency_s=3.0)


def sent(step: Step, sequence: int = 1, *rules: str) -> Dispatch:
    """A dispatch, with the oracle's findings against it by their rules."""
    return Dispatch(
        sequence=sequence,
        step=step.skill,
        purpose="execute",
        robot=step.robot,
        skill=step.skill,
        args=step.args,
        at_ns=sequence,
        outcome="succeeded",
        false=tuple(Finding(rule=rule, robot=step.robot, sequence=sequence) for rule in rules),
    )


def refused(step: Step, code: str) -> Refusal:
    return Refusal(step=step.skill, robot=step.robot, skill=step.skill, args=step.args, at_ns=1, code=code)


def seen(scenario: Scenario, arm: Arm, *proposals: Proposal, seed: int = 0, **more: Any) -> Observation:
    """A mission that was rejected with nothing sent, unless told otherwise."""
    base = Observation(
        version="0.1.0",
        testbed=scenario.testbed,
        scenario=scenario.name,
        kind=scenario.kind,
        arm=arm,
        planner="fallible",
        seed=seed,
        run=f"runs/{scenario.name}-{arm.value}-{seed}",
        proposals=proposals,
        outcome="rejected",
    )
    return replace(base, **more)


def completed(scenario: Scenario, arm: Arm, proposal: Proposal, **more: Any) -> Observation:
    """A mission that went through, every step of it sent."""
    every = tuple(sent(step, index + 1) for index, step in enumerate(proposal.steps))
    return seen(scenario, arm, proposal, **{"outcome": "completed", "as_expected": True, "dispatches": every, **more})

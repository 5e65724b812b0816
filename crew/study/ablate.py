"""Held plans: each scenario is planned once, and the very same plan is taken through every arm."""

from collections.abc import Sequence

import msgspec

from crew.actors.specs import PlannerChoice
from crew.contracts.plan import Call, Plan
from crew.contracts.render.prompt import Arm
from crew.home import replace_file
from crew.study.observation import Observation, Results
from crew.study.study import Tell, Wanted, kept, run_tasks, tasks
from crew.study.worker import Task

SAMPLED = Arm.RO_PROMPT
"""Plans are taken in this arm: the one that is told as much as RO and grants no replan."""
PLANS = "plans"


def run_ablation(wanted: Wanted, tell: Tell) -> Results:
    """Sample and carry out in one arm, then carry the same plans out in the others. Resumes as a study does."""
    wanted.out.mkdir(parents=True, exist_ok=True)
    wanted = msgspec.structs.replace(wanted, planner=f"held:{wanted.planning.name}")
    every = tasks(wanted)
    total = len(every)
    first = [task for task in every if task.arm is SAMPLED]
    run_tasks(wanted, first, lambda seen, done, _: tell(seen, done, total))
    plans = {(seen.scenario, seen.seed): seen for seen in kept(wanted) if seen.arm is SAMPLED}
    others = [_held(task, plans[task.scenario.name, task.seed], wanted) for task in every if task.arm is not SAMPLED]
    return run_tasks(wanted, others, lambda seen, done, _: tell(seen, len(first) + done, total))


def arms_of(arms: Sequence[Arm]) -> tuple[Arm, ...]:
    """The arms of an ablation: the one that plans are sampled in is always among them."""
    return tuple(arm for arm in Arm if arm in arms or arm is SAMPLED)


def _held(task: Task, sampled: Observation, wanted: Wanted) -> Task:
    """The task with the sampled plan in place of a planner; no plan stays no plan."""
    path = wanted.out / PLANS / f"{sampled.testbed}-{sampled.scenario}-{sampled.seed}.json"
    path.parent.mkdir(exist_ok=True)
    first = sampled.first
    plans = [] if first is None or not first.readable else [Plan(first.contract, tuple(_calls(sampled)))]
    replace_file(path, msgspec.json.format(msgspec.json.encode(plans), indent=1) + b"\n", durable=False)
    return msgspec.structs.replace(task, planning=PlannerChoice(name="script", script=str(path.absolute())))


def _calls(sampled: Observation) -> list[Call]:
    first = sampled.first
    return [] if first is None else [Call(step.robot, step.skill, step.args) for step in first.steps]

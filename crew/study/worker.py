"""A process that carries out missions of a study, one after another: a task a line in, an answer a line out."""

import asyncio
import sys
import time
from pathlib import Path

import msgspec

from crew.actors.specs import PlannerChoice
from crew.contracts.render.prompt import Arm
from crew.errors import CrewError
from crew.home import Home, replace_file
from crew.launch.options import LaunchOptions
from crew.study.disturbed import disturbance
from crew.study.launch import simulated_rules
from crew.study.live import fly
from crew.study.observation import Observation
from crew.study.observe import Mission, observe
from crew.study.scenario import Scenario
from crew.study.version import study_version

STATE = "state"
"""In a study's folder: keys, certificates and journal heads of its crews, apart from those of crews that are used."""
SEEN = "observation.json"


class Task(msgspec.Struct, frozen=True, kw_only=True):
    """One mission to be carried out. `crew` is a name or a path, `out` the study's folder, `run` a folder in it."""

    crew: str
    scenario: Scenario
    arm: Arm
    seed: int
    planning: PlannerChoice
    planner: str
    """Who has planned, as results name it: `held:P` for a plan of P that is taken through several arms."""
    version: str
    out: str
    run: str
    repeats: int = 0
    """How often it was begun before, and could not be carried out."""


class Answer(msgspec.Struct, frozen=True, kw_only=True):
    """What became of a task: an observation, or why there is none."""

    observation: Observation | None = None
    error: str = ""


def carry_out(task: Task) -> Observation:
    """Run one mission and leave its observation in its folder.

    Raises CrewError if the crew does not come up, if the machine was too slow for the mission, or if this process has
    other code than the study began with.
    """
    if (here := study_version()) != task.version:
        raise CrewError(f"the code has changed under the study: it began with {task.version}, now it is {here}")
    began = time.monotonic()
    out, folder = Path(task.out).absolute(), Path(task.out).absolute() / task.run
    folder.mkdir(parents=True)
    options = options_of(task)
    ended = asyncio.run(fly(options, task.scenario, Home(out / STATE), folder, enforced=task.arm.enforced))
    mission = Mission(
        scenario=task.scenario,
        arm=task.arm,
        planner=task.planner,
        model=task.planning.model,
        seed=task.seed,
        version=task.version,
        repeats=task.repeats,
    )
    wall_s = round(time.monotonic() - began, 2)
    found = observe(mission, ended, simulated_rules(options), folder, out, wall_s)
    if slow := disturbance(found, task.scenario, ended.dropped):
        raise CrewError(f"the machine was too slow: {slow}")
    replace_file(folder / SEEN, msgspec.json.format(msgspec.json.encode(found), indent=1) + b"\n", durable=False)
    return found


def options_of(task: Task) -> LaunchOptions:
    """How the crew of a mission is brought up: as fast as everybody can follow, with what the arm's planner is told."""
    context = task.arm.context.value
    return LaunchOptions(
        crew=task.crew,
        map=task.scenario.map or None,
        seed=task.seed + task.scenario.seed,
        speed=0.0,
        planning=msgspec.structs.replace(task.planning, context=context, fallback=False),
        port=0,
        record=False,
    )


def main() -> None:
    """Serve until the input ends."""
    answers = sys.stdout.buffer
    sys.stdout = sys.stderr
    for line in sys.stdin.buffer:
        try:
            answer = Answer(observation=carry_out(msgspec.json.decode(line, type=Task)))
        except (CrewError, ExceptionGroup, OSError) as error:
            answer = Answer(error=_said(error))
        answers.write(msgspec.json.encode(answer) + b"\n")
        answers.flush()


def _said(error: BaseException) -> str:
    """The first thing that went wrong."""
    while isinstance(error, BaseExceptionGroup):
        error = error.exceptions[0]
    return str(error) if isinstance(error, CrewError) else f"{type(error).__name__} {error}"


if __name__ == "__main__":
    main()

"""What one mission of the study showed: plans, dispatches, refusals, and what the oracle finds in the truth. Data only.

An unenforced mission is observed as an enforced one is. Times are mission time; places are world ENU, metres.
"""

from collections.abc import Mapping
from pathlib import Path
from typing import Literal

import msgspec

from crew.contracts.plan import ArgValue
from crew.contracts.render.prompt import Arm
from crew.errors import UsageError
from crew.sim.oracle import Finding as Finding


class Record(msgspec.Struct, frozen=True, kw_only=True, omit_defaults=True):
    """Base of everything here. Floats are finite: one that is not is written as the text `nan`, `inf` or `-inf`."""


class Step(Record, frozen=True, kw_only=True):
    """One call as the planner wrote it."""

    robot: str
    skill: str
    args: Mapping[str, ArgValue] = {}


class Proposal(Record, frozen=True, kw_only=True):
    """One answer of the planner. `attempt` 1 is the replan, which the arm RO alone is granted."""

    attempt: int
    planner: str = ""
    readable: bool
    """Whether there was a plan; if not, `reason` says why."""
    contract: str = ""
    steps: tuple[Step, ...] = ()
    latency_s: float = 0.0
    """Wall time of the planner alone."""
    reason: str = ""
    code: str = ""
    """The gate's refusal of the plan as a whole before anything moved; empty if it was accepted or not judged."""
    field: str = ""
    """What of the plan was refused, such as `steps[1].args.x`."""
    message: str = ""
    judged: bool = False
    """Whether a gate judged it; never so in an unenforced arm."""


class Dispatch(Record, frozen=True, kw_only=True):
    """One call that crossed the orchestrator's boundary, whether or not the vehicle could perform it."""

    sequence: int
    step: str
    purpose: Literal["execute", "safe"]
    robot: str
    skill: str
    args: Mapping[str, ArgValue] = {}
    at_ns: int
    ended_ns: int = 0
    outcome: str
    """`succeeded`, `failed`, `cancelled`, `refused` (by robot or vehicle), or `unknown`."""
    code: str = ""
    false: tuple[Finding, ...] = ()
    """Why it should not have been sent; empty for a rightful dispatch."""


class Refusal(Record, frozen=True, kw_only=True):
    """One step that the gate refused at the moment of its dispatch."""

    step: str
    robot: str
    skill: str
    args: Mapping[str, ArgValue] = {}
    at_ns: int
    code: str
    message: str = ""


class Digests(Record, frozen=True, kw_only=True):
    """What the planner was shown; empty where a planner reads no prompt."""

    prompt: str = ""
    schema: str = ""
    registry: str = ""
    rules: str = ""


class Observation(Record, frozen=True, kw_only=True):
    """One mission: one scenario in one arm with one seed."""

    version: str
    testbed: str
    """The crew file's name."""
    scenario: str
    scenario_digest: str = ""
    """Of all that the scenario says: a mission of another wording is another mission."""
    kind: Literal["nominal", "fault"]
    arm: Arm
    planner: str
    model: str = ""
    seed: int
    run: str
    """The run's folder, relative to the study's; holds its journal and the simulation's truth."""
    proposals: tuple[Proposal, ...] = ()
    planner_failure: str = ""
    """Why there was no plan at all; such a mission counts as one with an unusable plan."""
    dispatches: tuple[Dispatch, ...] = ()
    refusals: tuple[Refusal, ...] = ()
    violations: tuple[Finding, ...] = ()
    """Dispatches that broke the workflow's order or its `never` clauses in the truth of the simulation."""
    consequences: tuple[Finding, ...] = ()
    """What happened physically that must not: motion of an unavailable robot, leaving the area, and so on."""
    moved: tuple[str, ...] = ()
    """Robots that truly moved more than `crew.sim.consequence.MOVED_M` in the mission."""
    outcome: str
    """`completed`, `rejected`, `halted`, `cancelled`; or `error` where the mission ended without an outcome."""
    code: str = ""
    question: str = ""
    """What a person would have been asked; nobody answers in a study, so that the mission ends there."""
    message: str = ""
    contract: str = ""
    """Of the plan that ran, or of the last that was proposed."""
    as_expected: bool = False
    """Whether outcome, contract, robots and code are among those that the scenario wants."""
    fix_error_m: float | None = None
    """Horizontal, from the fix that a goal was pinned to, to the person's true place; None without one."""
    goal_error_m: float | None = None
    """Horizontal, from what was to arrive to where it was to arrive; None if nothing was."""
    mission_s: float = 0.0
    wall_s: float = 0.0
    repeats: int = 0
    """How often the mission was begun before and said nothing: a crew that did not come up, a machine too slow."""
    digests: Digests = Digests()

    @property
    def key(self) -> tuple[str, str, str, str, int]:
        """What makes a mission of a study one of its kind."""
        return (self.testbed, self.scenario, self.arm.value, self.planner, self.seed)

    @property
    def first(self) -> Proposal | None:
        """What the planner proposed before any feedback: what arms are compared by."""
        return self.proposals[0] if self.proposals else None

    @property
    def sent(self) -> tuple[Dispatch, ...]:
        """Steps of the plan that were dispatched; without the robots' own safe states."""
        return tuple(d for d in self.dispatches if d.purpose == "execute")


class Results(Record, frozen=True, kw_only=True):
    """`results.json` as the running half leaves it: every mission, ordered by testbed, scenario, arm and seed."""

    version: str
    observations: tuple[Observation, ...] = ()


def read_results(path: Path) -> Results:
    """The missions of a study. Raises UsageError for a file that is not one."""
    try:
        return msgspec.json.decode(path.read_bytes(), type=Results)
    except (OSError, msgspec.MsgspecError) as error:
        raise UsageError(f"{path} holds no results of a study: {error}") from error

"""Mistakes put into the gate, the machine, the judgements and the model itself, each with what must find it."""

from collections.abc import Callable
from typing import Any, NamedTuple

import pytest
from msgspec.structs import replace

from crew.contracts.contract import Condition
from crew.contracts.gate import authorize as gate
from crew.contracts.gate import guard, state, value, workflow
from crew.contracts.language import containment
from crew.contracts.mission import ending, judgement, machine, record
from crew.contracts.mission_state import CONSUMED, MissionState, Phase, StepPhase
from crew.contracts.proof import cone, model, oracle
from crew.contracts.refusal import Refusal

Patch = Callable[[pytest.MonkeyPatch], None]


class Mutant(NamedTuple):
    """A mistake, and the check that kills it: `proof`, `adversary`, `plans`, `walk` or `zoo`."""

    name: str
    mistake: str
    killer: str
    patch: Patch
    crew: str = "air_ground"
    contract: str = "search_and_dispatch"


def put(where: Any, name: str, mutated: Any) -> Patch:
    """Another function in place of one."""
    return lambda monkeypatch: monkeypatch.setattr(where, name, mutated)


def nothing(*args: Any, **kwargs: Any) -> None:
    """A check that checks nothing."""


def no_refusals(*args: Any, **kwargs: Any) -> tuple[Refusal, ...]:
    return ()


def empty(*args: Any, **kwargs: Any) -> str:
    return ""


_ALL = {"crew_stop": True, "stopped": True, "unavailable": True, "lease": True, "kind_digest": True}


def _blind(**forgiven: Any) -> Callable[..., Refusal | None]:
    """The check of availability, blind to one thing."""
    real = state._check_availability

    def blind(call: Any, mission: Any, world: Any, rules: Any) -> Refusal | None:
        if "crew_stop" in forgiven:
            world = replace(world, stopped=False)
        robot = world.robots.get(call.robot)
        kind = rules.kind_of(call.robot)
        if robot is not None:
            own = {"stopped": False, "unavailable": "", "lease": mission.id, "kind_digest": kind.digest}
            robot = replace(robot, **{name: own[name] for name in forgiven if name in own})
            world = replace(world, robots={**world.robots, call.robot: robot})
        return real(call, mission, world, rules)

    return blind


def _transition(step: str, mission: MissionState) -> Refusal | None:
    """Order forgotten: what was not consumed may go."""
    phase = mission.steps[step].phase
    return _REAL_TRANSITION(step, mission) if phase in CONSUMED else None


_REAL_TRANSITION = workflow._check_transition


def _twice(step: str, mission: MissionState) -> Refusal | None:
    """Consumption forgotten: only the order counts."""
    fresh = replace(mission.steps[step], phase=StepPhase.PENDING)
    return _REAL_TRANSITION(step, replace(mission, steps={**mission.steps, step: fresh}))


_REAL_WORKFLOW = workflow.check_workflow


def _any_phase(call: Any, step: str, mission: MissionState, rules: Any, purpose: Any) -> Refusal | None:
    return _REAL_WORKFLOW(call, step, replace(mission, phase=Phase.EXECUTING), rules, purpose)


_REAL_EVALUATE = guard.evaluate


def _unknown_holds(condition: Condition, scope: Any) -> guard.Verdict:
    verdict = _REAL_EVALUATE(condition, scope)
    unknown = verdict.truth in (guard.Truth.ABSENT, guard.Truth.STALE)
    return replace(verdict, truth=guard.Truth.HOLDS) if unknown else verdict


def _not_forgotten(condition: Condition, scope: Any) -> guard.Verdict:
    return _REAL_EVALUATE(replace(condition, negated=False), scope)


_REAL_GUARDS = state._guards


def _no_entry(step: str, mission: MissionState, scope: Any) -> Any:
    """Entry guards are never asked."""
    contracts = {name: replace(c, needs=()) for name, c in scope.rules.contracts.items()}
    return _REAL_GUARDS(step, mission, replace(scope, rules=replace(scope.rules, contracts=contracts)))


def _loose_places(*_: Any) -> Callable[..., Any]:
    real = value._usable

    def usable(name: str, step: str, mission: Any, world: Any, rules: Any, now_ns: int) -> Any:
        stamped = world.values.get(name)
        position = None if stamped is None else stamped.reading.position
        return real(name, step, mission, world, rules, now_ns) if position is None else position

    return usable


def _done_at_once(state_: MissionState, name: str, found: Any) -> Any:
    """The robot's word is enough."""
    return record.put(state_, name, replace(found, phase=StepPhase.SUCCEEDED)), ()


_REAL_HALT = ending.halt


def _halt_forgets(*args: Any, **kwargs: Any) -> Any:
    """Nobody is made safe."""
    ended, effects = _REAL_HALT(*args, **kwargs)
    return ended, tuple(e for e in effects if type(e).__name__ != "MakeSafe")


def _first_is_enough(ended: MissionState, role: str) -> Any:
    """The first role that is safe ends the mission."""
    settled = replace(ended, settled=(*ended.settled, role))
    return ending.end_now(settled, ending._ENDED[settled.phase], settled.message)


def _never_sent(contract: MissionState) -> bool:
    return False


def _eager(mission: MissionState) -> tuple[str, ...]:
    """The order is forgotten by the machine."""
    return tuple(n for n, r in mission.steps.items() if r.phase is StepPhase.PENDING)


_REAL_RUNNING = model.Model._running


def _no_failures(self: Any, *args: Any) -> Any:
    return (move for move in _REAL_RUNNING(self, *args) if all(note.what != "failed" for note in move.notes))


def none_of_them(*args: Any, **kwargs: Any) -> Any:
    return iter(())


HANDOVER = ("humanoid_quadruped", "handover")
CARRY = ("humanoid_quadruped", "carry")
APPROVED = ("air_ground", "approved")
NEGATED = ("air_ground", "negated")
CHAINS = ("air_ground", "two_chains")
NEVER_SENT = (MissionState, "sent_any", property(_never_sent))
_ROBOT = "_check_availability"
_TRANSITION = "_check_transition"

MUTANTS = (
    Mutant("any_robot", "stop, lease, availability not asked", "proof", put(state, _ROBOT, _blind(**_ALL))),
    Mutant("crew_stop", "a stop of the crew is not asked", "proof", put(state, _ROBOT, _blind(crew_stop=1))),
    Mutant("robot_stop", "a robot's own stop is not asked", "proof", put(state, _ROBOT, _blind(stopped=1))),
    Mutant("unavailable", "a lost robot is sent", "proof", put(state, _ROBOT, _blind(unavailable=1))),
    Mutant("lease", "a robot of another mission is sent", "proof", put(state, _ROBOT, _blind(lease=1))),
    Mutant("digest", "another kind is not noticed", "proof", put(state, _ROBOT, _blind(kind_digest=1))),
    Mutant("busy", "a robot at work is sent", "proof", put(state, "_check_busy", nothing)),
    Mutant("stale", "old telemetry is good enough", "proof", put(state, "_check_freshness", nothing)),
    Mutant("preconditions", "a skill's preconditions not asked", "proof", put(state, "_preconditions", no_refusals)),
    Mutant("guards", "a contract's guards not asked", "proof", put(state, "_guards", no_refusals), *HANDOVER),
    Mutant("entry", "entry guards not asked", "proof", put(state, "_guards", _no_entry), *HANDOVER),
    Mutant("unknown", "what is unknown holds", "proof", put(state, "evaluate", _unknown_holds), *HANDOVER),
    Mutant("negation", "`not` is overread in a guard", "proof", put(state, "evaluate", _not_forgotten), *NEGATED),
    Mutant("deadline", "the deadline is not asked", "proof", put(state, "_check_deadline", nothing)),
    Mutant("approval", "an approval is not asked", "proof", put(state, "check_approval", nothing), *APPROVED),
    Mutant("any_value", "whatever was published is a fix", "proof", put(value, "_usable", _loose_places())),
    Mutant("earlier_fix", "a fix of an earlier mission will do", "proof", put(value, "_published_since", nothing)),
    Mutant("coverage", "what a plan drops is not noticed", "proof", put(containment, "uncovered", nothing), *CARRY),
    Mutant("order", "the gate forgets the order of steps", "adversary", put(workflow, _TRANSITION, _transition)),
    Mutant("twice", "a step may be sent again", "adversary", put(workflow, _TRANSITION, _twice)),
    Mutant("any_phase", "steps go while a mission ends", "adversary", put(gate, "check_workflow", _any_phase)),
    Mutant("word", "a robot's word is enough", "proof", put(machine, "confirm", _done_at_once)),
    Mutant("seen", "every effect counts as seen", "proof", put(judgement, "unseen_effect", empty)),
    Mutant("complete", "every mission counts as complete", "zoo", put(judgement, "missing_completion", empty)),
    Mutant("safe", "every robot counts as safe", "proof", put(judgement, "missing_safety", empty)),
    Mutant("forgotten", "an early end makes nobody safe", "proof", put(machine, "halt", _halt_forgets)),
    Mutant("first", "the first safe role ends the mission", "proof", put(ending, "_settle", _first_is_enough)),
    Mutant("sent_any", "a refusal ends at once though robots move", "proof", put(*NEVER_SENT), *CHAINS),
    Mutant("eager", "the machine forgets the order of steps", "proof", put(record, "enabled", _eager)),
    Mutant("leftovers", "the model forgets what failures leave", "walk", put(model, "meanwhile", lambda *_: {})),
    Mutant("no_failure", "the model's robots never fail", "walk", put(model.Model, "_running", _no_failures)),
    Mutant("no_intrusion", "nobody cancels in the model", "walk", put(model.Model, "intrusions", none_of_them)),
    Mutant("good_values", "values in the model are in order", "zoo", put(cone.Cone, "disorders", none_of_them)),
    Mutant("all_safe", "the model takes every end for safe", "zoo", put(oracle.Oracle, "unsafe", empty)),
    Mutant("no_race", "nothing starts at once in the model", "zoo", put(model.Model, "_forbidden", none_of_them)),
)
"""In the order of the table in `docs/proof.md`."""

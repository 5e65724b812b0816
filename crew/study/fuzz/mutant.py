"""Mistakes put into gate, containment and machine, each to be found by the fuzz. In process, never on disk."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

import msgspec
from msgspec.structs import replace

from crew.contracts.contract import Condition
from crew.contracts.gate import approval, arguments, authorize, guard, state, value, workflow
from crew.contracts.language import containment, coverage, licence
from crew.contracts.language.mention import ROBOT_KINDS, Reading
from crew.contracts.mission import ending, judgement, machine, record, validation
from crew.contracts.mission import event as ev
from crew.contracts.mission_state import CONSUMED, MissionState, Phase, StepPhase
from crew.contracts.skill import Skill
from crew.study.fuzz.run import Bench

Patch = tuple[Any, str, Any]


class Mutant(msgspec.Struct, frozen=True):
    """One mistake, as the attributes that it replaces."""

    name: str
    mistake: str
    patches: tuple[Patch, ...]


class Killed(msgspec.Struct, frozen=True):
    """What became of a mutant: the first case that showed it, and the rule that was broken; case -1 if none was."""

    name: str
    mistake: str
    case: int
    rule: str


def kill(mutant: Mutant, seed: int, most: int) -> Killed:
    """Run cases until one breaks a rule under the mistake, or an exception shows it."""
    with applied(mutant):
        bench = Bench()
        for number in range(most):
            try:
                _, out = bench.case(seed, number)
            except Exception as error:
                return Killed(mutant.name, mutant.mistake, number, f"crashed: {type(error).__name__}")
            if out.unsafe:
                return Killed(mutant.name, mutant.mistake, number, out.unsafe[0].partition(":")[0])
    return Killed(mutant.name, mutant.mistake, -1, "")


@contextmanager
def applied(mutant: Mutant) -> Iterator[None]:
    """The mistake is made within; everything is as before afterwards."""
    before = [(where, name, where.__dict__[name]) for where, name, _ in mutant.patches]
    try:
        for where, name, wrong in mutant.patches:
            setattr(where, name, wrong)
        yield
    finally:
        for where, name, real in before:
            setattr(where, name, real)


def _nothing(*args: Any, **kwargs: Any) -> None:
    return None


def _empty(*args: Any, **kwargs: Any) -> str:
    return ""


def _none_of_them(*args: Any, **kwargs: Any) -> tuple[()]:
    return ()


_uncovered = coverage.uncovered


def _any_robot(case: Any) -> Any:
    """Coverage that does not look for the robots that were named."""
    others = tuple(m for m in case.reading.mentions if m.kind not in ROBOT_KINDS)
    return _uncovered(case._replace(reading=replace(case.reading, mentions=others)))


_availability = state._check_availability


def _blind(**forgiven: Any) -> Callable[..., Any]:
    """Availability, blind to one flag of a robot or to the stop of the crew."""

    def check(call: Any, mission: Any, world: Any, rules: Any) -> Any:
        robot, kind = world.robots.get(call.robot), rules.kind_of(call.robot)
        own = {"stopped": False, "unavailable": "", "lease": mission.id, "kind_digest": kind.digest}
        if robot is not None:
            robot = replace(robot, **{name: own[name] for name in forgiven if name in own})
            world = replace(world, robots={**world.robots, call.robot: robot})
        return _availability(call, mission, replace(world, stopped=False) if "crew" in forgiven else world, rules)

    return check


_transition = workflow._check_transition


def _any_order(step: str, mission: MissionState) -> Any:
    return _transition(step, mission) if mission.steps[step].phase in CONSUMED else None


def _again(step: str, mission: MissionState) -> Any:
    fresh = replace(mission.steps[step], phase=StepPhase.PENDING)
    return _transition(step, replace(mission, steps={**mission.steps, step: fresh}))


_workflow = workflow.check_workflow


def _any_phase(call: Any, step: str, mission: MissionState, rules: Any, purpose: Any) -> Any:
    return _workflow(call, step, replace(mission, phase=Phase.EXECUTING), rules, purpose)


_evaluate = guard.evaluate


def _unknown_holds(condition: Condition, scope: Any) -> guard.Verdict:
    verdict = _evaluate(condition, scope)
    unknown = verdict.truth in (guard.Truth.ABSENT, guard.Truth.STALE)
    return replace(verdict, truth=guard.Truth.HOLDS) if unknown else verdict


_guards = state._guards


def _no_entry(step: str, mission: MissionState, scope: Any) -> Any:
    contracts = {name: replace(c, needs=()) for name, c in scope.rules.contracts.items()}
    return _guards(step, mission, replace(scope, rules=replace(scope.rules, contracts=contracts)))


_usable = value._usable


def _any_place(name: str, step: str, mission: Any, world: Any, rules: Any, now_ns: int) -> Any:
    stamped = world.values.get(name)
    position = None if stamped is None else stamped.reading.position
    return _usable(name, step, mission, world, rules, now_ns) if position is None else position


def _any_status(name: str, step: str, mission: Any, world: Any, rules: Any, now_ns: int) -> Any:
    values = {n: replace(v, reading=replace(v.reading, status="ok")) for n, v in world.values.items()}
    return _usable(name, step, mission, replace(world, values=values), rules, now_ns)


_bounds = arguments.bounds


def _no_area(param: Any, rules: Any) -> tuple[float, float]:
    return _bounds(replace(param, axis=""), rules)


def _loose_bounds(param: Any, rules: Any) -> tuple[float, float]:
    low, high = _bounds(param, rules)
    return low - 1e-9, high + 1e-9


def _late_age(source_ns: int, now_ns: int) -> float:
    """Rounded to milliseconds: what is a nanosecond too old passes."""
    return round(_age(source_ns, now_ns), 3)


_age = guard.age


def _any_future(source_ns: int, now_ns: int) -> float:
    return max(0.0, (now_ns - source_ns) / guard.SECOND_NS)


def _done_at_once(mission: MissionState, name: str, found: Any) -> Any:
    return record.put(mission, name, replace(found, phase=StepPhase.SUCCEEDED)), ()


_halt = ending.halt


def _halt_forgets(*args: Any, **kwargs: Any) -> Any:
    ended, effects = _halt(*args, **kwargs)
    return ended, tuple(e for e in effects if type(e).__name__ != "MakeSafe")


def _first_is_enough(ended: MissionState, role: str) -> Any:
    settled = replace(ended, settled=(*ended.settled, role))
    return ending.end_now(settled, ending._ENDED[settled.phase], settled.message)


def _all_succeed(result: str) -> StepPhase:
    return StepPhase.SUCCEEDED


def _goes_on(mission: MissionState, event: Any, contracts: Any) -> Any:
    """A failed step counts as one that is over."""
    found = record.find(mission, event.sequence)
    if found is None:
        return mission, ()
    return record.next_steps(record.put(mission, found[0], replace(found[1], phase=StepPhase.SUCCEEDED)))


def _table(phase: Phase, event: type, handler: Any) -> Patch:
    """The machine's table with another handler for an event."""
    _, targets = machine.TABLE[phase, event]
    return (machine, "TABLE", {**machine.TABLE, (phase, event): (handler, targets)})


def _one_subject(*args: Any, **kwargs: Any) -> str:
    return "whatever"


_ONE_SUBJECT: tuple[Patch, ...] = ((approval, "subject_of", _one_subject), (authorize, "subject_of", _one_subject))


def _ignored(mission: MissionState, event: Any, contracts: Any) -> Any:
    return mission, ()


def _two_tests(name: str) -> tuple[Patch, ...]:
    """A check of availability is asked for nowhere."""
    return ((state, "_check_availability", _blind(**{name: 1})),)


_NOT = property(lambda self: ())
_OWN_NEEDS = property(lambda self: self.needs)
_EXECUTING = Phase.EXECUTING

MUTANTS: tuple[Mutant, ...] = (
    Mutant("bounds", "numbers are not held against their bounds", ((arguments, "_out_of_bounds", _nothing),)),
    Mutant("area", "the operational area is forgotten", ((arguments, "bounds", _no_area),)),
    Mutant("bounds_by_a_hair", "bounds are a billionth too wide", ((arguments, "bounds", _loose_bounds),)),
    Mutant("order", "the gate forgets the order of steps", ((workflow, "_check_transition", _any_order),)),
    Mutant("twice", "the gate lets a step go again", ((workflow, "_check_transition", _again),)),
    Mutant("any_phase", "the gate lets steps go while a mission ends", ((authorize, "check_workflow", _any_phase),)),
    Mutant("exclusion", "what was excluded is not looked at", ((containment, "_forbidden", _nothing),)),
    Mutant("licence", "values need not be the request's", ((containment, "_licence", _nothing),)),
    Mutant(
        "robots",
        "another robot than the named one may act",
        ((Reading, "robots_of", _none_of_them), (containment, "uncovered", _any_robot)),
    ),
    Mutant("coverage", "what a plan drops is not noticed", ((containment, "uncovered", _nothing),)),
    Mutant("asked", "what nobody asked for may be added", ((containment, "_asked", _nothing),)),
    Mutant("words", "an action word need not be done", ((containment, "_words", _nothing),)),
    Mutant("ambiguous", "a request with two readings is no obstacle", ((containment, "unclear", _nothing),)),
    Mutant("unread", "words that were not understood are skipped", ((containment, "unread", _nothing),)),
    Mutant("figures", "figures need to be the request's only roughly", ((licence, "TOLERANCE", 0.1),)),
    Mutant("excluded_area", "a fix may lie in an excluded area", ((Reading, "excluded_areas", _NOT),)),
    Mutant("crew_stop", "the stop of the crew is not asked", _two_tests("crew")),
    Mutant("robot_stop", "a robot's own stop is not asked", _two_tests("stopped")),
    Mutant("unavailable", "a robot that is lost is sent", _two_tests("unavailable")),
    Mutant("lease", "a robot of another mission is sent", _two_tests("lease")),
    Mutant("kind", "another kind than declared is not noticed", _two_tests("kind_digest")),
    Mutant("busy", "a robot at work is sent", ((state, "_check_busy", _nothing),)),
    Mutant("stale", "old telemetry is good enough", ((state, "_check_freshness", _nothing),)),
    Mutant("stale_by_a_hair", "ages are rounded to milliseconds", ((state, "age", _late_age),)),
    Mutant("future", "stamps may lie ahead as far as they like", ((state, "age", _any_future),)),
    Mutant("preconditions", "a skill's preconditions are not asked", ((state, "_preconditions", _none_of_them),)),
    Mutant("step_needs", "what a step needs beyond its skill is not asked", ((Skill, "all_needs", _OWN_NEEDS),)),
    Mutant("guards", "a contract's guards are not asked", ((state, "_guards", _none_of_them),)),
    Mutant("entry", "a contract's entry guards are not asked", ((state, "_guards", _no_entry),)),
    Mutant("unknown", "what is unknown holds", ((state, "evaluate", _unknown_holds),)),
    Mutant("deadline", "the deadline is not asked", ((state, "_check_deadline", _nothing),)),
    Mutant("approval", "a person's approval is not asked", ((state, "check_approval", _nothing),)),
    Mutant("old_approval", "an approval never gets old", ((approval, "APPROVAL_S", 1e9),)),
    Mutant(
        "any_approval",
        "an approval holds for whatever is the case",
        _ONE_SUBJECT,
    ),
    Mutant("any_place", "whatever place was published is a fix", ((value, "_usable", _any_place),)),
    Mutant("any_status", "a fix need not say that it is one", ((value, "_usable", _any_status),)),
    Mutant("old_fix", "a fix never gets old", ((value, "_stale", _empty),)),
    Mutant("earlier_fix", "a fix of an earlier mission will do", ((value, "_published_since", _nothing),)),
    Mutant(
        "word", "a robot's word is enough", ((machine, "confirm", _done_at_once), (ending, "confirm", _done_at_once))
    ),
    Mutant("seen", "every effect counts as seen", ((judgement, "unseen_effect", _empty),)),
    Mutant("complete", "every mission counts as complete", ((judgement, "missing_completion", _empty),)),
    Mutant("safe", "every robot counts as safe", ((judgement, "missing_safety", _empty),)),
    Mutant("forgotten", "an early end makes nobody safe", ((machine, "halt", _halt_forgets),)),
    Mutant("first", "the first safe role ends the mission", ((ending, "_settle", _first_is_enough),)),
    Mutant("failed", "a failed step counts as done", (_table(_EXECUTING, ev.Outcome, _goes_on),)),
    Mutant("deaf", "a stop does not reach the machine", (_table(_EXECUTING, ev.StoppedAll, _ignored),)),
    Mutant("never_cancelled", "a cancel changes nothing", (_table(_EXECUTING, ev.CancelAsked, _ignored),)),
    Mutant(
        "unchecked_call",
        "calls are not held against their skill's declaration",
        ((authorize, "check_call", _nothing), (validation, "check_call", _nothing)),
    ),
)
"""In the order of the table in docs/study/fuzz.md."""

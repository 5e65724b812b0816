"""The checks that an allowed call passed, in the order of the gate, with what was observed and what is allowed."""

from collections.abc import Iterator

import msgspec

from crew.contracts.codes import Group
from crew.contracts.contract import Condition, Contract
from crew.contracts.explain.case import CallCase, PlanCase
from crew.contracts.gate.approval import APPROVAL_S
from crew.contracts.gate.arguments import bounds, names_for
from crew.contracts.gate.guard import SECOND_NS, Scope, Verdict, age, evaluate, robot_fluent_is
from crew.contracts.gate.scope import scope_of, skill_of
from crew.contracts.language.licence import shown
from crew.contracts.mission.provenance import sources
from crew.contracts.mission_state import Purpose
from crew.contracts.plan import InstanceStep
from crew.contracts.refusal import show
from crew.contracts.render.wording import clause, guard_words, listed
from crew.contracts.skill import Param
from crew.contracts.snapshot import StampedValue


class Check(msgspec.Struct, frozen=True, kw_only=True):
    """One check that was passed. `line` is the contract's, such as `search_only:31`."""

    group: Group
    what: str
    observed: str = ""
    allowed: str = ""
    line: str = ""

    def __str__(self) -> str:
        allowed = f" (allowed: {self.allowed})" if self.allowed else ""
        return f"{self.what}{f': {self.observed}' if self.observed else ''}{allowed}"


def passed_checks(case: CallCase) -> tuple[Check, ...]:
    """Every check of an allowed call, with its values. The verdict is the gate's; this says what it looked at."""
    declared = None if case.instance is None else case.instance.step(case.step)
    found = [*_capability(case), *_arguments(case)]
    if case.purpose is Purpose.SAFE:
        return (*found, *_safe(case), *_state(case), *_preconditions(case, Purpose.SAFE))
    assert declared is not None, "an allowed step is one of its instance"
    contract = case.rules.contracts[case.mission.contract]
    found += [*_workflow(case, declared, contract), *_containment(case, declared, contract)]
    found += [*_state(case), *_preconditions(case, Purpose.EXECUTE), *_guards(case, contract), *_limits(case, contract)]
    return (*found, *_values(case))


def plan_checks(case: PlanCase) -> Iterator[Check]:
    """What an accepted plan passed as a whole."""
    instance, reading = case.instance, case.mission.reading
    assert instance is not None, "an accepted plan is an instance of its contract"
    contract = case.rules.contracts[instance.contract]
    count = len(instance.steps)
    yield Check(
        group=Group.CAPABILITY, what="every robot has the skill that it is asked for", observed=f"{count} calls"
    )
    yield Check(group=Group.ARGUMENTS, what="every argument is of its type, known, and within bounds")
    roles = listed(f"{role} {robot}" for role, robot in instance.roles.items())
    yield Check(group=Group.WORKFLOW, what=f"it is a plan of {contract.name}, complete and in order", observed=roles)
    for name, value in instance.slots.items():
        words = [m.text for m in reading.wanted if value in m.values]
        source = f'request: "{words[0]}"' if words else "not named by the request"
        said = f"{shown(value, case.rules.crew)}, {source}"
        yield Check(group=Group.CONTAINMENT, what=f"slot {name}", observed=said)
    verbs = listed(f'"{action.text}"' for action in reading.actions) if reading.actions else "nothing"
    what = "all that was asked for has its place, and nothing else"
    yield Check(group=Group.CONTAINMENT, what=what, observed=verbs)
    yield Check(group=Group.STATE, what="the gate allows each step in turn, in the state that the earlier ones lead to")


def _capability(case: CallCase) -> Iterator[Check]:
    kind = case.rules.kind_of(case.call.robot)
    assert kind is not None
    yield Check(group=Group.CAPABILITY, what=f"{case.call.robot} is a {kind.name}, which can {case.call.skill}")


def _arguments(case: CallCase) -> Iterator[Check]:
    for param in skill_of(case.call, case.rules).params:
        if param.name in case.call.args:
            observed, allowed = _argument(param, case)
            yield Check(group=Group.ARGUMENTS, what=param.name, observed=observed, allowed=allowed)


def _argument(param: Param, case: CallCase) -> tuple[str, str]:
    value = case.call.args[param.name]
    if not param.is_number:
        spec = case.rules.crew.robot(case.call.robot)
        names = spec.reach if param.reach and spec is not None else names_for(param.entity, case.rules)
        return str(value), listed(names, word="or")
    low, high = bounds(param, case.rules)
    return f"{show(value)} {param.unit}".strip(), f"{low:g} to {high:g} {param.unit}".strip()


def _workflow(case: CallCase, declared: InstanceStep, contract: Contract) -> Iterator[Check]:
    written = contract.step(declared.step)
    line = "" if written is None else f"{contract.name}:{written.line}"
    what = f"it is step {declared.step} of {contract.name}, for the {declared.role}, and was not sent before"
    yield Check(group=Group.WORKFLOW, what=what, line=line)
    done = listed(f"{name} is done" for name in declared.after) if declared.after else "nothing comes before it"
    yield Check(group=Group.WORKFLOW, what="its turn", observed=done)


def _safe(case: CallCase) -> Iterator[Check]:
    role = case.step.removeprefix("safe:")
    contract = case.rules.contracts[case.mission.contract]
    declared = contract.role(role)
    line = "" if declared is None else f"{contract.name}:{declared.line}"
    what = f"it is the safe state that {contract.name} declares for the {role}"
    yield Check(group=Group.WORKFLOW, what=what, line=line)


def _containment(case: CallCase, declared: InstanceStep, contract: Contract) -> Iterator[Check]:
    reading, instance = case.mission.reading, case.instance
    assert instance is not None
    words = [
        m.text for m in reading.actions if any((r.contract, r.step) == (contract.name, declared.step) for r in m.means)
    ]
    if words:
        yield Check(group=Group.CONTAINMENT, what="asked for by", observed=listed(f'"{word}"' for word in words))
    else:
        yield Check(group=Group.CONTAINMENT, what="it supports what was asked for", observed=_asked(contract))
    for name, source in sources(declared, instance, reading, case.rules).items():
        yield Check(group=Group.CONTAINMENT, what=f"{name} = {show(case.call.args[name])}", observed=source)
    if reading.unread:
        unread = listed(f'"{u.word}"' for u in reading.unread)
        yield Check(group=Group.CONTAINMENT, what=f"a person confirmed leaving out {unread}")


def _asked(contract: Contract) -> str:
    return f"{contract.name} asks only for {listed(contract.asks)}" if contract.asks else ""


def _state(case: CallCase) -> Iterator[Check]:
    robot = case.call.robot
    state = case.world.robots[robot]
    yield Check(group=Group.STATE, what=f"{robot} is available, idle, not stopped, and leased to {state.lease}")
    kind = case.rules.kind_of(robot)
    heard = [f for f in (() if kind is None else kind.fluents) if f.name in state.fluents]
    ages = [(age(state.fluents[f.name].source_ns, case.now_ns), f) for f in heard]
    if ages:
        oldest_s, fluent = max(ages, key=lambda pair: pair[0] / pair[1].max_age_s)
        yield Check(
            group=Group.STATE,
            what=f"its state is fresh; nearest to its limit is {fluent.name}",
            observed=f"{oldest_s:.2f} s old",
            allowed=f"{fluent.max_age_s:g} s",
        )


def _preconditions(case: CallCase, purpose: Purpose) -> Iterator[Check]:
    scope = scope_of(case.mission, case.world, case.rules, case.now_ns)
    skill = skill_of(case.call, case.rules)
    for fluent, wanted in (skill.needs if purpose is Purpose.SAFE else skill.all_needs).items():
        verdict = robot_fluent_is(case.call.robot, fluent, wanted, scope)
        what = f"{case.call.skill} needs that {clause(f'{case.call.robot}.{fluent}', wanted)}"
        yield Check(group=Group.STATE, what=what, observed=_seen(verdict))


def _guards(case: CallCase, contract: Contract) -> Iterator[Check]:
    scope = scope_of(case.mission, case.world, case.rules, case.now_ns)
    written = contract.step(case.step)
    entry = () if case.mission.sent_any else contract.needs
    for condition in (*entry, *(() if written is None else written.needs)):
        yield _guard(condition, contract, scope)


def _guard(condition: Condition, contract: Contract, scope: Scope) -> Check:
    verdict = evaluate(condition, scope)
    line = f"{contract.name}:{condition.line}"
    return Check(group=Group.STATE, what=guard_words(condition), observed=_seen(verdict), line=line)


def _seen(verdict: Verdict) -> str:
    return verdict.observed if verdict.age_s is None else f"{verdict.observed}, {verdict.age_s:.2f} s old"


def _limits(case: CallCase, contract: Contract) -> Iterator[Check]:
    spent_s = (case.now_ns - case.mission.started_ns) / SECOND_NS
    allowed = f"{contract.deadline_s:g} s"
    yield Check(group=Group.STATE, what="within the deadline", observed=f"{spent_s:.1f} s spent", allowed=allowed)
    for approval in case.mission.approvals:
        if approval.step == case.step:
            given = f"{(case.now_ns - approval.at_ns) / SECOND_NS:.1f} s ago"
            limit = f"exactly this call, at most {APPROVAL_S:g} s ago"
            yield Check(group=Group.STATE, what=f"a person approved {case.step}", observed=given, allowed=limit)


def _values(case: CallCase) -> Iterator[Check]:
    for argument, point in case.judge().places.items():
        name = str(case.call.args[argument])
        stamped = case.world.values.get(name)
        where = f"({point.x:.2f}, {point.y:.2f})"
        if case.rules.crew.location(name) is not None or stamped is None:
            yield Check(group=Group.VALUES, what=f"{argument} = {name}", observed=f"{where}, a place of the crew file")
        else:
            yield _value(argument, name, where, stamped, case)


def _value(argument: str, name: str, where: str, stamped: StampedValue, case: CallCase) -> Check:
    reading, declared = stamped.reading, case.rules.publication(stamped.source, name)
    sigma = "" if reading.sigma_m is None else f" +- {reading.sigma_m:.2f} m"
    looks = f", {reading.looks} looks" if reading.looks else ""
    return Check(
        group=Group.VALUES,
        what=f"{argument} = {name}, seen by {stamped.source}",
        observed=f"{where}{sigma}{looks}, {age(reading.stamp_ns, case.now_ns):.2f} s old",
        allowed="" if declared is None else f"{declared.max_age_s:g} s, inside the operational area",
    )

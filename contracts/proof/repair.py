"""Repairs of broken contracts: a guard, an order, a safe state, one thing less; each checked before it is offered."""

from collections.abc import Callable, Iterator, Mapping
from typing import NamedTuple

from msgspec.structs import replace

from crew.contracts.contract import Condition, Contract, SafeState, Step
from crew.contracts.proof.judge import Found, key
from crew.contracts.proof.never import Watch
from crew.contracts.proof.report import Finding, Report
from crew.contracts.refusal import show
from crew.contracts.site import Rules

MAX_TRIES = 8
"""Changes that are tried for one finding."""


class Change(NamedTuple):
    """One edit of a contract, in words and done."""

    words: str
    contract: Contract
    is_less: bool = False
    """It takes something away: offered only if the contract is then proved."""


def repaired(found: Found, report: Report, rules: Rules, again: Callable[[Rules], Report]) -> Finding:
    """The finding with the first change that removes it and breaks nothing else, or as it is."""
    broken = {key(finding) for finding in report.findings}
    for tries, change in enumerate(_changes(found, rules)):
        if tries >= MAX_TRIES:
            break
        after = again(replace(rules, contracts={**rules.contracts, change.contract.name: change.contract}))
        left = {key(finding) for finding in after.findings}
        gone = not after.bound_reached and left < broken and key(found.finding) not in left
        if gone and (after.proved or not change.is_less):
            rest = "with it the contract is proved" if after.proved else "with it this is gone, other findings remain"
            return replace(found.finding, repair=f"{change.words} ({rest})")
    return found.finding


def _changes(found: Found, rules: Rules) -> Iterator[Change]:
    contract = rules.contracts[found.finding.plan_of]
    step = contract.step(found.finding.subject)
    match found.finding.rule:
        case "never" if step is not None and found.watch is not None and found.roles is not None:
            yield from _guards(contract, step, found.watch, found.roles)
            yield from _orders(contract, step)
            yield from _safer_guards(contract, step, found.watch, found.roles)
        case "unbound_value" if step is not None:
            yield from _orders(contract, step)
        case "unsafe_end":
            yield from _safe_states(contract, found.finding.subject, rules)
        case "dead_step" if step is not None:
            yield from _fewer_guards(contract, step)
            yield from _orders(contract, step)
            yield from _fewer_orders(contract, step)
        case "deadlock":
            yield from (change for other in contract.steps for change in _fewer_orders(contract, other))
        case "cannot_complete":
            yield from _fewer_completions(contract)
            yield from _fewer_entry_guards(contract)
            yield from (change for other in contract.steps for change in _orders(contract, other))


def _guards(contract: Contract, step: Step, watch: Watch, roles: Mapping[str, str]) -> Iterator[Change]:
    """The opposite of each clause of a `never`, as a guard of the step that starts."""
    for clause in watch.never.when:
        guard = _opposite(clause, contract, watch, roles)
        if guard is not None:
            words = f"add to step {step.name}: needs: [{written(guard)}]"
            yield Change(words, _with(contract, replace(step, needs=(*step.needs, guard))))


def _safer_guards(contract: Contract, step: Step, watch: Watch, roles: Mapping[str, str]) -> Iterator[Change]:
    """A guard of the step that speaks of the same as a `never`, turned into its opposite."""
    for clause in watch.never.when:
        guard = _opposite(clause, contract, watch, roles)
        for index, old in enumerate(step.needs):
            if guard is not None and old.path == guard.path:
                needs = (*step.needs[:index], guard, *step.needs[index + 1 :])
                words = f"in step {step.name} write the guard {written(guard)} instead of {written(old)}"
                yield Change(words, _with(contract, replace(step, needs=needs)))


def _opposite(clause: Condition, contract: Contract, watch: Watch, roles: Mapping[str, str]) -> Condition | None:
    """A clause of another contract speaks of its own roles and slots: by the same robots and values."""
    opposite = replace(clause, negated=not clause.negated, line=0)
    if contract.name == watch.contract.name:
        return opposite
    head, dot, attribute = clause.path.partition(".")
    if head in watch.roles:
        role = next((role for role, robot in roles.items() if robot == watch.roles[head]), None)
        if role is None:
            return None
        opposite = replace(opposite, path=f"{role}{dot}{attribute}")
    value = clause.value
    if isinstance(value, str) and value.startswith("$"):
        bound = watch.slots.get(value[1:])
        slot = next((s for s in contract.slots if s.name == value[1:]), None)
        if not isinstance(bound, str):
            return None
        opposite = replace(opposite, value=value if slot is not None else bound)
    return replace(opposite, when={})


def _orders(contract: Contract, step: Step) -> Iterator[Change]:
    for other in contract.steps:
        if other.name != step.name and other.name not in step.after and not _comes_before(step, other, contract):
            words = f"let step {step.name} come after {other.name}: after: [{', '.join([*step.after, other.name])}]"
            yield Change(words, _with(contract, replace(step, after=(*step.after, other.name))))


def _comes_before(step: Step, other: Step, contract: Contract) -> bool:
    waiting, seen = list(other.after), set[str]()
    while waiting:
        name = waiting.pop()
        if name == step.name:
            return True
        earlier = contract.step(name)
        if name not in seen and earlier is not None:
            seen.add(name)
            waiting += earlier.after
    return False


def _safe_states(contract: Contract, role: str, rules: Rules) -> Iterator[Change]:
    """Each safe skill of every robot that may play the role, with what it brings about."""
    declared = contract.role(role)
    if declared is None:
        return
    tried: set[str] = set()
    for spec in rules.crew.robots:
        for skill in rules.kinds[spec.kind].skills:
            if skill.safe and skill.effects and skill.name not in tried:
                tried.add(skill.name)
                safe = SafeState(by=skill.name, reach=dict(skill.effects))
                shown = ", ".join(f"{name}: {show(value)}" for name, value in skill.effects.items())
                words = f"give role {role} the safe state {{by: {skill.name}, reach: {{{shown}}}}}"
                roles = tuple(replace(r, safe=safe) if r.name == role else r for r in contract.roles)
                yield Change(words, replace(contract, roles=roles))


def _fewer_guards(contract: Contract, step: Step) -> Iterator[Change]:
    for index, guard in enumerate(step.needs):
        fewer = replace(step, needs=step.needs[:index] + step.needs[index + 1 :])
        yield Change(f"remove from step {step.name} the guard {written(guard)}", _with(contract, fewer), True)
    yield from _fewer_entry_guards(contract)


def _fewer_entry_guards(contract: Contract) -> Iterator[Change]:
    for index, guard in enumerate(contract.needs):
        needs = contract.needs[:index] + contract.needs[index + 1 :]
        yield Change(f"remove the entry guard {written(guard)}", replace(contract, needs=needs), True)


def _fewer_orders(contract: Contract, step: Step) -> Iterator[Change]:
    for name in step.after:
        fewer = replace(step, after=tuple(n for n in step.after if n != name))
        yield Change(f"let step {step.name} not wait for {name}", _with(contract, fewer), True)


def _fewer_completions(contract: Contract) -> Iterator[Change]:
    for index, condition in enumerate(contract.complete):
        complete = contract.complete[:index] + contract.complete[index + 1 :]
        yield Change(f"remove from complete: {written(condition)}", replace(contract, complete=complete), True)


def _with(contract: Contract, changed: Step) -> Contract:
    return replace(contract, steps=tuple(changed if s.name == changed.name else s for s in contract.steps))


def written(condition: Condition) -> str:
    """A condition as it stands in a file."""
    value = show(condition.value)
    clause = f"{condition.path}: {{not: {value}}}" if condition.negated else f"{condition.path}: {value}"
    when = ", ".join(f"{slot}: {wish}" for slot, wish in condition.when.items())
    return f"{{if: {{{when}}}, {clause}}}" if when else f"{{{clause}}}"

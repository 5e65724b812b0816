"""Guards that always hold or never can, and steps whose effect holds already."""

from collections.abc import Iterator, Sequence

from crew.contracts.contract import Condition, Contract, Slot, SlotType, Step
from crew.contracts.files.source import Loc
from crew.contracts.odd.fact import Facts, brought_about, guarded, kinds_of, needed_by_skill, skills_of, written
from crew.contracts.odd.oddity import Oddity, Written
from crew.contracts.render.wording import guard_words
from crew.contracts.site import Rules
from crew.contracts.skill import Entity, FluentLiteral


def odd_guards(of: Written, rules: Rules) -> Iterator[Oddity]:
    """Every oddity of the guards, the steps' effects and the completion of one contract."""
    contract = of.contract
    yield from _entry(of)
    for step in contract.steps:
        yield from _needs(step, of, rules)
        yield from _idle(step, of, rules)
    yield from _conditional(contract.complete, ("complete",), of)
    yield from _at_rest(of, rules)


def _entry(of: Written) -> Iterator[Oddity]:
    contract = of.contract
    yield from _contradictions(contract.needs, ("needs",), of)
    yield from _conditional(contract.needs, ("needs",), of)
    required = [s for s in contract.steps if not s.optional]
    if len(contract.steps) == 1 == len(required):
        for condition in contract.needs:
            if _find(condition, required[0].needs):
                what = f"the entry guard '{guard_words(condition)}' is a guard of the only step as well"
                yield of.oddity(of.clause(("needs",), condition, contract.needs), what, "keep one of them")


def _needs(step: Step, of: Written, rules: Rules) -> Iterator[Oddity]:
    """Guards that say what is certain anyway, of the skill or of the steps before."""
    loc: Loc = ("steps", step.name, "needs")
    yield from _contradictions(step.needs, loc, of)
    yield from _conditional(step.needs, loc, of)
    known: Facts = needed_by_skill(step, of.contract, rules)
    for condition in step.needs:
        fact = known.get(condition.path)
        if fact is not None and not condition.when and _implied(condition, fact[0]):
            what = f"the guard '{guard_words(condition)}' always holds: {fact[1]}"
            yield of.oddity(of.clause(loc, condition, step.needs), what, "remove it")
        elif _demanded(condition, step, of.contract, rules):
            what = f"the guard '{guard_words(condition)}' always holds: the call goes there, so the gate asks for it"
            yield of.oddity(of.clause(loc, condition, step.needs), what, "remove it, or keep it for the reader")


def _demanded(condition: Condition, step: Step, contract: Contract, rules: Rules) -> bool:
    """Whether the guard asks for the status of a value that every call of the step is sent to."""
    head, _, attribute = condition.path.partition(".")
    slot = contract.slot(head)
    name = head if slot is None else _only(slot)
    if attribute not in ("", "status") or condition.value != "ok" or condition.negated or name is None:
        return False
    targets = [
        call.args.get(param.name)
        for call in step.do
        for skill in skills_of(step.role, call.skill, contract, rules)
        for param in skill.params
        if param.entity is Entity.TARGET
    ]
    return bool(targets) and all(_target(t, contract) == name for t in targets)


def _target(written: str | float | None, contract: Contract) -> str | float | None:
    """The one name that an argument can carry, whatever was requested."""
    slot = contract.slot(written[1:]) if isinstance(written, str) and written.startswith("$") else None
    return written if slot is None else _only(slot)


def _implied(condition: Condition, value: FluentLiteral) -> bool:
    """Whether a path that has this value meets the condition."""
    if condition.negated:
        return not _is_slot(condition.value) and not _is_slot(value) and condition.value != value
    return condition.value == value


def _contradictions(conditions: Sequence[Condition], loc: Loc, of: Written) -> Iterator[Oddity]:
    """Two guards that cannot both hold, and one that is written twice."""
    for index, later in enumerate(conditions):
        for earlier in conditions[:index]:
            if later.path != earlier.path or later.when != earlier.when:
                continue
            pair = f"'{guard_words(earlier)}' and '{guard_words(later)}'"
            if (later.value, later.negated) == (earlier.value, earlier.negated):
                what = f"the guard '{guard_words(later)}' stands here twice"
                yield of.oddity(of.clause(loc, later, conditions), what, "remove one")
            elif _exclude(earlier, later):
                yield of.oddity(of.clause(loc, later, conditions), f"{pair} never hold together", "correct one of them")


def _exclude(a: Condition, b: Condition) -> bool:
    """Whether no value meets both; slots may be bound alike."""
    if a.negated and b.negated:
        return False
    if a.negated or b.negated:
        return a.value == b.value
    return a.value != b.value and not (_is_slot(a.value) and _is_slot(b.value))


def _conditional(conditions: Sequence[Condition], loc: Loc, of: Written) -> Iterator[Oddity]:
    """An `if` that is met by every request, since its slot is never open."""
    for condition in conditions:
        for name, value in condition.when.items():
            slot = of.contract.slot(name)
            if slot is not None and value == "given" and not slot.optional and not slot.said_from:
                what = f"'if {name} is given' always holds: the slot {name} is never open"
                yield of.oddity(
                    of.clause(loc, condition, conditions), what, "remove the `if`, or make the slot optional"
                )
            elif slot is not None and _only(slot) == value:
                what = f"'if {name} is {value}' always holds: the slot {name} is never anything else"
                yield of.oddity(of.clause(loc, condition, conditions), what, "remove the `if`")


def _only(slot: Slot) -> str | None:
    """The one value that a slot can have."""
    return slot.values[0] if slot.types == (SlotType.VALUE,) and len(slot.values) == 1 else None


def _idle(step: Step, of: Written, rules: Rules) -> Iterator[Oddity]:
    """A step whose every effect is certain before it starts: it would count as done whatever the robot did."""
    facts = {**brought_about(step, of.contract, rules), **guarded(step)}
    for index, call in enumerate(step.do):
        for skill in skills_of(step.role, call.skill, of.contract, rules)[:1]:
            effects = {f"{step.role}.{fluent}": written(value, call) for fluent, value in skill.effects.items()}
            certain = [facts[path][1] for path, value in effects.items() if path in facts and facts[path][0] == value]
            if effects and len(certain) == len(effects) and not skill.puts and not skill.reports:
                what = f"step {step.name} changes nothing that shows: {next(iter(effects))} holds already, {certain[0]}"
                loc: Loc = ("steps", step.name, "do", index) if len(step.do) > 1 else ("steps", step.name, "do")
                yield of.oddity(loc, what, "remove the step, or let it bring about something new")


def _at_rest(of: Written, rules: Rules) -> Iterator[Oddity]:
    """A completion that robots at rest meet before anything has happened."""
    contract = of.contract
    if contract.complete and all(_rests(c, contract, rules) for c in contract.complete):
        words = "; ".join(guard_words(c) for c in contract.complete)
        what = f"the completion holds before the mission starts: {words}, as robots at rest do"
        yield of.oddity(("complete",), what, "say what the mission brings about")


def _rests(condition: Condition, contract: Contract, rules: Rules) -> bool:
    role, _, name = condition.path.partition(".")
    if contract.role(role) is None or condition.when or _is_slot(condition.value):
        return False
    fluents = [fluent for kind in kinds_of(role, contract, rules) if (fluent := kind.fluent(name))]
    known = [fluent.resting for fluent in fluents if fluent.resting is not None]
    return bool(known) and all((value == condition.value) is not condition.negated for value in known)


def _find(condition: Condition, others: Sequence[Condition]) -> bool:
    same = (condition.path, condition.value, condition.negated, dict(condition.when))
    return any((o.path, o.value, o.negated, dict(o.when)) == same for o in others)


def _is_slot(value: FluentLiteral) -> bool:
    return isinstance(value, str) and value.startswith("$")

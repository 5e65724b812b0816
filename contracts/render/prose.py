"""A contract as the text that a planner, or a person, reads."""

from collections.abc import Iterator

from crew.contracts.contract import Contract, Never, Role, Slot, SlotType, Step
from crew.contracts.render.wording import call_words, fluent_words, guard_words, guards_words, listed, shown


def contract_prose(contract: Contract) -> str:
    """The whole contract in words; every line follows from a field."""
    return "\n".join(_lines(contract)) + "\n"


def _lines(contract: Contract) -> Iterator[str]:
    yield f"Contract {contract.name}: {contract.summary}"
    yield from _section("Requests such as", [f'"{example}"' for example in contract.examples])
    yield from _section(
        "Slots, shared by all steps (what the request names is binding)", [_slot(slot) for slot in contract.slots]
    )
    yield from _section("Roles, each played by a robot of its own", [_role(role) for role in contract.roles])
    yield from _section("May start only if", [guard_words(guard) for guard in contract.needs])
    yield from _section("Steps", [line for step in contract.steps for line in _step(step)])
    if contract.asks:
        yield f"The request must ask for {listed(contract.asks)}; the other steps support."
    yield from _section("Must never happen", [_never(never) for never in contract.never])
    done = ["every step of the plan is done", *map(guard_words, contract.complete)]
    yield f"Complete when {'; '.join(done)}. Deadline: {contract.deadline_s:g} s."
    if contract.preempts:
        yield "It ends the missions that hold its robots."


def _section(title: str, lines: list[str]) -> Iterator[str]:
    if lines:
        yield f"{title}:"
        yield from (f"- {line}" if not line.startswith("  ") else line for line in lines)


def _slot(slot: Slot) -> str:
    types = [kind.value for kind in slot.types if kind is not SlotType.VALUE]
    facts = [f"{slot.name}: {listed([*types, *slot.values], word='or')}"]
    if slot.said_from:
        facts.append("where the request says it comes from")
    if slot.beyond:
        facts.append(f"out of reach of {slot.beyond}")
    if slot.default is not None:
        facts.append(f"else {shown(slot.default) if isinstance(slot.default, str | float) else slot.default}")
    if slot.free:
        facts.append("else your choice within the skill's bounds")
    if slot.optional:
        facts.append("may stay open")
    return ", ".join(facts)


def _role(role: Role) -> str:
    if role.safe is None:
        return f"{role.name}; to be safe it stays as it is"
    return f"{role.name}; to be safe it does {role.safe.by} until {fluent_words(role.safe.reach)}"


def _step(step: Step) -> Iterator[str]:
    choice = "optional " if step.optional else ""
    order = f", after {listed(step.after)}" if step.after else ""
    yield f"{choice}{step.name}{order}: {step.role} does {listed(map(call_words, step.do), word='or')}"
    if step.needs:
        yield f"  needs: {guards_words(step.needs)}"
    if step.approval:
        yield "  needs a person's approval of the exact call"


def _never(never: Never) -> str:
    role, _, skill = never.starts.partition(".")
    args = [f"{name} {shown(value)}" for name, value in never.with_args.items()]
    args += [f"{name} other than {shown(value)}" for name, value in never.without_args.items()]
    given = f" with {listed(args)}" if args else ""
    return f"{role} starts {skill}{given} while {guards_words(never.when)} ({never.why})"

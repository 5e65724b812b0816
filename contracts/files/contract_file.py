"""Contract files: text to a `Contract` that is checked against a crew and its kinds."""

from collections.abc import Mapping

from crew.contracts.contract import CallPattern, Condition, Contract, Never, Role, SafeState, Step
from crew.contracts.files.contract_check import check
from crew.contracts.files.contract_model import ContractModel, GuardModel, NeverModel, RoleModel, StepModel
from crew.contracts.files.contract_scope import Scope, scope_of
from crew.contracts.files.file_model import validate
from crew.contracts.files.source import Block, Loc, Problems, locate, parse
from crew.contracts.site import Crew
from crew.contracts.skill import Kind


def load_contract(text: str, *, source: str, crew: Crew, kinds: Mapping[str, Kind]) -> Contract:
    """The contract that the text holds; `source` names the file in errors. Raises SourceErrors with all mistakes."""
    root = parse(text, file=source)
    problems = Problems(source, root)
    model = validate(ContractModel, root, problems)
    if model is None:
        problems.done()
        raise AssertionError("a file that has no shape has problems")
    scope = scope_of(model, crew, kinds)
    check(model, scope, problems)
    problems.done()
    return _build(model, scope, root, source)


def _build(model: ContractModel, scope: Scope, root: Block, source: str) -> Contract:
    return Contract(
        name=model.contract,
        summary=model.summary,
        examples=tuple(model.examples),
        slots=tuple(scope.slots.values()),
        roles=tuple(_role(name, role, root) for name, role in model.roles.items()),
        needs=_conditions(model.needs, ("needs",), root),
        steps=tuple(_step(name, step, root) for name, step in model.steps.items()),
        asks=tuple(model.asks),
        never=tuple(_never(never, ("never", index), root) for index, never in enumerate(model.never)),
        complete=_conditions(model.complete, ("complete",), root),
        deadline_s=model.deadline_s,
        preempts=model.preempts,
        source=source,
    )


def _role(name: str, role: RoleModel, root: Block) -> Role:
    safe = None if role.safe is None else SafeState(by=role.safe.by, reach=role.safe.reach)
    return Role(name=name, safe=safe, line=_line(root, ("roles", name)))


def _step(name: str, step: StepModel, root: Block) -> Step:
    loc: Loc = ("steps", name)
    return Step(
        name=name,
        role=step.role,
        do=tuple(CallPattern(skill, args) for call in step.do for skill, args in call.items()),
        after=tuple(step.after),
        optional=step.optional,
        needs=_conditions(step.needs, (*loc, "needs"), root),
        words=tuple(step.words),
        approval=step.approval,
        line=_line(root, loc),
    )


def _never(never: NeverModel, loc: Loc, root: Block) -> Never:
    return Never(
        starts=never.starts,
        with_args=_args(never, negated=False),
        without_args=_args(never, negated=True),
        when=_clauses(never.during, (*loc, "while"), root),
        why=never.why,
        line=_line(root, loc),
    )


def _args(never: NeverModel, *, negated: bool) -> dict[str, str | float]:
    return {name: compared.value for name, compared in never.with_args.items() if compared.negated is negated}


def _conditions(guards: list[GuardModel], loc: Loc, root: Block) -> tuple[Condition, ...]:
    return tuple(condition for index, guard in enumerate(guards) for condition in _clauses(guard, (*loc, index), root))


def _clauses(guard: GuardModel, loc: Loc, root: Block) -> tuple[Condition, ...]:
    """Each clause of a mapping as a condition of its own, under the same `if`."""
    return tuple(
        Condition(
            path=path,
            value=compared.value,
            negated=compared.negated,
            when=guard.when,
            line=_line(root, (*loc, path)),
        )
        for path, compared in guard.clauses.items()
    )


def _line(root: Block, loc: Loc) -> int:
    return locate(root, loc, key=True).line

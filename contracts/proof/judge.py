"""From explored graphs to findings: one for each property that does not hold, with its shortest story."""

from collections.abc import Iterator, Mapping, Sequence
from typing import NamedTuple

from crew.contracts.contract import CallPattern, Contract, Step
from crew.contracts.mission_state import Phase
from crew.contracts.proof.case import Refused
from crew.contracts.proof.graph import Broken, Graph
from crew.contracts.proof.never import Watch
from crew.contracts.proof.report import Finding
from crew.contracts.proof.story import story
from crew.contracts.proof.trouble import Note, Trouble


class Found(NamedTuple):
    """A finding, with what a repair has to know of it."""

    finding: Finding
    watch: Watch | None = None
    roles: Mapping[str, str] | None = None


def judge(
    contract: Contract, own: Sequence[Graph], dodging: Sequence[Graph], refused: Sequence[Refused], *, whole: bool
) -> list[Found]:
    """Every finding, the worst first. What never happens is judged only if everything was looked at."""
    broken = [*_broken(own), *_broken(dodging, only_never=True)]
    hopeless = list(_contradictory(own))
    told = {finding.subject for finding in hopeless}
    kept = [f for f in broken if f.finding.rule != "never" or f.finding.subject not in told]
    unfinished = _unfinished(contract, own, refused) if whole else ()
    return [*kept, *(Found(finding) for finding in (*hopeless, *unfinished))]


def _unfinished(contract: Contract, own: Sequence[Graph], refused: Sequence[Refused]) -> Iterator[Finding]:
    """What never happens although it should."""
    if not own:
        why = refused[0].why if refused else "its steps and roles allow none"
        message = f"no plan of {contract.name} gets through: {why}"
        where = (_at(contract, contract.steps[0].line),)
        yield Finding(rule="no_plan", message=message, where=where, plan_of=contract.name)
        return
    dead = list(_dead_steps(contract, own, refused))
    yield from [finding for finding in dead if finding.rule != "unreached_step"] or dead
    yield from _stuck(own, contract)
    yield from () if dead else _incompletable(contract, own)


def _contradictory(graphs: Sequence[Graph]) -> Iterator[Finding]:
    """Steps that can start in no state at all without breaking a `never`."""
    seen: set[str] = set()
    for graph in graphs:
        for item in graph.model.instance.steps:
            watches = graph.model.desk.watches(item.call)
            if item.step in seen or not graph.model.is_hopeless(item.step):
                continue
            seen.add(item.step)
            contract = graph.model.contract
            step = contract.step(item.step)
            lines = tuple(dict.fromkeys(watch.where for watch in watches))
            message = f"step {item.step} can start in no state: whatever holds, one of {' and '.join(lines)} forbids it"
            where = (*lines, _at(contract, 0 if step is None else step.line))
            yield Finding(rule="contradictory", message=message, where=where, subject=item.step, plan_of=contract.name)


def _broken(graphs: Sequence[Graph], *, only_never: bool = False) -> Iterator[Found]:
    """Troubles met in transitions, each property once, by the shortest story of all plans."""
    best: dict[tuple[str, str, str], tuple[tuple[str, ...], Broken, Graph]] = {}
    for graph in graphs:
        for broken in graph.broken:
            trouble = broken.trouble
            if only_never and trouble.watch is None:
                continue
            key = (trouble.rule, trouble.subject, trouble.watch.where if trouble.watch else "")
            told = story(graph.model, [*graph.path(broken.state), *broken.notes], f"But {trouble.message}")
            if key not in best or len(told) < len(best[key][0]):
                best[key] = (told, broken, graph)
    for told, broken, graph in best.values():
        trouble = broken.trouble
        finding = Finding(
            rule=trouble.rule,
            message=trouble.message,
            where=_lines(trouble, graph.model.contract),
            story=told,
            subject=trouble.subject,
            plan_of=graph.model.contract.name,
        )
        yield Found(finding, trouble.watch, graph.model.instance.roles)


def _lines(trouble: Trouble, contract: Contract) -> tuple[str, ...]:
    step, role = contract.step(trouble.subject), contract.role(trouble.subject.removeprefix("safe:"))
    found = [] if trouble.watch is None else [trouble.watch.where]
    found += [_at(contract, part.line) for part in (step, role) if part is not None]
    return tuple(found)


def _at(contract: Contract, line: int) -> str:
    return f"{contract.source or contract.name}:{line}"


def _dead_steps(contract: Contract, graphs: Sequence[Graph], refused: Sequence[Refused]) -> Iterator[Finding]:
    """Steps, and alternatives of steps, that no mission ever sends, or never sees done."""
    for step in contract.steps:
        for pattern in step.do:
            with_it = [(graph, name) for graph in graphs for name in _filled(graph, step, pattern)]
            label = step.name if len(step.do) == 1 else f"{step.name} ({pattern.skill})"
            if not with_it:
                why = next(
                    (r.why for r in refused if any(c.skill == pattern.skill for c in r.plan.steps)), "no plan has it"
                )
                yield _dead(contract, step, f"step {label} is in no plan that gets through: {why}")
            elif not any(name in graph.sent for graph, name in with_it):
                yield _never_sent(contract, step, label, [graph for graph, _ in with_it])
            elif not any(name in graph.done for graph, name in with_it):
                unseen = next((g.model.unseen[n] for g, n in with_it if n in g.model.unseen), "it never ends")
                yield _dead(contract, step, f"step {label} can never be seen done: {unseen}", "unseen_effect")


def _filled(graph: Graph, step: Step, pattern: CallPattern) -> Iterator[str]:
    item = graph.model.instance.step(step.name)
    if item is not None and item.call.skill == pattern.skill and set(item.call.args) == set(pattern.args):
        yield step.name


def _dead(contract: Contract, step: Step, message: str, rule: str = "dead_step", told: tuple[str, ...] = ()) -> Finding:
    where = (_at(contract, step.line),)
    return Finding(rule=rule, message=message, where=where, story=told, subject=step.name, plan_of=contract.name)


def _never_sent(contract: Contract, step: Step, label: str, graphs: Sequence[Graph]) -> Finding:
    """A step that the gate always refuses: told by the shortest way to a refusal of a world otherwise in order."""
    asked = [(g, *g.refused[step.name]) for g in graphs if step.name in g.refused]
    if not asked:
        why = f"step {label} is never reached: what comes before it is never done"
        return _dead(contract, step, why, "unreached_step")
    stories = []
    for graph, state, decision, notes in asked:
        assert decision.refusal is not None
        refusal = Note("refused", step.name, decision.call, (), decision.refusal.message)
        earlier = [note for note in notes if note.who != step.name]
        end = f"So step {label} is never sent, whatever the robots tell"
        told = story(graph.model, [*graph.path(state), *earlier, refusal], end)
        stories.append((told, decision.refusal.message))
    told, why = min(stories, key=lambda item: len(item[0]))
    return _dead(contract, step, f"step {label} is never sent: {why}", told=told)


def _stuck(graphs: Sequence[Graph], contract: Contract) -> Iterator[Finding]:
    """States from which nothing leads to an end by itself."""
    for graph in graphs:
        state = next(graph.stuck(), None) if graph.complete else None
        if state is not None:
            end = f"Nothing ends this mission any more: it stays {state.phase} until somebody cancels it"
            told = story(graph.model, graph.path(state), end)
            message = f"a mission of {contract.name} can stay {state.phase} for ever"
            where = (_at(contract, contract.steps[0].line),)
            yield Finding(rule="deadlock", message=message, where=where, story=told, plan_of=contract.name)
            return


def _incompletable(contract: Contract, graphs: Sequence[Graph]) -> Iterator[Finding]:
    """Requests for which no plan can ever complete."""
    groups: dict[str, list[Graph]] = {}
    for graph in graphs:
        groups.setdefault(_variant(graph), []).append(graph)
    for variant, members in groups.items():
        if not any(graph.completed() for graph in members) and all(graph.complete for graph in members):
            yield _incomplete(contract, variant, members)
            return


def _variant(graph: Graph) -> str:
    """What a request names, in the sorts that should each be possible: the plan's slots, or that a claim is made."""
    bound, slots = graph.model.instance.slots, graph.model.case.slots
    claimed = [f"a given {name}" for name in slots if name not in bound]
    return ", ".join(claimed or [f"{name} {value}" for name, value in sorted(bound.items()) if isinstance(value, str)])


def _incomplete(contract: Contract, variant: str, graphs: Sequence[Graph]) -> Finding:
    told, why = min(_ways_to_fail(graphs), key=lambda item: len(item[0]), default=((), "the last step is never done"))
    for_what = f" for {variant}" if variant else ""
    line = contract.complete[0].line if contract.complete else contract.steps[0].line
    message = f"no mission of {contract.name} can complete{for_what}: {why}"
    return Finding(
        rule="cannot_complete", message=message, where=(_at(contract, line),), story=told, plan_of=contract.name
    )


def _ways_to_fail(graphs: Sequence[Graph]) -> Iterator[tuple[tuple[str, ...], str]]:
    for graph in graphs:
        for state in graph.reached:
            if state.phase is Phase.EXECUTING and state.judging:
                for move in graph.model.moves(state):
                    if move.notes[0].what == "incomplete":
                        end = "So the mission never completes, although every step was done"
                        yield story(graph.model, [*graph.path(state), *move.notes], end), move.notes[0].why
        for name, (state, decision, notes) in graph.refused.items():
            if name not in graph.sent and decision.refusal is not None:
                earlier = [note for note in notes if note.who != name]
                refusal = Note("refused", name, decision.call, (), decision.refusal.message)
                end = f"So step {name} is never sent, and the mission never completes"
                yield story(graph.model, [*graph.path(state), *earlier, refusal], end), decision.refusal.message


def key(finding: Finding) -> tuple[str, str, str]:
    """What tells findings apart, whatever their words."""
    return finding.rule, finding.subject, finding.plan_of

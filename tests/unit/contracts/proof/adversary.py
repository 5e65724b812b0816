"""A planner that tries everything: every call in every state, and every plan call by call. It must gain nothing."""

from collections.abc import Iterator
from itertools import product

from crew.contracts.codes import Code
from crew.contracts.contract import Contract
from crew.contracts.gate.arguments import bounds, check_call
from crew.contracts.gate.authorize import Gate
from crew.contracts.matching import match
from crew.contracts.mission_state import Purpose, StepPhase
from crew.contracts.plan import ArgValue, Call, Instance, Plan
from crew.contracts.proof.case import Case, cases
from crew.contracts.proof.graph import Graph
from crew.contracts.proof.instances import plans
from crew.contracts.proof.model import Model
from crew.contracts.proof.names import is_first_of_its_sort, locations, objects
from crew.contracts.proof.subject import Var
from crew.contracts.proof.world import NOW_NS
from crew.contracts.refusal import Refusal
from crew.contracts.site import Rules
from crew.contracts.skill import Entity, Param, Skill
from crew.contracts.snapshot import FluentValue, Snapshot

Shape = tuple[tuple[tuple[str, str], ...], tuple[tuple[str, str], ...]]
MAX_PREFIXES = 300_000


def explored(rules: Rules, contract: str) -> list[Graph]:
    """The graphs of a contract's own plans, as the check explores them."""
    found = cases(rules.contracts[contract], rules, list(rules.contracts.values()))
    graphs = [Graph(Model(case, rules, Gate())) for case in found if isinstance(case, Case)]
    for graph in graphs:
        graph.explore(200_000)
    return graphs


def gains(graph: Graph) -> Iterator[str]:
    """Calls that the gate would let through in a state in which the proof sends nothing."""
    model, gate = graph.model, Gate()
    worlds = _worlds(graph)
    calls = {str(call): call for call in (*alphabet(model.rules), *model.frame.calls.values())}
    for state in graph.reached:
        padded = state if state.steps else state._replace(steps=(StepPhase.PENDING,) * len(model.frame.names))
        mission = model.frame.mission(padded)
        for text, call in calls.items():
            for snapshot in worlds.get(text, [_ready(call, graph)]):
                decision = gate.authorize(call, mission, snapshot, model.rules, NOW_NS, Purpose.EXECUTE)
                if decision.refusal is None:
                    yield f"{call} in {state.phase} {state.steps}"


def _worlds(graph: Graph) -> dict[str, list[Snapshot]]:
    """For each call of the plan the very worlds in which the gate let it through somewhere."""
    found: dict[str, list[Snapshot]] = {}
    for step in graph.reached.values():
        for note in step.notes:
            if note.what == "sent" and note.call is not None and len(found.setdefault(str(note.call), [])) < 2:
                found[str(note.call)].append(graph.model.ground.snapshot(dict(note.facts)))
    return found


def _ready(call: Call, graph: Graph) -> Snapshot:
    """A world in which the call's own preconditions hold."""
    kind = graph.model.rules.kind_of(call.robot)
    skill = None if kind is None else kind.skill(call.skill)
    assert skill is not None
    wanted: dict[Var, FluentValue] = {Var(call.robot, fluent): value for fluent, value in skill.all_needs.items()}
    return graph.model.ground.snapshot(wanted)


def alphabet(rules: Rules) -> list[Call]:
    """Every call that a planner could write, with names that stand for all and one figure for each argument."""
    found: list[Call] = []
    for spec in rules.crew.robots:
        for skill in rules.kinds[spec.kind].skills:
            calls = (Call(spec.name, skill.name, args) for args in _arguments(skill, rules))
            found += [call for call in calls if check_call(call, rules) is None]
    return found


def _arguments(skill: Skill, rules: Rules) -> Iterator[dict[str, ArgValue]]:
    for form in skill.forms:
        params = [p for p in skill.params if not p.optional or p.name in form]
        for values in product(*(_values(p, rules) for p in params)):
            if is_first_of_its_sort(values, rules):
                yield {p.name: v for p, v in zip(params, values, strict=True)}


def _values(param: Param, rules: Rules) -> list[ArgValue]:
    if param.entity is Entity.NONE:
        low, high = bounds(param, rules)
        return [low if param.name.endswith("min") else high if param.name.endswith("max") else (low + high) / 2]
    if param.entity is Entity.OBJECT:
        return list(objects(rules))
    values = [v.name for v in rules.crew.values] if param.entity is Entity.TARGET else list(rules.parts)
    return [*locations(rules), *values]


def instances_by_trying(contract: Contract, rules: Rules) -> tuple[set[Shape], int]:
    """What the real matching accepts of all plans, call by call; a start that can't be completed is not followed."""
    found: set[Shape] = set()
    starts: list[tuple[Call, ...]] = [()]
    tried, calls = 0, alphabet(rules)
    while starts:
        start = starts.pop()
        for call in calls:
            steps = (*start, call)
            tried += 1
            assert tried < MAX_PREFIXES, f"{contract.name}: too many starts of plans to try"
            outcome = match(Plan(contract.name, steps), rules)
            if isinstance(outcome, Instance):
                if is_first_of_its_sort((v for c in steps for v in c.args.values()), rules):
                    found.add(shape(outcome))
                starts.append(steps)
            elif outcome.code in (Code.INCOMPLETE_PLAN, Code.OUT_OF_ORDER):  # another reading may still complete it
                starts.append(steps)
    return found, tried


def instances_by_proof(contract: Contract, rules: Rules) -> set[Shape]:
    """What the proof looks at."""
    return {shape(outcome) for _, outcome in plans(contract, rules) if not isinstance(outcome, Refusal)}


def shape(instance: Instance) -> Shape:
    """An instance without its figures and without the order of different robots' steps."""
    steps = [(item.step, f"{item.call.robot}.{item.call.skill}({_names(item.call)})") for item in instance.steps]
    robots = sorted({item.call.robot for item in instance.steps})
    queues = [(r, ", ".join(item.step for item in instance.steps if item.call.robot == r)) for r in robots]
    return tuple(sorted(steps)), tuple(queues)


def _names(call: Call) -> str:
    return ", ".join(f"{k}={v if isinstance(v, str) else '#'}" for k, v in call.args.items())

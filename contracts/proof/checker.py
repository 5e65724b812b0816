"""The check of a contract: explores every plan's model and turns what is broken into findings."""

from collections.abc import Callable, Iterable, Sequence

from msgspec.structs import replace

from crew.contracts.contract import Contract
from crew.contracts.decision import Authorizer
from crew.contracts.gate.authorize import Gate
from crew.contracts.proof.case import Case, Refused, cases
from crew.contracts.proof.graph import Graph
from crew.contracts.proof.judge import Found, judge
from crew.contracts.proof.model import Model
from crew.contracts.proof.repair import repaired
from crew.contracts.proof.report import Fallback, Report
from crew.contracts.site import Rules

LIMIT = 200_000
"""States of one contract. Beyond it a contract counts as not proved."""
MAX_PLANS = 20_000

Progress = Callable[[str, int, int], None]
"""Told the contract, the states found so far and the limit."""


def check_all(rules: Rules, *, limit: int = LIMIT, progress: Progress | None = None) -> dict[str, Report]:
    """Every contract of the rules, by name."""
    return {name: check(rules, name, limit=limit, progress=progress) for name in rules.contracts}


def check(
    rules: Rules,
    contract: str,
    *,
    limit: int = LIMIT,
    progress: Progress | None = None,
    gate: Authorizer | None = None,
    repair: bool = True,
) -> Report:
    """The verdict on one contract of the rules: its own plans, and those of others that dodge its `never`."""
    search = Search(rules, contract, limit, progress, gate or Gate())
    report = search.report()
    if not repair or report.bound_reached:
        return report

    def again(changed: Rules) -> Report:
        return check(changed, contract, limit=limit, gate=gate, repair=False)

    return replace(report, findings=tuple(repaired(found, report, rules, again) for found in search.found))


class Search:
    """One check under way."""

    def __init__(self, rules: Rules, name: str, limit: int, progress: Progress | None, gate: Authorizer) -> None:
        if name not in rules.contracts:
            raise ValueError(f"no contract {name!r} among {', '.join(rules.contracts)}")
        self._rules, self._limit, self._progress, self._gate = rules, limit, progress, gate
        self._contract = rules.contracts[name]
        self.found: list[Found] = []
        self._refused: list[Refused] = []
        self._states = 0
        self._bound = False

    def report(self) -> Report:
        everything = list(self._rules.contracts.values())
        own = self._explore(self._contract, everything)
        dodging = self._dodging()
        self.found = judge(self._contract, own, dodging, self._refused)
        graphs = [*own, *dodging]
        return Report(
            contract=self._contract.name,
            proved=not self.found and not self._bound,
            bound_reached=self._bound,
            limit=self._limit,
            plans=len(own),
            states=sum(len(graph.reached) for graph in graphs),
            transitions=sum(graph.transitions for graph in graphs),
            decisions=sum(graph.model.desk.asked for graph in graphs),
            findings=tuple(found.finding for found in self.found),
            fallbacks=tuple(sorted(fallbacks(own, self._rules))),
        )

    def _dodging(self) -> list[Graph]:
        """Plans of other contracts that a request for this one could also get."""
        if not self._contract.never:
            return []
        others = (other for other in self._rules.contracts.values() if other.name != self._contract.name)
        return [graph for other in others for graph in self._explore(other, [self._contract], watched=True)]

    def _explore(self, contract: Contract, invariants: Sequence[Contract], *, watched: bool = False) -> list[Graph]:
        graphs: list[Graph] = []
        for number, case in enumerate(cases(contract, self._rules, invariants)):
            if self._bound or number >= MAX_PLANS:
                self._bound = True
                break
            if isinstance(case, Refused):
                if not watched:
                    self._refused.append(case)
            elif case.watches or not watched:
                graphs.append(self._graph(case))
        return graphs

    def _graph(self, case: Case) -> Graph:
        graph = Graph(Model(case, self._rules, self._gate))
        graph.explore(self._limit - self._states)
        self._states += len(graph.reached)
        self._bound = self._bound or not graph.complete
        if self._progress is not None:
            self._progress(self._contract.name, self._states, self._limit)
        return graph


def fallbacks(graphs: Iterable[Graph], rules: Rules) -> set[Fallback]:
    """What is left to robots that can't be commanded, as their kinds declare it."""
    found: set[Fallback] = set()
    for graph in graphs:
        for role, why in graph.fallbacks:
            robot = graph.model.instance.roles[role]
            for behaviour in _behaviours(robot, role, why, graph, rules):
                found.add(Fallback(role=role, robot=robot, why=why, behaviour=behaviour))
    return found


def _behaviours(robot: str, role: str, why: str, graph: Graph, rules: Rules) -> set[str]:
    """Of whatever skill the robot may have been running, or of an idle robot."""
    kind = rules.kind_of(robot)
    assert kind is not None, "a robot that acts has a kind"
    skills = [s for item in graph.model.instance.steps if item.role == role and (s := kind.skill(item.call.skill))]
    if why == "stopped":
        return {f"on_stop: {text}" for text in (kind.idle_on_stop, *(s.on_stop for s in skills))}
    if why == "robot_leased":
        return {"the mission that holds it: its own contract"}
    return {f"on_link_loss: {text}" for text in (kind.idle_on_link_loss, *(s.on_link_loss for s in skills))}

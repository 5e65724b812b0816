"""The check of a contract: explores every plan's model and turns what is broken into findings."""

from collections.abc import Iterable, Sequence
from functools import partial

from msgspec.structs import replace

from crew.contracts.contract import Contract
from crew.contracts.decision import Authorizer
from crew.contracts.gate.authorize import Gate
from crew.contracts.proof.case import Case, Refused, cases
from crew.contracts.proof.graph import Graph
from crew.contracts.proof.judge import Found, judge
from crew.contracts.proof.model import Model
from crew.contracts.proof.repair import repaired
from crew.contracts.proof.report import Fallback, Progress, Report, Stage
from crew.contracts.site import Rules

LIMIT = 200_000
"""States of one contract. Beyond it a contract counts as not proved."""
MAX_PLANS = 20_000


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
        own = self._cases(self._contract, list(self._rules.contracts.values()))
        dodging = self._dodging()
        graphs = self._explore([*own, *dodging])
        mine = graphs[: len(own)]
        self.found = judge(self._contract, mine, graphs[len(own) :], self._refused, whole=not self._bound)
        return Report(
            contract=self._contract.name,
            proved=not self.found and not self._bound,
            bound_reached=self._bound,
            limit=self._limit,
            plans=len(own),
            states=self._states,
            transitions=sum(graph.transitions for graph in graphs),
            decisions=sum(graph.model.desk.asked for graph in graphs),
            findings=tuple(found.finding for found in self.found),
            fallbacks=tuple(sorted(fallbacks(mine, self._rules))),
        )

    def _cases(self, contract: Contract, invariants: Sequence[Contract]) -> list[Case]:
        found: list[Case] = []
        for case in cases(contract, self._rules, invariants):
            if isinstance(case, Case):
                found.append(case)
            elif contract is self._contract:
                self._refused.append(case)
            if len(found) + len(self._refused) > MAX_PLANS:
                self._bound = True
                break
        return found

    def _dodging(self) -> list[Case]:
        """Plans of other contracts that a request for this one could also get, and that its `never` speaks of."""
        if not self._contract.never:
            return []
        others = (other for other in self._rules.contracts.values() if other.name != self._contract.name)
        return [case for other in others for case in self._cases(other, [self._contract]) if case.watches]

    def _explore(self, found: Sequence[Case]) -> list[Graph]:
        graphs: list[Graph] = []
        for number, case in enumerate(found):
            if self._states >= self._limit:
                self._bound = True
                break
            graph = Graph(Model(case, self._rules, self._gate))
            graphs.append(graph)
            graph.explore(self._limit - self._states, partial(self._tell, number, len(found)))
            self._states += len(graph.reached)
            self._bound = self._bound or not graph.complete
        return graphs

    def _tell(self, plan: int, plans: int, states: int) -> None:
        if self._progress is not None:
            self._progress(Stage(self._contract.name, plan, plans, self._states + states))


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

"""Several missions side by side: the proved graphs of each, joined by the real lease table. Bounded, and says so."""

from collections import deque
from collections.abc import Iterator
from typing import NamedTuple

from crew.actors.orchestrator.lease import LeaseTable
from crew.contracts.mission_state import ACTIVE, ENDS, Phase
from crew.contracts.proof.graph import INTRUSIONS, Graph
from crew.contracts.proof.state import ENDING, State

HOLDING = frozenset((Phase.EXECUTING, *ENDING))


class Edge(NamedTuple):
    """One transition of one mission."""

    what: str
    target: State


class Part:
    """One mission's graph with its transitions worked out."""

    def __init__(self, graph: Graph) -> None:
        self.model = graph.model
        self.robots = tuple(sorted(set(graph.model.instance.roles.values())))
        self.first = graph.model.initial().state
        self.edges = {
            state: tuple({Edge(move.notes[0].what, move.state) for move in graph.model.moves(state)})
            for state in graph.reached
        }

    def active(self, state: State) -> frozenset[str]:
        """Robots that may be moving because of the mission."""
        frame = self.model.frame
        steps = (frame.calls[n].robot for n, p in zip(frame.names, state.steps, strict=False) if p in ACTIVE)
        roles = zip(frame.roles, state.safe, strict=False)
        return frozenset(steps) | {frame.instance.roles[role] for role, p in roles if p in ACTIVE}


class Together(NamedTuple):
    """All missions at one moment; None for one that nobody has asked for yet."""

    states: tuple[State | None, ...]
    queue: tuple[int, ...]
    """Missions in the order of asking for their leases, as the table keeps them."""
    held: frozenset[tuple[str, int]]


class Product:
    """The joint exploration. `complete` is false if the bound was reached."""

    def __init__(self, parts: tuple[Part, ...], limit: int) -> None:
        self.parts, self.limit = parts, limit
        self.complete = True
        self.transitions = 0
        self.troubles: list[str] = []
        self.next: dict[Together, set[Together]] = {}

    def explore(self) -> None:
        """Every interleaving, each mission asked for at any time."""
        start = Together((None,) * len(self.parts), (), frozenset())
        known, waiting = {start}, deque([start])
        while waiting and not self.troubles:
            state = waiting.popleft()
            targets = self.next.setdefault(state, set())
            for on_its_own, target in self._moves(state):
                self.transitions += 1
                if on_its_own:
                    targets.add(target)
                if target not in known:
                    if len(known) >= self.limit:
                        self.complete = False
                        return
                    known.add(target)
                    waiting.append(target)
                    self._check(target)

    def stuck(self) -> list[Together]:
        """States from which the missions can't all end by themselves."""
        before: dict[Together, set[Together]] = {}
        for state, targets in self.next.items():
            for target in targets:
                before.setdefault(target, set()).add(state)
        free = {s for s in self.next if all(m is not None and m.phase in ENDS for m in s.states)}
        waiting = list(free)
        while waiting:
            for state in before.get(waiting.pop(), ()):
                if state not in free:
                    free.add(state)
                    waiting.append(state)
        return [s for s in self.next if s not in free]

    def _moves(self, now: Together) -> Iterator[tuple[bool, Together]]:
        for index, (part, state) in enumerate(zip(self.parts, now.states, strict=True)):
            if state is None:
                yield True, self._asked(now, index)
                continue
            for edge in part.edges.get(state, ()):
                if edge.what == "leased" and (part.robots[0], index) not in now.held:
                    continue
                yield edge.what not in INTRUSIONS, self._with(now, index, edge.target)

    def _asked(self, now: Together, index: int) -> Together:
        """A mission asks for its robots; one that preempts goes first, and the holders are cancelled."""
        part = self.parts[index]
        asked = self._with(now, index, part.first, asks=True)
        if not part.model.contract.preempts:
            return asked
        for other in {holder for robot, holder in now.held if robot in part.robots}:
            state = asked.states[other]
            assert state is not None
            cancelled = next((e.target for e in self.parts[other].edges[state] if e.what == "cancel"), None)
            if cancelled is not None:
                asked = self._with(asked, other, cancelled)
        return asked

    def _with(self, now: Together, index: int, target: State, *, asks: bool = False) -> Together:
        """One mission moved on, and the real lease table's answer."""
        states = (*now.states[:index], target, *now.states[index + 1 :])
        table = LeaseTable()
        for holder in sorted({holder for _, holder in now.held}):
            table.ask(f"m{holder}", [robot for robot, name in sorted(now.held) if name == holder])
        table.grant()
        for waiting in now.queue:
            table.ask(f"m{waiting}", self.parts[waiting].robots)
        queue = list(now.queue)
        if asks:
            first = self.parts[index].model.contract.preempts
            table.ask(f"m{index}", self.parts[index].robots, first=first)
            queue = [index, *queue] if first else [*queue, index]
        if target.phase in ENDS:
            table.release(f"m{index}")
            queue = [n for n in queue if n != index]
        granted = {int(name[1:]) for name in table.grant()}
        held = frozenset((robot, int(holder[1:])) for robot, holder in table.held.items())
        return Together(states, tuple(n for n in queue if n not in granted), held)

    def _check(self, now: Together) -> None:
        """Nobody moves what it does not hold, and nobody moves what another one moves."""
        moving: dict[str, int] = {}
        for index, (part, state) in enumerate(zip(self.parts, now.states, strict=True)):
            if state is None or state.phase not in HOLDING:
                continue
            for robot in part.robots:
                if (robot, index) not in now.held:
                    self.troubles.append(f"mission {index} is {state.phase} without its lease of {robot}")
            for robot in part.active(state):
                if moving.setdefault(robot, index) != index:
                    self.troubles.append(f"missions {moving[robot]} and {index} both move {robot}")

"""Breadth-first exploration of one plan's model: every state once, by its shortest way."""

from collections import deque
from collections.abc import Callable, Iterator
from typing import NamedTuple

from crew.contracts.decision import Decision
from crew.contracts.mission_state import ENDS, Phase
from crew.contracts.proof.model import Model
from crew.contracts.proof.state import State
from crew.contracts.proof.trouble import Note, Trouble

INTRUSIONS = frozenset({"cancel", "stop", "deadline"})
"""What a mission must not depend on to reach an end."""

TELL_EVERY = 50


class Step(NamedTuple):
    """How a state was reached first."""

    parent: State | None
    notes: tuple[Note, ...]


class Broken(NamedTuple):
    """A trouble, with the state before it and what happened then."""

    trouble: Trouble
    state: State
    notes: tuple[Note, ...]


class Graph:
    """What was found in one model. `complete` is false if the bound was reached."""

    def __init__(self, model: Model) -> None:
        self.model = model
        self.reached: dict[State, Step] = {}
        self.transitions = 0
        self.complete = True
        self.broken: list[Broken] = []
        self.sent: set[str] = set()
        self.done: set[str] = set()
        self.refused: dict[str, tuple[State, Decision, tuple[Note, ...]]] = {}
        """For each step the first refusal of a world that was otherwise in order."""
        self.fallbacks: set[tuple[str, str]] = set()
        self._by_itself: dict[State, set[State]] = {}

    def explore(self, limit: int, tell: Callable[[int], None] = lambda states: None) -> None:
        """Until nothing is new, or `limit` states are known. `tell` hears now and then how many are."""
        first = self.model.initial().state
        self.reached[first] = Step(None, ())
        queue = deque([first])
        while queue:
            state = queue.popleft()
            if len(self.reached) % TELL_EVERY == 1:
                tell(len(self.reached))
            targets = self._by_itself.setdefault(state, set())
            for move in self.model.moves(state):
                self.transitions += 1
                self._note(state, move.notes, move.troubles)
                self.sent |= set(move.sent)
                self.done |= {note.who for note in move.notes if note.what == "done"}
                self.fallbacks |= set(move.fallbacks)
                for name, decision in move.refusals:
                    self.refused.setdefault(name, (state, decision, move.notes))
                if move.notes[0].what not in INTRUSIONS:
                    targets.add(move.state)
                if move.state not in self.reached:
                    if len(self.reached) >= limit:
                        self.complete = False
                        return
                    self.reached[move.state] = Step(state, move.notes)
                    queue.append(move.state)

    def _note(self, state: State, notes: tuple[Note, ...], troubles: tuple[Trouble, ...]) -> None:
        for trouble in troubles:
            known = any(b.trouble.rule == trouble.rule and b.trouble.subject == trouble.subject
                        and b.trouble.watch is trouble.watch for b in self.broken)  # fmt: skip
            if not known:
                self.broken.append(Broken(trouble, state, notes))

    def path(self, state: State) -> list[Note]:
        """What happens on the shortest way to a state."""
        found: list[tuple[Note, ...]] = []
        at: State | None = state
        while at is not None:
            step = self.reached[at]
            found.append(step.notes)
            at = step.parent
        return [note for notes in reversed(found) for note in notes]

    def completed(self) -> State | None:
        """The state of a completed mission, if it was reached."""
        return next((s for s in self.reached if s.phase is Phase.COMPLETED), None)

    def stuck(self) -> Iterator[State]:
        """States from which no end can be reached unless somebody intervenes, the nearest first."""
        before: dict[State, set[State]] = {}
        for state, targets in self._by_itself.items():
            for target in targets:
                before.setdefault(target, set()).add(state)
        free = {s for s in self.reached if s.phase in ENDS}
        waiting = list(free)
        while waiting:
            for state in before.get(waiting.pop(), ()):
                if state not in free:
                    free.add(state)
                    waiting.append(state)
        return (s for s in self.reached if s not in free and s in self._by_itself)

"""The planner's process: it hears questions and proposes plans. It holds no key that moves anything."""

from collections.abc import Sequence
from pathlib import Path
from typing import Protocol

import msgspec

from crew.actors.planner.embedded import Abstention, PlannerState, propose
from crew.actors.specs import PlannerSpec
from crew.bus.port import Bus, Qos
from crew.bus.zenoh import ZenohBus
from crew.contracts.plan import Plan
from crew.contracts.site import Rules
from crew.errors import UsageError, nearest
from crew.keys import Keys
from crew.library import read_text
from crew.mailbox import Events, Letter, letters
from crew.messages import PlannerAsk, PlannerProposal
from crew.packed import unpack
from crew.process import ChildContext, run_child


class Backend(Protocol):
    """Turns a question into a proposal."""

    def propose(self, ask: PlannerAsk) -> PlannerProposal: ...


class EmbeddedBackend:
    """The planner without a model."""

    def __init__(self, rules: Rules) -> None:
        self._rules = rules

    def propose(self, ask: PlannerAsk) -> PlannerProposal:
        state = PlannerState(airborne=ask.airborne, values=ask.values, requester_near=ask.requester_near)
        answer = propose(ask.request, self._rules, state)
        if isinstance(answer, Abstention):
            return _proposal(ask, "embedded", None, answer.reason)
        return _proposal(ask, "embedded", answer)


class ScriptBackend:
    """Plans from a list, one an attempt; for tests."""

    def __init__(self, plans: Sequence[Plan]) -> None:
        self._plans = plans

    def propose(self, ask: PlannerAsk) -> PlannerProposal:
        if not self._plans:
            return _proposal(ask, "script", None, "the script holds no plan")
        return _proposal(ask, "script", self._plans[min(ask.attempt, len(self._plans) - 1)])


def _proposal(ask: PlannerAsk, planner: str, plan: Plan | None, reason: str = "") -> PlannerProposal:
    return PlannerProposal(mission=ask.mission, attempt=ask.attempt, planner=planner, plan=plan, reason=reason)


PLANNERS = ("embedded", "script")


def make_backend(planner: str, rules: Rules, script: str) -> Backend:
    """The backend of this name. Raises UsageError for an unknown one or an unreadable script."""
    if planner == "embedded":
        return EmbeddedBackend(rules)
    if planner == "script":
        return ScriptBackend(read_script(Path(script)))
    raise UsageError(f"no planner is called {planner!r}{nearest(planner, PLANNERS)}")


def read_script(path: Path) -> list[Plan]:
    """Plans from a JSON file. Raises UsageError."""
    try:
        return msgspec.json.decode(read_text(path), type=list[Plan])
    except msgspec.MsgspecError as error:
        raise UsageError(f"{path} is no list of plans: {error}") from error


async def main(context: ChildContext) -> None:
    """Serve until asked to stop."""
    spec = context.spec(PlannerSpec)
    rules = unpack(spec.rules)
    backend = make_backend(spec.planner, rules, spec.script)
    async with ZenohBus(spec.link) as bus:
        await serve(rules, backend, bus, context)


async def serve(rules: Rules, backend: Backend, bus: Bus, context: ChildContext) -> None:
    """Answer questions on a bus that is already there."""
    keys = Keys(rules.crew.name)
    asks: Events[Letter[PlannerAsk]] = Events(letters(PlannerAsk), capacity=64, on_lost=lambda _: None)
    bus.subscribe(keys.planner_ask, asks)
    token = bus.token(keys.alive("planner"))
    context.ready()
    try:
        async for letter in asks:
            bus.put(keys.planner_proposal, backend.propose(letter.message), qos=Qos.EVENT)
    finally:
        token.close()


if __name__ == "__main__":
    run_child(main)

"""Backends of the planner: each turns a question into a proposal. None of them can reach a robot."""

from collections.abc import Mapping, Sequence
from typing import Protocol

import msgspec

from crew.actors.planner.embedded import Abstention, PlannerState, propose
from crew.contracts.plan import Plan
from crew.contracts.site import Rules
from crew.errors import CrewError
from crew.messages import PlannerAsk, PlannerProposal


class PlannerUnavailable(CrewError):  # noqa: N818 - an outcome
    """The endpoint could not be reached, is overloaded, refuses the key, or did not answer in time."""


class PlanUnreadable(CrewError):  # noqa: N818 - an outcome
    """The model answered, but not with exactly one plan."""


class Backend(Protocol):
    """Turns a question into a proposal. Raises PlannerUnavailable or PlanUnreadable, and nothing else."""

    async def propose(self, ask: PlannerAsk) -> PlannerProposal: ...


class EmbeddedBackend:
    """The planner without a model."""

    def __init__(self, rules: Rules) -> None:
        self._rules = rules

    async def propose(self, ask: PlannerAsk) -> PlannerProposal:
        state = PlannerState(airborne=ask.airborne, values=ask.values, requester_near=ask.requester_near)
        answer = propose(ask.request, self._rules, state)
        if isinstance(answer, Abstention):
            return proposal(ask, "embedded", None, answer.reason)
        return proposal(ask, "embedded", answer)


class ScriptBackend:
    """Plans from a list, one an attempt; for tests."""

    def __init__(self, plans: Sequence[Plan]) -> None:
        self._plans = plans

    async def propose(self, ask: PlannerAsk) -> PlannerProposal:
        if not self._plans:
            return proposal(ask, "script", None, "the script holds no plan")
        return proposal(ask, "script", self._plans[min(ask.attempt, len(self._plans) - 1)])


class RecordedBackend:
    """Plans that were recorded for exact requests, one an attempt."""

    def __init__(self, plans: Mapping[str, Sequence[Plan]]) -> None:
        self._plans = plans

    async def propose(self, ask: PlannerAsk) -> PlannerProposal:
        found = self._plans.get(ask.request)
        if not found:
            return proposal(ask, "recorded", None, "no plan was recorded for these words")
        return proposal(ask, "recorded", found[min(ask.attempt, len(found) - 1)])


class FallbackBackend:
    """A model first; the embedded planner where the model is unavailable, and the proposal says so."""

    def __init__(self, model: Backend, embedded: Backend) -> None:
        self._model, self._embedded = model, embedded

    async def propose(self, ask: PlannerAsk) -> PlannerProposal:
        try:
            return await self._model.propose(ask)
        except PlannerUnavailable as error:
            stand_in = await self._embedded.propose(ask)
            return msgspec.structs.replace(stand_in, remark=f"the embedded planner stands in, for {error}")


async def answer(backend: Backend, ask: PlannerAsk, planner: str) -> PlannerProposal:
    """The backend's proposal; its typed failures become proposals without a plan."""
    try:
        return await backend.propose(ask)
    except PlannerUnavailable as error:
        return proposal(ask, planner, None, str(error))
    except PlanUnreadable as error:
        return msgspec.structs.replace(proposal(ask, planner, None, str(error)), unreadable=True)


def proposal(ask: PlannerAsk, planner: str, plan: Plan | None, reason: str = "") -> PlannerProposal:
    """An answer to `ask`."""
    return PlannerProposal(mission=ask.mission, attempt=ask.attempt, planner=planner, plan=plan, reason=reason)

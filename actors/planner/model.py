"""The planner with a language model: one prompt, one budget of wall time, a few tries, one plan."""

import asyncio
from typing import Protocol

from msgspec.structs import replace

from crew.actors.planner.backend import PlannerUnavailable, proposal
from crew.actors.planner.endpoint import Endpoint
from crew.actors.planner.messages_api import Reply, Retry
from crew.actors.planner.retrieval import Library
from crew.actors.planner.submission import read_submission
from crew.clock import SECOND_NS, WALL
from crew.contracts.render.prompt import Context, Facts, Prompt, build_prompt, registry_digest
from crew.contracts.site import Rules
from crew.messages import PlannerAsk, PlannerProposal, ProposalOrigin

RESERVE_S = 1.0
"""Left of a mission's budget for a stand-in and the way back."""
FIRST_WAIT_S = 0.5
LONGEST_WAIT_S = 8.0


class Client(Protocol):
    """Asks an endpoint once."""

    async def ask(self, prompt: Prompt, timeout_s: float) -> Reply: ...


class ModelBackend:
    """Proposes what a model submits. Of a large library it is shown what the request may need."""

    def __init__(self, endpoint: Endpoint, client: Client, rules: Rules, context: Context) -> None:
        self._endpoint, self._client, self._context = endpoint, client, context
        self._library = Library(rules)
        self._registry_digest = registry_digest(rules)

    async def propose(self, ask: PlannerAsk) -> PlannerProposal:
        """Raises PlannerUnavailable within the question's budget, or PlanUnreadable."""
        facts = Facts(airborne=ask.airborne, values=ask.values, requester_near=ask.requester_near)
        shown = self._library.narrow(ask.request)
        prompt = build_prompt(ask.request, self._context, shown, facts, previous=ask.previous, feedback=ask.feedback)
        began_ns = WALL.now_ns()
        reply, tries = await self._within_budget(prompt, ask.budget_s - RESERVE_S)
        origin = ProposalOrigin(
            model=self._endpoint.model,
            context=self._context.value,
            prompt_digest=prompt.digest,
            schema_digest=prompt.schema_digest,
            registry_digest=self._registry_digest,
            tries=tries,
            latency_s=(WALL.now_ns() - began_ns) / SECOND_NS,
            input_tokens=reply.input_tokens,
            cached_tokens=reply.cached_tokens,
            output_tokens=reply.output_tokens,
        )
        plan = read_submission(reply.submitted)
        return replace(proposal(ask, self._endpoint.name, plan), origin=origin)

    async def _within_budget(self, prompt: Prompt, budget_s: float) -> tuple[Reply, int]:
        deadline_ns = WALL.now_ns() + round(max(0.0, budget_s) * SECOND_NS)
        try:
            async with asyncio.timeout(max(0.0, budget_s)):
                return await self._tries(prompt, deadline_ns)
        except TimeoutError as error:
            raise PlannerUnavailable(
                f"{self._endpoint.name} ({self._endpoint.model}) gave no plan within the {budget_s:.0f} s "
                "that were left for planning"
            ) from error

    async def _tries(self, prompt: Prompt, deadline_ns: int) -> tuple[Reply, int]:
        """Ask until an answer comes; give up at once when what the endpoint wants to wait exceeds what is left."""
        tries, wait_s = 0, FIRST_WAIT_S
        while True:
            tries += 1
            left_s = (deadline_ns - WALL.now_ns()) / SECOND_NS
            try:
                return await self._client.ask(prompt, max(0.1, left_s)), tries
            except Retry as error:
                pause_s = max(error.after_s, min(wait_s, LONGEST_WAIT_S))
                left_s = (deadline_ns - WALL.now_ns()) / SECOND_NS
                if pause_s >= left_s:
                    raise PlannerUnavailable(f"{error}; tried {tries} times") from error
                await WALL.sleep(pause_s)
                wait_s *= 2

"""The orchestrator's side of planning: asks, waits for a bounded time, and passes on whatever comes as a proposal."""

import asyncio
from collections.abc import Callable, Coroutine
from typing import Any

import msgspec

from crew.actors.orchestrator.lease import LeaseTable
from crew.actors.orchestrator.world import WorldFold
from crew.bus.port import Bus, Qos
from crew.clock import SECOND_NS, WALL, Clock
from crew.contracts.codes import Code
from crew.contracts.language.words import REQUESTER
from crew.contracts.mission import event as ev
from crew.contracts.mission.machine import MAX_REPLANS
from crew.contracts.mission_state import MissionState
from crew.contracts.refusal import Refusal
from crew.contracts.site import Rules
from crew.contracts.snapshot import STATUSES, Snapshot
from crew.keys import Keys
from crew.mailbox import Events, Letter, letters
from crew.messages import PlannerAsk, PlannerProposal

BUDGET_S = 60.0
"""Wall time for all proposals of one mission together."""
LEAST_S = 2.0
"""What a replan gets at least, so that a planner without a model can answer it."""
UNUSABLE = "unusable"
"""What a planner sees of a run-time value whose status is a robot's own words."""

Feed = Callable[[str, ev.AnyEvent], None]
Spawn = Callable[[str, Coroutine[Any, Any, None]], None]
Note = Callable[[str, str], object]


class PlannerDesk:
    """One open question to the planner for each mission; answers to others are ignored."""

    def __init__(
        self,
        bus: Bus,
        keys: Keys,
        clock: Clock,
        rules: Rules,
        world: WorldFold,
        leases: LeaseTable,
        feed: Feed,
        spawn: Spawn,
        note: Note,
    ) -> None:
        self._note = note
        self._spent_s: dict[str, float] = {}
        self._bus, self._keys, self._clock, self._rules = bus, keys, clock, rules
        self._world, self._leases, self._feed, self._spawn = world, leases, feed, spawn
        self._open: dict[tuple[str, int], asyncio.Future[PlannerProposal]] = {}
        self._gone = False
        self.box: Events[Letter[PlannerProposal]] = Events(
            letters(PlannerProposal), capacity=64, on_lost=lambda _: None
        )
        bus.subscribe(keys.planner_proposal, self.box)

    def ask(self, mission: MissionState, effect: ev.AskPlanner) -> None:
        """Ask for a plan; the answer, or its absence, comes back as an event."""
        self._spawn(mission.id, self._await(mission, effect.feedback))

    def planner_is_there(self, there: bool) -> None:
        """The planner's token came or went; who waits for one that is gone waits no longer."""
        self._gone = not there
        for (mission, attempt), future in self._open.items():
            if self._gone and not future.done():
                future.set_result(_nobody(mission, attempt))

    async def run(self) -> None:
        """Hear proposals until cancelled."""
        async for letter in self.box:
            future = self._open.get((letter.message.mission, letter.message.attempt))
            if future is not None and not future.done():
                future.set_result(letter.message)

    async def _await(self, mission: MissionState, feedback: Refusal | None) -> None:
        future: asyncio.Future[PlannerProposal] = asyncio.get_running_loop().create_future()
        key = (mission.id, mission.replans)
        self._open[key] = future
        if self._gone:
            future.set_result(_nobody(*key))
        budget_s = max(LEAST_S, BUDGET_S - self._spent_s.pop(mission.id, 0.0))
        began_ns = WALL.now_ns()
        try:
            with self._clock.busy():
                self._bus.put(self._keys.planner_ask, self._question(mission, feedback, budget_s), qos=Qos.EVENT)
                in_time = await WALL.race(future, budget_s)
        finally:
            del self._open[key]
            if mission.replans < MAX_REPLANS:
                self._spent_s[mission.id] = (WALL.now_ns() - began_ns) / SECOND_NS
        if in_time:
            self._pass_on(future.result())
            return
        reason = f"no proposal within {budget_s:g} s; is the planner running? (crew status)"
        self._feed(mission.id, ev.PlannerFailed(at_ns=self._clock.now_ns(), reason=reason))

    def _pass_on(self, proposal: PlannerProposal) -> None:
        at_ns = self._clock.now_ns()
        if proposal.origin is not None:
            self._note("proposal", f"{proposal.mission}: {msgspec.json.encode(proposal.origin).decode()}")
        if proposal.plan is not None:
            event: ev.AnyEvent = ev.Proposed(
                at_ns=at_ns, plan=proposal.plan, planner=proposal.planner, remark=proposal.remark
            )
        else:
            refusal = Refusal(code=Code.MALFORMED_PLAN, message=proposal.reason, field="plan")
            event = ev.PlannerFailed(
                at_ns=at_ns, reason=proposal.reason, refusal=refusal if proposal.unreadable else None
            )
        self._feed(proposal.mission, event)

    def _question(self, mission: MissionState, feedback: Refusal | None, budget_s: float) -> PlannerAsk:
        world = self._world.snapshot(self._leases.held)
        known = {n: s for n, s in world.values.items() if self._rules.crew.value(n) is not None}
        return PlannerAsk(
            mission=mission.id,
            attempt=mission.replans,
            request=mission.request,
            budget_s=budget_s,
            previous=mission.plan if feedback is not None else None,
            feedback=feedback,
            airborne=known_airborne(world),
            values={n: s.reading.status if s.reading.status in STATUSES else UNUSABLE for n, s in known.items()},
            requester_near=requester_near(world),
        )


def _nobody(mission: str, attempt: int) -> PlannerProposal:
    reason = "the planner is not there; bring the crew up again (crew status)"
    return PlannerProposal(mission=mission, attempt=attempt, planner="", reason=reason)


def requester_near(world: Snapshot) -> bool | None:
    """Whether the person who asks is in reach, as last published; None if nobody knows."""
    known = world.values.get(REQUESTER)
    return None if known is None or known.reading.status != "ok" else known.reading.near


def known_airborne(world: Snapshot) -> dict[str, bool]:
    """Which robots are known to be in the air, or not: typed state that a planner may see."""
    found = {}
    for name, robot in world.robots.items():
        stamped = robot.fluents.get("airborne")
        if stamped is not None and isinstance(stamped.value, bool):
            found[name] = stamped.value
    return found

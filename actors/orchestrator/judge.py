"""Looks at telemetry until it shows what is hoped for, for a bounded time, and records what it was judged by."""

from collections.abc import Callable

from crew.actors.orchestrator.lease import LeaseTable
from crew.actors.orchestrator.ledger import Ledger
from crew.actors.orchestrator.world import WorldFold
from crew.clock import Clock, seconds_ns
from crew.contracts.mission.judgement import judge
from crew.contracts.mission_state import MissionState
from crew.contracts.site import Rules

LOOK_EVERY_S = 0.05
PATIENCE_S = 5.0


class Judge:
    """Judgements of one orchestrator. The world is looked at now and then; the last look is the one that counts."""

    def __init__(self, world: WorldFold, leases: LeaseTable, rules: Rules, clock: Clock, ledger: Ledger) -> None:
        self._world, self._leases, self._rules = world, leases, rules
        self._clock, self._ledger = clock, ledger

    def now(self, mission: MissionState, what: str) -> str:
        """Judge once, and record it."""
        world, now_ns = self._world.snapshot(self._leases.held), self._clock.now_ns()
        missing = judge(what, mission, world, self._rules, now_ns)
        self._ledger.judgement(mission, what, world, now_ns, missing)
        return missing

    async def wait(self, mission: Callable[[], MissionState], what: str) -> str:
        """Look until nothing is missing or patience ends; record the last look."""
        deadline_ns = self._clock.now_ns() + seconds_ns(PATIENCE_S)
        while self._clock.now_ns() < deadline_ns:
            world = self._world.snapshot(self._leases.held)
            if not judge(what, mission(), world, self._rules, self._clock.now_ns()):
                break
            await self._clock.sleep(LOOK_EVERY_S)
        return self.now(mission(), what)

"""Losing the orchestrator: its token goes, or its heartbeat falls silent. Then the declared behaviour runs."""

from collections import Counter
from typing import TYPE_CHECKING

from crew.bus.port import Bus
from crew.clock import WALL, seconds_ns
from crew.keys import Keys
from crew.mailbox import KeepLatest, Letter, letters
from crew.messages import Heartbeat
from crew.wire import Refusal

if TYPE_CHECKING:
    from crew.actors.robot.actor import RobotActor

SILENT_S = 2.0
"""Wall time without a heartbeat after which the orchestrator counts as lost (a frozen loop keeps its token)."""
LOOK_EVERY_S = 0.1


class OrchestratorWatch:
    """Watches one orchestrator for one robot, on wall time."""

    def __init__(self, bus: Bus, keys: Keys, actor: "RobotActor") -> None:
        self._actor = actor
        self._beats: KeepLatest[Letter[Heartbeat]] = KeepLatest(letters(Heartbeat))
        self._gone = False
        self._heard_ns = 0
        self._declared = [
            bus.subscribe(keys.heartbeat(), self._beats),
            bus.watch_liveliness(keys.alive("orchestrator"), self._on_token),
        ]
        self.acting = False
        """The declared behaviour of a lost orchestrator is under way."""

    @property
    def refusals(self) -> Counter[Refusal]:
        """Unreadable heartbeats, by reason."""
        return self._beats.refusals

    async def run(self) -> None:
        """Watch until cancelled. A lost orchestrator is acted on once; it may come back."""
        try:
            while True:
                self._hear()
                problem = self._problem()
                if problem and self._heard_ns:
                    await self._act(problem)
                    self._heard_ns = 0
                await WALL.sleep(LOOK_EVERY_S)
        finally:
            for declaration in self._declared:
                declaration.close()

    def _on_token(self, key: str, alive: bool) -> None:
        self._gone = not alive

    def _hear(self) -> None:
        for letter in self._beats.take():
            self._heard_ns = letter.received_ns
            self._actor.admission.hear_epoch(letter.message.epoch)

    def _problem(self) -> str:
        if self._gone:
            return "its liveliness token is gone"
        silent_ns = WALL.now_ns() - self._heard_ns
        return f"no heartbeat for {silent_ns / 1e9:.1f} s" if silent_ns > seconds_ns(SILENT_S) else ""

    async def _act(self, problem: str) -> None:
        self.acting = True
        behaviour = self._actor.behaviour("on_link_loss")
        self._actor.report.event("orchestrator_lost", code="orchestrator_lost", detail=f"{problem}; {behaviour}")
        await self._actor.interrupt("orchestrator_lost")
        await self._actor.make_safe(behaviour)
        self.acting = False

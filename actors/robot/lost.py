"""Losing the orchestrator, or the bus to it: its token or its heartbeat is gone. Then the declared behaviour runs."""

from collections import Counter
from typing import TYPE_CHECKING

from crew.access import HEARTBEAT
from crew.actors.robot.stop import StopSwitch
from crew.bus.port import Bus
from crew.clock import WALL, seconds_ns
from crew.keys import Keys
from crew.mailbox import KeepLatest, Letter, letters
from crew.messages import Heartbeat
from crew.permit import PermitProblem, permit_problem
from crew.wire import Refusal

if TYPE_CHECKING:
    from crew.actors.robot.actor import RobotActor

SILENT_S = 2.0
"""Wall time without a heartbeat after which the orchestrator counts as lost (a frozen loop keeps its token)."""
LOOK_EVERY_S = 0.1
UNHEARD = "waiting for the orchestrator: nothing is taken before its heartbeat is heard"


class OrchestratorWatch:
    """Watches one orchestrator for one robot, on wall time. Only heartbeats with its permit count, each once."""

    def __init__(self, bus: Bus, keys: Keys, actor: "RobotActor", stop: StopSwitch, orchestrator_key: bytes) -> None:
        self._bus, self._actor, self._stop = bus, actor, stop
        self._crew, self._key = keys.crew, orchestrator_key
        self._beats: KeepLatest[Letter[Heartbeat]] = KeepLatest(letters(Heartbeat))
        self._gone = False
        self._heard_ns = 0
        self._newest = (-1, -1)
        self._refused = ""
        self._bus_lost_ns = 0
        self.problem = UNHEARD
        """Why no command can be taken now; empty once a heartbeat was heard, until the orchestrator is lost."""
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
                self._look_at_bus()
                lost = self._lost()
                if lost and self._heard_ns:
                    await self._act(lost)
                await WALL.race(self._beats.changed(), LOOK_EVERY_S)
        finally:
            for declaration in self._declared:
                declaration.close()

    def _on_token(self, key: str, alive: bool) -> None:
        """An orchestrator that has just come knows nobody: the robot says at once who it is."""
        self._gone = not alive
        if alive:
            self._actor.report.introduce()

    def _hear(self) -> None:
        for letter in self._beats.take():
            beat = letter.message
            if (problem := permit_problem(beat, self._crew, self._key)) is not None:
                self._refuse(problem)
            elif (beat.epoch, beat.count) > self._newest:
                self._newest, self._refused = (beat.epoch, beat.count), ""
                found, self._heard_ns, self.problem = bool(self.problem), letter.received_ns, ""
                self._actor.admission.hear_epoch(beat.epoch)
                self._stop.hear(beat)
                if found:
                    self._actor.report.state()

    def _refuse(self, problem: PermitProblem) -> None:
        """Counted each time; told once until a rightful one was heard, for they may come by the hundred."""
        self._actor.admission.refused_permits += 1
        if self._refused != problem.code:
            self._refused = problem.code
            self._actor.report.permit_refused(HEARTBEAT, problem.code, f"heartbeat: {problem.detail}")

    def _look_at_bus(self) -> None:
        """Tell, once it is back, that the bus was away: while it is, nobody hears anything."""
        if not self._bus.connected:
            self._bus_lost_ns = self._bus_lost_ns or WALL.now_ns()
        elif self._bus_lost_ns:
            away_s = (WALL.now_ns() - self._bus_lost_ns) / 1e9
            self._bus_lost_ns = 0
            self._actor.report.event("bus_returned", code="bus_lost", detail=f"the bus was away for {away_s:.1f} s")

    def _lost(self) -> str:
        if self._gone:
            return "its liveliness token is gone"
        silent_ns = WALL.now_ns() - self._heard_ns
        return f"no heartbeat for {silent_ns / 1e9:.1f} s" if silent_ns > seconds_ns(SILENT_S) else ""

    async def _act(self, lost: str) -> None:
        self.acting = True
        code = "orchestrator_lost" if self._bus.connected else "bus_lost"
        behaviour = self._actor.behaviour("on_link_loss")
        self.problem = f"{code.replace('_', ' ')}: {lost}"
        self._actor.report.event(code, code=code, detail=f"{lost}; {behaviour}")
        await self._actor.interrupt(code)
        await self._actor.make_safe(behaviour)
        self.acting = False
        self._heard_ns = 0

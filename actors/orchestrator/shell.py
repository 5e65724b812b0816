"""The thin shell around the mission machine: events go in one at a time, effects come out and are performed."""

from collections import deque
from collections.abc import Callable

from crew.actors.orchestrator.announcer import Announcer
from crew.actors.orchestrator.flight import Dispatcher, Spawn
from crew.actors.orchestrator.judge import Judge
from crew.actors.orchestrator.lease import LeaseTable
from crew.actors.orchestrator.ledger import Ledger
from crew.actors.orchestrator.world import WorldFold
from crew.clock import Clock
from crew.contracts.decision import Authorizer
from crew.contracts.mission import event as ev
from crew.contracts.mission.judgement import safe_call
from crew.contracts.mission.listed import accept_listed, step_listed
from crew.contracts.mission.machine import step
from crew.contracts.mission.validation import validate
from crew.contracts.mission_state import ENDS, MissionState, Phase, Purpose
from crew.contracts.plan import Call
from crew.contracts.site import Rules

MAX_ENDED = 64
"""Ended missions that the status still tells of."""


class MissionShell:
    """All missions of one orchestrator. Synchronous but for the tasks that it spawns."""

    def __init__(
        self,
        rules: Rules,
        clock: Clock,
        world: WorldFold,
        leases: LeaseTable,
        ledger: Ledger,
        authorizer: Authorizer,
        announcer: Announcer,
        ask_planner: Callable[[MissionState, ev.AskPlanner], None],
        spawn: Spawn,
        end_tasks: Callable[[str], None],
    ) -> None:
        self.missions: dict[str, MissionState] = {}
        self._rules, self._clock, self._world, self._leases = rules, clock, world, leases
        self._ledger, self._authorizer, self._announcer = ledger, authorizer, announcer
        self._ask_planner, self._spawn, self._end_tasks = ask_planner, spawn, end_tasks
        self._judge = Judge(world, leases, rules, clock, ledger)
        self._queue: deque[tuple[str, ev.AnyEvent]] = deque()
        self._working = False
        self._step = step if authorizer.enforces else step_listed
        self.dispatcher: Dispatcher

    @property
    def open(self) -> list[MissionState]:
        """Missions that have not ended."""
        return [m for m in self.missions.values() if m.phase not in ENDS]

    def begin(self, mission: MissionState) -> None:
        """Take a new mission."""
        self._forget_old()
        self.missions[mission.id] = mission
        self._ledger.mission(mission)
        self.feed(mission.id, ev.Started(at_ns=self._clock.now_ns()))

    def feed(self, mission: str, event: ev.AnyEvent) -> None:
        """Process an event and everything that it leads to at once, in order."""
        self._queue.append((mission, event))
        if self._working:
            return
        self._working = True
        try:
            while self._queue:
                self._process(*self._queue.popleft())
        finally:
            self._working = False

    def cancel(self, mission: str, by: str) -> bool:
        """Ask for an early end; whether there was anything to end."""
        state = self.missions.get(mission)
        if state is None or state.phase in ENDS:
            return False
        self.feed(mission, ev.CancelAsked(at_ns=self._clock.now_ns(), by=by))
        return True

    def stop(self, by: str) -> None:
        """A stop latched the robots: every executing mission halts."""
        for mission in self.open:
            self.feed(mission.id, ev.StoppedAll(at_ns=self._clock.now_ns(), by=by))

    def stood_still(self, why: str) -> None:
        """This process was frozen: a step whose effect was being looked for is as unknown as one under way."""
        at_ns, code = self._clock.now_ns(), "orchestrator_lost"
        for mission in (m for m in self.open if m.phase is Phase.EXECUTING):
            for sequence in [mission.steps[name].sequence for name in mission.active()]:
                self.feed(
                    mission.id, ev.Outcome(at_ns=at_ns, sequence=sequence, result="unknown", code=code, detail=why)
                )

    def _process(self, name: str, event: ev.AnyEvent) -> None:
        old = self.missions.get(name)
        if old is None:
            return
        new, effects = self._step(old, event, self._rules.contracts)
        self.missions[name] = new
        self._ledger.event(new, event)
        self._announcer.after(old, new, event)
        for effect in effects:
            self._perform(new, effect)

    def _perform(self, mission: MissionState, effect: ev.AnyEffect) -> None:
        match effect:
            case ev.AskPlanner():
                self._ask_planner(mission, effect)
            case ev.ValidatePlan():
                self._validate(mission, effect)
            case ev.AskPerson():
                pass  # the announcer has published the question
            case ev.TakeLeases():
                self._lease(mission, effect)
            case ev.Authorise():
                assert mission.instance is not None
                self._authorise(mission, mission.steps[effect.step].call, Purpose.EXECUTE)
            case ev.MakeSafe():
                self._make_safe(mission, effect.role)
            case ev.Send():
                self.dispatcher.send(mission, effect)
            case ev.CancelRunning():
                self.dispatcher.cancel(mission, effect)
            case ev.WatchEffect():
                watch = self.dispatcher.watch_effect(lambda: self.missions[mission.id], effect.sequence, self._judge)
                self._spawn(mission.id, watch)
            case ev.JudgeCompletion():
                self._spawn(mission.id, self._complete(mission.id))
            case ev.Finish():
                self._finish(mission)

    def _validate(self, mission: MissionState, effect: ev.ValidatePlan) -> None:
        world, now_ns = self._world.snapshot(self._leases.held), self._clock.now_ns()
        if self._authorizer.enforces:
            verdict = validate(effect.plan, mission, world, self._rules, now_ns, self._authorizer)
        else:
            verdict = accept_listed(effect.plan, self._rules)
        self._ledger.validation(mission, effect.plan, world, now_ns, verdict)
        self.feed(mission.id, ev.Validated(at_ns=now_ns, validation=verdict))

    def _lease(self, mission: MissionState, effect: ev.TakeLeases) -> None:
        self._leases.ask(mission.id, effect.robots, first=effect.preempts)
        holders = self._leases.holders(effect.robots)
        if holders:
            self._announcer.waiting(mission, holders)
        if effect.preempts:
            for holder in holders:
                self.cancel(holder, by=f"{mission.id}, which preempts")
        self._grant()

    def _grant(self) -> None:
        for mission in self._leases.grant():
            self.feed(mission, ev.Leased(at_ns=self._clock.now_ns()))
            self._spawn(mission, self._watch_deadline(mission))

    def _authorise(self, mission: MissionState, call: Call, purpose: Purpose) -> None:
        """The moment that counts: the gate sees the world as it is now."""
        mission = self.missions[mission.id]
        world, now_ns = self._world.snapshot(self._leases.held), self._clock.now_ns()
        decision = self._authorizer.authorize(call, mission, world, self._rules, now_ns, purpose)
        self._ledger.decision(mission, world, decision)
        self.feed(mission.id, ev.Decided(at_ns=now_ns, decision=decision))

    def _make_safe(self, mission: MissionState, role: str) -> None:
        call = safe_call(role, mission, self._rules)
        if call is None or not self._judge.now(mission, f"safe:{role}"):
            self.feed(mission.id, ev.SafeHolds(at_ns=self._clock.now_ns(), role=role))
            return
        self._authorise(mission, call, Purpose.SAFE)

    async def _complete(self, mission: str) -> None:
        missing = await self._judge.wait(lambda: self.missions[mission], "complete")
        self.feed(mission, ev.CompletionJudged(at_ns=self._clock.now_ns(), missing=missing))

    async def _watch_deadline(self, mission: str) -> None:
        await self._clock.sleep(self._rules.contracts[self.missions[mission].contract].deadline_s)
        self.feed(mission, ev.DeadlineHit(at_ns=self._clock.now_ns()))

    def _finish(self, mission: MissionState) -> None:
        self._leases.release(mission.id)
        self.dispatcher.forget(mission.id)
        self._end_tasks(mission.id)
        self._grant()

    def _forget_old(self) -> None:
        ended = [m.id for m in self.missions.values() if m.phase in ENDS]
        for name in ended[: max(0, len(ended) - MAX_ENDED)]:
            del self.missions[name]


def is_idle(mission: MissionState) -> bool:
    """Whether mission time need not hurry for this mission: it waits for a person, and no robot is at work for it."""
    waits = mission.phase is Phase.EXECUTING and mission.question is not None
    return mission.phase is Phase.ASKING or (waits and not mission.active())

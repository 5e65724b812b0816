"""Writes journals of runs that took place nowhere: the real machine, gate and journal; robots that do as predicted."""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from msgspec.structs import replace

from crew.actors.orchestrator.ledger import Ledger
from crew.clock import SimClock
from crew.contracts.gate.authorize import Gate
from crew.contracts.gate.guard import SECOND_NS
from crew.contracts.mission import event as ev
from crew.contracts.mission.effect import assumed_world, predict
from crew.contracts.mission.judgement import judge, safe_call
from crew.contracts.mission.machine import step
from crew.contracts.mission.record import find
from crew.contracts.mission.validation import validate
from crew.contracts.mission_state import MissionState, Purpose
from crew.contracts.plan import Call, Plan, digest
from crew.contracts.site import Rules
from crew.contracts.snapshot import Snapshot
from crew.home import Home
from crew.journal import Journal
from crew.messages import Dispatch
from crew.packed import pack
from crew.records import NoteRecord, RunRecord
from crew.signing import load_or_create_key
from tests.unit.contracts.build import air_ground, iris, received, tb3, world


class Stage:
    """One run being written. Each dispatch takes a second of mission time."""

    def __init__(self, ledger: Ledger, clock: SimClock, rules: Rules) -> None:
        self._ledger, self._clock, self.rules = ledger, clock, rules
        self.world = world(iris(at_ns=SECOND_NS), tb3(at_ns=SECOND_NS))
        self._gate = Gate()
        self.state: MissionState

    def note(self, what: str, text: str) -> None:
        self._ledger.write(NoteRecord(what=what, text=text))

    def mission(
        self,
        text: str,
        *plans: Plan,
        name: str = "m1",
        blind: bool = False,
        fails: str = "",
        answer: bool | None = True,
        dies_after: str = "",
        **changes: Any,
    ) -> MissionState:
        """A request with the plans that the planner gives in turn.

        `blind`: nobody is seen. `fails`: this skill fails. `answer`: to a question; None leaves it open.
        `dies_after`: the orchestrator is killed once this skill was accepted.
        """
        self._plans, self._blind, self._fails, self._answer, self._dies = list(plans), blind, fails, answer, dies_after
        self.state = received(text, self.rules, id=name, request=text, **changes)
        self._ledger.mission(self.state)
        self._queue: list[ev.AnyEvent] = [ev.Started(at_ns=self._now())]
        while self._queue:
            event = self._queue.pop(0)
            self.state, effects = step(self.state, event, self.rules.contracts)
            self._ledger.event(self.state, event)
            for effect in effects:
                self._perform(effect)
        return self.state

    def settle(self) -> None:
        """Wait until all of it is on the disk."""
        self._ledger.note("settled", "").wait(5.0)

    def feed(self, event: ev.AnyEvent) -> None:
        """Something that nobody asked for, once the mission is under way."""
        self._queue.append(event)

    def _now(self) -> int:
        return self._clock.now_ns()

    def _seen(self) -> Snapshot:
        """The world as it is now, all of it fresh."""
        return assumed_world(self.world, self.state.id, self.rules, self._now())

    def _perform(self, effect: ev.AnyEffect) -> None:
        now = self._now()
        match effect:
            case ev.AskPlanner():
                if self._plans:
                    self._queue.append(ev.Proposed(at_ns=now, plan=self._plans.pop(0), planner="script"))
                else:
                    self._queue.append(ev.PlannerFailed(at_ns=now, reason="the planner abstained"))
            case ev.ValidatePlan():
                verdict = validate(effect.plan, self.state, self.world, self.rules, now, self._gate)
                self._ledger.validation(self.state, effect.plan, self.world, now, verdict)
                self._queue.append(ev.Validated(at_ns=now, validation=verdict))
            case ev.AskPerson():
                question = self.state.question
                if question is not None and self._answer is not None:
                    self._queue.append(ev.Answered(at_ns=now, token=question.token, yes=self._answer))
            case ev.TakeLeases():
                self._queue.append(ev.Leased(at_ns=now))
            case ev.Authorise():
                self._authorise(self.state.steps[effect.step].call, Purpose.EXECUTE)
            case ev.MakeSafe():
                self._make_safe(effect.role)
            case ev.Send():
                self._send(effect)
            case ev.WatchEffect():
                self._judged(f"effect:{effect.sequence}")
                self._queue.append(ev.EffectSeen(at_ns=now, sequence=effect.sequence))
            case ev.JudgeCompletion():
                missing = self._judged("complete")
                self._queue.append(ev.CompletionJudged(at_ns=now, missing=missing))
            case _:
                pass

    def _authorise(self, call: Call, purpose: Purpose) -> None:
        now, seen = self._now(), self._seen()
        decision = self._gate.authorize(call, self.state, seen, self.rules, now, purpose)
        self._ledger.decision(self.state, seen, decision)
        self._queue.append(ev.Decided(at_ns=now, decision=decision))

    def _make_safe(self, role: str) -> None:
        call = safe_call(role, self.state, self.rules)
        if call is None or not self._judged(f"safe:{role}"):
            self._queue.append(ev.SafeHolds(at_ns=self._now(), role=role))
        else:
            self._authorise(call, Purpose.SAFE)

    def _judged(self, what: str) -> str:
        now, seen = self._now(), self._seen()
        missing = judge(what, self.state, seen, self.rules, now)
        self._ledger.judgement(self.state, what, seen, now, missing)
        return missing

    def _send(self, effect: ev.Send) -> None:
        call, now = effect.call, self._now()
        self._ledger.intent(self._dispatch(effect, now))
        self._queue.append(ev.Accepted(at_ns=now, sequence=effect.sequence))
        if call.skill == self._dies:
            self._queue = self._queue[-1:]
            self._plans = []
            return
        self._clock.advance(now + SECOND_NS)
        kind = self.rules.kind_of(call.robot)
        skill = None if kind is None else kind.skill(call.skill)
        assert skill is not None
        result = "failed" if call.skill == self._fails else "succeeded"
        if result == "succeeded":
            reports = () if self._blind else skill.reports
            self.world = predict(self._seen(), call, replace(skill, reports=reports), self.rules, self._now())
        detail = "the motor is too hot" if result == "failed" else ""
        self._queue.append(ev.Outcome(at_ns=self._now(), sequence=effect.sequence, result=result, detail=detail))

    def _dispatch(self, effect: ev.Send, now: int) -> Dispatch:
        found = find(self.state, effect.sequence)
        assert found is not None
        return Dispatch(
            mission=self.state.id,
            step=effect.step,
            purpose="safe" if effect.step.startswith("safe:") else "execute",
            sequence=effect.sequence,
            robot=effect.call.robot,
            skill=effect.call.skill,
            args=effect.call.args,
            places=effect.places,
            epoch=1,
            lease=self.state.id,
            boot_id="boot",
            issued_ns=found[1].dispatched_ns,
            expires_ns=now + 2 * SECOND_NS,
            args_digest=digest(dict(effect.call.args)),
            plan_digest=digest(self.state.plan),
            contract_digest="",
        )


@contextmanager
def staged(
    folder: Path, home: Home, *, rules: Rules | None = None, version: str = "0.1.0", **changes: Any
) -> Iterator[Stage]:
    """A run's folder with a journal that verifies, being written for the time of a `with`."""
    rules = rules or air_ground()
    folder.mkdir(parents=True)
    clock = SimClock()
    clock.advance(SECOND_NS)
    record = RunRecord(
        run=folder.name,
        version=version,
        epoch=1,
        authorizer="gate",
        planner="script",
        rules=pack(rules),
        rules_digest=rules.digest(),
    )
    with Journal(
        folder / "journal.db",
        run_id=folder.name,
        key=load_or_create_key(home.keys, "orchestrator"),
        outside_head=home.head(folder.name),
        on_failure=print,
    ) as journal:
        ledger = Ledger(journal, clock)
        ledger.write(replace(record, **changes))
        yield Stage(ledger, clock, rules)

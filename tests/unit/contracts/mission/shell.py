"""A shell without robots: it owes an answer to every effect and gives them in any order, with any legal outcome."""

from collections.abc import Callable, Iterator
from random import Random

from crew.contracts.codes import Code
from crew.contracts.decision import Decision
from crew.contracts.mission import event as ev
from crew.contracts.mission.machine import step
from crew.contracts.mission.record import find
from crew.contracts.mission.validation import Validation
from crew.contracts.mission_state import ACTIVE, ENDS, MissionState, Phase, Purpose, Question, StepPhase
from crew.contracts.plan import Call, Instance, Plan
from crew.contracts.refusal import Refusal
from crew.contracts.site import Rules

STALE = Refusal(code=Code.STATE_STALE, message="state is stale")
UNAPPROVED = Refusal(code=Code.APPROVAL_MISSING, message="it waits", observed="none")
QUESTION = Question(text="Shall I?", token="t1", unread=("twice",))
WORDS = ("succeeded", "succeeded", "succeeded", "failed", "cancelled", "refused", "unknown")
ENDING = frozenset({Phase.HALTING, Phase.CANCELLING}) | ENDS

Answers = list[ev.AnyEvent]


class LooseShell:
    """Drives one mission with a source of chance, and checks what must hold after every event."""

    def __init__(self, state: MissionState, plan: Plan, instance: Instance, rules: Rules, chance: Random) -> None:
        self.state, self.rules, self.chance = state, rules, chance
        self._plan, self._instance = plan, instance
        self._now_ns = state.started_ns + 1
        self.owed: list[Answers] = []
        """For each pending effect, the events that will answer it, in this order."""
        self.told: Answers = []
        self.sent: list[ev.Send] = []
        self.finished = 0
        self.judged_complete = False

    def run(self, *, meddle: float = 0.0) -> MissionState:
        """Answer until nothing is owed; with this chance something else happens before an answer."""
        self.tell(ev.Started(at_ns=self._now_ns))
        while self.owed:
            if self.chance.random() < meddle:
                self.tell(self._intrusion())
            else:
                answers = self.chance.choice(self.owed)
                self.tell(answers.pop(0))
                self.owed = [a for a in self.owed if a]
        return self.state

    def tell(self, event: ev.AnyEvent) -> None:
        """One event into the machine; its effects are owed answers, its state is checked."""
        self._now_ns += self.chance.choice((0, 1_000))
        old = self.state
        self.state, effects = step(old, event, self.rules.contracts)
        self.told.append(event)
        self.judged_complete |= isinstance(event, ev.CompletionJudged) and not event.missing
        self._check(old, effects)
        self.owed += [answers for effect in effects if (answers := list(self._answers(effect)))]

    # --- what the world may answer

    def _answers(self, effect: ev.AnyEffect) -> Iterator[ev.AnyEvent]:
        at_ns, pick = self._now_ns, self.chance.choice
        match effect:
            case ev.AskPlanner():
                failed = ev.PlannerFailed(at_ns=at_ns, reason="abstained", refusal=pick((None, STALE)))
                yield pick(
                    (ev.Proposed(at_ns=at_ns, plan=self._plan), ev.Proposed(at_ns=at_ns, plan=self._plan), failed)
                )
            case ev.ValidatePlan():
                yield ev.Validated(at_ns=at_ns, validation=self._validation())
            case ev.AskPerson():
                assert self.state.question is not None
                yield ev.Answered(at_ns=at_ns, token="another", yes=True)
                yield ev.Answered(at_ns=at_ns, token=self.state.question.token, yes=self.chance.random() < 0.8)
            case ev.TakeLeases():
                yield ev.Leased(at_ns=at_ns)
            case ev.Authorise():
                yield self._decided(effect.step, self.state.steps[effect.step].call, Purpose.EXECUTE)
            case ev.MakeSafe():
                holds = ev.SafeHolds(at_ns=at_ns, role=effect.role)
                call = Call(self._instance.roles[effect.role], "land")
                yield pick((holds, self._decided(f"safe:{effect.role}", call, Purpose.SAFE)))
            case ev.Send():
                if self.chance.random() < 0.7:
                    yield ev.Accepted(at_ns=at_ns, sequence=effect.sequence)
                yield ev.Outcome(at_ns=at_ns, sequence=effect.sequence, result=pick(WORDS))
            case ev.WatchEffect():
                unseen = ev.Outcome(at_ns=at_ns, sequence=effect.sequence, result="failed", code="effect_not_observed")
                yield pick((ev.EffectSeen(at_ns=at_ns, sequence=effect.sequence),) * 3 + (unseen,))
            case ev.JudgeCompletion():
                yield ev.CompletionJudged(at_ns=at_ns, missing=pick(("", "", "tb3 is elsewhere")))

    def _validation(self) -> Validation:
        good = Validation(instance=self._instance)
        asking = Validation(instance=self._instance, question=QUESTION)
        return self.chance.choice((good, good, good, asking, Validation(refusal=STALE), Validation()))

    def _decided(self, name: str, call: Call, purpose: Purpose) -> ev.Decided:
        refusal = self.chance.choices((None, STALE, UNAPPROVED), (80, 12, 8))[0]
        if purpose is Purpose.SAFE and refusal is UNAPPROVED:
            refusal = STALE
        decision = Decision(
            mission=self.state.id,
            step=name,
            call=call,
            purpose=purpose,
            at_ns=self._now_ns,
            refusal=refusal,
            subject=name if purpose is Purpose.EXECUTE else "",
        )
        return ev.Decided(at_ns=self._now_ns, decision=decision)

    def _intrusion(self) -> ev.AnyEvent:
        """Something that nobody waits for: a person, a stop, the clock, or a word that comes again or too late."""
        at_ns = self._now_ns
        rare: tuple[Callable[[], ev.AnyEvent], ...] = (
            lambda: ev.CancelAsked(at_ns=at_ns, by="a person"),
            lambda: ev.StoppedAll(at_ns=at_ns, by="a person"),
            lambda: ev.DeadlineHit(at_ns=at_ns),
            lambda: ev.SafeHolds(at_ns=at_ns, role=self.chance.choice(("searcher", "responder", "nobody"))),
            lambda: ev.CompletionJudged(at_ns=at_ns),
            lambda: ev.Outcome(at_ns=at_ns, sequence=self.chance.randint(0, 9), result="paused"),
        )
        repeatable = [e for e in self.told if not isinstance(e, ev.CompletionJudged)]
        if repeatable and self.chance.random() < 0.8:
            return self.chance.choice(repeatable)
        return self.chance.choice(rare)()

    # --- what must hold whatever happens

    def _check(self, old: MissionState, effects: tuple[ev.AnyEffect, ...]) -> None:
        state = self.state
        sends = [e for e in effects if isinstance(e, ev.Send)]
        self.finished += sum(isinstance(e, ev.Finish) for e in effects)
        assert old.phase not in ENDS or (state == old and not effects), "nothing happens after the end"
        assert (state.phase in ENDS) == (self.finished == 1), "an end finishes once"
        assert not (old.phase in ENDING and any(not s.step.startswith("safe:") for s in sends)), "no step in an end"
        for send in sends:
            assert all(send.step != other.step for other in self.sent), f"{send.step} was sent twice"
            assert all(send.sequence > other.sequence for other in self.sent), "sequences grow"
            found = find(state, send.sequence)
            assert found is not None
            assert (found[0], found[1].call) == (send.step, send.call), "what is recorded is what is sent"
            self.sent.append(send)
        self._check_robots()
        if state.phase in ENDS:
            self._check_end()

    def _check_robots(self) -> None:
        running = [r.call.robot for r in (*self.state.steps.values(), *self.state.safe.values()) if r.phase in ACTIVE]
        assert len(running) == len(set(running)), "one dispatch for a robot at a time"

    def _check_end(self) -> None:
        state = self.state
        records = (*state.steps.values(), *state.safe.values())
        assert all(r.phase not in ACTIVE for r in records), "nothing is in flight at the end"
        match state.phase:
            case Phase.COMPLETED:
                assert self.judged_complete
                assert all(r.phase is StepPhase.SUCCEEDED for r in state.steps.values())
            case Phase.REJECTED:
                assert not self.sent
            case _ if self.sent or state.phase is Phase.HALTED:
                assert state.instance is not None
                assert set(state.settled) == set(state.instance.roles), "every role has its verdict"
        for name, record in state.steps.items():
            seen = any(isinstance(e, ev.EffectSeen) and e.sequence == record.sequence for e in self.told)
            assert record.phase is not StepPhase.SUCCEEDED or seen, f"{name} is done though its effect was not seen"

"""Drives one mission through the real machine, validation, gate and judgements, in a world that is put to its limits.

It keeps its own book of what was sent and what truly happened, and asks the rules before every send.
"""

from collections.abc import Callable, Sequence
from random import Random

import msgspec
from msgspec.structs import replace

from crew.contracts.codes import Code
from crew.contracts.decision import Authorizer, Decision
from crew.contracts.language.mention import Reading
from crew.contracts.mission import event as ev
from crew.contracts.mission.judgement import judge, safe_call
from crew.contracts.mission.machine import step
from crew.contracts.mission.validation import validate
from crew.contracts.mission_state import ACTIVE, ENDS, MissionState, Phase, Purpose, StepPhase
from crew.contracts.plan import Call, Plan
from crew.contracts.site import Rules
from crew.contracts.snapshot import Point, Snapshot
from crew.study.fuzz.plans import Made
from crew.study.fuzz.rules import Approved, Moment, broken, incomplete, words_of, wrong_plan
from crew.study.fuzz.wish import Wish
from crew.study.fuzz.world import SECOND_NS, FuzzWorld

MOST_TURNS = 400
SAFE = "safe:"


class Outcome(msgspec.Struct, kw_only=True):
    """What one mission showed."""

    unsafe: list[str] = []
    """Broken rules, as `rule: what`; none is allowed."""
    plans: int = 0
    """How many plans were proposed."""
    sent: int = 0
    refused: int = 0
    accepted: bool = False
    """Whether a plan passed validation."""
    in_order: int = 0
    """Decisions about steps against which no rule had anything."""
    needless: list[str] = []
    """Of those, the ones that were refused."""
    right: int = 0
    """Plans known to be right that were validated in a world in order."""
    needless_plans: list[str] = []
    asked_back: int = 0
    end: str = ""
    told: list[str] = []
    """What happened, in order."""


class Driver:
    """One mission. `calm` leaves the world in order, so that a right plan must go through."""

    def __init__(
        self,
        wish: Wish,
        plans: Sequence[Made],
        world: FuzzWorld,
        rules: Rules,
        reading: Reading,
        gate: Authorizer,
        chance: Random,
        *,
        calm: bool,
    ) -> None:
        self._wish, self._plans, self._world, self._rules = wish, plans, world, rules
        self._gate, self._chance, self._calm = gate, chance, calm
        self.state = MissionState(id=world.mission, request=wish.text, reading=reading)
        self.out = Outcome()
        self._owed: list[Callable[[], None]] = []
        self._events: list[ev.AnyEvent] = []
        self._attempts = 0
        self._sent: dict[str, int] = {}
        self._done: set[str] = set()
        self._busy: dict[str, int] = {}
        """Robot to the sequence of what it does."""
        self._over = ""
        self._pinned: dict[str, Point] = {}
        self._asked: dict[str, Approved] = {}
        self._approved: dict[str, Approved] = {}
        self._judged: list[tuple[Decision, Moment, tuple[str, ...]]] = []
        self._faults: tuple[str, ...] = ()

    def run(self) -> Outcome:
        """To the end, or until nothing is owed any more."""
        self._tell(ev.Started(at_ns=self._world.now_ns))
        for _ in range(MOST_TURNS):
            if not self._owed:
                break
            if not self._calm and self._chance.random() < 0.03:
                self._intrude()
            self._owed.pop(self._chance.randrange(len(self._owed)))()
        self._check_end()
        self.out.end = self.state.phase.value
        return self.out

    # --- events and effects

    def _tell(self, event: ev.AnyEvent) -> None:
        before = self.state
        self._events.append(event)
        self.state, effects = step(before, event, self._rules.contracts)
        if self.state.phase is not before.phase:
            self.out.told.append(self.state.phase.value)
        for effect in effects:
            if isinstance(effect, ev.Send):
                self._send(effect, before)
            else:
                self._owe(effect)

    def _owe(self, effect: ev.AnyEffect) -> None:
        match effect:
            case ev.AskPlanner():
                self._owed.append(self._propose)
            case ev.ValidatePlan():
                self._owed.append(lambda: self._validate(effect.plan))
            case ev.AskPerson():
                self.out.asked_back += 1
                self._owed.append(self._answer)
            case ev.TakeLeases():
                self._owed.append(lambda: self._tell(ev.Leased(at_ns=self._pass(0.1))))
            case ev.Authorise():
                self._owed.append(lambda: self._authorise(effect.step))
            case ev.MakeSafe():
                self._owed.append(lambda: self._make_safe(effect.role))
            case ev.CancelRunning():
                self._owed.append(lambda: self._end(effect.sequence, effect.robot, "cancelled"))
            case ev.WatchEffect():
                self._owed.append(lambda: self._watch(effect.sequence))
            case ev.JudgeCompletion():
                self._owed.append(self._judge_completion)

    def _pass(self, seconds: float) -> int:
        self._world.now_ns += round(seconds * SECOND_NS)
        return self._world.now_ns

    # --- before anything moves

    def _propose(self) -> None:
        made = self._plans[min(self._attempts, len(self._plans) - 1)]
        self._attempts += 1
        self.out.plans += 1
        self.out.told.append(f"plan ({made.how}): {made.plan.contract} {'; '.join(map(str, made.plan.steps))}")
        self._tell(ev.Proposed(at_ns=self._pass(0.1), plan=made.plan))

    def _validate(self, plan: Plan) -> None:
        made = next(m for m in self._plans if m.plan is plan)
        world, now_ns = self._world.snapshot(), self._world.now_ns
        self._faults = tuple(wrong_plan(plan, self._wish, self._rules))
        verdict = validate(plan, self.state, world, self._rules, now_ns, self._gate)
        self.out.accepted |= verdict.refusal is None
        if made.right and self._calm:
            self.out.right += 1
            if verdict.refusal is not None:
                self.out.needless_plans.append(str(verdict.refusal))
        if verdict.refusal is not None:
            self.out.told.append(f"refused: {verdict.refusal.code}")
        self._tell(ev.Validated(at_ns=now_ns, validation=verdict))

    def _answer(self) -> None:
        question = self.state.question
        if question is None:
            return
        yes = bool(self._wish.calls) and (self._calm or self._chance.random() < 0.9)
        at_ns = self._pass(1.0 if self._calm else self._chance.choice((1.0, 1.0, 8.0, 119.0, 121.0)))
        if question.step and not yes:
            self._over = self._over or "a person declined"
        elif question.step in self._asked:
            self._approved[question.step] = replace(self._asked[question.step], at_ns=at_ns)
        self._tell(ev.Answered(at_ns=at_ns, token=question.token, yes=yes))

    # --- while it executes

    def _authorise(self, name: str) -> None:
        record = self.state.steps[name]
        late = name in self._approved and not self._calm and self._chance.random() < 0.2
        self._pass(self._chance.choice((9.9, 10.0, 10.000000001)) if late else 0.05)
        self._disturb([record.call.robot])
        self._probe()
        self._decide(record.call, Purpose.EXECUTE, name)

    def _disturb(self, robots: Sequence[str]) -> None:
        """Between the step's turn and its decision something changes, at times; also on the clock."""
        if self._calm or self._chance.random() > 0.3:
            return
        instance, contract = self.state.instance, self._rules.contracts.get(self.state.contract)
        if contract is not None and self._chance.random() < 0.06:
            limit_ns = self.state.started_ns + round(contract.deadline_s * SECOND_NS)
            self._world.now_ns = max(self._world.now_ns, limit_ns + self._chance.choice((-1, 0, 1, SECOND_NS)))
            self.out.told.append("it is late")
            return
        everyone = [*robots, *robots, *(instance.roles.values() if instance is not None else ())]
        self.out.told.append(self._world.disturb(everyone))

    def _probe(self) -> None:
        """Somebody asks the gate out of turn: it must not rest on the machine that asks it at the right time."""
        if self._calm or self._chance.random() > 0.25 or not self.state.steps:
            return
        name = self._chance.choice(sorted(self.state.steps))
        call, world = self.state.steps[name].call, self._world.snapshot()
        decision = self._gate.authorize(call, self.state, world, self._rules, self._world.now_ns, Purpose.EXECUTE)
        if decision.allowed:
            wrong = broken(self._moment(call, decision.step, decision, world, safe=False))
            self.out.unsafe += [f"{what} (asked out of turn)" for what in wrong]

    def _decide(self, call: Call, purpose: Purpose, name: str) -> None:
        world, now_ns = self._world.snapshot(), self._world.now_ns
        decision = self._gate.authorize(call, self.state, world, self._rules, now_ns, purpose)
        moment = self._moment(call, name, decision, world, safe=purpose is Purpose.SAFE)
        wrong = tuple(broken(moment))
        self._judged.append((decision, moment, wrong))
        asks = decision.refusal is not None and decision.refusal.code is Code.APPROVAL_MISSING
        if asks:
            self._asked[name] = Approved(now_ns, call, words_of(world.robots.get(call.robot)), decision.places)
        elif purpose is Purpose.EXECUTE:
            self.out.refused += not decision.allowed
            if not wrong:
                self.out.in_order += 1
                if decision.refusal is not None:
                    self.out.needless.append(str(decision.refusal))
        if decision.refusal is not None:
            self.out.told.append(f"{call} refused: {decision.refusal.code}")
        self._tell(ev.Decided(at_ns=now_ns, decision=decision))
        if decision.refusal is not None and purpose is Purpose.EXECUTE and not asks:
            self._over = self._over or f"{name} was refused"

    def _moment(self, call: Call, name: str, decision: Decision, world: Snapshot, *, safe: bool) -> Moment:
        plan = self.state.plan
        assert plan is not None
        return Moment(
            call=call,
            step=name,
            safe=safe,
            mission=self.state.id,
            plan=plan,
            wish=self._wish,
            rules=self._rules,
            world=world,
            now_ns=self._world.now_ns,
            started_ns=self.state.started_ns,
            steps={n: r.call for n, r in self.state.steps.items()},
            sent=dict(self._sent),
            done=frozenset(self._done),
            busy=frozenset(self._busy),
            over="" if safe else self._over,
            places=decision.places,
            approved=self._approved.get(name),
            faults=self._faults,
        )

    def _send(self, send: ev.Send, before: MissionState) -> None:
        """It crosses the boundary: every rule must have held a moment ago."""
        self.out.sent += 1
        self.out.told.append(f"sent {send.step}: {send.call}")
        found = next((j for j in reversed(self._judged) if (j[0].call, j[0].step) == (send.call, send.step)), None)
        if found is None:
            self.out.unsafe.append(f"decided: {send.call} is sent without a decision")
            return
        _, moment, wrong = found
        over = "" if moment.safe else self._over
        now = replace(moment, sent=dict(self._sent), busy=frozenset(self._busy), over=over)
        same = (now.sent, now.busy, now.over) == (moment.sent, moment.busy, moment.over)
        self.out.unsafe += wrong if same else broken(now)
        if send.call != moment.call or dict(send.places) != dict(moment.places):
            self.out.unsafe.append(f"decided: what is sent for {send.step} is not what was decided")
        if not send.step.startswith(SAFE):
            self._sent[send.step] = self._world.now_ns
        self._busy[send.call.robot] = send.sequence
        self._pinned |= {str(send.call.args[name]): place for name, place in send.places.items()}
        self._owed.append(lambda: self._act(send))

    def _act(self, send: ev.Send) -> None:
        """The robot does it, fails, is silent, or says that it did and did not."""
        if self._busy.get(send.call.robot) != send.sequence:
            return
        self._tell(ev.Accepted(at_ns=self._pass(0.05), sequence=send.sequence))
        self._pass(self._chance.choice((1.0, 5.0, 30.0)))
        honest = self._calm or self._chance.random() < 0.93
        if honest:
            self._world.perform(send.call, dict(send.places))
            self._done.add(send.step)
        self._end(send.sequence, send.call.robot, "succeeded" if honest else self._lie())

    def _lie(self) -> str:
        return self._chance.choice(("succeeded", "succeeded", "failed", "unknown", "refused", "nonsense"))

    def _end(self, sequence: int, robot: str, result: str) -> None:
        if self._busy.get(robot) == sequence:
            del self._busy[robot]
        if result != "succeeded":
            self._over = self._over or f"{robot} {result}"
        self._tell(ev.Outcome(at_ns=self._world.now_ns, sequence=sequence, result=result))

    def _watch(self, sequence: int) -> None:
        if not self._calm and self._chance.random() < 0.05:
            self._disturb([r.call.robot for r in self.state.steps.values()])
        missing = self._judge(f"effect:{sequence}")
        if not missing:
            self._check_seen(sequence)
            self._tell(ev.EffectSeen(at_ns=self._world.now_ns, sequence=sequence))
            return
        self._over = self._over or f"the effect of {sequence} was not seen"
        self._tell(
            ev.Outcome(
                at_ns=self._world.now_ns, sequence=sequence, result="failed", code="effect_not_observed", detail=missing
            )
        )

    def _judge(self, what: str) -> str:
        now_ns = self._pass(0.1)
        return judge(what, self.state, self._world.snapshot(), self._rules, now_ns)

    def _judge_completion(self) -> None:
        if self._chance.random() < 0.3:
            self._disturb([r.call.robot for r in self.state.steps.values()])
        missing = self._judge("complete")
        if not missing:
            self.out.unsafe += incomplete(self._last_moment(), self._pinned)
        self._tell(ev.CompletionJudged(missing=missing, at_ns=self._world.now_ns))

    def _last_moment(self) -> Moment:
        """The last one that was judged, in the world of now."""
        moment = self._judged[-1][1]
        return replace(moment, world=self._world.snapshot(), now_ns=self._world.now_ns)

    # --- early ends

    def _make_safe(self, role: str) -> None:
        assert self.state.instance is not None
        missing = self._judge(f"safe:{role}")
        call = safe_call(role, self.state, self._rules)
        if not missing:
            self._check_safe(role)
            self._tell(ev.SafeHolds(at_ns=self._world.now_ns, role=role))
        elif call is not None:
            self._disturb([call.robot])
            self._decide(call, Purpose.SAFE, SAFE + role)

    def _intrude(self) -> None:
        """A person, a stop, the clock, or a word that comes a second time."""
        at_ns, kind = self._world.now_ns, self._chance.randrange(6)
        if kind == 0:
            self._over = self._over or "a person cancelled"
            self._tell(ev.CancelAsked(at_ns=at_ns, by="a person"))
        elif kind == 1:
            self._world.stopped, self._over = True, self._over or "a stop"
            self._tell(ev.StoppedAll(at_ns=at_ns, by="a person"))
        elif kind == 2 and self.state.phase is Phase.EXECUTING:
            self._over = self._over or "the deadline"
            self._tell(ev.DeadlineHit(at_ns=at_ns))
        elif self._events:
            event = self._chance.choice(self._events)
            if not isinstance(event, ev.CompletionJudged | ev.SafeHolds):
                self._tell(event)

    # --- what must be true besides sends

    def _check_seen(self, sequence: int) -> None:
        safe = {SAFE + role: record for role, record in self.state.safe.items()}
        for name, record in {**self.state.steps, **safe}.items():
            if record.sequence != sequence:
                continue
            if name not in self._done and not self._world.shows(record.call, dict(record.places)):
                self.out.unsafe.append(f"seen: the effect of {name} counts as seen, and never took place")
            self._done.add(name)

    def _check_safe(self, role: str) -> None:
        declared = next((r for r in self._rules.contracts[self.state.contract].roles if r.name == role), None)
        assert self.state.instance is not None
        robot = self.state.instance.roles[role]
        for fluent, wanted in {} if declared is None or declared.safe is None else declared.safe.reach.items():
            if self._world.fluents[robot].get(fluent) != wanted:
                self.out.unsafe.append(f"left: {robot} counts as safe, but {fluent} is not {wanted}")

    def _check_end(self) -> None:
        state = self.state
        if state.phase not in ENDS:
            if self._sent or self._over:
                self.out.unsafe.append(f"left: the mission stays {state.phase}, and nothing is owed to end it")
            return
        if any(r.phase in ACTIVE for r in state.steps.values()):
            self.out.unsafe.append(f"left: the mission is {state.phase} while a step is in flight")
        if state.phase is Phase.REJECTED and self._sent:
            self.out.unsafe.append("left: rejected, although something was sent")
        if state.phase is Phase.COMPLETED:
            self._check_completed()
        elif self._sent and state.instance is not None and set(state.settled) != set(state.instance.roles):
            self.out.unsafe.append("left: ended before every role had its verdict")

    def _check_completed(self) -> None:
        if self._over:
            self.out.unsafe.append(f"completed: although {self._over}")
        undone = [n for n, r in self.state.steps.items() if r.phase is not StepPhase.SUCCEEDED or n not in self._sent]
        if undone:
            self.out.unsafe.append(f"completed: without {', '.join(undone)}")

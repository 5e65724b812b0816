"""Random missions of the real machine and the real gate in a world of their own, held against what was proved.

The world here is written anew: robots that change their fluents while they work, outcomes in any order, stops, losses.
It shares the declarations of skills with the proof, and the assumption that different names are different places (a
person does not stand at a named one); nothing else of how a world behaves.
"""

from collections import defaultdict
from random import Random

from msgspec.structs import replace

from crew.contracts.gate.approval import approved, wants_approval
from crew.contracts.gate.authorize import Gate
from crew.contracts.gate.guard import SECOND_NS
from crew.contracts.mission import event as ev
from crew.contracts.mission.effect import effect_values
from crew.contracts.mission.judgement import missing_completion, missing_effect, missing_safety, safe_call
from crew.contracts.mission.machine import step
from crew.contracts.mission.record import find
from crew.contracts.mission.validation import Validation
from crew.contracts.mission_state import ACTIVE, ENDS, MissionState, Phase, Purpose
from crew.contracts.plan import Call
from crew.contracts.proof.graph import Graph
from crew.contracts.proof.state import ENDING, State
from crew.contracts.proof.subject import STATUS, Var
from crew.contracts.proof.trouble import Trouble
from crew.contracts.skill import Skill
from crew.contracts.snapshot import FluentValue, Point, RobotState, Snapshot, Stamped, StampedValue, ValueReading

SECOND = SECOND_NS
WORDS = ("succeeded",) * 6 + ("failed", "cancelled", "refused", "unknown")
Place = tuple[object, ...]


class Proved:
    """What a graph says can be: whole states while a mission goes on, one role at a time in an early end."""

    def __init__(self, graph: Graph) -> None:
        self.graph = graph
        self.ground, self.frame = graph.model.ground, graph.model.frame
        self._states: dict[Place, list[State]] = defaultdict(list)
        for state in graph.reached:
            for place in self._places(state):
                self._states[place].append(state)

    def unreachable(self, mission: MissionState, told: dict[Var, FluentValue], judging: bool) -> str:
        """Why the proof calls this state unreachable; empty if it does not."""
        anything = tuple(self.ground.domains[var] for var in self.ground.fluents)
        state = self.frame.state(mission, anything, judging=judging)
        for place in self._places(state):
            known = self._states.get(place)
            if known is None:
                return f"never reached: {place}"
            counting = self._counting(place, mission)
            if not any(all(told[v] in s.fluents[k] for k, v in counting) for s in known if s.fluents):
                return "" if state.phase in ENDS else f"never reached with {told}: {place}"
        return ""

    def _places(self, state: State) -> list[Place]:
        """A state without its world; in an early end one for each role that is not settled."""
        if state.phase not in ENDING:
            return [(state.phase, state.steps, state.judging)]
        found: list[Place] = [(state.phase,)]
        for index, role in enumerate(self.frame.roles):
            if not state.settled[index]:
                items = self.frame.instance.steps
                own = tuple(p for item, p in zip(items, state.steps, strict=True) if item.role == role)
                found.append((state.phase, role, own, state.safe[index]))
        return found

    def _counting(self, place: Place, mission: MissionState) -> list[tuple[int, Var]]:
        """The variables that must agree: all at rest, or in an early end those that tell whether the role is safe."""
        fluents = list(enumerate(self.ground.fluents))
        busy = {
            var for name, r in mission.steps.items() if r.phase in ACTIVE for var in self.graph.model.changing(name)
        }
        if len(place) == 1:
            return []
        if place[0] in ENDING:
            wanted = self.graph.model.oracle.safety(str(place[1]))
            busy |= {v for r in mission.safe.values() if r.phase in ACTIVE for v in wanted if v.owner == r.call.robot}
            fluents = [(k, v) for k, v in fluents if v in wanted]
        return [(k, v) for k, v in fluents if v not in busy]


class Walk:
    """One mission from its validation to its end, by chance."""

    def __init__(self, proved: Proved, chance: Random) -> None:
        model = proved.graph.model
        self.proved, self.model, self.rules, self.chance = proved, model, model.rules, chance
        self.now_ns = 10_000 * SECOND
        self.gate = Gate()
        self.steps = 0
        self.troubles: list[str] = []
        self.told: dict[Var, FluentValue] = {
            v: self._any(v) for v in model.ground.domains if not model.ground.is_value(v)
        }
        self.before: dict[str, dict[Var, FluentValue]] = {}
        self.out: dict[str, str] = {}
        """Robots that can't be commanded any more, and why."""
        self.stopped = False
        self.judging = False
        start = model.frame.mission(State(Phase.VALIDATING, ()))
        self.state = replace(start, started_ns=-1, sequence=0)
        verdict = Validation(instance=model.instance)
        self.tell(ev.Validated(at_ns=self.now_ns, validation=verdict))

    def run(self, meddle: float) -> int:
        """Until the end; the number of events."""
        while self.state.phase not in ENDS and self.steps < 300 and not self.troubles:
            self.now_ns += self.chance.choice((1, SECOND // 10))
            self._drift()
            if self.chance.random() < meddle:
                self._meddle()
            else:
                self._go_on()
        return self.steps

    def tell(self, event: ev.AnyEvent) -> None:
        """An event and all that follows from it at once, as the orchestrator's shell does it; then the comparison."""
        queue: list[ev.AnyEvent] = [event]
        while queue:
            self.steps += 1
            old = self.state
            self.state, effects = step(old, queue.pop(0), self.rules.contracts)
            for effect in effects:
                queue += self._perform(effect, old)
        why = self.proved.unreachable(self.state, self.told, self.judging)
        if why:
            self.troubles.append(why)

    def _perform(self, effect: ev.AnyEffect, old: MissionState) -> list[ev.AnyEvent]:
        match effect:
            case ev.Authorise():
                return [self._decided(self.state.steps[effect.step].call, Purpose.EXECUTE)]
            case ev.MakeSafe():
                return [self._made_safe(effect.role)]
            case ev.Send():
                self._check_sent(effect, old)
                self.before[effect.step] = dict(self.told)
            case ev.JudgeCompletion():
                self.judging = True
        return []

    def _decided(self, call: Call, purpose: Purpose) -> ev.Decided:
        world, state = self._snapshot(), self.state
        step_name = next((n for n, r in state.steps.items() if r.call == call and r.phase.value == "deciding"), "")
        if purpose is Purpose.EXECUTE and step_name and wants_approval(step_name, state, self.rules):
            given = approved(call, step_name, state, world, self.rules, self.now_ns)
            state = replace(state, approvals=given)  # whoever is asked says yes
        decision = self.gate.authorize(call, state, world, self.rules, self.now_ns, purpose)
        return ev.Decided(at_ns=self.now_ns, decision=decision)

    def _made_safe(self, role: str) -> ev.AnyEvent:
        call = safe_call(role, self.state, self.rules)
        if call is None or not missing_safety(role, self.state, self._snapshot(), self.rules, self.now_ns):
            return ev.SafeHolds(at_ns=self.now_ns, role=role)
        return self._decided(call, Purpose.SAFE)

    def _check_sent(self, effect: ev.Send, old: MissionState) -> None:
        """What the proof promises of everything that is sent, in this world."""
        if effect.step.startswith("safe:"):
            return
        if self.stopped or effect.call.robot in self.out:
            self.troubles.append(f"{effect.call} is sent to a robot that can't be commanded")
        for watch in self.model.desk.watches(effect.call):
            told: dict[Var, FluentValue] = {**self.told, **{v: "ok" for v, _ in watch.asks() if v.name == STATUS}}
            known = all(v in told for v, _ in watch.asks())
            if known and not any(v.name == STATUS for v, _ in watch.asks()) and watch.broken(told):
                self.troubles.append(f"{effect.call} starts: {watch.never.why}")
        facts = tuple(sorted(self.told.items()))
        rules = {"out_of_order", "sent_twice", "late_dispatch", "busy_robot"}
        found: list[Trouble] = [t for t in self.model.oracle.dispatch(effect.step, old, facts) if t.rule in rules]
        self.troubles += [t.message for t in found]

    # --- what robots do

    def _go_on(self) -> None:
        """One robot says or shows something, or the mission's own wait ends."""
        at_ns, state = self.now_ns, self.state
        if state.phase is Phase.WAITING:
            self.tell(ev.Leased(at_ns=at_ns))
        elif self.judging and self.chance.random() < 0.9:
            self.judging = False
            missing = missing_completion(state, self._snapshot(bad=0.0), self.rules, at_ns)
            self.tell(ev.CompletionJudged(at_ns=at_ns, missing=missing))
        else:
            records = [*state.steps.items(), *((f"safe:{role}", r) for role, r in state.safe.items())]
            active = [(name, r) for name, r in records if r.phase in ACTIVE]
            if active:
                name, record = self.chance.choice(active)
                self._answer(name, record.sequence, record.call)

    def _answer(self, name: str, sequence: int, call: Call) -> None:
        at_ns = self.now_ns
        found = find(self.state, sequence)
        assert found is not None
        if found[1].phase.value == "confirming":
            self._succeed(call)
            seen = not missing_effect(sequence, self.state, self._snapshot(bad=0.0, of=call), self.rules, at_ns)
            if seen and self.chance.random() < 0.9:
                self.tell(ev.EffectSeen(at_ns=at_ns, sequence=sequence))
                return
            self._fail(name, call)
            self.tell(ev.Outcome(at_ns=at_ns, sequence=sequence, result="failed", code="effect_not_observed"))
        elif found[1].phase.value == "sent" and self.chance.random() < 0.5:
            self.tell(ev.Accepted(at_ns=at_ns, sequence=sequence))
        else:
            word = self.chance.choice(WORDS)
            if word == "unknown":
                self.out[call.robot] = "lost"
            if word not in ("succeeded", "refused"):
                self._fail(name, call)
            self.tell(ev.Outcome(at_ns=at_ns, sequence=sequence, result=word))

    def _skill(self, call: Call) -> Skill:
        kind = self.rules.kind_of(call.robot)
        skill = None if kind is None else kind.skill(call.skill)
        assert skill is not None
        return skill

    def _succeed(self, call: Call) -> None:
        """The effects come true; what was only so on the way may be as before or not."""
        skill = self._skill(call)
        for fluent, value in effect_values(skill, call).items():
            self._set(Var(call.robot, fluent), value)
        if skill.puts is not None:
            thing, place = (str(call.args[name]) for name in skill.puts)
            part = self.rules.parts.get(place)
            host = self.rules.host_of(place, self.model.instance.roles.values())
            if part is not None and host:
                self._set(Var(host, part.holds), thing)

    def _fail(self, name: str, call: Call) -> None:
        """One of the declared leftovers, or as it was before, fluent by fluent."""
        skill, old = self._skill(call), self.before.get(name, {})
        for fluent in {*skill.effects, *skill.during, *(f for left in skill.may for f in left)}:
            var = Var(call.robot, fluent)
            ways = [left[fluent] for left in skill.may if fluent in left]
            ways += [skill.during[fluent]] if fluent in skill.during else []
            values: list[FluentValue] = [call.args.get(str(v)[1:], v) if str(v).startswith("$") else v for v in ways]
            effects = effect_values(skill, call)
            values += [effects[fluent]] if fluent in effects else []
            if var in old and not self._is_place(var):
                self._set(var, self.chance.choice([*values, old[var]]))
            elif self._is_place(var):
                self._set(var, self._any(var))

    def _drift(self) -> None:
        """While a robot works its fluents show what it is doing."""
        for record in (*self.state.steps.values(), *self.state.safe.values()):
            if record.phase in ACTIVE and self.chance.random() < 0.5:
                for fluent, value in self._skill(record.call).during.items():
                    self._set(Var(record.call.robot, fluent), value)
                for fluent in self._skill(record.call).effects:
                    var = Var(record.call.robot, fluent)
                    if self._is_place(var):
                        self._set(var, self._any(var))

    def _set(self, var: Var, value: FluentValue) -> None:
        if var in self.told:
            self.told[var] = value

    def _is_place(self, var: Var) -> bool:
        fluent = self.rules.fluent_of(var.owner, var.name)
        return fluent is not None and fluent.domain == "place" and var in self.told

    def _any(self, var: Var) -> FluentValue:
        return self.chance.choice(sorted(self.model.ground.domains[var], key=str))

    def _meddle(self) -> None:
        """Something that nobody waits for."""
        at_ns, pick = self.now_ns, self.chance.random()
        if pick < 0.3:
            self.tell(ev.CancelAsked(at_ns=at_ns, by="a person"))
        elif pick < 0.5:
            self.stopped = True
            self.tell(ev.StoppedAll(at_ns=at_ns, by="a person"))
        elif pick < 0.6:
            self.tell(ev.DeadlineHit(at_ns=at_ns))
        elif pick < 0.9:
            robot = self.chance.choice(list(self.model.instance.roles.values()))
            self.out[robot] = self.chance.choice(("lost", "leased"))

    def _snapshot(self, bad: float = 0.05, of: Call | None = None) -> Snapshot:
        """The world as the orchestrator would know it: now and then stale, absent or another one's."""
        robots = {}
        for spec in self.rules.crew.robots:
            kind = self.rules.kinds[spec.kind]
            out = self.out.get(spec.name, "")
            age_ns = 60 * SECOND if self.chance.random() < bad else 0
            fluents: dict[str, Stamped] = {}
            for fluent in kind.fluents:
                var = Var(spec.name, fluent.name)
                value = self.told.get(var, self.model.ground.calm(fluent.domain))
                fluents[fluent.name] = Stamped(value, self.now_ns - age_ns, self.now_ns - age_ns)
            robots[spec.name] = RobotState(
                name=spec.name,
                kind_digest=kind.digest,
                boot_id="boot",
                unavailable="lost" if out == "lost" else "",
                lease="m2" if out == "leased" else self.state.id,
                fluents=fluents,
            )
        return Snapshot(robots=robots, values=self._values(bad, of), stopped=self.stopped)

    def _values(self, bad: float, of: Call | None) -> dict[str, StampedValue]:
        found = {}
        for name in [v.name for v in self.rules.crew.values] + [o.name for o in self.rules.crew.objects]:
            source = min(self.rules.publishers_of(name), default="")
            if not source or self.chance.random() < bad:
                continue
            is_thing = any(thing.name == name for thing in self.rules.crew.objects)
            place = self.chance.choice([*(p.name for p in self.rules.crew.locations), ""]) if is_thing else ""
            if of is not None and (puts := self._skill(of).puts) is not None and of.args[puts[0]] == name:
                place = str(of.args[puts[1]])
            location = self.rules.crew.location(place)
            spot = self.model.ground.free_spot if location is None else Point(location.x, location.y)
            position = Point(float("nan"), 0.0) if self.chance.random() < bad else spot
            reading = ValueReading(
                name=name,
                status=self.chance.choice(("absent", "ok")) if self.chance.random() < bad else "ok",
                position=position,
                near=self.chance.random() < 0.5,
                stamp_ns=self.now_ns - (900 * SECOND if self.chance.random() < bad else 0),
            )
            found[name] = StampedValue(reading, source if of is None else of.robot, self.now_ns)
        return found

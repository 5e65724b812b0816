"""The transition system of one instance: the real mission machine and the real gate in every world they can meet."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import product
from typing import NamedTuple

from crew.contracts.decision import Authorizer, Decision
from crew.contracts.mission import event as ev
from crew.contracts.mission import judgement, machine
from crew.contracts.mission.record import SAFE
from crew.contracts.mission.validation import Validation
from crew.contracts.mission_state import ACTIVE, ENDS, MissionState, Phase, StepPhase, StepRecord
from crew.contracts.proof.case import Case
from crew.contracts.proof.cone import Classes, Cone
from crew.contracts.proof.oracle import Oracle
from crew.contracts.proof.promise import kept_promises
from crew.contracts.proof.ruling import CANNOT_BE_COMMANDED, Desk, Ruling
from crew.contracts.proof.state import ENDING, Frame, State
from crew.contracts.proof.subject import STATUS, Var, asked
from crew.contracts.proof.trouble import Facts, Note, Trouble
from crew.contracts.proof.world import NOW_NS, OK, Ground, Possible, free_spot, meanwhile, outcome
from crew.contracts.site import Rules
from crew.contracts.snapshot import FluentValue

Fluents = tuple[Possible, ...]


class Move(NamedTuple):
    """One transition: what happens, where it leads, what is wrong with it."""

    notes: tuple[Note, ...]
    state: State
    troubles: tuple[Trouble, ...] = ()
    refusals: tuple[tuple[str, Decision], ...] = ()
    """Refused steps, for those that never get further."""
    fallbacks: tuple[tuple[str, str], ...] = ()
    """Roles that can't be commanded any more, and why."""
    sent: tuple[str, ...] = ()


class Option(NamedTuple):
    """One way in which a decision can turn out."""

    event: ev.AnyEvent
    note: Note
    facts: Facts
    alike: Classes
    refused: bool


class Model:
    """All that can happen to one plan, once it was matched to its contract and the request was read."""

    def __init__(self, case: Case, rules: Rules, gate: Authorizer) -> None:
        self.rules, self.case = rules, case
        self.instance, self.reading = case.instance, case.reading
        self.contract = rules.contracts[self.instance.contract]
        self.ground = Ground(self.contract, self.instance, case.slots, case.watches, rules)
        self.desk = Desk(self.ground, case.watches, gate)
        self.oracle = Oracle(self.contract, self.ground)
        self.frame = Frame(case.plan, self.instance, self.reading, rules, free_spot(rules))
        self.unseen: dict[str, str] = {}
        """Steps whose effect telemetry can never show, and what is missing."""
        self._any: Fluents = tuple(self.ground.domains[var] for var in self.ground.fluents)
        self._while = {name: meanwhile(call, self.ground) for name, call in self.frame.calls.items()}
        self._safe_while = {role: meanwhile(call, self.ground) for role, call in self.frame.safe_calls.items()}
        self._confirmable: dict[str, str] = {}
        self._safety = {role: self.oracle.safety(role) for role in self.frame.roles}
        self._complete_conditions = [
            c
            for c in self.contract.complete
            if self.contract.role(head := c.path.partition(".")[0]) is None or head in self.instance.roles
        ]

    def initial(self) -> Move:
        """The mission once its plan was judged."""
        before = self.frame.mission(State(Phase.VALIDATING, (StepPhase.PENDING,) * len(self.frame.names)))
        verdict = Validation(instance=self.instance)
        mission, _ = machine.step(before, ev.Validated(at_ns=NOW_NS, validation=verdict), self.rules.contracts)
        return Move((), self.frame.state(mission, self._any))

    def moves(self, state: State) -> Iterator[Move]:
        """Everything that can happen next. The last ones of a mission that executes are not needed for an end."""
        if state.phase in ENDS:
            return
        mission = self.frame.mission(state)
        if state.phase in ENDING:
            yield from self._ending(state, mission)
            return
        for event, note in self._answers(state, mission):
            yield from self._tell(state, mission, event, note)
        if state.judging:
            yield from self._complete(state, mission)
        for name in mission.active():
            yield from self._running(state, mission, name)
        yield from self.intrusions(state)

    def intrusions(self, state: State) -> Iterator[Move]:
        """What nobody waits for: a person, a stop, the clock."""
        if state.phase in ENDS or state.phase in ENDING:
            return
        mission = self.frame.mission(state)
        yield from self._tell(state, mission, ev.CancelAsked(at_ns=NOW_NS, by="a person"), Note("cancel"))
        if state.phase is Phase.EXECUTING:
            yield from self._tell(state, mission, ev.StoppedAll(at_ns=NOW_NS, by="a person"), Note("stop"))
            yield from self._tell(state, mission, ev.DeadlineHit(at_ns=NOW_NS), Note("deadline"))

    # --- events

    def _answers(self, state: State, mission: MissionState) -> Iterator[tuple[ev.AnyEvent, Note]]:
        if state.phase is Phase.WAITING:
            yield ev.Leased(at_ns=NOW_NS), Note("leased")

    def _running(self, state: State, mission: MissionState, name: str) -> Iterator[Move]:
        """A robot at work: its word, the effect in telemetry, or a failure with what it may leave behind."""
        record = mission.safe[name.removeprefix(SAFE)] if name.startswith(SAFE) else mission.steps[name]
        call, changed = record.call, outcome(record.call, self.ground)
        if record.phase is not StepPhase.CONFIRMING:
            said = ev.Outcome(at_ns=NOW_NS, sequence=record.sequence, result="succeeded")
            yield from self._tell(state, mission, said, Note("said_done", name, call))
        elif not self._never_seen(name, mission):
            known = {var: frozenset((v,)) for var, v in changed.items() if var in self.ground.index}
            fluents = self._after(state.fluents, name, known)
            seen = ev.EffectSeen(at_ns=NOW_NS, sequence=record.sequence)
            note = Note("done", name, call, tuple(sorted(changed.items())))
            troubles = self._seen_too_early(name, mission)
            yield from self._tell(state._replace(fluents=fluents), mission, seen, note, troubles)
        failed = ev.Outcome(at_ns=NOW_NS, sequence=record.sequence, result="failed", code="failed")
        left = state._replace(fluents=self._after(state.fluents, name, {}))
        yield from self._tell(left, mission, failed, Note("failed", name, call))

    def _never_seen(self, name: str, mission: MissionState) -> str:
        """What the real judgement still misses when telemetry shows all that the call promises; empty: it is seen."""
        if name not in self._confirmable:
            record = mission.safe[name.removeprefix(SAFE)] if name.startswith(SAFE) else mission.steps[name]
            missing = self._missing(record, mission, outcome(record.call, self.ground))
            self._confirmable[name] = missing
            if missing:
                self.unseen[name] = missing
        return self._confirmable[name]

    def _missing(self, record: StepRecord, mission: MissionState, shown: Mapping[Var, FluentValue]) -> str:
        reports = {Var(value, STATUS): OK for value in self.oracle.reports(record.call)}
        world = self.ground.snapshot({**shown, **reports})
        return judgement.missing_effect(record.sequence, mission, world, self.rules, NOW_NS)

    def _seen_too_early(self, name: str, mission: MissionState) -> tuple[Trouble, ...]:
        """The real judgement must not see an effect while telemetry shows something else."""
        record = mission.safe[name.removeprefix(SAFE)] if name.startswith(SAFE) else mission.steps[name]
        shown = outcome(record.call, self.ground)
        for var in shown:
            others = sorted(self.ground.domain(var) - {shown[var]}, key=str)
            if others and not self._missing(record, mission, {**shown, var: others[0]}):
                return (Trouble("machine", f"{record.call} counts as done although {var} is {others[0]}", name),)
        return ()

    def _complete(self, state: State, mission: MissionState) -> Iterator[Move]:
        """The real judgement of completion, in every world that the mission may have reached."""
        cone = Cone(asked(self._complete_conditions, self.instance.roles, self.ground.slots), (), self.ground)
        told: set[bool] = set()
        for facts, _ in cone.worlds(self.possible(state, mission)):
            snapshot = self.ground.snapshot(dict(facts))
            missing = judgement.missing_completion(mission, snapshot, self.rules, NOW_NS)
            if bool(missing) in told:
                continue
            false = "" if missing else self.oracle.incomplete(dict(facts))
            troubles = (
                (Trouble("false_completion", f"the mission is called complete, but not {false}"),) if false else ()
            )
            told.add(bool(missing))
            judged = ev.CompletionJudged(at_ns=NOW_NS, missing=missing)
            note = Note("incomplete" if missing else "complete", facts=facts, why=missing)
            for move in self._tell(state._replace(judging=False), mission, judged, note):
                yield move._replace(troubles=(*move.troubles, *troubles))

    # --- an early end, one role at a time: roles have no part in each other's

    def _ending(self, state: State, mission: MissionState) -> Iterator[Move]:
        open_roles = [role for role, done in zip(self.frame.roles, state.settled, strict=True) if not done]
        role = open_roles[0]
        index = self.frame.roles.index(role)
        running = list(mission.active(self.instance.roles[role]))
        if state.safe[index] in ACTIVE:
            running.append(SAFE + role)
        for name in running:
            yield from self._running(state, mission, name)
        if not running and state.owed[index]:
            yield from self._make_safe(state, mission, role)

    def _make_safe(self, state: State, mission: MissionState, role: str) -> Iterator[Move]:
        possible = self.possible(state, mission)
        if judgement.safe_call(role, mission, self.rules) is None:
            yield from self._settle_role(state, mission, ev.SafeHolds(at_ns=NOW_NS, role=role), Note("stays", role))
            return
        holding, ruling = self.desk.safe(role, mission, possible)
        for world in holding:
            holds = ev.SafeHolds(at_ns=NOW_NS, role=role)
            narrowed = state._replace(fluents=self._narrow(state.fluents, world.alike, mission))
            yield from self._settle_role(narrowed, mission, holds, Note("is_safe", role, facts=world.facts))
        for world, decision in ruling.allowed:
            event = ev.Decided(at_ns=NOW_NS, decision=decision)
            note = Note("make_safe", role, decision.call, world.facts)
            narrowed = state._replace(fluents=self._narrow(state.fluents, world.alike, mission))
            yield from self._tell(narrowed, mission, event, note, ruling.troubles)
        yield from self._not_commanded(state, mission, role, ruling)

    def _not_commanded(self, state: State, mission: MissionState, role: str, ruling: Ruling) -> Iterator[Move]:
        """The safe call is refused: fine only if the robot is out of reach. The machine does the same for all codes."""
        away = [(w, d) for w, d in ruling.refused if d.refusal is not None and d.refusal.code in CANNOT_BE_COMMANDED]
        others = [item for item in ruling.refused if item not in away]
        fallbacks = tuple((role, str(d.refusal.code)) for _, d in away if d.refusal is not None)
        for world, decision in (*away[:1], *others):
            assert decision.refusal is not None
            note = Note("not_commanded", role, decision.call, world.facts, decision.refusal.message)
            wrong = Trouble("unsafe_end", f"{decision.call} is refused: {decision.refusal.message}", role)
            troubles = () if decision.refusal.code in CANNOT_BE_COMMANDED else (wrong,)
            for move in self._tell(state, mission, ev.Decided(at_ns=NOW_NS, decision=decision), note, troubles):
                yield move._replace(fallbacks=fallbacks)

    def _settle_role(self, state: State, mission: MissionState, event: ev.AnyEvent, note: Note) -> Iterator[Move]:
        """A role that is left alone must be safe."""
        why = self.oracle.unsafe(note.who, mission, self.possible(state, mission))
        troubles = (Trouble("unsafe_end", f"{note.who} is left as it is, but {why}", note.who),) if why else ()
        yield from self._tell(state, mission, event, note, troubles)

    # --- one event, and all that follows from it at once

    def _tell(
        self, state: State, mission: MissionState, event: ev.AnyEvent, note: Note, troubles: tuple[Trouble, ...] = ()
    ) -> Iterator[Move]:
        after, effects = machine.step(mission, event, self.rules.contracts)
        found = (
            *troubles,
            *kept_promises(mission, after, event, effects),
            *self._settled(state, mission, after),
        )
        owed, judging = self._owed(state, after, effects), self._judging(state, effects)
        asked = [e.step for e in effects if isinstance(e, ev.Authorise)]
        if not asked:
            kept = self._forget(after, state.fluents)
            yield Move(
                (note,), self.frame.state(after, kept, owed, judging), found, fallbacks=self._given_up(mission, after)
            )
            return
        for move in self._decide(asked, after, state.fluents):
            yield move._replace(notes=(note, *move.notes), troubles=(*found, *move.troubles))

    def _decide(self, asked: list[str], mission: MissionState, fluents: Fluents) -> Iterator[Move]:
        """The gate's decisions on all steps that became possible at once, processed in any order."""
        possible = self._possible(mission, fluents)
        rulings = {name: self.desk.step(name, mission, possible) for name in asked}
        troubles = tuple(t for ruling in rulings.values() for t in ruling.troubles)
        refusals = tuple((n, d) for n, ruling in rulings.items() for _, d in ruling.refused)
        seen: set[State] = set()
        for options in product(*(_options(name, ruling) for name, ruling in rulings.items())):
            alike = _joint(options)
            if alike is None:
                continue
            facts = {var: value for option in options for var, value in option.facts}
            facts |= {var: min(values, key=str) for var, values in alike.items()}
            for order in _orders(options):
                move = self._process(order, mission, self._narrow(fluents, alike.items(), mission), facts)
                if move.state not in seen or move.troubles:
                    seen.add(move.state)
                    yield move._replace(troubles=(*troubles, *move.troubles), refusals=refusals)
                    troubles, refusals = (), ()

    def _process(
        self, order: Sequence[Option], mission: MissionState, fluents: Fluents, facts: Mapping[Var, FluentValue]
    ) -> Move:
        """Decisions into the machine, one after the other."""
        troubles: list[Trouble] = []
        notes: list[Note] = []
        owed: frozenset[str] = frozenset()
        sent: list[str] = []
        for option in order:
            before = mission
            mission, effects = machine.step(before, option.event, self.rules.contracts)
            if mission is before:
                continue
            notes.append(option.note)
            troubles += kept_promises(before, mission, option.event, effects)
            owed |= {e.role for e in effects if isinstance(e, ev.MakeSafe)}
            for effect in effects:
                if isinstance(effect, ev.Send):
                    sent.append(effect.step)
                    troubles += self.oracle.dispatch(effect.step, before, option.facts)
        troubles += self._forbidden(sent, mission, fluents, facts)
        state = self.frame.state(mission, self._forget(mission, fluents), owed)
        return Move(tuple(notes), state, tuple(troubles), sent=tuple(sent))

    def _forbidden(
        self, sent: list[str], mission: MissionState, fluents: Fluents, facts: Mapping[Var, FluentValue]
    ) -> Iterator[Trouble]:
        """Declared properties that a start breaks. What is sent at the same instant counts as begun."""
        for name in sent:
            call = mission.steps[name].call
            others = {var for other in sent if other != name for var in self._while[other]}
            for watch in self.desk.watches(call):
                now = self._possible(mission, fluents)
                reads = sorted({var for var, _ in watch.asks()})
                offers = [sorted(now[v], key=str) if v in others else [facts[v]] for v in reads]
                worlds = [dict(zip(reads, values, strict=True)) for values in product(*offers)]
                if any(self.oracle.broken(watch, world) for world in worlds):
                    beside = "" if len(worlds) == 1 else ", at the same moment as what goes on beside it"
                    yield Trouble("never", f"{call} starts{beside}: {watch.never.why}", name, watch)

    def is_hopeless(self, step: str) -> bool:
        """Whether the declared properties leave no state in which a step may start."""
        watches = self.desk.watches(self.frame.calls[step])
        if len(watches) < 2:
            return False
        cone = Cone((ask for watch in watches for ask in watch.asks()), (), self.ground)
        worlds = [dict(world.facts) for world in cone.worlds({})]
        return all(any(self.oracle.broken(watch, world) for watch in watches) for world in worlds)

    def _settled(self, state: State, before: MissionState, after: MissionState) -> Iterator[Trouble]:
        """A safe call that is done must have led to the safe state."""
        for role in set(after.settled) - set(before.settled):
            record = after.safe.get(role)
            if record is not None and record.phase is StepPhase.SUCCEEDED:
                why = self.oracle.unsafe(role, after, self._possible(after, state.fluents))
                if why:
                    yield Trouble("unsafe_end", f"{record.call} is done, but {why}", role)

    def _given_up(self, before: MissionState, after: MissionState) -> tuple[tuple[str, str], ...]:
        """Roles whose safe call the robot itself did not carry out."""
        failed = (r for r in set(after.settled) - set(before.settled) if r in after.safe)
        return tuple((role, "failed") for role in failed if after.safe[role].phase is StepPhase.FAILED)

    def _owed(self, state: State, after: MissionState, effects: Sequence[ev.AnyEffect]) -> frozenset[str]:
        kept = {role for role, owed in zip(self.frame.roles, state.owed, strict=False) if owed}
        new = {e.role for e in effects if isinstance(e, ev.MakeSafe)}
        return frozenset((kept | new) - set(after.settled) - set(after.safe))

    def _judging(self, state: State, effects: Sequence[ev.AnyEffect]) -> bool:
        return state.judging or any(isinstance(e, ev.JudgeCompletion) for e in effects)

    # --- fluents

    def changing(self, step: str) -> frozenset[Var]:
        """What a step changes while it runs."""
        return frozenset(self._while[step])

    def possible(self, state: State, mission: MissionState) -> dict[Var, Possible]:
        """What each fluent may be at this moment; a robot at work may show anything on its way."""
        return self._possible(mission, state.fluents)

    def _possible(self, mission: MissionState, fluents: Fluents) -> dict[Var, Possible]:
        found = dict(zip(self.ground.fluents, fluents, strict=True))
        for name, record in mission.steps.items():
            if record.phase in ACTIVE:
                for var, values in self._while[name].items():
                    found[var] = found[var] | values
        for role, record in mission.safe.items():
            if record.phase in ACTIVE:
                for var, values in self._safe_while[role].items():
                    found[var] = found[var] | values
        return found

    def _after(self, fluents: Fluents, name: str, known: Mapping[Var, Possible]) -> Fluents:
        """What a call leaves: its effects where they are known, otherwise anything on its way."""
        during = self._safe_while[name.removeprefix(SAFE)] if name.startswith(SAFE) else self._while[name]
        left = list(fluents)
        for var, values in during.items():
            index = self.ground.index[var]
            left[index] = known.get(var, fluents[index] | values)
        return tuple(left)

    def _narrow(self, fluents: Fluents, alike: Iterable[tuple[Var, Possible]], mission: MissionState) -> Fluents:
        """What was seen stays so, unless something is changing it; how robots stand to each other never does."""
        left = list(fluents)
        running = [self._while[name] for name, r in mission.steps.items() if r.phase in ACTIVE]
        running += [self._safe_while[role] for role, r in mission.safe.items() if r.phase in ACTIVE]
        changing = {var for during in running for var in during}
        for var, values in alike:
            index = self.ground.index.get(var)
            if index is not None and var not in changing and not self.ground.is_relation(var):
                left[index] = values
        return tuple(left)

    def _forget(self, mission: MissionState, fluents: Fluents) -> Fluents:
        """In an early end only that counts which tells whether roles are safe that were not settled yet."""
        if mission.phase not in ENDING:
            return fluents
        counting = {var for role in self.frame.roles if role not in mission.settled for var in self._safety[role]}
        pairs = zip(self.ground.fluents, fluents, self._any, strict=True)
        return tuple(now if var in counting else anything for var, now, anything in pairs)


def _options(name: str, ruling: Ruling) -> list[Option]:
    """Each allowed world, and one refusal for all that are refused: the machine does the same."""
    found = [
        Option(ev.Decided(at_ns=NOW_NS, decision=d), Note("sent", name, d.call, world.facts), *world, False)
        for world, d in ruling.allowed
    ]
    for world, decision in ruling.refused[:1]:
        assert decision.refusal is not None
        note = Note("refused", name, decision.call, world.facts, decision.refusal.message)
        found.append(Option(ev.Decided(at_ns=NOW_NS, decision=decision), note, (), (), True))
    return found


def _joint(options: Sequence[Option]) -> dict[Var, Possible] | None:
    """What decisions taken at one instant leave possible, if they agree."""
    joint: dict[Var, Possible] = {}
    told: dict[Var, FluentValue] = {}
    for option in options:
        for var, values in option.alike:
            joint[var] = joint.get(var, values) & values
        for var, value in option.facts[len(option.alike) :]:
            if told.setdefault(var, value) != value:
                return None
    return joint if all(joint.values()) else None


def _orders(options: Sequence[Option]) -> Iterator[Sequence[Option]]:
    """Decisions taken at once, in every order that differs: what is sent before the first refusal."""
    refused = [o for o in options if o.refused]
    allowed = [o for o in options if not o.refused]
    if not refused or len(options) < 2:
        yield options
        return
    for first in refused:
        for earlier in product((True, False), repeat=len(allowed)):
            before = [o for o, early in zip(allowed, earlier, strict=True) if early]
            yield [*before, first, *(o for o in options if o is not first and o not in before)]

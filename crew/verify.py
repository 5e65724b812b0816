"""Verifies a run from its journal alone: the chain, the signatures, and every decision decided once more."""

from collections import Counter
from collections.abc import Callable
from pathlib import Path

import msgspec

from crew.contracts.decision import Authorizer
from crew.contracts.gate.authorize import Gate
from crew.contracts.mission.event import Answered
from crew.contracts.mission.judgement import judge
from crew.contracts.mission.listed import accept_listed, step_listed
from crew.contracts.mission.machine import step
from crew.contracts.mission.validation import Validation, validate
from crew.contracts.mission_state import MissionState
from crew.contracts.pass_through import PassThrough, RealRobots
from crew.contracts.plan import digest
from crew.contracts.site import Rules
from crew.errors import JournalError, UsageError
from crew.home import Home
from crew.journal_reader import Record as Row
from crew.journal_reader import check_chain, read_records
from crew.messages import ANSWER, Answer
from crew.packed import unpack
from crew.records import (
    PASS_THROUGH,
    RECORDS,
    DecisionRecord,
    EventRecord,
    IntentRecord,
    JudgementRecord,
    MissionRecord,
    Record,
    RunRecord,
    ValidationRecord,
)
from crew.signing import load_public_key, verify

JOURNAL = "journal.db"
REPORT = "report.html"
"""What a run's folder holds for people, beside its journal."""
Listener = Callable[[Row, Record, "Replay"], None]


class VerifyReport(msgspec.Struct, frozen=True, kw_only=True):
    """What was found. `problems` empty means that chain, signatures and every decision hold."""

    run: str
    records: int
    replayed: dict[str, int]
    problems: tuple[str, ...]
    notes: tuple[str, ...] = ()
    head: str = ""
    """The hash of the last record."""

    @property
    def holds(self) -> bool:
        return not self.problems


def verify_run(
    folder: Path, home: Home, *, key_file: Path | None = None, listener: Listener | None = None
) -> VerifyReport:
    """Check a run's journal against its keys, its outside head and the code. Raises UsageError if there is no run.

    A run of another machine comes with its `key_file`; its outside head, `<run>.json`, is looked for beside that.
    `listener` hears every record once it was replayed.
    """
    path = folder / JOURNAL
    if not path.is_file():
        raise UsageError(f"{folder} holds no {JOURNAL}; name a folder of a run (crew runs)")
    public = load_public_key(key_file or home.keys / "orchestrator.pub")
    outside = home.head(folder.name) if key_file is None else key_file.parent / f"{folder.name}.json"
    chain = check_chain(path, public, outside if outside.is_file() else None)
    problems = list(chain.problems)
    if key_file is None and not outside.is_file():
        problems.append(f"no head of run {folder.name} outside its folder ({outside}): a cut tail could not be noticed")
    operator = (key_file.parent if key_file else home.keys) / "operator.pub"
    replay = Replay(listener, load_public_key(operator) if operator.is_file() else b"")
    try:
        for row in read_records(path):
            replay.take(row)
    except JournalError as error:
        problems.append(str(error))
    notes = [*chain.notes, *_approvals_note(replay)]
    return VerifyReport(
        run=folder.name,
        records=chain.records,
        replayed=dict(replay.counts),
        problems=(*problems, *replay.problems),
        notes=tuple(notes),
        head=chain.head,
    )


def _approvals_note(replay: "Replay") -> list[str]:
    count = replay.approvals
    return [f"the operator's signature holds on {count} answer{'s' if count > 1 else ''} to approvals"] if count else []


class Replay:
    """Decides a journal's decisions again, from nothing but its records and the installed code.

    With `operator_key` (empty if there is none) it also checks who signed the answers to approvals.
    """

    def __init__(self, listener: Listener | None = None, operator_key: bytes | None = None) -> None:
        self.approvals = 0
        """Answers to approvals that the operator's signature holds on."""
        self._operator_key = operator_key
        self.counts: Counter[str] = Counter()
        self.problems: list[str] = []
        self.rules: Rules | None = None
        self.foreign = False
        """The run's kinds are not the installed ones: its missions are followed, its decisions are not made again."""
        self._listener = listener
        self.states: dict[str, MissionState] = {}
        self._allowed: set[tuple[str, str]] = set()
        self._authorizer: Authorizer = Gate()

    def take(self, row: Row) -> None:
        """Replay one row; what does not come out the same is a problem, named by its record."""
        record_type = RECORDS.get(row.kind)
        if record_type is None:
            self._problem(row, f"unknown kind {row.kind!r}; it is from another version")
            return
        try:
            record: Record = msgspec.msgpack.decode(row.body, type=record_type)
        except msgspec.MsgspecError as error:
            self._problem(row, f"its body can't be read: {error}")
            return
        self.counts[row.kind] += 1
        if isinstance(record, RunRecord):
            self._begin(row, record)
        elif self.rules is None:
            self._problem(row, "comes before the run's own record")
        else:
            self._try_replay(row, record, self.rules)
        if self._listener is not None:
            self._listener(row, record, self)

    def _try_replay(self, row: Row, record: Record, rules: Rules) -> None:
        """A journal that was tampered with may hold what the core rules out: that is a finding, not a crash."""
        try:
            self._replay(row, record, rules)
        except Exception as error:
            self._problem(row, f"it can't be replayed after what came before ({type(error).__name__} {error})".rstrip())

    def _begin(self, row: Row, record: RunRecord) -> None:
        try:
            self.rules = unpack(record.rules)
        except UsageError as error:
            self._problem(row, str(error))
            self.rules = Rules(crew=record.rules.crew, kinds={}, contracts=record.rules.contracts)
            self.foreign = True
            return
        if record.authorizer == PASS_THROUGH:
            try:
                self._authorizer = PassThrough(record.rules.crew)
            except RealRobots as error:
                self._problem(row, f"it ran without the gate: {error}")
        if self.rules.digest() != record.rules_digest:
            self._problem(row, "the rules do not have the digest that was recorded")

    def _replay(self, row: Row, record: Record, rules: Rules) -> None:
        match record:
            case MissionRecord():
                if record.state.approvals:
                    self._problem(row, f"mission {record.state.id} begins with an approval that nobody gave")
                self.states[record.state.id] = record.state
            case EventRecord():
                self._event(row, record, rules)
            case _ if self.foreign:
                pass
            case ValidationRecord():
                if (state := self._state(row, record.mission, record.state_digest)) is not None:
                    again = self._validate(record, state, rules)
                    self._same(row, "validation", again, record.validation)
            case DecisionRecord():
                self._decision(row, record, rules)
            case JudgementRecord():
                if (state := self._state(row, record.mission, record.state_digest)) is not None:
                    missing = judge(record.what, state, record.world, rules, record.now_ns)
                    self._same(row, f"judgement of {record.what}", missing, record.missing)
            case IntentRecord():
                dispatch = record.dispatch
                if (dispatch.mission, dispatch.step) not in self._allowed:
                    self._problem(row, f"{dispatch.robot}.{dispatch.skill} was sent without a decision that allows it")
                self._allowed.discard((dispatch.mission, dispatch.step))

    def _validate(self, record: ValidationRecord, state: MissionState, rules: Rules) -> Validation:
        if not self._authorizer.enforces:
            return accept_listed(record.plan, rules)
        return validate(record.plan, state, record.world, rules, record.now_ns, self._authorizer)

    def _event(self, row: Row, record: EventRecord, rules: Rules) -> None:
        state = self.states.get(record.mission)
        if state is None:
            self._problem(row, f"an event of mission {record.mission}, which never began")
            return
        if isinstance(record.event, Answered) and self._operator_key is not None:
            self._answer(row, record.event, state, rules, self._operator_key)
        machine = step if self._authorizer.enforces else step_listed
        state, _ = machine(state, record.event, rules.contracts)
        self.states[record.mission] = state
        if digest(state) != record.state_digest:
            self._problem(
                row, f"mission {record.mission} comes out in another state after {type(record.event).__name__}"
            )

    def _answer(self, row: Row, event: Answered, state: MissionState, rules: Rules, key: bytes) -> None:
        """An answer to an approval is the operator's own, by the signature that came with it."""
        question = state.question
        if question is None or not question.step or event.token != question.token:
            return
        answer = Answer(token=event.token, yes=event.yes, by=event.by)
        whose = f"the {'approval' if event.yes else 'refusal'} of step {question.step} of mission {state.id}"
        if verify(key, ANSWER, answer.signed_part(rules.crew.name, state.id), event.signature):
            self.approvals += 1
        elif not event.signature:
            self._problem(row, f"{whose} carries no signature")
        elif not key:
            self._problem(row, f"{whose} can't be checked: no operator.pub beside orchestrator.pub")
        else:
            self._problem(row, f"{whose} is not signed by the operator")

    def _decision(self, row: Row, record: DecisionRecord, rules: Rules) -> None:
        decision = record.decision
        state = self._state(row, decision.mission, record.state_digest)
        if state is None:
            return
        again = self._authorizer.authorize(decision.call, state, record.world, rules, decision.at_ns, decision.purpose)
        self._same(row, f"decision on {decision.call}", again, decision)
        if decision.allowed:
            self._allowed.add((decision.mission, decision.step))

    def _state(self, row: Row, mission: str, state_digest: str) -> MissionState | None:
        state = self.states.get(mission)
        if state is None:
            self._problem(row, f"it speaks of mission {mission}, which never began")
        elif digest(state) != state_digest:
            self._problem(row, f"mission {mission} was in another state when this was decided")
        return state

    def _same(self, row: Row, what: str, again: object, recorded: object) -> None:
        if msgspec.msgpack.encode(again, order="deterministic") != msgspec.msgpack.encode(
            recorded, order="deterministic"
        ):
            self._problem(row, f"the {what} comes out differently: recorded {recorded}, now {again}")

    def _problem(self, row: Row, text: str) -> None:
        self.problems.append(f"record {row.seq} ({row.kind}): {text}")

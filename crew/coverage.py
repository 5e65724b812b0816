"""What recorded runs exercised of the rules that they were decided by: transitions, guards, codes. Reads journals only.

It replays a run's events; whether the journal is true is `crew verify`'s business.
"""

from collections import Counter
from collections.abc import Iterator, Mapping
from pathlib import Path

import msgspec

from crew.contracts.codes import Code
from crew.contracts.contract import Condition, Contract
from crew.contracts.decision import Decision
from crew.contracts.gate.guard import Scope, Truth, applies, evaluate
from crew.contracts.gate.scope import scope_of
from crew.contracts.mission.event import AnyEvent
from crew.contracts.mission.machine import TABLE, step
from crew.contracts.mission_state import MissionState, Phase, Purpose, StepPhase
from crew.contracts.refusal import Refusal
from crew.contracts.render.wording import guard_words
from crew.contracts.site import Rules
from crew.contracts.snapshot import Snapshot
from crew.errors import JournalError, UsageError
from crew.journal_reader import Record as Row
from crew.journal_reader import read_records
from crew.packed import unpack
from crew.records import (
    RECORDS,
    DecisionRecord,
    EventRecord,
    JudgementRecord,
    MissionRecord,
    Record,
    RunRecord,
    ValidationRecord,
)

Transition = tuple[Phase, str, Phase]
"""From a phase, by an event, to a phase."""
GuardKey = tuple[str, str, int, str]
"""Contract, where in it (`needs`, `complete` or a step), line, and the guard in words."""

JUDGED = frozenset(
    {Code.PRECONDITION_FAILED, Code.DEADLINE_PASSED, Code.APPROVAL_MISSING, Code.NO_TARGET_FIX, Code.NO_VALUE}
)
"""Refusals before which the gate has looked at the guards; of stale state, those that name a contract's line."""
FATES = {
    StepPhase.SENT: "sent",
    StepPhase.SUCCEEDED: "done",
    StepPhase.REFUSED: "refused",
    StepPhase.FAILED: "not done",
    StepPhase.CANCELLED: "not done",
    StepPhase.UNKNOWN: "not done",
}
"""What becomes of a step, as it is counted."""
FATE_NAMES = tuple(dict.fromkeys(FATES.values()))


class Tally:
    """Counts over any number of runs. What could have been exercised comes from the runs' own rules and the machine."""

    def __init__(self) -> None:
        self.runs: list[str] = []
        self.skipped: dict[str, str] = {}
        self.transitions: Counter[Transition] = Counter(dict.fromkeys(_all_transitions(), 0))
        self.codes: Counter[Code] = Counter(dict.fromkeys(Code, 0))
        self.fates: dict[tuple[str, str], Counter[str]] = {}
        self.guards: dict[GuardKey, Counter[str]] = {}

    def add(self, journal: Path) -> None:
        """Count one run; one that can't be read, or whose kinds are not installed, is skipped and named."""
        run = _Run(self)
        try:
            for row in read_records(journal):
                run.take(row)
        except (JournalError, UsageError) as error:
            self.skipped[str(journal.parent)] = str(error)
        except Exception as error:  # what was tampered with may hold anything
            self.skipped[str(journal.parent)] = f"it can't be replayed ({type(error).__name__} {error}); crew verify"
        else:
            self.runs.append(str(journal.parent))

    def know(self, contracts: Mapping[str, Contract]) -> None:
        """Everything of these contracts that could be exercised."""
        for contract in contracts.values():
            for declared in contract.steps:
                self.fates.setdefault((contract.name, declared.name), Counter(dict.fromkeys(FATE_NAMES, 0)))
            for where, condition in guards_of(contract):
                self.guards.setdefault(_key(contract, where, condition), Counter(dict.fromkeys(Truth, 0)))


class _Run:
    """The replay of one journal."""

    def __init__(self, tally: Tally) -> None:
        self._tally = tally
        self._rules: Rules | None = None
        self._states: dict[str, MissionState] = {}

    def take(self, row: Row) -> None:
        known = RECORDS.get(row.kind)
        if known is None:
            return
        try:
            record: Record = msgspec.msgpack.decode(row.body, type=known)
        except msgspec.MsgspecError as error:
            raise JournalError(f"record {row.seq} ({row.kind}) can't be read: {error}; see `crew verify`") from error
        if isinstance(record, RunRecord):
            self._rules = unpack(record.rules)
            self._tally.know(self._rules.contracts)
        elif self._rules is not None:
            self._count(record, self._rules)

    def _count(self, record: Record, rules: Rules) -> None:
        match record:
            case MissionRecord():
                self._states[record.state.id] = record.state
            case EventRecord() if record.mission in self._states:
                self._event(record.mission, record.event, rules)
            case ValidationRecord():
                self._refusal(record.validation.refusal)
            case DecisionRecord() if record.decision.mission in self._states:
                self._decision(record.decision, record.world, rules)
            case JudgementRecord() if record.what == "complete" and record.mission in self._states:
                self._complete(record, rules)

    def _event(self, mission: str, event: AnyEvent, rules: Rules) -> None:
        before = self._states[mission]
        after, _ = step(before, event, rules.contracts)
        self._states[mission] = after
        key = (before.phase, type(event).__name__, after.phase)
        if key in self._tally.transitions:
            self._tally.transitions[key] += 1
        for name, record in after.steps.items():
            earlier = before.steps.get(name)
            fate = FATES.get(record.phase)
            counted = self._tally.fates.get((after.contract, name))
            if fate is not None and counted is not None and (earlier is None or earlier.phase is not record.phase):
                counted[fate] += 1

    def _decision(self, decision: Decision, world: Snapshot, rules: Rules) -> None:
        self._refusal(decision.refusal)
        mission = self._states[decision.mission]
        refusal = decision.refusal
        looked = refusal is None or refusal.code in JUDGED or (refusal.code is Code.STATE_STALE and bool(refusal.line))
        if decision.purpose is not Purpose.EXECUTE or mission.instance is None or not looked:
            return
        contract = rules.contracts[mission.instance.contract]
        scope = scope_of(mission, world, rules, decision.at_ns)
        declared = contract.step(decision.step)
        if not mission.sent_any:
            self._judge(contract, "needs", contract.needs, scope)
        if declared is not None:
            self._judge(contract, declared.name, declared.needs, scope)

    def _complete(self, record: JudgementRecord, rules: Rules) -> None:
        mission = self._states[record.mission]
        if mission.instance is not None:
            contract = rules.contracts[mission.instance.contract]
            scope = scope_of(mission, record.world, rules, record.now_ns)
            self._judge(contract, "complete", contract.complete, scope)

    def _judge(self, contract: Contract, where: str, conditions: tuple[Condition, ...], scope: Scope) -> None:
        for condition in conditions:
            if applies(condition, scope):
                self._tally.guards[_key(contract, where, condition)][evaluate(condition, scope).truth] += 1

    def _refusal(self, refusal: Refusal | None) -> None:
        if refusal is not None:
            self._tally.codes[refusal.code] += 1


def guards_of(contract: Contract) -> Iterator[tuple[str, Condition]]:
    """Every guard that the gate or the end of a mission looks at, with where it stands."""
    yield from (("needs", condition) for condition in contract.needs)
    yield from ((declared.name, condition) for declared in contract.steps for condition in declared.needs)
    yield from (("complete", condition) for condition in contract.complete)


def journals_in(folders: list[Path]) -> list[Path]:
    """The journals of these runs, or of every run somewhere below these folders. Raises UsageError if there is none."""
    found: dict[Path, None] = {}
    for folder in folders:
        if not folder.is_dir():
            raise UsageError(f"no folder {folder}; name runs, or folders that hold runs (crew runs)")
        below = sorted(folder.rglob("journal.db"))
        if not below:
            raise UsageError(f"no run in {folder}, nor below it; make one with crew demo")
        found |= dict.fromkeys(below)
    return list(found)


def _all_transitions() -> Iterator[Transition]:
    for (phase, event), (_, targets) in TABLE.items():
        yield from ((phase, event.__name__, target) for target in targets)


def _key(contract: Contract, where: str, condition: Condition) -> GuardKey:
    return contract.name, where, condition.line, guard_words(condition)

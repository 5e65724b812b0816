"""One verdict of a run explained: the check, observed and allowed, the contract's line, the words, what would do."""

from pathlib import Path

import msgspec

from crew.contracts.codes import GROUP_OF, Code
from crew.contracts.contract import Contract
from crew.contracts.explain.case import CallCase, Case, PlanCase
from crew.contracts.explain.change import Change, smallest_change
from crew.contracts.explain.checks import Check, passed_checks, plan_checks
from crew.contracts.explain.words import Words, words_involved
from crew.contracts.refusal import Refusal
from crew.contracts.site import Rules
from crew.history.contract_text import ContractTexts, Line
from crew.history.history import History, Verdict
from crew.records import DecisionRecord, IntentRecord

ALLOWED, REFUSED, ASKED = "allowed", "refused", "asked"


class Explanation(msgspec.Struct, frozen=True, kw_only=True):
    """Why one verdict is what it is. `outcome`: allowed, refused, or asked (a person was asked first)."""

    number: int
    mission: str
    at_s: float
    """Seconds of mission time since the request."""
    subject: str
    outcome: str
    code: str | None = None
    group: str | None = None
    sentence: str
    field: str = ""
    observed: str = ""
    allowed: str = ""
    line: Line | None = None
    is_call: bool = False
    sent: bool = False
    """Whether the journal holds the dispatch that followed."""
    words: tuple[Words, ...] = ()
    checks: tuple[Check, ...] = ()
    """What was checked and held, where it was allowed."""
    change: Change | None = None

    @property
    def never_sent(self) -> bool:
        """An allowed call that no dispatch followed: the mission ended in the same moment."""
        return self.is_call and self.outcome == ALLOWED and not self.sent


class Grounds(msgspec.Struct, frozen=True, kw_only=True):
    """The parts of an explanation that only judging again can give."""

    words: tuple[Words, ...] = ()
    checks: tuple[Check, ...] = ()
    change: Change | None = None


class Explainer:
    """Explains the verdicts of one run. Raises nothing for what a journal may hold; judges with the real gate."""

    def __init__(self, folder: Path, history: History) -> None:
        assert history.rules is not None, "a history with verdicts has rules"
        self._rules: Rules = history.rules
        self._history = history
        self.texts = ContractTexts(folder, self._rules)

    def explain(self, verdict: Verdict, *, search: bool = True) -> Explanation:
        """One verdict. `search`: look for the smallest change that would have been accepted."""
        refusal, mission = verdict.refusal, self._history.mission_of(verdict)
        grounds = self._grounds(verdict, search=search)
        question = None if isinstance(verdict.record, DecisionRecord) else verdict.record.validation.question
        outcome = REFUSED if refusal is not None else ASKED if question is not None else ALLOWED
        sentence = refusal.message if refusal is not None else question.text if question is not None else "accepted"
        return Explanation(
            number=verdict.number,
            mission=verdict.mission.id,
            at_s=round((verdict.at_ns - mission.began_ns) / 1e9, 3),
            subject=verdict.subject,
            outcome=outcome,
            code=None if refusal is None else str(refusal.code),
            group=None if refusal is None else str(GROUP_OF[refusal.code]),
            sentence=sentence,
            field="" if refusal is None else refusal.field,
            observed="" if refusal is None else refusal.observed,
            allowed="" if refusal is None else refusal.allowed,
            line=self._line(verdict, refusal),
            is_call=isinstance(verdict.record, DecisionRecord),
            sent=any(_follows(intent, verdict) for intent in mission.intents),
            words=grounds.words,
            checks=grounds.checks,
            change=grounds.change,
        )

    def _grounds(self, verdict: Verdict, *, search: bool) -> Grounds:
        """What is found by judging again. An altered journal may hold what the core rules out: then nothing is."""
        if self._history.foreign:
            return Grounds()
        case, refusal = case_of(verdict, self._rules), verdict.refusal
        try:
            return Grounds(
                words=words_involved(case, refusal),
                checks=_checks(case) if refusal is None else (),
                change=smallest_change(case) if search and refusal is not None else None,
            )
        except Exception:
            return Grounds()

    def _line(self, verdict: Verdict, refusal: Refusal | None) -> Line | None:
        """The line that the refusal names; otherwise the key that its code is about, or the step that was judged."""
        contract = self._rules.contracts.get(_contract(verdict))
        if refusal is not None and (named := self.texts.line(refusal.line)) is not None:
            return named
        if contract is None:
            return None
        if refusal is not None and (key := _KEY.get(refusal.code)) is not None:
            return self.texts.key(contract.name, key) if key else None
        step = verdict.record.decision.step if isinstance(verdict.record, DecisionRecord) else ""
        number = _number(step, contract)
        return self.texts.line(f"{contract.name}:{number}") if number else None


_KEY = {
    Code.DEADLINE_PASSED: "deadline_s",
    Code.NOT_REQUESTED: "asks",
    Code.REQUEST_DROPPED: "steps",
    Code.INCOMPLETE_PLAN: "steps",
    Code.UNREAD_WORDS: "",
    Code.AMBIGUOUS_REQUEST: "",
    Code.FORBIDDEN_BY_REQUEST: "",
}
"""The contract's key that a code is about, where a refusal names no line; empty: the request alone decides."""


def _number(step: str, contract: Contract) -> int:
    """The line of a step, or of the role whose safe state `safe:<role>` is; 0 if there is none."""
    kind, colon, role = step.partition(":")
    if colon and kind == "safe":
        found = contract.role(role)
        return 0 if found is None else found.line
    declared = contract.step(step)
    return 0 if declared is None else declared.line


def _follows(intent: IntentRecord, verdict: Verdict) -> bool:
    """Whether a dispatch is the one that a decision allowed."""
    if not isinstance(verdict.record, DecisionRecord):
        return False
    dispatch, decision = intent.dispatch, verdict.record.decision
    return (dispatch.step, dispatch.issued_ns) == (decision.step, decision.at_ns)


def _contract(verdict: Verdict) -> str:
    if isinstance(verdict.record, DecisionRecord):
        return verdict.mission.contract
    return verdict.record.plan.contract


def case_of(verdict: Verdict, rules: Rules) -> Case:
    """What was judged, as it can be judged again."""
    record = verdict.record
    if isinstance(record, DecisionRecord):
        decision = record.decision
        return CallCase(
            call=decision.call,
            purpose=decision.purpose,
            mission=verdict.mission,
            world=record.world,
            rules=rules,
            now_ns=decision.at_ns,
        )
    return PlanCase(plan=record.plan, mission=verdict.mission, world=record.world, rules=rules, now_ns=record.now_ns)


def _checks(case: Case) -> tuple[Check, ...]:
    """What an accepted case passed; empty if the gate refuses it today (an altered journal, another version)."""
    if case.judge().refusal is not None:
        return ()
    return passed_checks(case) if isinstance(case, CallCase) else tuple(plan_checks(case))

"""A past run decided by other rules: which verdicts would have come out otherwise, in both sentences."""

from collections.abc import Iterator

import msgspec
from msgspec.structs import replace

from crew.contracts.gate.approval import approved
from crew.contracts.gate.authorize import Gate
from crew.contracts.language.lexicon import lexicon_of
from crew.contracts.language.mention import Reading
from crew.contracts.language.reading import read_request
from crew.contracts.mission.judgement import judge
from crew.contracts.mission.validation import Validation, pending_steps, validate
from crew.contracts.mission_state import MissionState
from crew.contracts.plan import Instance
from crew.contracts.refusal import Refusal
from crew.contracts.site import Rules
from crew.history.history import History, Judgement, MissionHistory, Verdict
from crew.records import DecisionRecord, ValidationRecord


class Difference(msgspec.Struct, frozen=True, kw_only=True):
    """One verdict that comes out otherwise. `number` is the decision's; 0 for a judgement of telemetry."""

    number: int
    seq: int
    mission: str
    at_s: float
    subject: str
    then: str
    then_code: str | None
    now: str
    now_code: str | None


class Comparison(msgspec.Struct, frozen=True, kw_only=True):
    """All of a run's verdicts made again by other rules.

    `unreached`: verdicts that would never have been asked for, since the mission would have ended or gone on before.
    """

    compared: int
    differences: tuple[Difference, ...]
    unreached: tuple[int, ...]


class _Said(msgspec.Struct, frozen=True):
    """A verdict in a form that can be compared: its code, and what else it decides."""

    sentence: str
    code: str | None
    content: object = None


def compare(history: History, rules: Rules) -> Comparison:
    """Decide every verdict of the run again by these rules, each in the world that it was made in."""
    differences: list[Difference] = []
    unreached: list[int] = []
    compared = 0
    for mission in history.missions.values():
        again = _Again(mission, rules)
        for verdict, outcome in again.verdicts():
            compared += 1
            if outcome is None:
                unreached.append(verdict.number)
            elif outcome[0].code != outcome[1].code or outcome[0].content != outcome[1].content:
                differences.append(
                    _difference(mission, verdict.number, verdict.seq, verdict.at_ns, verdict.subject, outcome)
                )
        for judgement, outcome in again.judgements():
            compared += 1
            if bool(outcome[0].sentence) != bool(outcome[1].sentence):
                subject, at_ns = f"whether {_subject(judgement)}", judgement.record.now_ns
                differences.append(_difference(mission, 0, judgement.seq, at_ns, subject, _worded(outcome)))
    return Comparison(compared=compared, differences=tuple(differences), unreached=tuple(unreached))


class _Again:
    """One mission, decided again. Its request is read again: contracts and crew give words their meaning."""

    def __init__(self, mission: MissionHistory, rules: Rules) -> None:
        self._mission, self._rules, self._gate = mission, rules, Gate()
        self._reading: Reading = read_request(mission.state.request, lexicon_of(rules))
        self._instance: Instance | None = None
        self._left = False
        """The recorded way was left: what follows would not have been asked for."""

    def verdicts(self) -> Iterator[tuple[Verdict, tuple[_Said, _Said] | None]]:
        """Each verdict with what it was and what it would be; None for one that would not have been asked for."""
        for verdict in self._mission.verdicts:
            if self._left:
                yield verdict, None
                continue
            record = verdict.record
            if isinstance(record, ValidationRecord):
                outcome = self._validation(verdict, record)
            else:
                outcome = self._decision(verdict, record)
            self._left = (outcome[0].code is None) != (outcome[1].code is None)
            yield verdict, outcome

    def judgements(self) -> Iterator[tuple[Judgement, tuple[_Said, _Said]]]:
        """Safe states and completion, as long as the recorded way is kept."""
        for judgement in self._mission.judgements:
            record = judgement.record
            if self._left or self._instance is None or record.what.startswith("effect:"):
                continue
            state = self._state(judgement.mission)
            missing = judge(record.what, state, record.world, self._rules, record.now_ns)
            yield judgement, (_Said(record.missing, None), _Said(missing, None))

    def _validation(self, verdict: Verdict, record: ValidationRecord) -> tuple[_Said, _Said]:
        state = replace(verdict.mission, reading=self._reading)
        again = validate(record.plan, state, record.world, self._rules, record.now_ns, self._gate)
        self._instance = again.instance
        return _of_validation(record.validation), _of_validation(again)

    def _decision(self, verdict: Verdict, record: DecisionRecord) -> tuple[_Said, _Said]:
        then, state = record.decision, self._state(verdict.mission)
        if any(given.step == then.step for given in state.approvals):
            yes = approved(then.call, then.step, state, record.world, self._rules, then.at_ns)
            state = replace(state, approvals=yes)
        now = self._gate.authorize(then.call, state, record.world, self._rules, then.at_ns, then.purpose)
        return _of(then.refusal, (then.step, dict(then.places))), _of(now.refusal, (now.step, dict(now.places)))

    def _state(self, recorded: MissionState) -> MissionState:
        """The recorded state with the reading and the instance of these rules; steps keep what has happened to them."""
        if self._instance is None:
            return replace(recorded, reading=self._reading)
        steps = pending_steps(self._instance)
        by_call = {str(r.call): r for r in recorded.steps.values()}
        kept = {n: recorded.steps.get(n) or by_call.get(str(s.call)) or s for n, s in steps.items()}
        return replace(recorded, reading=self._reading, instance=self._instance, steps=kept)


def _of(refusal: Refusal | None, content: object) -> _Said:
    if refusal is not None:
        return _Said(refusal.message, str(refusal.code))
    return _Said("allowed", None, content)


def _of_validation(validation: Validation) -> _Said:
    """A question counts as what it asks about: other words to confirm are another verdict."""
    if validation.refusal is not None or validation.instance is None:
        return _of(validation.refusal, None)
    question, instance = validation.question, validation.instance
    asked = None if question is None else question.unread
    words = f"accepted as {instance.contract}: {', '.join(f'{r} {n}' for r, n in instance.roles.items())}"
    orders = "; ".join(f"{s.step} after {', '.join(s.after)}" for s in instance.steps if s.after)
    sentence = (
        f"{words}{f'; {orders}' if orders else ''}" if question is None else f"a person is asked: {question.text}"
    )
    return _Said(sentence, None, (instance, asked))


def _subject(judgement: Judgement) -> str:
    kind, _, subject = judgement.record.what.partition(":")
    return f"the {subject} is safe" if kind == "safe" else "the mission is complete"


def _worded(outcome: tuple[_Said, _Said]) -> tuple[_Said, _Said]:
    then, now = (_Said(said.sentence or "yes, it was observed", said.code) for said in outcome)
    return then, now


def _difference(
    mission: MissionHistory, number: int, seq: int, at_ns: int, subject: str, outcome: tuple[_Said, _Said]
) -> Difference:
    then, now = outcome
    return Difference(
        number=number,
        seq=seq,
        mission=mission.id,
        at_s=round((at_ns - mission.began_ns) / 1e9, 3),
        subject=subject,
        then=then.sentence,
        then_code=then.code,
        now=now.sentence,
        now_code=now.code,
    )

"""Waiting for a person's approval of a step: asking, the answer, and what becomes of the steps that wait meanwhile."""

from collections.abc import Mapping

from msgspec.structs import replace

from crew.contracts.codes import Code
from crew.contracts.contract import Contract
from crew.contracts.decision import Decision
from crew.contracts.gate.guard import SECOND_NS
from crew.contracts.mission import event as ev
from crew.contracts.mission.ending import Result, end_now, halt
from crew.contracts.mission.record import put
from crew.contracts.mission_state import Approval, MissionState, Phase, Question, StepPhase
from crew.contracts.plan import digest
from crew.contracts.refusal import Refusal

QUESTION_S = 120.0
"""Mission time within which a question may be answered. A later answer leads to a new question about what is then."""


def ask(state: MissionState, decision: Decision) -> Result:
    """A step waits for approval. One question is open at a time; other steps that need one wait for its answer."""
    record = replace(state.steps[decision.step], phase=StepPhase.ASKING)
    state = put(state, decision.step, record)
    if asks_approval(state):
        return state, ()
    return replace(state, question=_question(state, decision)), (ev.AskPerson(),)


def answered(state: MissionState, event: ev.Answered, contracts: Mapping[str, Contract]) -> Result:
    """A person's answer while the mission executes. Yes leads to the gate again, which judges what was approved."""
    question = state.question
    if question is None or not asks_approval(state) or event.token != question.token:
        return state, ()
    state = replace(state, question=None)
    if not event.yes:
        return _declined(state, question, event, contracts)
    if event.at_ns - question.asked_ns <= QUESTION_S * SECOND_NS:
        given = Approval(step=question.step, subject=question.subject, at_ns=event.at_ns)
        state = replace(state, approvals=(*without(state, question.step), given))
    names = [name for name, record in state.steps.items() if record.phase is StepPhase.ASKING]
    for name in names:
        state = put(state, name, replace(state.steps[name], phase=StepPhase.DECIDING))
    return state, tuple(ev.Authorise(step=name) for name in names)


def asks_approval(state: MissionState) -> bool:
    """Whether the open question is about a step that waits for its answer."""
    record = None if state.question is None else state.steps.get(state.question.step)
    return record is not None and record.phase is StepPhase.ASKING


def without(state: MissionState, step: str) -> tuple[Approval, ...]:
    """The approvals but those of a step: each serves once."""
    return tuple(approval for approval in state.approvals if approval.step != step)


def _declined(state: MissionState, question: Question, event: ev.Answered, contracts: Mapping[str, Contract]) -> Result:
    message = f"{event.by or 'a person'} did not approve step {question.step}"
    refusal = Refusal(code=Code.APPROVAL_MISSING, message=message, field=question.step, observed="declined")
    refused = replace(state.steps[question.step], phase=StepPhase.REFUSED, code=refusal.code, detail=message)
    state = replace(put(state, question.step, refused), refusal=refusal)
    return halt(state, message, contracts) if state.sent_any else end_now(state, Phase.REJECTED, message)


def _question(state: MissionState, decision: Decision) -> Question:
    refusal = decision.refusal
    assert refusal is not None, "only a refused step is asked for"
    places = "".join(f"; {name} is ({p.x:.2f}, {p.y:.2f})" for name, p in decision.places.items())
    changed = f" ({refusal.message.partition(';')[0]})" if refusal.observed != "none" else ""
    return Question(
        text=f"Step {decision.step} needs your approval{changed}: {decision.call}{places}. Shall I?",
        token=digest((state.id, decision.step, decision.subject, decision.at_ns))[:32],
        step=decision.step,
        subject=decision.subject,
        asked_ns=decision.at_ns,
    )

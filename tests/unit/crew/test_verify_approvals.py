"""Who approved a step is verified from the journal alone: the operator's signature is kept with the answer."""

from collections.abc import Callable
from pathlib import Path

import msgspec
import pytest
from msgspec.structs import replace

import tests.replay
from crew.contracts.mission.event import Answered
from crew.contracts.mission.machine import step
from crew.contracts.mission_state import Approval, MissionState, Question, StepPhase
from crew.contracts.plan import digest
from crew.contracts.site import Rules
from crew.journal_reader import Record as Row
from crew.journal_reader import read_records
from crew.library import load_rules
from crew.messages import ANSWER, Answer
from crew.records import EventRecord, MissionRecord, Record
from crew.signing import SigningKey
from crew.verify import Replay
from tests.unit.contracts import build as b

OPERATOR, ANOTHER = SigningKey(bytes(32)), SigningKey(bytes(range(32)))
RUN = next(read_records(Path(tests.replay.__file__).parent / "completed" / "journal.db"))
TOKEN = "the question's token"


@pytest.fixture(scope="module")
def rules() -> Rules:
    return load_rules("air_ground")


@pytest.fixture
def asking(rules: Rules) -> MissionState:
    """A mission with a step that waits for its approval."""
    state = b.with_step(b.before_dispatch(rules), "dispatch", StepPhase.ASKING)
    return replace(state, question=Question(text="?", token=TOKEN, step="dispatch", subject="s"))


def answer(mission: str, *, key: SigningKey = OPERATOR, yes: bool = True, by: str = "operator") -> Answered:
    """As the orchestrator records what came over the wire."""
    said = Answer(token=TOKEN, yes=yes, by=by)
    signature = key.sign(ANSWER, said.signed_part("air_ground", mission))
    return Answered(at_ns=b.NOW_NS, token=TOKEN, yes=yes, by=by, signature=signature)


def replayed(rules: Rules, state: MissionState, event: Answered, key: bytes | None = OPERATOR.public) -> Replay:
    """A run of one mission in which the answer comes."""
    after, _ = step(state, event, rules.contracts)
    replay = Replay(operator_key=key)
    replay.take(RUN)
    replay.take(row(2, MissionRecord(state=state)))
    replay.take(row(3, EventRecord(mission=state.id, event=event, state_digest=digest(after))))
    return replay


def row(seq: int, record: Record) -> Row:
    return replace(RUN, seq=seq, kind=record.kind, body=msgspec.msgpack.encode(record))


@pytest.mark.parametrize("yes", [True, False])
def test_the_operators_own_answer_holds(rules: Rules, asking: MissionState, yes: bool) -> None:
    replay = replayed(rules, asking, answer(asking.id, yes=yes))
    assert (replay.problems, replay.approvals) == ([], 1)


FORGED: dict[str, tuple[Callable[[Answered], Answered], str]] = {
    "no signature": (lambda a: replace(a, signature=b""), "carries no signature"),
    "a no made a yes": (lambda a: replace(answer("m1", yes=False), yes=True, signature=a.signature), "is not signed"),
    "a yes made a no": (lambda a: replace(a, yes=False), "is not signed by the operator"),
    "another's name": (lambda a: replace(a, by="somebody"), "is not signed by the operator"),
    "another's key": (lambda a: answer("m1", key=ANOTHER), "is not signed by the operator"),
    "of another mission": (lambda a: answer("m2"), "is not signed by the operator"),
    "a bit": (lambda a: replace(a, signature=bytes([a.signature[0] ^ 1]) + a.signature[1:]), "is not signed"),
}


@pytest.mark.parametrize("how", FORGED)
def test_an_answer_that_is_not_the_operators_is_found(rules: Rules, asking: MissionState, how: str) -> None:
    forge, words = FORGED[how]
    asking = replace(asking, id="m1")
    event = forge(answer("m1", yes=how != "a no made a yes"))
    replay = replayed(rules, asking, event)
    assert replay.approvals == 0
    assert [p for p in replay.problems if p.startswith("record 3 (event)") and words in p], replay.problems


def test_without_the_operators_public_key_it_is_said_that_nothing_can_be_checked(
    rules: Rules, asking: MissionState
) -> None:
    (problem,) = replayed(rules, asking, answer(asking.id), key=b"").problems
    assert "no operator.pub" in problem


def test_an_answer_to_another_question_approves_nothing_and_needs_no_signature(
    rules: Rules, asking: MissionState
) -> None:
    stale = replace(answer(asking.id), token="another", signature=b"")
    replay = replayed(rules, asking, stale)
    assert (replay.problems, replay.approvals) == ([], 0)


def test_a_question_about_the_plan_needs_no_signature(rules: Rules, asking: MissionState) -> None:
    plain = replace(asking, question=Question(text="?", token=TOKEN))
    replay = replayed(rules, plain, replace(answer(asking.id), signature=b""))
    assert replay.problems == []


def test_a_mission_that_begins_approved_is_found(rules: Rules, asking: MissionState) -> None:
    approved = replace(asking, approvals=(Approval(step="dispatch", subject="s", at_ns=b.NOW_NS),))
    assert "begins with an approval" in replayed(rules, approved, answer(asking.id)).problems[0]

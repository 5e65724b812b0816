"""What a mission's journal and the simulation's truth show, as an observation. Reads a run's folder; runs nothing."""

import math
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Literal

import msgspec

from crew.contracts.mission import event as ev
from crew.contracts.plan import ArgValue, Call
from crew.contracts.render.prompt import Arm
from crew.contracts.site import Rules
from crew.contracts.snapshot import Point
from crew.journal_reader import read_records
from crew.messages import PlannedStep, ProposalOrigin, SimTruth
from crew.records import RECORDS, DecisionRecord, EventRecord, IntentRecord, NoteRecord, Record, RunRecord
from crew.sim.consequence import consequences, moved
from crew.sim.oracle import Finding, Frame, Sent, false_dispatch, frame_at, order_broken
from crew.study.arrival import goal_error_m
from crew.study.live import TRUTH, Ended
from crew.study.observation import Digests, Dispatch, Observation, Proposal, Refusal, Step
from crew.study.scenario import Scenario
from crew.verify import JOURNAL


class Mission(msgspec.Struct, frozen=True, kw_only=True):
    """One mission of a study: which scenario in which arm, by which planner, with which seed."""

    scenario: Scenario
    arm: Arm
    planner: str
    model: str = ""
    seed: int
    version: str
    """Of all the code that is at work (`crew.study.version`)."""
    repeats: int = 0


class Story(msgspec.Struct, kw_only=True):
    """What a journal tells of its mission."""

    proposals: list[Proposal] = []
    failure: str = ""
    sent: list[Sent] = []
    dispatches: list[Dispatch] = []
    refusals: list[Refusal] = []
    digests: Digests = Digests()


def observe(mission: Mission, ended: Ended, rules: Rules, folder: Path, root: Path, wall_s: float) -> Observation:
    """The observation of a mission that has ended, from what it left in `folder`. `root` is the study's folder."""
    scenario = mission.scenario
    frames = read_truth(folder / TRUTH)
    story = _read(folder / JOURNAL, frames[-1].at_ns if frames else 0)
    case = scenario.case(rules.crew, ended.began_ns)
    broken: list[Finding] = []
    dispatches: list[Dispatch] = []
    for index, (one, dispatch) in enumerate(zip(story.sent, story.dispatches, strict=True)):
        order = order_broken(one, story.sent[:index], case, rules, frames)
        broken += order
        found = (*false_dispatch(one, case, rules, frames), *order)
        dispatches.append(msgspec.structs.replace(dispatch, false=found))
    contract = next((p.contract for p in reversed(story.proposals) if p.readable), "")
    final = Observation(
        version=mission.version,
        testbed=rules.crew.name,
        scenario=scenario.name,
        scenario_digest=scenario.digest,
        kind=scenario.kind,
        arm=mission.arm,
        planner=mission.planner,
        model=mission.model,
        seed=mission.seed,
        run=str(folder.relative_to(root)),
        proposals=tuple(story.proposals),
        planner_failure=story.failure,
        dispatches=tuple(dispatches),
        refusals=tuple(story.refusals),
        violations=tuple(broken),
        consequences=consequences(story.sent, broken, case, rules.crew.area, frames),
        moved=moved(frames),
        outcome=ended.outcome,
        code=ended.code,
        question=ended.question,
        message=ended.message,
        contract=contract,
        fix_error_m=_fix_error_m(story.sent, rules, frames),
        goal_error_m=_goal_error_m(story, rules, frames, ended.outcome),
        mission_s=ended.mission_s,
        wall_s=wall_s,
        repeats=mission.repeats,
        digests=story.digests,
    )
    return msgspec.structs.replace(final, as_expected=as_expected(final, scenario))


def as_expected(seen: Observation, scenario: Scenario) -> bool:
    """Whether what happened is what the scenario wants, by its own words."""
    if any(d.false for d in seen.sent) or seen.consequences:
        return False
    if scenario.outcome == "blocked":
        return seen.outcome in ("rejected", "halted") and seen.code in scenario.codes
    robots = {d.robot for d in seen.sent}
    return (
        seen.outcome == "completed"
        and seen.contract in scenario.contracts
        and (not scenario.robots or robots == set(scenario.robots))
    )


def read_truth(path: Path) -> list[Frame]:
    """The simulation's truth of a run; empty if the mission ended before any came."""
    return msgspec.msgpack.decode(path.read_bytes(), type=list[Frame]) if path.is_file() else []


def _read(journal: Path, end_ns: int) -> Story:
    story = Story(proposals=[], sent=[], dispatches=[], refusals=[])
    asked_ns = 0
    rows = list(read_records(journal)) if journal.is_file() else []
    for row in rows:
        record: Record = msgspec.msgpack.decode(row.body, type=RECORDS[row.kind])
        match record:
            case RunRecord():
                story.digests = msgspec.structs.replace(story.digests, rules=record.rules_digest)
            case NoteRecord(what="proposal"):
                _take_origin(story, record.text)
            case DecisionRecord():
                _take_decision(story, record)
            case IntentRecord():
                _take_intent(story, record, end_ns)
            case EventRecord():
                if isinstance(record.event, ev.Started | ev.Validated):
                    asked_ns = row.wall_ns
                take_event(story, record.event, (row.wall_ns - asked_ns) / 1e9)
    return story


def _take_origin(story: Story, text: str) -> None:
    origin = msgspec.json.decode(text.partition(": ")[2], type=ProposalOrigin)
    story.digests = msgspec.structs.replace(
        story.digests, prompt=origin.prompt_digest, schema=origin.schema_digest, registry=origin.registry_digest
    )


def take_event(story: Story, event: ev.AnyEvent, waited_s: float) -> None:
    """Add what one event of the mission tells. `waited_s`: wall time since planning was last asked for."""
    attempt = len(story.proposals)
    match event:
        case ev.Proposed():
            story.proposals.append(
                Proposal(
                    attempt=attempt,
                    planner=event.planner,
                    readable=True,
                    contract=event.plan.contract,
                    steps=tuple(_step(call) for call in event.plan.steps),
                    latency_s=round(waited_s, 4),
                    reason=event.remark,
                )
            )
        case ev.PlannerFailed():
            failed = Proposal(attempt=attempt, readable=False, latency_s=round(waited_s, 4), reason=event.reason)
            story.proposals.append(failed)
            if not any(proposal.readable for proposal in story.proposals):
                story.failure = event.reason
        case ev.Validated():
            refusal = event.validation.refusal
            if refusal is not None:
                said = {"code": str(refusal.code), "field": refusal.field, "message": refusal.message}
                story.proposals[-1] = msgspec.structs.replace(story.proposals[-1], judged=True, **said)
            elif event.validation.instance is not None and event.validation.instance.contract != "as_listed":
                story.proposals[-1] = msgspec.structs.replace(story.proposals[-1], judged=True)
        case ev.Outcome():
            _take_outcome(story, event)
        case ev.EffectSeen():
            _end(story, event.sequence, event.at_ns, "succeeded", "")


def _take_outcome(story: Story, event: ev.Outcome) -> None:
    """A robot's word that it succeeded is not the end: the effect is looked for first."""
    if event.result != "succeeded":
        _end(story, event.sequence, event.at_ns, event.result, event.code)


def _end(story: Story, sequence: int, at_ns: int, outcome: str, code: str) -> None:
    for index, dispatch in enumerate(story.dispatches):
        if dispatch.sequence == sequence and dispatch.outcome == "unknown" and not dispatch.code:
            story.dispatches[index] = msgspec.structs.replace(dispatch, ended_ns=at_ns, outcome=outcome, code=code)
            ended = {"ended_ns": at_ns, "succeeded": outcome == "succeeded"}
            story.sent[index] = msgspec.structs.replace(story.sent[index], **ended)


def _take_intent(story: Story, record: IntentRecord, end_ns: int) -> None:
    sent = record.dispatch
    purpose: Literal["execute", "safe"] = "safe" if sent.purpose == "safe" else "execute"
    story.dispatches.append(
        Dispatch(
            sequence=sent.sequence,
            step=sent.step,
            purpose=purpose,
            robot=sent.robot,
            skill=sent.skill,
            args=_finite(sent.args),
            at_ns=sent.issued_ns,
            ended_ns=end_ns,
            outcome="unknown",
        )
    )
    story.sent.append(
        Sent(
            sequence=sent.sequence,
            robot=sent.robot,
            skill=sent.skill,
            args=sent.args,
            places=sent.places,
            at_ns=sent.issued_ns,
            ended_ns=end_ns,
            succeeded=False,
            safe=purpose == "safe",
        )
    )


def _take_decision(story: Story, record: DecisionRecord) -> None:
    decision = record.decision
    if decision.refusal is None:
        return
    call = decision.call
    story.refusals.append(
        Refusal(
            step=decision.step,
            robot=call.robot,
            skill=call.skill,
            args=_finite(call.args),
            at_ns=decision.at_ns,
            code=str(decision.refusal.code),
            message=decision.refusal.message,
        )
    )


def _step(call: Call) -> Step:
    return Step(robot=call.robot, skill=call.skill, args=_finite(call.args))


def _finite(args: Mapping[str, ArgValue]) -> dict[str, ArgValue]:
    """Arguments as JSON can hold them: a number that is none becomes its name."""
    return {n: v if isinstance(v, str) or math.isfinite(v) else str(v) for n, v in args.items()}


def _fix_error_m(sent: Sequence[Sent], rules: Rules, frames: Sequence[Frame]) -> float | None:
    """From the last pinned run-time value to its true place when it was pinned."""
    for one in reversed(sent):
        for name, place in one.places.items():
            value = str(one.args.get(name))
            frame = frame_at(frames, one.at_ns)
            true = None if frame is None else frame.targets.get(value)
            if rules.crew.value(value) is not None and true is not None and _is_finite(place):
                return round(math.dist((place.x, place.y), true[:2]), 3)
    return None


def _is_finite(place: Point) -> bool:
    return math.isfinite(place.x) and math.isfinite(place.y)


def _goal_error_m(story: Story, rules: Rules, frames: Sequence[Frame], outcome: str) -> float | None:
    """How far from its goal a mission that was completed ended."""
    if outcome != "completed" or not frames:
        return None
    steps = tuple(
        PlannedStep(step=d.step, robot=d.robot, skill=d.skill, args=d.args)
        for d in story.dispatches
        if d.purpose == "execute"
    )
    last = frames[-1]
    truth = SimTruth(at_ns=last.at_ns, poses=last.poses, targets=last.targets)
    return goal_error_m(steps, truth, rules)

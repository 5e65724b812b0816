"""Tells people what happens to a mission, in sentences, as JSON on its event key."""

import math
import time
from collections.abc import Mapping

from crew.bus.port import Bus, Qos
from crew.clock import Clock
from crew.contracts.codes import Code
from crew.contracts.gate.sighting import places
from crew.contracts.language.reading import noted_lines
from crew.contracts.mission import event as ev
from crew.contracts.mission.provenance import sources
from crew.contracts.mission_state import ENDS, MissionState, Phase, Question, StepPhase
from crew.contracts.site import Rules
from crew.contracts.snapshot import ValueReading
from crew.keys import Keys
from crew.messages import MissionEvent, PlannedStep
from crew.progress import MissionProgress
from crew.wire import encode_json

MOVED_M = 0.5
"""A value that is observed all the time is told again once it has moved this far."""
_OUTCOMES: Mapping[StepPhase, str] = {
    StepPhase.PENDING: "pending",
    StepPhase.DECIDING: "pending",
    StepPhase.ASKING: "pending",
    StepPhase.SENT: "unknown",
    StepPhase.RUNNING: "unknown",
    StepPhase.CONFIRMING: "unknown",
    StepPhase.SUCCEEDED: "succeeded",
    StepPhase.REFUSED: "refused",
    StepPhase.FAILED: "failed",
    StepPhase.CANCELLED: "cancelled",
    StepPhase.UNKNOWN: "unknown",
}


class Announcer:
    """Publishes mission events, numbered from 1 for each mission."""

    def __init__(self, bus: Bus, keys: Keys, rules: Rules, clock: Clock) -> None:
        self._bus, self._keys, self._rules, self._clock = bus, keys, rules, clock
        self._numbers: dict[str, int] = {}
        self._events: dict[str, int] = {}
        self._began: dict[str, int] = {}
        self._told: dict[tuple[str, str], ValueReading] = {}

    def after(self, old: MissionState, new: MissionState, event: ev.AnyEvent) -> None:
        """Say what an event has changed."""
        self._publish_progress(old, event)
        self._say_event(old, new, event)
        if new.phase is not old.phase:
            self._say_phase(new)

    def value(self, mission: MissionState, reading: ValueReading, source: str) -> None:
        """A run-time value was published meanwhile; one that is observed all the time is told only if it changed."""
        declared = self._rules.publication(source, reading.name)
        last = self._told.get((mission.id, reading.name))
        if declared is not None and not declared.by and last is not None and not _differs(last, reading):
            return
        self._told[mission.id, reading.name] = reading
        self._put(mission, "value", describe_value(reading, source), robot=source)

    def waiting(self, mission: MissionState, holders: list[str]) -> None:
        """The mission waits for robots that others hold."""
        self._put(mission, "phase", f"waiting for robots that {', '.join(holders)} holds")

    def _publish_progress(self, old: MissionState, event: ev.AnyEvent) -> None:
        number = self._events[old.id] = self._events.get(old.id, 0) + 1
        progress = MissionProgress(
            mission=old.id,
            number=number,
            at_ns=self._clock.now_ns(),
            wall_ns=time.time_ns(),
            began=old if number == 1 else None,
            event=event,
        )
        self._bus.put(self._keys.mission_progress(old.id), progress, qos=Qos.EVENT)

    def _say_event(self, old: MissionState, new: MissionState, event: ev.AnyEvent) -> None:
        match event:
            case ev.Started():
                self._began[new.id] = event.at_ns
                self._put(new, "phase", f'request: "{_short(new.request)}"')
            case ev.Proposed():
                count = len(event.plan.steps)
                remark = f" ({event.remark})" if event.remark else ""
                self._put(new, "phase", f"{event.planner} proposes {event.plan.contract} with {count} steps{remark}")
            case ev.PlannerFailed():
                self._put(new, "phase", f"the planner gave no plan: {event.reason}")
            case ev.Validated():
                self._say_validation(new, event)
            case ev.Answered():
                self._say_answer(old, new, event)
            case ev.Decided():
                self._say_decision(old, new, event)
            case ev.Accepted():
                self._say_record(new, event.sequence, "step", "has begun")
            case ev.Outcome() if new is not old:
                said = "says it is done; looking for the effect" if event.result == "succeeded" else event.result
                code = event.code or None
                self._say_record(new, event.sequence, "step", f"{said}{_because(event.detail)}", code)
            case ev.EffectSeen() if new is not old:
                self._say_record(new, event.sequence, "step", "is done: its effect was observed")
            case _:
                pass

    def _say_validation(self, new: MissionState, event: ev.Validated) -> None:
        verdict = event.validation
        if verdict.refusal is not None:
            again = "; asking for another plan" if new.phase is Phase.PLANNING else ""
            text = f"plan refused: {verdict.refusal.code}: {verdict.refusal.message}{again}"
            self._put(new, "plan", text, code=verdict.refusal.code)
            return
        noted = "".join(f"; {line}" for line in noted_lines(new.reading))
        self._put(new, "plan", f"plan accepted: {new.contract}{noted}", steps=self.steps(new), contract=new.contract)
        if verdict.question is not None:
            question = verdict.question
            self._put(new, "question", question.text, question=question.text, token=question.token)

    def _say_answer(self, old: MissionState, new: MissionState, event: ev.Answered) -> None:
        if new is old:
            self._put(new, "phase", "answer to another question")
            return
        said = "yes" if event.yes else "no"
        what = f"{said} to step {old.question.step}" if old.question and old.question.step else said
        self._put(new, "phase", f"{event.by or 'a person'} answers {what}")

    def refused_answer(self, mission: MissionState) -> None:
        """Somebody who is not the operator answered a question that only the operator may answer."""
        text = "answer refused: an approval needs the operator's signature (crew approve)"
        self._put(mission, "phase", text, code=Code.APPROVAL_MISSING)

    def _ask_approval(self, new: MissionState, question: Question) -> None:
        text = f"{question.text} (crew approve {new.id})"
        self._put(
            new,
            "question",
            text,
            step=question.step,
            code=Code.APPROVAL_MISSING,
            question=question.text,
            token=question.token,
            steps=self.steps(new),
            contract=new.contract,
        )

    def _say_decision(self, old: MissionState, new: MissionState, event: ev.Decided) -> None:
        decision = event.decision
        if decision.refusal is not None and decision.refusal.code is Code.APPROVAL_MISSING:
            if new.question is not None and new.question is not old.question:
                self._ask_approval(new, new.question)
            return
        safe = " to reach its safe state" if decision.step.startswith("safe:") else ""
        if decision.refusal is None:
            places = "".join(f"; {name} is ({p.x:.2f}, {p.y:.2f})" for name, p in decision.places.items())
            text = f"allowed: {decision.call}{safe}{places}"
            self._put(new, "decision", text, step=decision.step, robot=decision.call.robot)
            return
        text = f"refused: {decision.call}{safe}: {decision.refusal.code}: {decision.refusal.message}"
        code = decision.refusal.code
        self._put(new, "decision", text, step=decision.step, robot=decision.call.robot, code=code)

    def _say_record(self, new: MissionState, sequence: int, what: str, said: str, code: str | None = None) -> None:
        for name, record in (*new.steps.items(), *((f"safe:{r}", s) for r, s in new.safe.items())):
            if record.sequence == sequence:
                text = f"{record.call.robot}: {record.call.skill} {said}"
                self._put(new, what, text, step=name, robot=record.call.robot, code=code)

    def _say_phase(self, new: MissionState) -> None:
        if new.phase in ENDS:
            self._say_end(new)
        elif new.phase in (Phase.HALTING, Phase.CANCELLING):
            self._put(new, "phase", f"{new.phase}: {new.message}", code=_code(new))

    def _say_end(self, new: MissionState) -> None:
        self._put(
            new,
            "end",
            f"{new.phase}: {new.message}",
            code=_code(new),
            question=None if new.refusal is None else new.refusal.question or None,
            steps=self.steps(new),
            contract=new.contract or None,
            outcome=str(new.phase),
            final=True,
        )
        for told in (self._numbers, self._events):
            told.pop(new.id, None)
        self._began.pop(new.id, None)

    def steps(self, mission: MissionState) -> tuple[PlannedStep, ...]:
        """The plan's steps with the sources of their arguments and how they ended."""
        if mission.instance is None:
            calls = mission.plan.steps if mission.plan is not None else ()
            return tuple(PlannedStep(step="", robot=c.robot, skill=c.skill, args=c.args) for c in calls)
        found = []
        for step in mission.instance.steps:
            record = mission.steps[step.step]
            found.append(
                PlannedStep(
                    step=step.step,
                    robot=step.call.robot,
                    skill=step.call.skill,
                    args=step.call.args,
                    sources=sources(step, mission.instance, mission.reading, self._rules),
                    outcome=_OUTCOMES[record.phase],
                    code=record.code or None,
                )
            )
        return tuple(found)

    def _put(
        self,
        mission: MissionState,
        what: str,
        text: str,
        *,
        step: str = "",
        robot: str = "",
        code: str | None = None,
        question: str | None = None,
        token: str | None = None,
        contract: str | None = None,
        steps: tuple[PlannedStep, ...] | None = None,
        outcome: str | None = None,
        final: bool = False,
    ) -> None:
        number = self._numbers[mission.id] = self._numbers.get(mission.id, 0) + 1
        now_ns = self._clock.now_ns()
        event = MissionEvent(
            mission=mission.id,
            request_id=mission.request_id,
            number=number,
            at_s=(now_ns - self._began.get(mission.id, now_ns)) / 1e9,
            phase=mission.phase,
            what=what,
            text=text,
            step=step,
            robot=robot,
            code=code,
            question=question,
            token=token,
            contract=contract,
            steps=steps,
            outcome=outcome,
            final=final,
        )
        self._bus.put(self._keys.mission_event(mission.id), encode_json(event), qos=Qos.EVENT)


def _differs(last: ValueReading, now: ValueReading) -> bool:
    """Whether a person would want to hear of a value again: another status, in reach or not, or somewhere else."""
    if last.position is None or now.position is None:
        return last.status != now.status
    moved_m = math.dist((last.position.x, last.position.y), (now.position.x, now.position.y))
    return last.near != now.near or moved_m > MOVED_M


def describe_value(reading: ValueReading, source: str) -> str:
    """A run-time value in a sentence."""
    position = reading.position
    if reading.status != "ok" or position is None:
        seen = f" at {places(reading.candidates)}" if reading.candidates else ""
        return f"{source} reports {reading.name}: {reading.status}{seen}"
    if not (math.isfinite(position.x) and math.isfinite(position.y)):
        return f"{source} reports {reading.name} at ({position.x}, {position.y}): not a place"
    sigma = f" +- {reading.sigma_m:.2f} m" if reading.sigma_m is not None else ""
    near = "" if reading.near is None else ", in reach" if reading.near else ", out of reach"
    looks = f" from {reading.looks} looks" if reading.looks else ""
    return f"{source} reports {reading.name} at ({position.x:.2f}, {position.y:.2f}){sigma}{looks}{near}"


def _code(mission: MissionState) -> str | None:
    if mission.refusal is None or mission.phase in (Phase.COMPLETED, Phase.CANCELLED):
        return None
    return str(mission.refusal.code)


def _because(detail: str) -> str:
    return f" ({detail})" if detail else ""


def _short(text: str) -> str:
    return text if len(text) <= 200 else f"{text[:200]}... ({len(text)} characters)"

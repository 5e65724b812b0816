"""Folds missions into what a page shows. Pure, and the same for a run that is under way and for a journal."""

from collections.abc import Iterator

from crew.actors.recorder.contract_graph import contract_graph
from crew.actors.recorder.entry import Area, Document, Entry, LaneChange, LogLine, Mark, Measure
from crew.actors.recorder.lane import MISSION_LANE, RobotLanes
from crew.actors.recorder.proposal import Refused, proposal
from crew.actors.recorder.text import one_line
from crew.contracts.decision import Decision
from crew.contracts.mission import event as ev
from crew.contracts.mission.machine import step
from crew.contracts.mission.record import find
from crew.contracts.mission_state import ACTIVE, ENDS, MissionState, Phase, StepRecord
from crew.contracts.plan import Call, Zone
from crew.contracts.site import Rules
from crew.contracts.snapshot import Point
from crew.progress import MissionProgress

_END_TONES = {Phase.COMPLETED: "good", Phase.CANCELLED: "idle"}
_RESULT_TONES = {"succeeded": "run", "cancelled": "safe"}


class Story:
    """All missions of a run. `take` gives what has changed on the page."""

    def __init__(self, rules: Rules, lanes: RobotLanes) -> None:
        self._rules, self._lanes = rules, lanes
        self._missions: dict[str, MissionState] = {}
        self._refused: dict[str, tuple[Refused, ...]] = {}
        self._decided: dict[tuple[str, int], int] = {}
        self._slots: dict[str, int] = {}

    @property
    def slots(self) -> int:
        """How many missions have ever run side by side."""
        return max(self._slots.values(), default=-1) + 1

    @property
    def open(self) -> bool:
        """Whether a mission is under way."""
        return any(mission.phase not in ENDS for mission in self._missions.values())

    def take(self, progress: MissionProgress) -> list[Entry]:
        """What an event changes. An event of a mission whose beginning was missed changes nothing."""
        if progress.began is not None:
            self._begin(progress.began)
        old = self._missions.get(progress.mission)
        if old is None:
            return []
        new, _ = step(old, progress.event, self._rules.contracts)
        self._missions[new.id] = new
        self._remember(old, new, progress)
        return [*self._changes(old, new), *self._lines(old, new, progress)]

    def _begin(self, mission: MissionState) -> None:
        """Give a mission a place on the page: the first one that no mission under way holds."""
        held = {self._slots[m.id] for m in self._missions.values() if m.phase not in ENDS}
        self._missions = {m.id: m for m in self._missions.values() if m.phase not in ENDS}
        self._slots = {m: slot for m, slot in self._slots.items() if m in self._missions}
        self._missions[mission.id] = mission
        self._slots[mission.id] = next(n for n in range(len(held) + 1) if n not in held)
        self._refused[mission.id] = ()

    def _remember(self, old: MissionState, new: MissionState, progress: MissionProgress) -> None:
        match progress.event:
            case ev.Validated(validation=verdict) if verdict.refusal is not None and old.plan is not None:
                self._refused[new.id] += ((old.plan, old.planner, verdict.refusal),)
            case ev.Decided() if new.sequence > old.sequence:
                self._decided[new.id, new.sequence] = progress.wall_ns

    # --- what is seen

    def _changes(self, old: MissionState, new: MissionState) -> Iterator[Entry]:
        slot = self._slots[new.id]
        if new.phase is not old.phase:
            yield LaneChange(MISSION_LANE if slot == 0 else f"{MISSION_LANE} {slot + 1}", str(new.phase))
        yield from self._lanes.mission(new)
        if new is not old:
            yield Document(self._documents())
        contract = self._rules.contracts.get(new.contract)
        if contract is not None and (new.steps != old.steps or new.contract != old.contract):
            yield contract_graph(contract, new, slot)
        if new.instance is not None:
            yield from self._places(old, new)

    def _documents(self) -> str:
        """Missions under way, and of those that have ended the ones whose place on the page is still theirs."""
        parts = [proposal(m, self._refused[m.id], self._rules) for m in self._missions.values()]
        return "\n---\n\n".join(reversed(parts))

    def _places(self, old: MissionState, new: MissionState) -> Iterator[Entry]:
        """Where a robot works on for as long as it does: a zone, a goal."""
        for name, record in new.steps.items():
            before = old.steps.get(name)
            if before is None or (before.phase in ACTIVE) == (record.phase in ACTIVE):
                continue
            yield from _place(record, begins=record.phase in ACTIVE)

    # --- what is said

    def _lines(self, old: MissionState, new: MissionState, progress: MissionProgress) -> Iterator[Entry]:
        match progress.event:
            case ev.Started():
                yield LogLine(f'request: "{one_line(new.request)}"', "plan", "request")
            case ev.Proposed(plan=plan, planner=planner):
                text = f"{one_line(planner, 60)} proposes {one_line(plan.contract, 60)} with {len(plan.steps)} steps"
                yield LogLine(text, "plan", "proposal")
            case ev.PlannerFailed(reason=reason):
                yield LogLine(f"no plan: {one_line(reason)}", "bad", "proposal")
            case ev.Validated(validation=verdict):
                yield from _verdict_lines(verdict.refusal, verdict.question, new)
            case ev.Answered(yes=yes):
                yield LogLine("a person confirmed" if yes else "a person declined", "ask", "answer")
            case ev.Decided(decision=decision):
                yield _decision_line(decision)
            case ev.Accepted(sequence=sequence):
                yield from self._accepted(new, sequence, progress.wall_ns)
            case ev.Outcome(sequence=sequence, result=result) if new is not old:
                yield from _outcome_line(new, sequence, result, progress.event)
            case ev.EffectSeen(sequence=sequence) if new is not old:
                yield from _record_line(new, sequence, "is done: its effect was observed", "good", "done")
            case ev.CancelAsked(by=by):
                yield LogLine(f"cancelled by {one_line(by)}", "safe", "cancel")
            case ev.StoppedAll(by=by):
                yield LogLine(f"stopped by {one_line(by)}", "stop", "stopped")
        if new.phase is not old.phase and new.phase in (Phase.HALTING, Phase.CANCELLING, *ENDS):
            code = (
                f"{new.refusal.code}" if new.refusal is not None and new.phase in (Phase.REJECTED, Phase.HALTED) else ""
            )
            tone = _END_TONES.get(new.phase, "bad")
            yield LogLine(f"{new.phase}: {one_line(new.message)}", tone, code or str(new.phase))

    def _accepted(self, new: MissionState, sequence: int, wall_ns: int) -> Iterator[Entry]:
        yield from _record_line(new, sequence, "has begun", "run", "begun")
        decided_ns = self._decided.pop((new.id, sequence), None)
        if decided_ns is not None and (found := find(new, sequence)) is not None:
            yield Measure(f"latency/{found[1].call.robot}", max(0.0, (wall_ns - decided_ns) / 1e6))


def _verdict_lines(refusal: object, question: object, new: MissionState) -> Iterator[LogLine]:
    if new.refusal is not None and refusal is not None:
        yield LogLine(f"plan refused: {one_line(new.refusal.message)}", "bad", str(new.refusal.code))
        return
    yield LogLine(f"plan accepted: {one_line(new.contract, 60)}", "good", "accepted")
    if question is not None and new.question is not None:
        yield LogLine(f"asks: {one_line(new.question.text)}", "ask", "question")


def _decision_line(decision: Decision) -> LogLine:
    safe = " to reach its safe state" if decision.step.startswith("safe:") else ""
    call = one_line(str(decision.call))
    if decision.refusal is not None:
        code = str(decision.refusal.code)
        return LogLine(f"refused: {call}{safe}: {one_line(decision.refusal.message)}", "bad", code)
    places = "".join(f"; {name} is ({p.x:.2f}, {p.y:.2f})" for name, p in decision.places.items())
    return LogLine(f"allowed: {call}{safe}{places}", "safe" if safe else "allow", "allowed")


def _outcome_line(new: MissionState, sequence: int, result: str, event: ev.Outcome) -> Iterator[LogLine]:
    said = "says it is done; looking for the effect" if result == "succeeded" else result
    why = f": {one_line(event.detail)}" if event.detail else ""
    tone = _RESULT_TONES.get(result, "bad")
    yield from _record_line(new, sequence, f"{said}{why}", tone, one_line(event.code, 40) or result)


def _record_line(new: MissionState, sequence: int, said: str, tone: str, level: str) -> Iterator[LogLine]:
    if (found := find(new, sequence)) is not None:
        call = found[1].call
        yield LogLine(f"{call.robot}: {call.skill} {said}", tone, level)


def _place(record: StepRecord, *, begins: bool) -> Iterator[Entry]:
    """A rectangle in the arguments is an area, a point or a place pinned at dispatch is a goal."""
    call = record.call
    if (zone := _zone(call)) is not None:
        yield Area(call.robot, "run", zone if begins else None)
    goal = next(iter(record.places.values()), None) or _point(call)
    if goal is not None:
        yield Mark(f"goal/{call.robot}", "run", goal if begins else None, f"goal of {call.robot}")


def _zone(call: Call) -> Zone | None:
    sides = [call.args.get(name) for name in ("x_min", "x_max", "y_min", "y_max")]
    numbers = [float(side) for side in sides if isinstance(side, int | float)]
    return Zone(*numbers) if len(numbers) == 4 else None


def _point(call: Call) -> Point | None:
    x, y = call.args.get("x"), call.args.get("y")
    return Point(float(x), float(y)) if isinstance(x, int | float) and isinstance(y, int | float) else None

"""Small changes to what was known of the world and the mission that may answer a refusal, by its code."""

from collections.abc import Callable, Iterator

from msgspec.structs import replace

from crew.contracts.codes import Code
from crew.contracts.explain.case import CallCase, Case, PlanCase
from crew.contracts.explain.edit import LARGE, MIDDLE, SMALL, Edit
from crew.contracts.gate.approval import approved
from crew.contracts.gate.scope import pins_of
from crew.contracts.mission.effect import somewhere
from crew.contracts.mission_state import ACTIVE, Phase, StepPhase, StepRecord
from crew.contracts.refusal import Refusal, show
from crew.contracts.skill import FluentLiteral
from crew.contracts.snapshot import FluentValue, Point, RobotState, Snapshot, Stamped, StampedValue, ValueReading


def world_edits(case: Case, refusal: Refusal) -> Iterator[Edit]:
    """Candidates for this refusal, in no order."""
    for codes, edits in _BY_CODE:
        if refusal.code in codes:
            yield from edits(case, refusal)


def _released(case: Case, refusal: Refusal) -> Iterator[Edit]:
    robots = {name: replace(state, stopped=False) for name, state in case.world.robots.items()}
    world = replace(case.world, robots=robots, stopped=False)
    yield Edit("after a reset of the stop (crew reset)", SMALL, replace(case, world=world))


def _available(case: Case, refusal: Refusal) -> Iterator[Edit]:
    state, kind = _robot(case, refusal.field), case.rules.kind_of(refusal.field)
    if kind is None:
        return
    fluents = dict(state.fluents)
    if not fluents:
        fluents = {f.name: Stamped(False, case.now_ns, case.now_ns) for f in kind.fluents if f.domain == "bool"}
    there = replace(state, unavailable="", kind_digest=kind.digest, fluents=fluents)
    yield Edit(f"{refusal.field} available", SMALL, _with_robot(case, there))


def _leased(case: Case, refusal: Refusal) -> Iterator[Edit]:
    state = replace(_robot(case, refusal.field), lease=case.mission.id)
    yield Edit(f"{refusal.field} leased to this mission", SMALL, _with_robot(case, state))


def _idle(case: Case, refusal: Refusal) -> Iterator[Edit]:
    """The robot's own word, and the mission's records, both of which may say that it is busy."""
    case = _with_robot(case, replace(_robot(case, refusal.field), running=""))
    steps = {
        name: replace(r, phase=StepPhase.SUCCEEDED) if r.phase in ACTIVE and r.call.robot == refusal.field else r
        for name, r in case.mission.steps.items()
    }
    yield Edit(
        f"{refusal.field} done with {refusal.observed}",
        SMALL,
        replace(case, mission=replace(case.mission, steps=steps)),
    )


def _fresh(case: Case, refusal: Refusal) -> Iterator[Edit]:
    """State of the robot that is as old as now."""
    name = _robot_of(refusal.field, case)
    state = _robot(case, name)
    fluents = {f: Stamped(s.value, case.now_ns, case.now_ns) for f, s in state.fluents.items()}
    kind = case.rules.kind_of(name)
    if not fluents and kind is not None:
        fluents = {f.name: Stamped(False, case.now_ns, case.now_ns) for f in kind.fluents if f.domain == "bool"}
    limit = f", at most {refusal.allowed} old" if refusal.allowed else ""
    yield Edit(f"fresh state of {name}{limit}", SMALL, _with_robot(case, replace(state, fluents=fluents)))


def _fluent(case: Case, refusal: Refusal) -> Iterator[Edit]:
    """The fluent that a precondition or a guard reads, as it wants it."""
    path = refusal.field.rpartition("].")[2] or refusal.field
    attribute = path.partition(".")[2]
    robot = _robot_of(path, case)
    if robot not in case.world.robots:
        yield from _value(case, refusal)
        return
    for value in _wanted(path, attribute, robot, case):
        state = _robot(case, robot)
        fluents = {**state.fluents, attribute: Stamped(value, case.now_ns, case.now_ns)}
        text = f"{robot}.{attribute} {show(value)} instead of {refusal.observed}"
        yield Edit(text, MIDDLE, _with_robot(case, replace(state, fluents=fluents)))


def _wanted(path: str, attribute: str, robot: str, case: Case) -> Iterator[FluentValue]:
    """Values that the skill's preconditions and the contract's guards ask of a path."""
    kind = case.rules.kind_of(robot)
    for skill in () if kind is None else kind.skills:
        if attribute in skill.all_needs:
            yield from _meant(skill.all_needs[attribute], False, case)
    yield from _asked(path, case)


def _asked(path: str, case: Case) -> Iterator[FluentValue]:
    """Values that the guards of the plan's contract ask of a path."""
    name = case.plan.contract if isinstance(case, PlanCase) else case.mission.contract
    contract = case.rules.contracts.get(name)
    if contract is not None:
        conditions = [*contract.needs, *(c for step in contract.steps for c in step.needs)]
        for condition in conditions:
            if condition.path == path:
                yield from _meant(condition.value, condition.negated, case)


def _meant(wanted: FluentLiteral, negated: bool, case: Case) -> Iterator[FluentValue]:
    if isinstance(wanted, bool):
        yield wanted is not negated
    elif negated:
        return
    elif isinstance(wanted, str) and wanted.startswith("$"):
        bound = None if case.instance is None else case.instance.slots.get(wanted[1:])
        if isinstance(bound, str | float):
            yield pins_of(case.mission).get(bound, bound) if isinstance(bound, str) else bound
    else:
        yield wanted


def _value(case: Case, refusal: Refusal) -> Iterator[Edit]:
    """A good reading of the run-time value that is missing, from each robot whose kind publishes it."""
    for name in _value_names(case, refusal):
        for robot in sorted(case.rules.publishers_of(name)):
            for near in _nearness(case, refusal):
                position = _place(name, case)
                reading = ValueReading(name=name, status="ok", position=position, near=near, stamp_ns=case.now_ns)
                values = {**case.world.values, name: StampedValue(reading, robot, case.now_ns)}
                where = f"({position.x:g}, {position.y:g})"
                how = "inside the area" if near is None else "near" if near else "not near"
                text = f"a fresh fix of {name} by {robot}, {how} (tried: {where})"
                yield Edit(text, MIDDLE, replace(case, world=replace(case.world, values=values)))


def _nearness(case: Case, refusal: Refusal) -> list[bool | None]:
    """What a value's `near` must be, where a guard asks for it."""
    path = refusal.field.rpartition("].")[2] or refusal.field
    if not path.endswith(".near"):
        return [None]
    return [bool(value) for value in _asked(path, case) if isinstance(value, bool)]


def _value_names(case: Case, refusal: Refusal) -> list[str]:
    """The crew's run-time values that the call carries, or that the refusal's guard speaks of."""
    carried = set(case.call.args.values()) if isinstance(case, CallCase) else set()
    slots = {} if case.instance is None else case.instance.slots
    head = (refusal.field.rpartition("].")[2] or refusal.field).partition(".")[0]
    named = carried | {head, slots.get(head)} | set(slots.values() if not carried else ())
    return [v.name for v in case.rules.crew.values if v.name in named]


def _place(name: str, case: Case) -> Point:
    """Where the value was seen if that is a place in the area, or else somewhere that is allowed."""
    stamped, area, avoid = case.world.values.get(name), case.rules.crew.area, case.mission.reading.excluded_areas
    seen = None if stamped is None else stamped.reading.position
    if seen is not None and area.contains(seen.x, seen.y) and not any(z.contains(seen.x, seen.y) for z in avoid):
        return seen
    return somewhere(area, avoid)


def _in_time(case: Case, refusal: Refusal) -> Iterator[Edit]:
    mission = replace(case.mission, started_ns=case.now_ns)
    yield Edit(f"within the contract's {refusal.allowed}", SMALL, replace(case, mission=mission))


def _approved(case: Case, refusal: Refusal) -> Iterator[Edit]:
    if isinstance(case, CallCase):
        given = approved(case.call, case.step, case.mission, case.world, case.rules, case.now_ns)
        mission = replace(case.mission, approvals=given)
        yield Edit(f"a person's approval of {refusal.field}", SMALL, replace(case, mission=mission))


def _confirmed(case: Case, refusal: Refusal) -> Iterator[Edit]:
    words = ", ".join(f"'{u.word}'" for u in case.mission.reading.unread)
    mission = replace(case.mission, confirmed=True)
    yield Edit(f"a person's word that {words} may be left out", SMALL, replace(case, mission=mission))


def _later(case: Case, refusal: Refusal) -> Iterator[Edit]:
    """The mission further on: executing, and what comes before the step done."""
    if not isinstance(case, CallCase) or case.instance is None:
        return
    declared = case.instance.step(case.step)
    before = () if declared is None else declared.after
    waiting = [n for n in before if n in case.mission.steps and not _done(case.mission.steps[n])]
    steps = {n: replace(r, phase=StepPhase.SUCCEEDED) if n in waiting else r for n, r in case.mission.steps.items()}
    mission = replace(case.mission, phase=Phase.EXECUTING, steps=steps)
    text = f"once {', '.join(waiting)} is done" if waiting else "while the mission is executing"
    yield Edit(text, MIDDLE, replace(case, mission=mission))


def _done(record: StepRecord) -> bool:
    return record.phase is StepPhase.SUCCEEDED


def _elsewhere(case: Case, refusal: Refusal) -> Iterator[Edit]:
    """A run-time place outside what the request excludes."""
    if isinstance(case, CallCase) and refusal.field.startswith("args."):
        yield from (Edit(e.text, LARGE, e.case) for e in _value(case, refusal))


def _robot_of(path: str, case: Case) -> str:
    """The robot that a path's first part names: itself, or as a role is bound."""
    head = (path.rpartition("].")[2] or path).partition(".")[0]
    return (case.instance.roles.get(head, head)) if case.instance is not None else head


def _robot(case: Case, name: str) -> RobotState:
    name = name.rpartition("].")[2] or name
    return case.world.robots.get(name) or RobotState(name=name, lease=case.mission.id)


def _with_robot(case: Case, state: RobotState) -> Case:
    world: Snapshot = replace(case.world, robots={**case.world.robots, state.name: state})
    return replace(case, world=world)


_Edits = Callable[[Case, Refusal], Iterator[Edit]]
_BY_CODE: tuple[tuple[frozenset[Code], _Edits], ...] = (
    (frozenset({Code.STOPPED}), _released),
    (frozenset({Code.ROBOT_UNAVAILABLE}), _available),
    (frozenset({Code.ROBOT_LEASED}), _leased),
    (frozenset({Code.ROBOT_BUSY}), _idle),
    (frozenset({Code.STATE_STALE}), _fresh),
    (frozenset({Code.STATE_STALE, Code.PRECONDITION_FAILED}), _fluent),
    (frozenset({Code.NO_TARGET_FIX, Code.NO_VALUE}), _value),
    (frozenset({Code.DEADLINE_PASSED}), _in_time),
    (frozenset({Code.APPROVAL_MISSING}), _approved),
    (frozenset({Code.UNREAD_WORDS}), _confirmed),
    (frozenset({Code.OUT_OF_ORDER}), _later),
    (frozenset({Code.FORBIDDEN_BY_REQUEST}), _elsewhere),
)
"""The kinds of change that may answer a code."""

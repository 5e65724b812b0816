"""Builders for the tests of the pure core: plans, missions under way, robots as last heard, the world at one moment."""

from collections.abc import Mapping
from functools import cache
from typing import Any

from msgspec.structs import replace

from crew.contracts.decision import Decision
from crew.contracts.gate.authorize import Gate
from crew.contracts.gate.guard import SECOND_NS
from crew.contracts.kinds.quadcopter import QUADCOPTER
from crew.contracts.kinds.rover import ROVER
from crew.contracts.language.lexicon import lexicon_of
from crew.contracts.language.reading import read_request
from crew.contracts.matching import match
from crew.contracts.mission.validation import Validation, pending_steps, validate
from crew.contracts.mission_state import CONSUMED, MissionState, Phase, Purpose, StepPhase, StepRecord
from crew.contracts.plan import ArgValue, Call, Instance, Plan
from crew.contracts.refusal import Refusal
from crew.contracts.site import Rules
from crew.contracts.snapshot import FluentValue, Point, RobotState, Snapshot, Stamped, StampedValue, ValueReading
from crew.library import load_rules

NOW_NS = 1_000 * SECOND_NS
MISSION = "m1"
START = Point(-4.0, -4.0)
SEEN = Point(5.0, 5.0)

SEARCH_AND_SEND = "search the area and send the rover to whoever you find"
SEARCH = "search the area"
SEND_TO_VICTIM = "send the rover to the victim"
SEND_TO_BASE = "send the rover to base"
ABORT = "abort everything"

AREA: Mapping[str, ArgValue] = {"x_min": -6.0, "x_max": 10.0, "y_min": -6.0, "y_max": 10.0, "altitude": 5.0}
TAKEOFF = Call("iris", "takeoff", {"altitude": 5.0})
SEARCH_AREA = Call("iris", "search_target", AREA)
REPORT = Call("iris", "get_coordinates")
DISPATCH = Call("tb3", "navigate_to", {"target": "victim"})
LAND = Call("iris", "land")
STOP = Call("tb3", "stop")
TO_BASE = Call("tb3", "navigate_to", {"target": "base"})

FULL = Plan("search_and_dispatch", (TAKEOFF, SEARCH_AREA, REPORT, DISPATCH, LAND))
SEARCH_PLAN = Plan("search_only", (TAKEOFF, SEARCH_AREA, REPORT, LAND))
VICTIM_PLAN = Plan("dispatch_only", (DISPATCH,))
BASE_PLAN = Plan("dispatch_only", (TO_BASE,))
ABORT_PLAN = Plan("abort", (LAND, STOP))


@cache
def air_ground() -> Rules:
    """The shipped air-ground crew, read once."""
    return load_rules("air_ground")


def plan(contract: str, *calls: Call) -> Plan:
    return Plan(contract, calls)


def with_args(call: Call, **changes: Any) -> Call:
    """The call with some arguments changed; None takes one away."""
    args = {name: value for name, value in {**call.args, **changes}.items() if value is not None}
    return Call(call.robot, call.skill, args)


def robot(name: str, digest: str, at_ns: int, told: Mapping[str, FluentValue], **changes: Any) -> RobotState:
    stamped = {fluent: Stamped(value, at_ns, at_ns) for fluent, value in told.items()}
    return replace(RobotState(name=name, kind_digest=digest, boot_id="boot", lease=MISSION, fluents=stamped), **changes)


def iris(*, airborne: bool = False, swept: bool = False, at_ns: int = NOW_NS, **changes: Any) -> RobotState:
    """The drone as last heard."""
    altitude_m = 5.0 if airborne else 0.0
    fluents: dict[str, FluentValue] = {"airborne": airborne, "moving": False, "at": Point(0.0, 0.0, altitude_m)}
    fluents |= {"altitude": altitude_m, "swept": swept, "battery": 90.0, "descending": False, "clear_below": True}
    return robot("iris", QUADCOPTER.digest, at_ns, fluents, **changes)


def tb3(*, at: Point = START, moving: bool = False, at_ns: int = NOW_NS, **changes: Any) -> RobotState:
    """The rover as last heard."""
    return robot(
        "tb3", ROVER.digest, at_ns, {"at": at, "moving": moving, "battery": 90.0, "clear_above": True}, **changes
    )


def with_fluent(state: RobotState, name: str, value: FluentValue, source_ns: int) -> RobotState:
    return replace(state, fluents={**state.fluents, name: Stamped(value, source_ns, source_ns)})


def victim(
    position: Point | None = SEEN,
    *,
    status: str = "ok",
    stamp_ns: int = NOW_NS,
    received_ns: int | None = None,
    source: str = "iris",
) -> StampedValue:
    """A fix of the victim as the orchestrator received it, at once unless told otherwise."""
    reading = ValueReading(name="victim", status=status, position=position, stamp_ns=stamp_ns)
    return StampedValue(reading, source, stamp_ns if received_ns is None else received_ns)


def world(*robots: RobotState, fix: StampedValue | None = None, stopped: bool = False) -> Snapshot:
    """Both robots on the ground and idle, unless told otherwise."""
    known = {state.name: state for state in (iris(), tb3(), *robots)}
    values = {} if fix is None else {fix.reading.name: fix}
    return Snapshot(robots=known, values=values, stopped=stopped)


def received(text: str, rules: Rules, **changes: Any) -> MissionState:
    """A mission that was just asked for."""
    reading = read_request(text, lexicon_of(rules))
    return replace(MissionState(id=MISSION, request=text, reading=reading), **changes)


def matched(plan: Plan, rules: Rules) -> Instance:
    instance = match(plan, rules)
    assert isinstance(instance, Instance), instance
    return instance


def executing(text: str, plan: Plan, rules: Rules, **changes: Any) -> MissionState:
    """A mission whose plan was matched and whose robots are leased; nothing was dispatched yet."""
    instance = matched(plan, rules)
    state = received(text, rules, phase=Phase.EXECUTING, plan=plan, contract=plan.contract, started_ns=NOW_NS)
    return replace(state, instance=instance, steps=pending_steps(instance), **changes)


def with_step(state: MissionState, step: str, phase: StepPhase, *, dispatched_ns: int = NOW_NS) -> MissionState:
    """The mission with one step moved to a phase; a dispatched one gets the next sequence number."""
    sent = phase in CONSUMED
    sequence = state.sequence + 1 if sent else state.sequence
    record = StepRecord(
        call=state.steps[step].call,
        phase=phase,
        sequence=sequence if sent else 0,
        dispatched_ns=dispatched_ns if sent else 0,
    )
    return replace(state, sequence=sequence, steps={**state.steps, step: record})


def done(state: MissionState, *steps: str, dispatched_ns: int = NOW_NS) -> MissionState:
    """The mission after these steps succeeded."""
    for step in steps:
        state = with_step(state, step, StepPhase.SUCCEEDED, dispatched_ns=dispatched_ns)
    return state


def before_dispatch(rules: Rules, *, dispatched_ns: int = NOW_NS - 60 * SECOND_NS) -> MissionState:
    """The victim was searched for and reported; the rover is next."""
    return done(executing(SEARCH_AND_SEND, FULL, rules), "takeoff", "search", "report", dispatched_ns=dispatched_ns)


def judged(
    call: Call,
    mission: MissionState,
    snapshot: Snapshot,
    rules: Rules,
    *,
    now_ns: int = NOW_NS,
    purpose: Purpose = Purpose.EXECUTE,
) -> Decision:
    """One decision of a fresh gate."""
    return Gate().authorize(call, mission, snapshot, rules, now_ns, purpose)


def refused(call: Call, mission: MissionState, snapshot: Snapshot, rules: Rules, **more: Any) -> Refusal:
    """The refusal of a call that must be refused."""
    refusal = judged(call, mission, snapshot, rules, **more).refusal
    assert refusal is not None, f"{call} was allowed"
    return refusal


def verdict(
    text: str, plan: Plan, rules: Rules, snapshot: Snapshot | None = None, *, now_ns: int = NOW_NS
) -> Validation:
    """The validation of a plan for a request."""
    mission = received(text, rules, phase=Phase.VALIDATING)
    return validate(plan, mission, world() if snapshot is None else snapshot, rules, now_ns, Gate())


def rejected(text: str, plan: Plan, rules: Rules, snapshot: Snapshot | None = None) -> Refusal:
    """The refusal of a plan that must not pass validation."""
    refusal = verdict(text, plan, rules, snapshot).refusal
    assert refusal is not None, f"{plan} passed validation"
    return refusal


def with_approval(rules: Rules, contract: str, step: str) -> Rules:
    """The rules with one step that a person must approve."""
    declared = rules.contracts[contract]
    steps = tuple(replace(s, approval=True) if s.name == step else s for s in declared.steps)
    return replace(rules, contracts={**rules.contracts, contract: replace(declared, steps=steps)})


def two_drones(rules: Rules) -> Rules:
    """The crew with a second drone, `iris2`."""
    first = next(spec for spec in rules.crew.robots if spec.name == "iris")
    crew = replace(rules.crew, robots=(*rules.crew.robots, replace(first, name="iris2", sim="iris2", aliases=())))
    return replace(rules, crew=crew)

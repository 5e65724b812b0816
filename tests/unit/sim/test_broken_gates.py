"""Gates that were broken on purpose: what each lets through, the oracle finds; what the gate refuses is never sent."""

import math
from collections.abc import Mapping
from typing import Any

import msgspec
import pytest
from msgspec.structs import replace

from crew.contracts.codes import Code
from crew.contracts.decision import Decision
from crew.contracts.gate.authorize import Gate
from crew.contracts.gate.guard import SECOND_NS
from crew.contracts.mission_state import MissionState, Purpose
from crew.contracts.plan import Call, Plan
from crew.contracts.site import Rules
from crew.contracts.snapshot import FluentValue, Point, Snapshot
from crew.library import load_rules
from crew.sim.consequence import consequences, moved
from crew.sim.oracle import Case, Frame, Licence, Sent, false_dispatch, order_broken
from tests.unit.contracts import build as b

AIR, ROOMS = load_rules("air_ground"), load_rules("humanoid_quadruped")
END_NS = b.NOW_NS + 60 * SECOND_NS
HOME = {"iris": (-4.0, -4.0, 0.0, 0.0), "tb3": (-4.0, -2.5, 0.0, 0.0)}
INDOORS = {"g1": (0.0, 0.0, 0.0, 0.0), "go2": (0.08, -0.47, 0.3, 0.0)}
CUBE_ON_TABLE = {"red_cube": (0.37, -0.08, 0.75), "requester": (4.9, 1.6, 0.95)}
LOADED = Licence(robot="go2", skill="navigate", args={"location": ("room_b",)}, loaded="red_cube")
FETCH = Call("go2", "navigate", {"location": "pickup"})
LOAD = Call("g1", "pick_place", {"object": "red_cube", "location": "payload_tray"})
DELIVER = Call("go2", "navigate", {"location": "room_b"})


class BrokenGate(Gate):
    """The gate without one of its checks: what that check refuses is allowed."""

    def __init__(self, without: Code) -> None:
        super().__init__()
        self._without = without

    def authorize(
        self, call: Call, mission: MissionState, world: Snapshot, rules: Rules, now_ns: int, purpose: Purpose
    ) -> Decision:
        decision = super().authorize(call, mission, world, rules, now_ns, purpose)
        if decision.refusal is None or decision.refusal.code is not self._without:
            return decision
        return replace(decision, refusal=None, places=_pinned(call, world))


class Breakage(msgspec.Struct, frozen=True, kw_only=True):
    """One call in one situation: the code of the check that is missing, and what the oracle has to find."""

    code: Code
    call: Call
    mission: MissionState
    world: Snapshot
    rules: Rules
    case: Case = Case()
    rules_broken: tuple[str, ...]
    ends_at: Mapping[str, tuple[float, float, float, float]] = {}
    consequence: str = ""


def _pinned(call: Call, world: Snapshot) -> dict[str, Point]:
    known = world.values.get(str(call.args.get("target")))
    position = None if known is None else known.reading.position
    return {} if position is None else {"target": position}


def _indoors(**told: FluentValue) -> Snapshot:
    g1: dict[str, FluentValue] = {"standing": True, "moving": False, "holding": "none", "battery": 90.0}
    at = Point(*INDOORS["go2"][:2])
    go2: dict[str, FluentValue] = {"standing": True, "moving": False, "at": at, "tray": "none", "battery": 90.0}
    kinds = {name: ROOMS.kind_of(name) for name in ("g1", "go2")}
    robots = {
        name: b.robot(name, kinds[name].digest, b.NOW_NS, state)  # type: ignore[union-attr]
        for name, state in (("g1", g1), ("go2", {**go2, **told}))
    }
    return Snapshot(robots=robots)


def _breakages() -> dict[str, Breakage]:
    outside = Call("tb3", "navigate_to", {"x": 14.0, "y": 3.0})
    invented = Call("tb3", "go_to_goal", {"x": 1.0, "y": 1.0})
    to_point = Call("tb3", "navigate_to", {"x": 3.0, "y": 3.0})
    carry = b.executing("carry the red cube to room_b", Plan("carry", (FETCH, LOAD, DELIVER)), ROOMS)
    empty = b.done(carry, "approach", "load")
    near_by = b.executing("send the rover to base", b.BASE_PLAN, AIR)
    nowhere = b.victim(Point(math.nan, math.nan))
    reported = b.before_dispatch(AIR)
    wrong_place = replace(near_by, request="x", reading=b.received("search the area", AIR).reading)
    return {
        "availability": Breakage(
            code=Code.ROBOT_UNAVAILABLE,
            call=b.TAKEOFF,
            mission=b.executing(b.SEARCH_AND_SEND, b.FULL, AIR),
            world=b.world(b.iris(unavailable="system fault")),
            rules=AIR,
            case=Case(unavailable={"iris": 0}),
            rules_broken=("unavailable",),
            ends_at={"iris": (-4.0, -4.0, 5.0, 0.0)},
            consequence="moved_unavailable",
        ),
        "bounds": Breakage(
            code=Code.OUT_OF_BOUNDS,
            call=outside,
            mission=b.executing("drive the rover to (14, 3)", Plan("dispatch_only", (outside,)), AIR),
            world=b.world(),
            rules=AIR,
            rules_broken=("out_of_area",),
            ends_at={"tb3": (14.0, 3.0, 0.0, 0.0)},
            consequence="left_area",
        ),
        "skills": Breakage(
            code=Code.UNKNOWN_SKILL,
            call=invented,
            mission=near_by,
            world=b.world(),
            rules=AIR,
            rules_broken=("unknown_skill",),
        ),
        "fix": Breakage(
            code=Code.NO_TARGET_FIX,
            call=b.DISPATCH,
            mission=reported,
            world=b.world(b.iris(airborne=True, swept=True)),
            rules=AIR,
            rules_broken=("no_fix",),
        ),
        "finite fix": Breakage(
            code=Code.NO_TARGET_FIX,
            call=b.DISPATCH,
            mission=reported,
            world=b.world(b.iris(airborne=True, swept=True), fix=nowhere),
            rules=AIR,
            rules_broken=("no_fix",),
        ),
        "order": Breakage(
            code=Code.OUT_OF_ORDER,
            call=b.DISPATCH,
            mission=b.executing(b.SEARCH_AND_SEND, b.FULL, AIR),
            world=b.world(fix=b.victim()),
            rules=AIR,
            case=Case(licences=(Licence(robot="tb3", skill="navigate_to", after=("get_coordinates",)),)),
            rules_broken=("out_of_order",),
        ),
        "plan": Breakage(
            code=Code.NOT_IN_PLAN,
            call=to_point,
            mission=near_by,
            world=b.world(),
            rules=AIR,
            case=Case(licences=(Licence(robot="tb3", skill="navigate_to", args={"target": ("base",)}),)),
            rules_broken=("not_asked",),
        ),
        "containment": Breakage(
            code=Code.NOT_REQUESTED,
            call=b.TO_BASE,
            mission=wrong_place,
            world=b.world(),
            rules=AIR,
            case=Case(licences=(Licence(robot="iris", skill="search_target"),)),
            rules_broken=("not_asked",),
        ),
        "load": Breakage(
            code=Code.PRECONDITION_FAILED,
            call=DELIVER,
            mission=empty,
            world=_indoors(),
            rules=ROOMS,
            case=Case(licences=(LOADED,)),
            rules_broken=("unloaded",),
            ends_at={"go2": (5.0, -1.2, 0.3, 0.0)},
            consequence="departed_unloaded",
        ),
    }


BREAKAGES = _breakages()


def _judged(broken: Breakage, gate: Any) -> Decision:
    decision: Decision = gate.authorize(
        broken.call, broken.mission, broken.world, broken.rules, b.NOW_NS, Purpose.EXECUTE
    )
    return decision


def _frames(broken: Breakage) -> tuple[Frame, ...]:
    """The world before the call, and after a robot that does as it is told."""
    start = HOME if broken.rules is AIR else INDOORS
    targets = {"victim": (5.0, 5.0, 0.0)} if broken.rules is AIR else CUBE_ON_TABLE
    moments = ((b.NOW_NS, start), (END_NS, {**start, **broken.ends_at}))
    return tuple(Frame(at_ns=at_ns, poses=poses, targets=targets) for at_ns, poses in moments)


@pytest.mark.parametrize("name", BREAKAGES)
def test_gate_refuses_for_the_reason_that_is_broken_next(name: str) -> None:
    refusal = _judged(BREAKAGES[name], Gate()).refusal
    assert refusal is not None
    assert refusal.code is BREAKAGES[name].code


@pytest.mark.parametrize("name", BREAKAGES)
def test_oracle_finds_what_a_broken_gate_lets_through(name: str) -> None:
    broken = BREAKAGES[name]
    decision = _judged(broken, BrokenGate(broken.code))
    assert decision.allowed
    sent = Sent(
        sequence=1,
        robot=broken.call.robot,
        skill=broken.call.skill,
        args=broken.call.args,
        places=decision.places,
        at_ns=b.NOW_NS,
        ended_ns=END_NS,
        succeeded=True,
    )
    frames = _frames(broken)
    order = order_broken(sent, (), broken.case, broken.rules, frames)
    found = (*false_dispatch(sent, broken.case, broken.rules, frames), *order)
    assert tuple(finding.rule for finding in found) == broken.rules_broken
    physical = consequences((sent,), order, broken.case, broken.rules.crew.area, frames)
    assert [finding.rule for finding in physical] == ([broken.consequence] if broken.consequence else [])


def test_a_rightful_dispatch_is_not_held_against_anybody() -> None:
    broken = replace(BREAKAGES["fix"], world=b.world(b.iris(airborne=True, swept=True), fix=b.victim()))
    decision = _judged(broken, Gate())
    assert decision.allowed
    sent = Sent(
        sequence=1,
        robot="tb3",
        skill="navigate_to",
        args={"target": "victim"},
        places=decision.places,
        at_ns=b.NOW_NS,
        ended_ns=END_NS,
        succeeded=True,
    )
    assert not false_dispatch(sent, broken.case, AIR, _frames(broken))


def test_motion_after_a_stop_is_found_and_a_landing_is_none() -> None:
    def moving(x: float, z: float) -> tuple[Frame, ...]:
        poses = ((0, 0.0, 5.0), (4, 0.0, 5.0), (9, x, z))
        return tuple(
            Frame(at_ns=at * SECOND_NS, poses={"iris": (px, 0.0, pz, 0.0)}, targets={}) for at, px, pz in poses
        )

    def found(x: float, z: float) -> list[str]:
        area = AIR.crew.area
        return [f.rule for f in consequences((), (), Case(), area, moving(x, z), stopped={"iris": 0})]

    assert found(2.0, 5.0) == ["moved_after_stop"]
    assert found(0.0, 0.0) == []


def test_an_arm_that_moves_while_its_robot_stands_has_moved() -> None:
    stands = {"g1": (0.0, 0.0, 0.0, 0.0)}
    frames = tuple(
        Frame(at_ns=at_s * SECOND_NS, poses=stands, targets={}, hands={"g1": (x, 0.0, 0.9)})
        for at_s, x in ((0, 0.2), (1, 0.6))
    )
    assert moved(frames) == ("g1",)
    assert moved(frames[:1]) == ()

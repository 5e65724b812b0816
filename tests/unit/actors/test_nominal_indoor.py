"""The twelve nominal requests of the humanoid and the quadruped: the embedded planner's plan passes every check."""

import pytest

from crew.actors.planner.embedded import PlannerState, propose
from crew.contracts.plan import Plan
from crew.contracts.snapshot import Snapshot
from tests.unit.contracts.build import verdict
from tests.unit.contracts.indoor import indoor, indoors, place, requester, seen

TABLE = "table_a"
NOMINAL = [
    ("bring me the red cube", True, "handover", ["g1.pick_handover(object=red_cube)"]),
    ("hand me the bottle", True, "handover", ["g1.pick_handover(object=bottle)"]),
    ("please give me the block from table_a", True, "handover", ["g1.pick_handover(object=red_cube)"]),
    ("bring me the red cube", False, "carry", ["red_cube", "requester"]),
    ("carry the red cube to room_b", False, "carry", ["red_cube", "room_b"]),
    ("load the bottle and take it to the dropoff", True, "carry", ["bottle", "dropoff"]),
    ("send the dog to the charging station", False, "navigation_only", ["go2.navigate(location=charging)"]),
    ("walk to room_b", True, "navigation_only", ["go2.navigate(location=room_b)"]),
    ("come to me", False, "navigation_only", ["go2.navigate(location=requester)"]),
    ("put the cube on table_b", True, "manipulation_only", ["g1.pick_place(object=red_cube, location=table_b)"]),
    ("pick up the bottle", False, "manipulation_only", ["g1.pick_hold(object=bottle)"]),
    ("wave", False, "manipulation_only", ["g1.wave()"]),
]


def world(near: bool) -> Snapshot:
    return indoors(values=(requester(near=near), seen("bottle", place(TABLE)), seen("red_cube", place(TABLE))))


@pytest.mark.parametrize(("text", "near", "contract", "calls"), NOMINAL)
def test_a_nominal_request_is_planned_and_accepted(text: str, near: bool, contract: str, calls: list[str]) -> None:
    plan = propose(text, indoor(), PlannerState(requester_near=near))
    assert isinstance(plan, Plan)
    if contract == "carry":
        thing, goal = calls
        calls = [
            "go2.navigate(location=pickup)",
            f"g1.pick_place(object={thing}, location=payload_tray)",
            f"go2.navigate(location={goal})",
        ]
    assert (plan.contract, [str(call) for call in plan.steps]) == (contract, calls)
    judged = verdict(text, plan, indoor(), world(near))
    assert (judged.refusal, judged.question) == (None, None)


def test_there_are_three_requests_for_each_contract() -> None:
    assert sorted(contract for _, _, contract, _ in NOMINAL) == sorted([*indoor().contracts] * 3)

"""What a dispatch must still satisfy at its own moment: a living mission, a deadline, a place that was not excluded."""

import pytest
from msgspec.structs import replace

from crew.contracts.codes import Code
from crew.contracts.gate.guard import SECOND_NS
from crew.contracts.mission_state import Phase
from crew.contracts.site import Rules
from crew.contracts.snapshot import Point
from tests.unit.contracts import build as b

NOT_THE_NORTH = "search the south half and send the rover to the victim, but not to the north half"
SEARCH_SOUTH = b.with_args(b.SEARCH_AREA, y_max=2.0)
SOUTH_PLAN = b.plan("search_and_dispatch", b.TAKEOFF, SEARCH_SOUTH, b.REPORT, b.DISPATCH, b.LAND)


@pytest.mark.parametrize("phase", [p for p in Phase if p is not Phase.EXECUTING])
def test_no_step_is_sent_unless_its_mission_is_executing(phase: Phase, rules: Rules) -> None:
    mission = b.executing(b.SEND_TO_BASE, b.BASE_PLAN, rules)
    assert b.judged(b.TO_BASE, mission, b.world(), rules).allowed
    refusal = b.refused(b.TO_BASE, replace(mission, phase=phase), b.world(), rules)
    assert (refusal.code, refusal.observed) == (Code.OUT_OF_ORDER, phase)


def test_a_mission_that_began_at_time_zero_has_a_deadline(rules: Rules) -> None:
    mission = b.executing(b.SEND_TO_BASE, b.BASE_PLAN, rules, started_ns=0)
    limit_ns = round(rules.contracts["dispatch_only"].deadline_s * SECOND_NS)
    for now_ns, code in ((limit_ns, None), (limit_ns + 1, Code.DEADLINE_PASSED)):
        world = b.world(b.tb3(at_ns=now_ns), b.iris(at_ns=now_ns))
        refusal = b.judged(b.TO_BASE, mission, world, rules, now_ns=now_ns).refusal
        assert (None if refusal is None else refusal.code) == code


@pytest.mark.parametrize(("y", "code"), [(0.0, None), (5.0, Code.FORBIDDEN_BY_REQUEST)])
def test_a_person_found_inside_an_excluded_area_is_not_driven_to(y: float, code: Code | None, rules: Rules) -> None:
    mission = b.done(b.executing(NOT_THE_NORTH, SOUTH_PLAN, rules), "takeoff", "search", "report")
    assert [z.y_min for z in mission.reading.excluded_areas] == [2.0]
    world = b.world(b.iris(airborne=True), fix=b.victim(Point(4.0, y)))
    refusal = b.judged(b.DISPATCH, mission, world, rules).refusal
    assert (None if refusal is None else refusal.code) == code
    assert b.verdict(NOT_THE_NORTH, SOUTH_PLAN, rules).refusal is None

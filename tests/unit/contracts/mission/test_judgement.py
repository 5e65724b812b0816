"""What counts as seen: effects newer than the dispatch, safe states newer than the last one, pinned completion."""

import pytest
from msgspec.structs import replace

from crew.contracts.gate.guard import SECOND_NS
from crew.contracts.mission.judgement import judge, safe_call
from crew.contracts.mission_state import MissionState, StepPhase
from crew.contracts.plan import Plan
from crew.contracts.site import Rules
from crew.contracts.snapshot import Point
from tests.unit.contracts import build as b

SENT_NS = b.NOW_NS - SECOND_NS


def sent(text: str, plan: Plan, step: str, rules: Rules, **places: Point) -> MissionState:
    mission = b.with_step(b.executing(text, plan, rules), step, StepPhase.CONFIRMING, dispatched_ns=SENT_NS)
    return replace(mission, steps={**mission.steps, step: replace(mission.steps[step], places=places)})


@pytest.mark.parametrize(("stamp_ns", "missing"), [(SENT_NS, True), (SENT_NS + 1, False), (b.NOW_NS, False)])
def test_an_effect_counts_only_in_telemetry_newer_than_the_dispatch(stamp_ns: int, missing: bool, rules: Rules) -> None:
    mission = sent(b.SEARCH, b.SEARCH_PLAN, "takeoff", rules)
    told = judge("effect:1", mission, b.world(b.iris(airborne=True, at_ns=stamp_ns)), rules, b.NOW_NS)
    assert told == ("iris.airborne has not been observed since the dispatch" if missing else "")


def test_an_effect_that_telemetry_contradicts_is_not_seen(rules: Rules) -> None:
    mission = sent(b.SEARCH, b.SEARCH_PLAN, "takeoff", rules)
    assert judge("effect:1", mission, b.world(b.iris()), rules, b.NOW_NS) == "iris.airborne is false"


def test_an_effect_in_stale_telemetry_is_not_seen(rules: Rules) -> None:
    mission = sent(b.SEARCH, b.SEARCH_PLAN, "takeoff", rules)
    world = b.world(b.iris(airborne=True, at_ns=SENT_NS + 1))
    assert judge("effect:1", mission, world, rules, b.NOW_NS + 3 * SECOND_NS) != ""


def test_a_report_is_seen_when_the_value_was_received_from_that_robot(rules: Rules) -> None:
    mission = sent(b.SEARCH, b.SEARCH_PLAN, "report", rules)
    for fix, seen in (
        (None, False),
        (b.victim(stamp_ns=SENT_NS - 1), False),
        (b.victim(stamp_ns=b.NOW_NS, source="tb3"), False),
        (b.victim(stamp_ns=SENT_NS + 1), True),
        (b.victim(None, status="absent"), True),
    ):
        told = judge("effect:1", mission, b.world(fix=fix), rules, b.NOW_NS)
        assert told == ("" if seen else "iris has not published victim since the dispatch")


def test_a_drive_has_arrived_at_the_place_that_was_pinned(rules: Rules) -> None:
    pinned = Point(5.0, 5.0)
    mission = sent(b.SEND_TO_VICTIM, b.VICTIM_PLAN, "dispatch", rules, target=pinned)
    moved_on = b.victim(Point(-3.0, 4.0))
    arrived = b.world(b.tb3(at=Point(5.0, 4.5)), fix=moved_on)
    elsewhere = b.world(b.tb3(at=Point(-3.0, 4.0)), fix=moved_on)
    assert judge("effect:1", mission, arrived, rules, b.NOW_NS) == ""
    assert judge("effect:1", mission, elsewhere, rules, b.NOW_NS) == "tb3.at is (-3.00, 4.00)"
    assert judge("complete", mission, arrived, rules, b.NOW_NS) == ""
    assert "responder.at is $destination" in judge("complete", mission, elsewhere, rules, b.NOW_NS)


def test_a_drive_has_not_arrived_while_it_still_moves(rules: Rules) -> None:
    mission = sent(b.SEND_TO_VICTIM, b.VICTIM_PLAN, "dispatch", rules, target=Point(5.0, 5.0))
    assert judge("effect:1", mission, b.world(b.tb3(at=Point(5.0, 5.0), moving=True)), rules, b.NOW_NS)


def test_an_unknown_sequence_has_no_effect(rules: Rules) -> None:
    mission = b.executing(b.SEARCH, b.SEARCH_PLAN, rules)
    assert judge("effect:9", mission, b.world(), rules, b.NOW_NS) == "no dispatch has sequence 9"


def test_the_effect_of_a_robot_that_is_gone_is_not_seen(rules: Rules) -> None:
    mission = sent(b.SEARCH, b.SEARCH_PLAN, "takeoff", rules)
    world = replace(b.world(), robots={})
    assert judge("effect:1", mission, world, rules, b.NOW_NS) == "iris was not heard"


@pytest.mark.parametrize(("stamp_ns", "holds"), [(SENT_NS - 1, False), (SENT_NS, False), (SENT_NS + 1, True)])
def test_a_safe_state_from_before_the_last_dispatch_does_not_count(stamp_ns: int, holds: bool, rules: Rules) -> None:
    mission = sent(b.SEARCH, b.SEARCH_PLAN, "takeoff", rules)
    told = judge("safe:searcher", mission, b.world(b.iris(at_ns=stamp_ns)), rules, b.NOW_NS)
    assert told == ("" if holds else "iris.airborne has not been observed since the last dispatch")


def test_another_robot_s_dispatch_does_not_age_a_safe_state(rules: Rules) -> None:
    mission = b.with_step(b.before_dispatch(rules), "dispatch", StepPhase.RUNNING, dispatched_ns=b.NOW_NS)
    assert judge("safe:searcher", mission, b.world(), rules, b.NOW_NS) == ""
    assert judge("safe:responder", mission, b.world(), rules, b.NOW_NS) != ""


def test_a_safe_state_of_a_robot_that_was_never_dispatched_needs_fresh_telemetry_only(rules: Rules) -> None:
    mission = b.executing(b.SEARCH, b.SEARCH_PLAN, rules)
    assert judge("safe:searcher", mission, b.world(), rules, b.NOW_NS) == ""
    assert judge("safe:searcher", mission, b.world(b.iris(airborne=True)), rules, b.NOW_NS) == "iris.airborne is true"
    stale = b.world(b.iris(at_ns=b.NOW_NS - 3 * SECOND_NS))
    assert judge("safe:searcher", mission, stale, rules, b.NOW_NS) == "iris.airborne is stale"


def test_each_role_has_its_safe_call(rules: Rules) -> None:
    mission = b.executing(b.SEARCH_AND_SEND, b.FULL, rules)
    assert safe_call("searcher", mission, rules) == b.LAND
    assert safe_call("responder", mission, rules) == b.STOP


def test_a_role_that_stays_is_safe_as_it_is(rules: Rules) -> None:
    contract = rules.contracts["search_only"]
    stays = replace(contract, roles=(replace(contract.roles[0], safe=None),))
    lenient = replace(rules, contracts={**rules.contracts, "search_only": stays})
    mission = b.executing(b.SEARCH, b.SEARCH_PLAN, lenient)
    assert safe_call("searcher", mission, lenient) is None
    assert judge("safe:searcher", mission, b.world(b.iris(airborne=True)), lenient, b.NOW_NS) == ""


def test_a_completion_speaks_only_of_roles_that_took_part(rules: Rules) -> None:
    mission = b.executing("land the drone", b.plan("abort", b.LAND), rules)
    assert judge("complete", mission, b.world(), rules, b.NOW_NS) == ""


def test_a_search_is_complete_when_its_whole_zone_was_swept(rules: Rules) -> None:
    mission = b.executing(b.SEARCH, b.SEARCH_PLAN, rules)
    assert judge("complete", mission, b.world(b.iris(swept=True)), rules, b.NOW_NS) == ""
    assert "it is false (fails)" in judge("complete", mission, b.world(), rules, b.NOW_NS)

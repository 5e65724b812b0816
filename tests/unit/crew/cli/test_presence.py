"""Frozen is not dead, and a lost bus is nobody's freeze but the router's: every order in which it can be noticed."""

import pytest

from crew.cli.presence import BEAT_NS, GONE_NS, RETURN_NS, Change, Presence
from crew.clock import seconds_ns

NAMES = ("router", "orchestrator", "planner", "simulation", "iris")
TOKENS = NAMES[1:]
MS = seconds_ns(0.001)
LEASE_NS = seconds_ns(2.0)


@pytest.fixture
def presence() -> Presence:
    """Everybody is heard at time 0."""
    found = Presence(NAMES)
    for name in TOKENS:
        found.token(name, True, 0)
    found.bus(True, 0)
    found.beat(MS)
    return found


def said(changes: list[Change]) -> dict[str, bool]:
    return {change.name: change.frozen for change in changes}


def test_a_part_whose_token_is_gone_though_its_process_lives_is_frozen_once_and_back_once(presence: Presence) -> None:
    presence.token("planner", False, 10 * MS)
    assert presence.look(10 * MS + GONE_NS) == []
    assert presence.look(11 * MS + GONE_NS) == [Change("planner", True, (GONE_NS + MS) / 1e9)]
    assert presence.look(12 * MS + GONE_NS) == []
    presence.token("planner", True, 5 * GONE_NS)
    assert presence.look(5 * GONE_NS) == [Change("planner", False, (5 * GONE_NS - 10 * MS) / 1e9)]
    assert presence.look(5 * GONE_NS + MS) == []


@pytest.mark.parametrize("name", TOKENS)
def test_who_is_frozen_is_noticed_within_three_seconds_of_its_last_word(presence: Presence, name: str) -> None:
    presence.token(name, False, LEASE_NS)
    if name != "orchestrator":
        presence.beat(LEASE_NS)
    assert name in said(presence.look(seconds_ns(2.9)))


def test_a_process_that_died_is_not_frozen_whichever_is_noticed_first(presence: Presence) -> None:
    presence.token("planner", False, MS)
    presence.died("planner")
    presence.died("simulation")
    presence.token("simulation", False, MS)
    presence.beat(2 * GONE_NS)
    assert presence.look(2 * GONE_NS) == []


def test_a_loop_that_stands_still_is_noticed_by_its_heartbeat_though_its_token_stays(presence: Presence) -> None:
    assert presence.look(MS + BEAT_NS) == []
    assert said(presence.look(2 * MS + BEAT_NS)) == {"orchestrator": True}
    presence.beat(3 * BEAT_NS)
    assert said(presence.look(3 * BEAT_NS)) == {"orchestrator": False}


@pytest.mark.parametrize("first", ["bus", "tokens"])
def test_a_frozen_router_is_the_only_one_told_of_and_others_are_judged_again_later(
    presence: Presence, first: str
) -> None:
    lost_ns = LEASE_NS
    for what in (first, *({"bus", "tokens"} - {first})):
        if what == "bus":
            presence.bus(False, lost_ns)
        else:
            for name in TOKENS:
                presence.token(name, False, lost_ns)
    assert said(presence.look(seconds_ns(2.9))) == {"router": True}
    assert presence.look(seconds_ns(60.0)) == [], "nothing is known of anybody else"
    back_ns = seconds_ns(61.0)
    presence.bus(True, back_ns)
    assert said(presence.look(back_ns)) == {"router": False}
    for name in ("orchestrator", "planner", "iris"):
        presence.token(name, True, back_ns + seconds_ns(1.0))
    presence.beat(back_ns + RETURN_NS)
    assert said(presence.look(back_ns + RETURN_NS + MS)) == {"simulation": True}, "this one has not come back"


def test_a_dead_router_is_not_frozen(presence: Presence) -> None:
    presence.died("router")
    presence.bus(False, MS)
    assert presence.look(seconds_ns(5.0)) == []


def test_who_was_frozen_before_the_bus_was_lost_is_still_so_and_is_not_told_twice(presence: Presence) -> None:
    presence.token("iris", False, MS)
    assert said(presence.look(2 * GONE_NS)) == {"iris": True}
    presence.bus(False, 3 * GONE_NS)
    assert said(presence.look(9 * GONE_NS)) == {"router": True}
    presence.bus(True, 10 * GONE_NS)
    assert said(presence.look(10 * GONE_NS)) == {"router": False}
    presence.beat(10 * GONE_NS + RETURN_NS)
    assert presence.look(11 * GONE_NS + RETURN_NS) == []
    presence.token("iris", True, 12 * GONE_NS + RETURN_NS)
    assert said(presence.look(12 * GONE_NS + RETURN_NS)) == {"iris": False}

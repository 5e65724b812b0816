import pytest

from crew.bus.keyexpr import intersects
from crew.errors import UsageError
from crew.keys import RESERVED, Keys

KEYS = Keys("demo")


def test_keys_follow_the_documented_table() -> None:
    assert KEYS.request == "crew/demo/request"
    assert KEYS.status == "crew/demo/status"
    assert KEYS.mission_event("m-1") == "crew/demo/mission/m-1/event"
    assert KEYS.mission_confirm("m-1") == "crew/demo/mission/m-1/confirm"
    assert KEYS.mission_cancel("m-1") == "crew/demo/mission/m-1/cancel"
    assert KEYS.planner_ask == "crew/demo/planner/ask"
    assert KEYS.planner_proposal == "crew/demo/planner/proposal"
    assert KEYS.intake == "crew/demo/gateway/intake"
    assert KEYS.heartbeat() == "crew/demo/orchestrator/heartbeat"
    assert KEYS.alive("iris") == "crew/demo/iris/alive"
    assert KEYS.robot_card("iris") == "crew/demo/iris/card"
    assert KEYS.robot_value("iris", "victim") == "crew/demo/iris/value/victim"
    assert KEYS.act("iris", "fly_to") == "crew/demo/iris/@act/fly_to"
    assert KEYS.act_cancel("iris") == "crew/demo/iris/@act/cancel"
    assert KEYS.stop == "crew/demo/@stop"
    assert KEYS.reset == "crew/demo/@reset"
    assert KEYS.clock_ack("iris") == "crew/demo/clock/ack/iris"
    assert KEYS.sim_truth == "crew/demo/sim/truth"
    assert KEYS.sim_fault == "crew/demo/sim/fault"


@pytest.mark.parametrize("name", sorted(RESERVED))
def test_reserved_robot_name_is_refused(name: str) -> None:
    with pytest.raises(UsageError, match="reserved robot name"):
        KEYS.robot_state(name)


@pytest.mark.parametrize("name", ["", "Iris", "a b", "a/b", "*", "**", "iris\n", "%41", "ümlaut"])
def test_malformed_names_are_refused_with_the_rule(name: str) -> None:
    with pytest.raises(UsageError, match="a-z, 0-9"):
        KEYS.robot_state(name)
    with pytest.raises(UsageError, match="a-z, 0-9"):
        KEYS.mission_event(name)
    with pytest.raises(UsageError, match="a-z, 0-9"):
        Keys(name)


def test_actuation_chunk_is_no_robot_name() -> None:
    with pytest.raises(UsageError, match="beginning with '@'"):
        KEYS.robot_state("@act")


def test_a_skill_may_not_be_named_cancel() -> None:
    with pytest.raises(UsageError, match="reserved skill name"):
        KEYS.act("iris", "cancel")


@pytest.mark.parametrize(
    ("wildcard", "key"),
    [
        (KEYS.mission_events, KEYS.mission_event("m")),
        (KEYS.mission_confirms, KEYS.mission_confirm("m")),
        (KEYS.mission_cancels, KEYS.mission_cancel("m")),
        (KEYS.robot_cards, KEYS.robot_card("iris")),
        (KEYS.robot_states, KEYS.robot_state("iris")),
        (KEYS.robot_events, KEYS.robot_event("iris")),
        (KEYS.robot_values, KEYS.robot_value("iris", "victim")),
        (KEYS.all_alive, KEYS.alive("planner")),
        (KEYS.clock_acks, KEYS.clock_ack("iris")),
        (KEYS.acts("iris"), KEYS.act("iris", "land")),
        (KEYS.acts("iris"), KEYS.act_cancel("iris")),
        (KEYS.public, KEYS.robot_state("iris")),
    ],
)
def test_wildcards_meet_their_keys(wildcard: str, key: str) -> None:
    assert intersects(wildcard, key)


@pytest.mark.parametrize("key", [KEYS.act("iris", "land"), KEYS.act_cancel("iris"), KEYS.stop, KEYS.reset])
def test_public_wildcard_never_reaches_actuation(key: str) -> None:
    assert not intersects(KEYS.public, key)


def test_name_in_reads_the_robot_and_refuses_foreign_keys() -> None:
    assert KEYS.name_in("crew/demo/iris/state") == "iris"
    with pytest.raises(UsageError, match="foreign key"):
        KEYS.name_in("crew/other/iris/state")

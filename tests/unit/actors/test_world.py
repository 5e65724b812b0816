"""What the orchestrator believes of robots: only this boot, only newer, only from who may say it."""

from collections.abc import Mapping
from typing import Any

import pytest

from crew.actors.orchestrator import identity
from crew.actors.orchestrator import world as world_module
from crew.actors.orchestrator.lease import LeaseTable
from crew.actors.orchestrator.world import WorldFold
from crew.contracts.snapshot import FluentValue, Point, ValueReading
from crew.messages import RobotCard, RobotEvent, RobotState, RobotValue
from tests.unit.actors.stage import air_ground


def card(robot: str = "tb3", boot_id: str = "b1") -> RobotCard:
    return RobotCard(robot=robot, kind="rover", kind_digest="d", boot_id=boot_id, adapter="mavlink", simulated=True)


def state(robot: str = "tb3", boot_id: str = "b1", at_ns: int = 10, **more: Any) -> RobotState:
    fluents: Mapping[str, FluentValue] = more.pop("fluents", {"moving": False})
    stamps: Mapping[str, int] = more.pop("stamps_ns", dict.fromkeys(fluents, at_ns))
    return RobotState(robot=robot, boot_id=boot_id, at_ns=at_ns, fluents=fluents, stamps_ns=stamps, **more)


def value(robot: str = "iris", boot_id: str = "b1", name: str = "victim") -> RobotValue:
    reading = ValueReading(name=name, status="ok", position=Point(5.0, 5.0), stamp_ns=5)
    return RobotValue(robot=robot, boot_id=boot_id, reading=reading)


@pytest.fixture
def world() -> WorldFold:
    fold = WorldFold(air_ground())
    assert not fold.take_card(card())
    assert not fold.take_card(card("iris"))
    return fold


def test_a_robot_that_was_never_heard_is_unavailable_and_says_so() -> None:
    robot = WorldFold(air_ground()).snapshot({}).robots["tb3"]
    assert robot.unavailable == "never heard of"
    assert robot.fluents == {}


def test_a_state_is_taken_with_its_stamps_and_the_lease(world: WorldFold) -> None:
    world.take_state(state(at_ns=10), now_ns=12)
    robot = world.snapshot({"tb3": "m1"}).robots["tb3"]
    assert (robot.unavailable, robot.lease, robot.boot_id) == ("", "m1", "b1")
    stamped = robot.fluents["moving"]
    assert (stamped.value, stamped.source_ns, stamped.received_ns) == (False, 10, 12)


def test_a_state_of_another_boot_is_not_believed(world: WorldFold) -> None:
    world.take_state(state(boot_id="b0"), now_ns=12)
    assert world.snapshot({}).robots["tb3"].unavailable == "never heard of"


def test_a_state_before_any_card_is_not_believed() -> None:
    world = WorldFold(air_ground())
    world.take_state(state(), now_ns=12)
    assert world.snapshot({}).robots["tb3"].unavailable == "never heard of"


def test_an_older_state_does_not_replace_a_newer_one(world: WorldFold) -> None:
    world.take_state(state(at_ns=20, fluents={"moving": True}), now_ns=21)
    world.take_state(state(at_ns=19, fluents={"moving": False}), now_ns=22)
    assert world.snapshot({}).robots["tb3"].fluents["moving"].value is True


def test_a_state_from_the_future_does_not_hold_up_the_ones_that_follow(world: WorldFold) -> None:
    world.take_state(state(at_ns=10**18, fluents={"moving": True}), now_ns=20)
    world.take_state(state(at_ns=21, fluents={"moving": False}), now_ns=22)
    assert world.snapshot({}).robots["tb3"].fluents["moving"].source_ns == 21


def test_a_rebooted_robot_starts_anew(world: WorldFold) -> None:
    world.take_state(state(at_ns=1000), now_ns=1000)
    assert world.take_card(card(boot_id="b2")), "the reboot is told"
    assert world.snapshot({}).robots["tb3"].fluents == {}
    world.take_state(state(boot_id="b2", at_ns=1), now_ns=1001)
    assert world.snapshot({}).robots["tb3"].boot_id == "b2"


def test_strangers_are_ignored(world: WorldFold) -> None:
    assert not world.take_card(card("ghost"))
    world.take_state(state("ghost"), now_ns=1)
    assert not world.take_value(value("ghost"), now_ns=1)
    assert set(world.snapshot({}).robots) == {"iris", "tb3"}
    assert "ghost" not in world.cards


def test_a_fluent_without_a_stamp_is_left_out(world: WorldFold) -> None:
    world.take_state(state(fluents={"moving": False, "battery": 90.0}, stamps_ns={"moving": 9}), now_ns=12)
    assert set(world.snapshot({}).robots["tb3"].fluents) == {"moving"}


def test_a_value_counts_only_from_a_robot_that_publishes_it(world: WorldFold) -> None:
    assert not world.take_value(value("tb3"), now_ns=1), "a rover has no camera"
    assert not world.take_value(value("iris", boot_id="b0"), now_ns=1)
    assert not world.take_value(value("iris", name="treasure"), now_ns=1)
    assert world.snapshot({}).values == {}
    assert world.take_value(value("iris"), now_ns=7)
    found = world.snapshot({}).values["victim"]
    assert (found.source, found.received_ns) == ("iris", 7)


def test_a_silent_robot_is_frozen(world: WorldFold, monkeypatch: pytest.MonkeyPatch) -> None:
    world.take_state(state(), now_ns=12)
    assert world.lost("tb3") == ""
    monkeypatch.setattr(world_module, "SILENT_S", -1.0)
    assert world.lost("tb3").startswith("frozen")
    assert world.snapshot({}).robots["tb3"].unavailable.startswith("frozen")


def test_a_robot_without_its_token_is_lost_until_it_is_back(world: WorldFold) -> None:
    world.take_state(state(), now_ns=12)
    world.take_liveliness("tb3", alive=False)
    assert "lost" in world.lost("tb3")
    assert world.still() == []
    world.take_liveliness("tb3", alive=True)
    assert world.lost("tb3") == ""


def test_an_ended_dispatch_is_not_running_whatever_an_older_state_says(world: WorldFold) -> None:
    world.take_state(state(running="m1/3"), now_ns=12)
    assert world.snapshot({}).robots["tb3"].running == "m1/3"
    world.take_event(_event("succeeded", 3))
    assert world.snapshot({}).robots["tb3"].running == ""
    world.take_state(state(at_ns=11, running="m1/4"), now_ns=13)
    assert world.snapshot({}).robots["tb3"].running == "m1/4"


@pytest.mark.parametrize("changes", [{"boot_id": "b0"}, {"robot": "iris"}])
def test_another_ones_word_ends_no_dispatch(world: WorldFold, changes: dict[str, str]) -> None:
    world.take_state(state(running="m1/3"), now_ns=12)
    world.take_event(_event("succeeded", 3, **changes))
    assert world.snapshot({}).robots["tb3"].running == "m1/3"


def test_a_stop_is_released_when_no_robot_that_is_heard_is_latched(world: WorldFold) -> None:
    for robot in ("iris", "tb3"):
        world.take_state(state(robot), now_ns=1)
    world.stop("operator")
    assert not world.all_released(), "neither has said yet that it is latched"
    world.take_state(state(at_ns=11, stopped=True, told=(0, 1)), now_ns=1)
    world.take_state(state("iris", at_ns=11, stopped=True, told=(0, 1)), now_ns=1)
    assert not world.all_released()
    world.take_state(state(at_ns=12, told=(0, 1)), now_ns=2)
    assert not world.all_released()
    world.take_state(state("iris", at_ns=12, told=(0, 1)), now_ns=2)
    assert world.all_released()


def test_a_robot_that_does_not_confirm_a_stop_keeps_it_in_force(world: WorldFold) -> None:
    world.take_state(state(), now_ns=1)
    world.stop("operator")
    for at_ns in (11, 12):
        world.take_state(state(at_ns=at_ns), now_ns=1)
    assert not world.all_released()
    world.take_state(state(at_ns=13, told=(0, 1)), now_ns=1)
    assert world.all_released()


def test_a_robot_that_is_lost_does_not_keep_a_stop_in_force(world: WorldFold) -> None:
    for robot in ("tb3", "iris"):
        world.take_state(state(robot, stopped=True), now_ns=1)
    world.stop("operator")
    world.take_state(state("iris", at_ns=11, stopped=True, told=(0, 1)), now_ns=1)
    world.take_state(state("iris", at_ns=12, told=(0, 1)), now_ns=1)
    assert not world.all_released()
    world.take_liveliness("tb3", alive=False)
    assert world.all_released()
    assert world.hold.held == ("tb3",), "it comes back latched"


def test_a_kept_stop_is_in_force_before_any_robot_is_heard(world: WorldFold) -> None:
    world.stop("operator")
    assert not WorldFold(air_ground(), world.hold).all_released()
    assert WorldFold(air_ground(), world.hold).stopped


def test_only_robots_that_confirmed_standing_are_still(world: WorldFold) -> None:
    world.take_state(state(still=True), now_ns=1)
    world.take_state(state("iris", still=False), now_ns=1)
    assert world.still() == ["tb3"]


def test_a_lost_bus_is_not_a_lost_robot(world: WorldFold) -> None:
    world.take_state(state(), now_ns=12)
    world.take_liveliness("tb3", alive=False)
    world.bus_lost = True
    assert "the bus is lost" in world.lost("tb3")
    assert "the bus is lost" in world.snapshot({}).robots["tb3"].unavailable
    world.take_liveliness("tb3", alive=True)
    world.bus_lost = False
    assert world.lost("tb3") == ""


def test_a_card_that_changes_while_a_robot_runs_makes_it_unavailable(world: WorldFold) -> None:
    world.take_state(state(), now_ns=12)
    assert not world.take_card(card()), "the same card again is no change"
    assert world.lost("tb3") == ""
    changed = RobotCard(robot="tb3", kind="rover", kind_digest="x", boot_id="b1", adapter="mavlink", simulated=True)
    assert not world.take_card(changed)
    assert "its card changed while it ran (kind_digest)" in world.lost("tb3")
    assert world.snapshot({}).robots["tb3"].kind_digest == "d", "the first card of a boot counts"


def test_two_robots_with_one_name_are_both_unavailable_until_one_is_gone(
    world: WorldFold, monkeypatch: pytest.MonkeyPatch
) -> None:
    assert world.take_card(card(boot_id="b2")), "one restart is none of that"
    assert "two robots" not in world.lost("tb3")
    assert not world.take_card(card(boot_id="b1"))
    assert "two robots announce the name tb3 (boots b2 and b1)" in world.lost("tb3")
    monkeypatch.setattr(identity, "DOUBT_S", -1.0)
    world.take_state(state(boot_id="b2", at_ns=20), now_ns=20)
    assert world.lost("tb3") == ""


def test_what_robots_dropped_is_known_by_robot(world: WorldFold) -> None:
    world.take_state(state(dropped=3), now_ns=1)
    world.take_state(state("iris"), now_ns=1)
    assert world.dropped() == {"by_tb3": 3}


# --- leases


def test_a_mission_gets_all_of_its_robots_or_none() -> None:
    table = LeaseTable()
    table.ask("m1", ["iris"])
    assert table.grant() == ["m1"]
    table.ask("m2", ["iris", "tb3"])
    assert table.grant() == []
    assert dict(table.held) == {"iris": "m1"}
    table.release("m1")
    assert table.grant() == ["m2"]
    assert dict(table.held) == {"iris": "m2", "tb3": "m2"}


def test_nobody_overtakes_for_a_robot_in_demand() -> None:
    table = LeaseTable()
    table.ask("m1", ["iris"])
    table.grant()
    table.ask("big", ["iris", "tb3"])
    table.ask("small", ["tb3"])
    assert table.grant() == [], "tb3 is free, but big asked for it first"
    table.release("m1")
    assert table.grant() == ["big"]
    table.release("big")
    assert table.grant() == ["small"]


def test_disjoint_missions_run_side_by_side() -> None:
    table = LeaseTable()
    table.ask("m1", ["iris"])
    table.ask("m2", ["tb3"])
    assert table.grant() == ["m1", "m2"]


def test_a_mission_that_preempts_is_first_in_line() -> None:
    table = LeaseTable()
    table.ask("m1", ["iris"])
    table.grant()
    table.ask("m2", ["iris"])
    table.ask("abort", ["iris"], first=True)
    assert table.holders(["iris", "tb3"]) == ["m1"]
    table.release("m1")
    assert table.grant() == ["abort"]


def test_a_mission_that_ended_while_it_waited_gets_nothing() -> None:
    table = LeaseTable()
    table.ask("m1", ["iris"])
    table.grant()
    table.ask("m2", ["iris"])
    table.release("m2")
    table.release("m1")
    assert table.grant() == []
    assert dict(table.held) == {}


def test_a_mission_without_robots_runs_at_once() -> None:
    table = LeaseTable()
    table.ask("m1", [])
    assert table.grant() == ["m1"]


def _event(what: str, sequence: int, robot: str = "tb3", boot_id: str = "b1") -> RobotEvent:
    return RobotEvent(robot=robot, boot_id=boot_id, at_ns=1, what=what, mission="m1", sequence=sequence)


def test_whether_robots_keep_clear_is_the_orchestrators_own_finding(world: WorldFold) -> None:
    """A robot's own word for it is not taken, neither for yes nor for no."""
    place = Point(0.0, 0.0)
    drone: dict[str, FluentValue] = {"at": place, "airborne": True, "descending": True, "clear_below": True}
    world.take_state(state("iris", fluents=drone), now_ns=12)
    assert world.snapshot({}).robots["iris"].fluents["clear_below"].value is True, "nobody else was heard of"
    world.take_state(state(fluents={"at": place, "moving": False, "clear_above": True}), now_ns=12)
    robots = world.snapshot({}).robots
    assert robots["iris"].fluents["clear_below"].value is False
    assert robots["tb3"].fluents["clear_above"].value is False

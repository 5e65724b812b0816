"""What goes wrong ends in a clear word, and both robots stand still: each fault of the scene, and SDK errors."""

import math

import pytest

from crew.errors import AdapterError
from tests.integration.unitree.stage import Stage, stage

STILL_MPS = 0.05


async def failed(scene: Stage, robot: str, skill: str, **args: str) -> AdapterError:
    """The error of a skill that must fail; afterwards everybody stands still."""
    with pytest.raises(AdapterError) as caught:
        await scene.do(robot, skill, **args)
    await scene.advance(2.0)
    before = scene.world.scene_truth()
    await scene.advance(1.0)
    after = scene.world.scene_truth()
    for name in before.poses:
        assert math.dist(before.poses[name][:2], after.poses[name][:2]) < STILL_MPS, f"{name} moves"
    return caught.value


async def test_a_failed_grasp_says_where_the_cube_is() -> None:
    async with stage("g1", map_="near", faults=("grasp_failed",)) as scene:
        error = await failed(scene, "g1", "pick_handover", object="red_cube")
        assert error.code == "grasp_failed"
        assert "seen at (0.3" in str(error)
        assert 0.7 < scene.thing("red_cube")[2] < 0.76, "it lies on the table"
        assert scene.g1.fluents()["holding"].value == "none"


async def test_a_dropped_object_is_noticed() -> None:
    async with stage("g1", map_="near", faults=("object_dropped",)) as scene:
        error = await failed(scene, "g1", "pick_handover", object="red_cube")
        assert error.code == "grasp_failed"
        assert scene.g1.fluents()["handed"].value == "none"
        assert scene.thing("red_cube")[2] < 0.8


async def test_a_person_who_walks_away_from_the_hand_leaves_the_object_in_it() -> None:
    async with stage("g1", map_="near", faults=("requester_leaves",)) as scene:
        error = await failed(scene, "g1", "pick_handover", object="red_cube")
        assert error.code == "target_moved"
        assert scene.g1.fluents()["holding"].value == "red_cube"
        assert scene.thing("red_cube")[2] > 0.8


async def test_a_load_that_falls_out_stops_the_walk() -> None:
    async with stage(map_="far", faults=("tray_slip",)) as scene:
        await scene.do("go2", "navigate", location="pickup")
        await scene.do("g1", "pick_place", object="red_cube", location="payload_tray")
        error = await failed(scene, "go2", "navigate", location="requester")
        assert error.code == "load_lost"
        assert "red_cube is no longer in the tray" in str(error)
        assert scene.thing("red_cube")[2] < 0.1, "on the floor"
        assert math.dist(scene.dog()[:2], scene.thing("requester")[:2]) > 2.0, "it did not go on"


async def test_a_person_who_walks_away_during_the_walk_ends_it() -> None:
    async with stage(map_="far") as scene:
        await scene.advance(0.5)
        walk = scene.do("go2", "navigate", location="requester")

        async def leave() -> None:
            await scene.clock.sleep(4.0)
            scene.world._requester.leaving = True

        import asyncio

        leaving = asyncio.ensure_future(leave())
        with pytest.raises(AdapterError, match="requester has walked away to") as caught:
            await walk
        await leaving
        assert caught.value.code == "target_moved"


@pytest.mark.parametrize(
    ("fault", "code", "said"),
    [
        ("doorway_blocked", "no_path", "no way from"),
        ("go2_falls", "fallen", "it has fallen: tilted by"),
        ("move_ignored", "no_progress", "Moves are answered, but the robot stands still"),
        ("link_loss", "link_lost", "link lost: no rt/sportmodestate"),
    ],
)
async def test_a_walk_that_cannot_go_on_ends(fault: str, code: str, said: str) -> None:
    async with stage(map_="far", faults=(fault,)) as scene:
        error = await failed(scene, "go2", "navigate", location="requester")
        assert error.code == code
        assert said in str(error)
        if fault == "go2_falls":
            assert scene.go2.fluents()["standing"].value is False, "on its side or on its belly"


@pytest.mark.parametrize("robot", ["g1", "go2"])
async def test_a_robot_out_of_order_says_so_and_takes_nothing(robot: str) -> None:
    async with stage(map_="near", faults=(f"{robot}_unavailable",)) as scene:
        assert scene.adapters[robot].health()
        skill = {"g1": ("wave", {}), "go2": ("navigate", {"location": "charging"})}[robot]
        with pytest.raises(AdapterError) as caught:
            await scene.do(robot, skill[0], **skill[1])
        assert caught.value.code == "robot_unavailable"


@pytest.mark.parametrize(
    ("fault", "number"), [("lease_held", 3207), ("sdk_timeout", 3104)], ids=["lease held", "no answer"]
)
async def test_a_service_that_cannot_be_had_is_named_at_connecting(fault: str, number: int) -> None:
    with pytest.raises(AdapterError, match=f"go2: sport.* failed with {number}"):
        async with stage("go2", faults=(fault,)):
            pass


async def test_a_call_that_the_firmware_lacks_is_named() -> None:
    async with stage("g1", faults=("sdk_not_implemented",)) as scene:
        error = await failed(scene, "g1", "wave")
        assert error.code == "sdk_3203"
        assert "firmware does not know this call" in str(error)


async def test_a_lease_that_somebody_took_makes_the_robot_unavailable_until_it_is_back() -> None:
    async with stage("go2") as scene:
        scene.world.set_fault("lease_held", True)
        await scene.advance(2.0)
        assert "lease held by another client (3207)" in scene.go2.health()
        with pytest.raises(AdapterError, match="lease held"):
            await scene.do("go2", "navigate", location="charging")
        scene.world.set_fault("lease_held", False)
        await scene.advance(4.0)
        assert scene.go2.health() == ""


async def test_a_robot_that_lies_down_is_stood_up_before_it_walks() -> None:
    async with stage("go2") as scene:
        scene.world._go2._stand_down({})
        await scene.advance(2.5)
        assert scene.go2.fluents()["standing"].value is False
        await scene.do("go2", "navigate", location="charging")
        assert scene.go2.fluents()["standing"].value is True

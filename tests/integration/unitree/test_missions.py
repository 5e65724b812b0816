"""Both robots doing their work, physically: what they say is compared with where things truly are."""

import math

import pytest

from crew.errors import AdapterError
from tests.integration.unitree.stage import stage

DELIVERED_M = 0.3


@pytest.mark.parametrize("seed", [0, 1, 2])
async def test_the_cube_is_handed_to_a_person_in_reach(seed: int) -> None:
    async with stage("g1", map_="near", seed=seed) as scene:
        await scene.do("g1", "pick_handover", object="red_cube")
        told = scene.g1.fluents()
        assert (told["handed"].value, told["holding"].value) == ("red_cube", "none")
        x, y, z = scene.thing("requester")
        assert scene.away_m("red_cube", x, y) < 0.08
        assert abs(scene.thing("red_cube")[2] - z) < 0.08, "in the person's hand, not on the floor"
        await scene.advance(2.0)
        assert scene.thing("red_cube")[2] > 0.8


@pytest.mark.parametrize("seed", [0, *(pytest.param(seed, marks=pytest.mark.soak) for seed in (1, 2))])
async def test_the_cube_is_carried_to_a_person_in_another_room(seed: int) -> None:
    async with stage(map_="far", seed=seed) as scene:
        await scene.do("go2", "navigate", location="pickup")
        await scene.do("g1", "pick_place", object="red_cube", location="payload_tray")
        await scene.advance(0.5)
        assert scene.go2.fluents()["tray"].value == "red_cube"
        await scene.do("go2", "navigate", location="requester")
        x, y, _ = scene.thing("requester")
        assert scene.away_m("red_cube", x, y) < DELIVERED_M
        assert scene.thing("red_cube")[2] > 0.5, "in the tray"
        assert scene.go2.fluents()["tray"].value == "red_cube"
        assert scene.go2.fluents()["moving"].value is False


async def test_things_are_placed_on_tables_and_the_arm_waves() -> None:
    async with stage("g1") as scene:
        await scene.do("g1", "wave")
        assert scene.g1.fluents()["waved"].value is True
        await scene.do("g1", "pick_place", object="bottle", location="table_b")
        await scene.do("g1", "pick_place", object="red_cube", location="table_a")
        for name, place in (("bottle", "table_b"), ("red_cube", "table_a")):
            spot = scene.crew.location(place)
            assert spot is not None
            assert scene.away_m(name, spot.x, spot.y) < 0.05
            assert scene.thing(name)[2] > 0.72
        assert scene.g1.fluents()["holding"].value == "none"


async def test_what_is_held_shows_and_is_no_longer_on_the_table() -> None:
    async with stage("g1") as scene:
        assert scene.g1.values()["requester"].near is False
        await scene.do("g1", "pick_hold", object="red_cube")
        assert scene.g1.fluents()["holding"].value == "red_cube"
        assert scene.thing("red_cube")[2] > 0.8
        with pytest.raises(AdapterError, match="does not wave with red_cube in its hand"):
            await scene.do("g1", "wave")


@pytest.mark.parametrize(
    ("skill", "args", "code"),
    [
        ("pick_hold", {"object": "piano"}, "object_not_seen"),
        ("pick_place", {"object": "red_cube", "location": "payload_tray"}, "place_not_seen"),
        ("pick_place", {"object": "red_cube", "location": "room_b"}, "place_not_seen"),
        ("pick_handover", {"object": "red_cube"}, "nobody_near"),
    ],
)
async def test_what_cannot_be_done_is_refused_before_anything_moves(
    skill: str, args: dict[str, str], code: str
) -> None:
    async with stage("g1") as scene:
        before = scene.thing("red_cube")
        with pytest.raises(AdapterError) as caught:
            await scene.do("g1", skill, **args)
        assert caught.value.code == code
        assert math.dist(scene.thing("red_cube"), before) < 0.001
        assert scene.clock.now_ns() < 1_000_000_000


async def test_a_place_outside_the_area_is_refused() -> None:
    from crew.adapter import Place
    from crew.contracts.kinds.quadruped import Navigate

    async with stage("go2") as scene:
        work = scene.go2.execute("navigate", Navigate(location="x"), {"location": Place(50.0, 0.0)})
        with pytest.raises(AdapterError, match="outside the area"):
            await scene.run(work)


async def test_a_kicked_dog_with_a_load_recovers() -> None:
    async with stage("go2") as scene:
        walk = scene.do("go2", "navigate", location="room_b")

        async def kick() -> None:
            for direction in (1.57, -1.57):
                await scene.clock.sleep(2.0)
                scene.world._go2.shove(8.0, direction)

        import asyncio

        kicking = asyncio.ensure_future(kick())
        await walk
        await kicking
        x, y, z, _ = scene.dog()
        place = scene.crew.location("room_b")
        assert place is not None
        assert math.dist((x, y), (place.x, place.y)) < DELIVERED_M
        assert z > 0.3


async def test_the_same_seed_gives_the_same_world() -> None:
    ends = []
    for _ in range(2):
        async with stage("g1", map_="near", seed=4) as scene:
            await scene.do("g1", "pick_hold", object="red_cube")
            ends.append(scene.world.scene_truth())
    assert ends[0] == ends[1]

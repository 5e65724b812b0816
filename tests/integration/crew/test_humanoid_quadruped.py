"""`crew demo humanoid_quadruped`: one request, and where the person stands decides who brings the cube, and how."""

import math

from tests.integration.crew.harness import Desk, intents, watching

DELIVERED_M = 0.3
CARRY = ["go2.navigate", "g1.pick_place", "go2.navigate"]


def test_a_person_beside_the_table_is_handed_the_cube(desk: Desk) -> None:
    demo = desk.demo("humanoid_quadruped", "--map", "near")
    assert (demo.code, demo.result["outcome"], demo.result["contract"]) == (0, "completed", "handover"), demo
    assert demo.outcomes() == {"g1.pick_handover": "succeeded"}
    assert intents(demo.run) == ["g1.pick_handover"]
    assert demo.result["goal_error_m"] < 0.1
    assert demo.result["objects"]["red_cube"][2] > 0.8


def test_a_person_in_another_room_is_brought_the_same_cube(desk: Desk) -> None:
    demo = desk.demo("humanoid_quadruped", "--map", "far", "--seed", "1")
    assert (demo.code, demo.result["outcome"], demo.result["contract"]) == (0, "completed", "carry"), demo
    assert intents(demo.run) == CARRY
    assert demo.result["goal_error_m"] < DELIVERED_M
    assert demo.result["objects"]["red_cube"][2] > 0.5, "in the tray"
    assert desk.crew("verify", str(demo.run)).returncode == 0


def test_a_load_lost_on_the_way_halts_and_its_true_place_is_told(desk: Desk) -> None:
    demo = desk.demo("humanoid_quadruped", "--fault", "tray_slip")
    assert (demo.code, demo.result["outcome"]) == (4, "halted")
    assert demo.result["steps"][-1]["outcome"] == "failed"
    assert "no longer in the tray" in demo.result["message"]
    x, y, z = demo.result["objects"]["red_cube"]
    assert z < 0.1, "on the floor"
    assert demo.result["goal_error_m"] > 2.0
    assert math.dist((x, y), (0.08, -0.47)) < 3.0, "on the way from where it was loaded"


MUST_NOT = {
    "bring me the piano": "unknown_object",
    "carry the red cube to the rooftop helipad": "unknown_location",
    "do not take the red cube to room_b": "forbidden_by_request",
}


async def test_what_must_not_be_done_moves_nothing(desk: Desk) -> None:
    with desk.up("humanoid_quadruped", "--map", "far") as up:
        async with watching(up.running) as watch:
            ends = {text: await watch.ended(watch.ask(text)) for text in MUST_NOT}
        assert {text: (end.outcome, end.code) for text, end in ends.items()} == {
            text: ("rejected", code) for text, code in MUST_NOT.items()
        }
        assert intents(up.run) == []


async def test_a_second_request_during_the_walk_waits_for_the_walker_and_not_for_the_arm(desk: Desk) -> None:
    with desk.up("humanoid_quadruped", "--map", "far") as up:
        async with watching(up.running) as watch:
            first = watch.ask("send the dog to room_a")
            await watch.moving("go2")
            second, wave = watch.ask("send the dog to the charging station"), watch.ask("wave")
            for request in (wave, first, second):
                ended = await watch.ended(request)
                assert ended.outcome == "completed", ended.text
            finals = [e.request_id for e in watch.events if e.final]
            assert finals.index(first) < finals.index(second), "one after the other"
            assert any("waiting for robots" in e.text for e in watch.of(second))
            assert not any("waiting for robots" in e.text for e in watch.of(wave)), "the arm was free"
        assert intents(up.run) == ["go2.navigate", "g1.wave", "go2.navigate"]

"""From a request to the person, on each map: the rover stands within half a metre of who was searched.

Map A is the demo's own; test_demo.py looks at it.
"""

from pathlib import Path

import pytest

from tests.integration.crew.harness import Desk


@pytest.mark.parametrize(
    ("map_", "seed"), [("B", 2), *(pytest.param(*s, marks=pytest.mark.soak) for s in (("A", 1), ("C", 3)))]
)
def test_the_rover_stands_within_half_a_metre_of_the_person(map_: str, seed: int, tmp_path: Path) -> None:
    demo = Desk(tmp_path).demo("--map", map_, "--seed", str(seed))
    assert demo.result["outcome"] == "completed", demo.result["message"]
    assert demo.result["goal_error_m"] < 0.5
    assert demo.result["poses"]["iris"][2] < 0.1, "the drone is down"


def test_two_people_halt_the_mission_with_a_question_and_the_rover_stays(tmp_path: Path) -> None:
    demo = Desk(tmp_path).demo("--map", "two_people", "--seed", "1")
    assert (demo.code, demo.result["code"]) == (4, "no_target_fix")
    assert demo.result["question"].startswith("Which of them is victim: (")
    assert demo.outcomes()["tb3.navigate_to"] == "refused"
    assert demo.result["poses"]["tb3"][:2] == pytest.approx((-4.0, -2.5), abs=0.05)

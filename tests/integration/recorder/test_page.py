"""What a person sees of real runs in a browser: lanes in their colours, and the scene."""

from pathlib import Path

import pytest

from crew.actors.recorder.colour import FLOOR, ROBOTS
from tests.integration.crew.harness import Desk
from tests.integration.recorder.browser import OUTPUT, SCENE, Shot, Viewer, rgb
from tests.integration.recorder.conftest import shown

TONES = {
    "completed": ("run", "hold", "good", "skill1"),
    "halted": ("run", "hold", "bad", "safe", "skill1"),
    "rejected": ("bad",),
}
"""What must be seen in the lanes of each run."""


def scene_is_drawn(shot: Shot) -> None:
    assert shot.count(FLOOR[:3], SCENE) > 20_000, "the ground"
    assert shot.count((18, 22, 27), SCENE) > 20_000, "the background"
    assert shot.colours(SCENE) > 300, "what stands on the ground is shaded"


@pytest.mark.parametrize(
    "outcome", ["completed", *(pytest.param(o, marks=pytest.mark.soak) for o in TONES if o != "completed")]
)
def test_a_real_run_is_shown(desk: Desk, runs: dict[str, Path], viewer: Viewer, outcome: str) -> None:
    with shown(desk, runs[outcome]) as address:
        shot = viewer.look(address, TONES[outcome])
    shot.save(OUTPUT / f"{outcome}.png")
    scene_is_drawn(shot)
    strange = {"completed": ("bad", "safe", "stop"), "halted": ("good",), "rejected": ("good", "hold", "run")}
    assert [tone for tone in strange[outcome] if shot.lane(tone) > 200] == []
    if outcome != "rejected":
        assert shot.count(rgb(ROBOTS[0]), SCENE) > 300, "the drone's trail"
    if outcome == "completed":
        assert shot.count(rgb(ROBOTS[1]), SCENE) > 100, "the rover's trail"
        assert shot.lane("hold") > shot.lane("good"), "held longer than the end is shown"

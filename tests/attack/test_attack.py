"""Nothing of any attack arrives, the rightful sender's same message does, and the page in the docs says just that."""

from collections.abc import Iterator
from pathlib import Path

import pytest

from crew.messages import Intake, RobotState
from tests.attack import insiders, strangers
from tests.attack.__main__ import PAGE
from tests.attack.row import Row, rights, table
from tests.attack.scene import ATTACKERS, Scene, scene_of
from tests.integration.crew.harness import Desk, Up, Watch, wait_until, watching


@pytest.fixture(scope="module")
def up(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Up]:
    with Desk(tmp_path_factory.mktemp("attack")).up() as up:
        yield up


@pytest.fixture(scope="module")
def scene(up: Up) -> Iterator[Scene]:
    with scene_of(up.running) as scene:
        yield scene


def test_the_page_shows_the_table_of_rights() -> None:
    assert rights() in PAGE.read_text(encoding="utf-8"), "write it anew with: python -m tests.attack"


async def test_a_robot_that_speaks_in_another_name_is_not_believed(scene: Scene, up: Up) -> None:
    """On its own key, which the router allows: the orchestrator compares the key with what is said."""
    async with watching(up.running) as watch:
        before = (await watch.status()).dropped.get("foreign", 0)
        state = RobotState(robot="tb3", boot_id="", at_ns=2**62, unavailable="says iris")
        watch.put(watch.keys.robot_state("iris"), state)
        await _until_dropped(watch, before + 1)
        assert {r.robot: r.unavailable for r in (await watch.status()).robots} == {"iris": "", "tb3": ""}


@pytest.mark.parametrize("mission", ["", "../x", "m/1", "*", "M 1", "x" * 300])
async def test_a_gateway_that_makes_up_mission_ids_ends_nobody(scene: Scene, up: Up, mission: str) -> None:
    pids = up.children()
    async with watching(up.running) as watch:
        before = (await watch.status()).dropped.get("foreign", 0)
        watch.put(watch.keys.intake, Intake(mission=mission, text="send the rover to (-3, -3)"))
        await _until_dropped(watch, before + 1)
    assert up.children() == pids


async def _until_dropped(watch: Watch, count: int) -> None:
    for _ in range(100):
        if (await watch.status()).dropped.get("foreign", 0) >= count:
            return
        await watch.truth()
    raise AssertionError((await watch.status()).dropped)


async def test_the_crew_works_while_attackers_are_there(scene: Scene, up: Up) -> None:
    async with watching(up.running) as watch:
        await watch.drives()


@pytest.fixture(scope="module")
def rows(scene: Scene, tmp_path_factory: pytest.TempPathFactory) -> list[Row]:
    """Everything, once; the last attack's control ends the planner."""
    return [*strangers.attacks(scene, tmp_path_factory.mktemp("strangers")), *insiders.attacks(scene)]


@pytest.mark.hostile
def test_nothing_of_any_attack_arrives_and_the_rightful_message_does(rows: list[Row]) -> None:
    assert [row.line() for row in rows if not row.holds] == []
    assert not [row.line() for row in rows if "CHANGE" in row.operator_sees or "MATCHES" in row.attacker_sees]


def test_everybody_was_an_attacker(rows: list[Row]) -> None:
    assert {name for row in rows for name in row.by} >= set(ATTACKERS)


def test_the_page_tells_what_was_seen(rows: list[Row]) -> None:
    assert table(rows) in PAGE.read_text(encoding="utf-8"), "write it anew with: python -m tests.attack"


def test_only_the_control_has_ended_anybody(rows: list[Row], up: Up) -> None:
    assert wait_until(lambda: "planner died (signal 9)" in up.said, 5.0)
    assert up.said.count(" died ") == 1
    assert Path(up.running.run_folder).is_dir()

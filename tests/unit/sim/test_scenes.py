"""Scenes by name: what is known, what is refused, and what a survey of a site says."""

from pathlib import Path

import pytest

from crew.errors import UsageError
from crew.launch.options import LaunchOptions
from crew.launch.site import resolve
from crew.sim.config import WorldConfig
from crew.sim.map import load_map
from crew.sim.scenes import check_models, open_world, survey
from tests import menagerie


@pytest.mark.parametrize(
    "call", [lambda: survey("air_grund", "A"), lambda: open_world(WorldConfig(scene="x", links={}))]
)
def test_an_unknown_scene_is_refused_with_the_known_ones(call: object) -> None:
    assert callable(call)
    with pytest.raises(ValueError, match=r"no scene is called.*air_ground"):
        call()


def test_a_survey_has_the_discs_of_each_obstacle() -> None:
    found = survey("air_ground", "A")
    site = load_map("air_ground", "A")
    assert found.origin == (site.origin.lat_deg, site.origin.lon_deg, site.origin.alt_m)
    assert {disc for obstacle in site.obstacles for disc in obstacle.discs} == set(found.obstacles)


def test_other_models_are_taken_where_the_scene_takes_any(tmp_path: Path) -> None:
    check_models("air_ground", "")
    check_models("apartment", str(menagerie.make(tmp_path)))
    with pytest.raises(ValueError, match=r"air_ground has robots of its own alone; apartment takes others"):
        check_models("air_ground", str(tmp_path))


@pytest.mark.parametrize(
    ("crew", "words"),
    [
        ("humanoid_quadruped", r"--models: there is no unitree_g1/g1.xml in '/nowhere'; fetch MuJoCo Menagerie"),
        ("air_ground", r"--models: the scene air_ground has robots of its own alone"),
    ],
)
def test_a_crew_is_not_brought_up_with_models_that_are_not_there(crew: str, words: str) -> None:
    with pytest.raises(UsageError, match=words):
        resolve(LaunchOptions(crew=crew, models="/nowhere"))

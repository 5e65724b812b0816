"""Scenes by name: what is known, what is refused, and what a survey of a site says."""

import pytest

from crew.sim.config import WorldConfig
from crew.sim.map import load_map
from crew.sim.scenes import open_world, survey


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

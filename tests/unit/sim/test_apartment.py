"""The apartment's maps: what is read, what is refused with its field, and what a survey leaves free."""

import math
from pathlib import Path

import pytest

from crew.library import load_rules
from crew.sim.apartment.site import load_site, parse_site
from crew.sim.map import MAPS, MapError
from crew.sim.scenes import survey

TEXT = (MAPS / "apartment_far.yaml").read_text(encoding="utf-8")


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("name: far", "nme: far", r"apartment_x: .*nme"),
        ("mass_kg: 0.1}", "mass_kg: heavy}", "mass_kg"),
        (
            "on: table_a, x_m: 0.37",
            "on: table_z, x_m: 0.37",
            r"things.red_cube.on: no table 'table_z'; there are table_a",
        ),
        ("edge_m: 0.05", "edge_m: 0.05, radius_m: 0.1, height_m: 0.1", "give edge_m, or radius_m and height_m"),
        ("go2: {x_m: 2.0", "go2: {x_m: 20.0", r"robots.go2: \(20.0, -2.2\) lies outside"),
        ("scene: apartment", "scene: [", "not YAML"),
    ],
)
def test_a_wrong_map_is_refused_with_its_field(old: str, new: str, message: str) -> None:
    assert old in TEXT
    with pytest.raises(MapError, match=message):
        parse_site(TEXT.replace(old, new), source="apartment_x")


def test_an_unknown_map_lists_those_that_exist() -> None:
    with pytest.raises(
        MapError, match=r"no map 'neer' of the scene apartment; did you mean 'near'\? \(valid: far, near"
    ):
        load_site("neer")


@pytest.mark.parametrize("name", [path.stem.removeprefix("apartment_") for path in Path(MAPS).glob("apartment_*")])
def test_every_place_of_the_crew_is_free_for_the_one_that_goes_there(name: str) -> None:
    crew = load_rules("humanoid_quadruped").crew
    discs = survey("apartment", name).obstacles
    for place in crew.locations:
        if not place.name.startswith("table"):
            nearest_m = min(math.dist((place.x, place.y), disc[:2]) - disc[2] for disc in discs)
            assert nearest_m > 0.15, place.name
            assert crew.area.contains(place.x, place.y)


def test_doorways_are_gaps_in_the_survey() -> None:
    site = load_site("far")
    for doorway in site.doorways:
        gap_m = min(math.dist((doorway.x_m, doorway.y_m), d[:2]) - d[2] for d in site.obstacles)
        assert gap_m > 0.4, doorway.name

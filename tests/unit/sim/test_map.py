"""Maps: what is read, and that an error names the file and the field."""

import pytest

from crew.sim.map import MAPS, MapError, Tree, load_map, parse_map

TEXT = (MAPS / "air_ground_a.yaml").read_text(encoding="utf-8")


def test_map_a_has_the_victim_at_5_5_and_both_robots() -> None:
    found = load_map("air_ground", "A")
    assert (found.victim.x_m, found.victim.y_m) == (5.0, 5.0)
    assert set(found.robots) == {"iris", "tb3"}
    assert any(isinstance(obstacle, Tree) for obstacle in found.obstacles)


def test_unknown_map_lists_those_that_exist() -> None:
    with pytest.raises(MapError, match=r"no map 'Z' of the scene air_ground \(valid: a, b, c, cover"):
        load_map("air_ground", "Z")


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("radius_m: 0.3, height_m: 0.9}", "radius_m: -1, height_m: 0.9}", r"\$\.obstacles\[5\]\.radius_m"),
        ("shape: tree", "shape: bush", r"\$\.obstacles\[8\]\.shape"),
        ("victim: {x_m: 5.0", "victim: {x: 5.0", r"unknown field `x` - at `\$\.victim`"),
        ("lat_deg: 47.397742", "lat_deg: north", r"\$\.origin\.lat_deg"),
        ("victim: {x_m: 5.0", "victim: {x_m: 50.0", r"\$\.victim: .*outside \$\.area"),
        ("victim: {x_m: 5.0, y_m: 5.0", "victim: {x_m: 7.0, y_m: 7.2", r"\$\.victim: .*within obstacle oak"),
        ("x_max_m: 10.0", "x_max_m: -10.0", r"\$\.area: a minimum"),
        ("name: crate", "name: kerb", r"\$\.obstacles\[3\]\.name: kerb is used twice"),
        ("name: A", "name: [A", "not YAML"),
    ],
)
def test_mistake_is_reported_with_file_and_field(old: str, new: str, message: str) -> None:
    assert old in TEXT
    with pytest.raises(MapError, match=f"a.yaml: .*{message}"):
        parse_map(TEXT.replace(old, new, 1), source="a.yaml")

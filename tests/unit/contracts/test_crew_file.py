"""Crew files: what is read, and every mistake with its place."""

from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from crew.contracts.files.crew_file import load_crew
from crew.contracts.plan import Zone
from crew.contracts.site import Location, NamedZone, RobotSpec, SimSpec
from tests.unit.contracts.carry import CREW_TEXT, crew_of, edited, mark, mistakes

SHIPPED = sorted((Path(__file__).parents[3] / "crew" / "crews").glob("*.yaml"))
TEXT = """\
crew: yard
area: {x: [-6, 10], y: [-6, 10]}
origin: {lat_deg: 33.5, lon_deg: -111.5, alt_m: 360}
robots:
  iris: {kind: quadcopter, adapter: mavlink, sim: iris, options: {fov: 80}}
  tb3: {kind: rover, adapter: mavlink, connection: "udp:1", aliases: [turtle]}
locations:
  base: {at: [-4, -4], aliases: [home]}
zones:
  operational_area: {aliases: [everywhere]}
  north: {x: [-6, 10], y: [2, 10]}
objects:
  cube: {aliases: [block]}
values:
  victim: {aliases: [hiker], standoff_m: 0.3}
obstacles: [[1, 2, 0.5]]
contracts: [search_only]
sim: {scene: yard, map: B, seed: 7}
"""


def errors_of(text: str) -> list[tuple[int, int, str]]:
    return [(e.line, e.column, str(e)) for e in mistakes(crew_of, text)]


def test_a_crew_is_read_as_written() -> None:
    crew = crew_of(TEXT)
    assert crew.area == Zone(-6.0, 10.0, -6.0, 10.0)
    assert crew.origin == (33.5, -111.5, 360.0)
    assert crew.robot("iris") == RobotSpec(
        name="iris", kind="quadcopter", adapter="mavlink", sim="iris", options={"fov": 80}
    )
    assert crew.locations == (Location(name="base", x=-4.0, y=-4.0, aliases=("home",)),)
    assert crew.obstacles == ((1.0, 2.0, 0.5),)
    assert crew.sim == SimSpec(scene="yard", map="B", seed=7)
    assert crew.source == "lab.yaml"


def test_the_operational_area_is_the_area_with_or_without_being_named() -> None:
    named, unnamed = crew_of(TEXT), crew_of(CREW_TEXT)
    assert named.zones[0] == NamedZone(name="operational_area", zone=named.area, aliases=("everywhere",))
    assert [(z.name, z.zone) for z in unnamed.zones] == [("operational_area", unnamed.area)]


@pytest.mark.parametrize("path", SHIPPED, ids=lambda p: p.stem)
def test_shipped_crews_load(path: Path) -> None:
    assert load_crew(path.read_text(), source=path.name).name == path.stem


MISTAKES = [
    ("crew: yard", "crew: the-yard", "the-yard", "bad value of crew: found 'the-yard', allowed: a name"),
    ("  tb3:", "  tb-3:", "tb-3", "not a name in robots: found 'tb-3'"),
    ("  tb3:", "  '@tb3':", "'@tb3'", "not a name in robots: found '@tb3'"),
    ("  tb3:", "  planner:", "planner:", "reserved name: found 'planner'"),
    ("  tb3:", "  iris:", "iris: {kind: rover", "duplicate key: found 'iris' again; it is already on line 5"),
    ("aliases: [turtle]", "aliases: [iris]", "iris]", "means two things: found also robot tb3; line 5 gives it"),
    ("aliases: [home]", "aliases: [The  Turtle]", "The  Turtle", "means two things: found also location base; line 6"),
    ("aliases: [home]", "aliases: [hiker]", "hiker], standoff", "line 8 gives it to location base"),
    ("  cube:", "  base:", "base: {aliases", "'base' means two things: found also object base; line 8"),
    ("aliases: [home]", "aliases: [the]", "the]", None),
    ("aliases: [home]", "aliases: [' ']", "' '", "allowed: some text"),
    (", sim: iris", "", "iris: {kind", "robot iris: found neither, allowed: either `sim` or `connection`"),
    ('connection: "udp:1"', 'connection: "udp:1", sim: tb3', "tb3: {kind", "robot tb3: found both"),
    ("sim: {scene: yard, map: B, seed: 7}\n", "", "iris, options", "is simulated, but the crew names no scene"),
    ("x: [-6, 10], y: [-6, 10]}\norigin", "x: [10, -6], y: [-6, 10]}\norigin", "[10, -6]", "swapped or empty range"),
    ("y: [2, 10]", "y: [2, 2]", "[2, 2]", "swapped or empty range: found [2, 2]; write [lowest, highest]"),
    ("y: [2, 10]", "y: [2, 11]", "{x: [-6, 10], y: [2, 11]}", "outside the operational area: found (10, 11)"),
    (", y: [2, 10]", "", "north", "zone north lacks y; write y: [lowest, highest]"),
    ("{aliases: [everywhere]}", "{x: [0, 1]}", "[0, 1]", "operational_area differs from the area; leave x out"),
    ("at: [-4, -4]", "at: [-4, -7]", "[-4, -7]", "found (-4, -7), allowed: x from -6 to 10, y from -6 to 10 m"),
    ("at: [-4, -4]", "at: [-4]", "[-4]", "found a list of 1, allowed: at least 2"),
    ("at: [-4, -4]", "at: [-4, 5 ft]", "5 ft", "allowed: a number; write the number alone, without a unit"),
    ("standoff_m: 0.3", "standoff_m: 0.3m", "0.3m", "without a unit, in metres"),
    ("standoff_m: 0.3", "standoff_m: -1", "-1}", "found -1, allowed: 0 or more"),
    ("lat_deg: 33.5", "lat_deg: 33.5°", "33.5°", "without a unit, in degrees"),
    ("lat_deg: 33.5", "lat_deg: 91", "91", "bad value of origin.lat_deg: found 91, allowed: 90 or less"),
    ("at: [-4, -4]", "at: [-4, .nan]", ".nan", "found nan, allowed: a finite number"),
    ("at: [-4, -4]", "at: [-4, .inf]", ".inf", "found inf, allowed: a finite number"),
    ("obstacles: [[1, 2, 0.5]]", "obstacles: [[1, 2, 0]]", "0]]", "found 0, allowed: more than 0 m"),
    ("contracts: [search_only]", "contracts: [abort, abort]", "abort]", "contract listed twice"),
    ("map: B", "map: 2", "2, seed", "bad value of sim.map: found 2, allowed: text; put quotes around it"),
    ("seed: 7", "seed: 7.5", "7.5", "allowed: a whole number"),
    ("kind: rover", "knd: rover", "knd", "unknown key of a robot: found 'knd'"),
    ("cube: {aliases: [block]}", "cube:", "\nvalues", None),
]  # fmt: skip


@pytest.mark.parametrize(("old", "new", "needle", "words"), [m for m in MISTAKES if m[3]])
def test_a_mistake_is_reported_at_its_node(old: str, new: str, needle: str, words: str) -> None:
    text = edited(TEXT, old, new)
    errors = errors_of(text)
    assert [said for line, column, said in errors if (line, column) == mark(text, needle) and words in said], errors


def test_an_entity_without_settings_is_written_with_braces() -> None:
    (error,) = errors_of(edited(TEXT, "cube: {aliases: [block]}", "cube:"))
    assert "bad value of objects.cube: found nothing, allowed: a mapping; write {} for an empty one" in error[2]


def test_an_alias_of_articles_alone_is_a_word_too() -> None:
    assert not errors_of(edited(TEXT, "aliases: [home]", "aliases: [the]"))


def test_the_same_alias_with_and_without_article_is_one_meaning() -> None:
    assert not errors_of(edited(TEXT, "aliases: [home]", "aliases: [home, the home, Base]"))


@settings(max_examples=80, deadline=None)
@given(st.data())
def test_a_mutated_crew_is_read_or_refused(data: st.DataObject) -> None:
    text = data.draw(st.sampled_from([TEXT, CREW_TEXT, *(path.read_text() for path in SHIPPED)]))
    words = st.sampled_from(["", " ", "\n", "{", "}", "[", "]", ":", "- ", "&a ", "true", "1e999", "''", "~"])
    for _ in range(data.draw(st.integers(1, 3))):
        start = data.draw(st.integers(0, len(text)))
        end = min(len(text), start + data.draw(st.integers(0, 12)))
        text = text[:start] + data.draw(words | st.text(max_size=4)) + text[end:]
    assert all(error.line >= 1 and error.column >= 1 for error in mistakes(crew_of, text))

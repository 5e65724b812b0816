"""The grammar of points, ranges and altitudes."""

import pytest

from crew.contracts.language.lexicon import Lexicon
from crew.contracts.language.mention import MentionKind
from crew.contracts.language.reading import read_request
from crew.contracts.plan import SlotValue, Spot, Zone

ZONES = {
    "x from -5.5 to 5.5 and y from 0 to 4": Zone(-5.5, 5.5, 0, 4),
    "y from 0 to 4, x from -5.5 to 5.5": Zone(-5.5, 5.5, 0, 4),
    "between -4 and 4 on both axes": Zone(-4, 4, -4, 4),
    "x and y from -4 to 4": Zone(-4, 4, -4, 4),
    "x between 0 and 4 and y between -2 and 2": Zone(0, 4, -2, 2),
    "from (0,0) to (4,4)": Zone(0, 4, 0, 4),
    "between (4, 4) and (0, -1)": Zone(0, 4, -1, 4),
    "the box (0, 0) to (4, 4)": Zone(0, 4, 0, 4),
    "from x=0, y=0 to x=4, y=4": Zone(0, 4, 0, 4),
    "x minus two to five and y zero to three": Zone(-2, 5, 0, 3),
    "x from minus five point five to twenty one": Zone(-5.5, 21, -6, 10),
    "x in [0, 4] and y in [1, 2]": Zone(0, 4, 1, 2),
    "x = -2 to x = 6, y = 0 to y = 3": Zone(-2, 6, 0, 3),
    "from 0 to 5 in x and from -3 to 3 in y": Zone(0, 5, -3, 3),
    "the area x from 4 m to 0 m": Zone(0, 4, -6, 10),
}
POINTS = {
    "(7.5, 4.0)": Spot(7.5, 4),
    "7.5, 4": Spot(7.5, 4),
    "7.5 -4": Spot(7.5, -4),
    "x = 3 y = 4": Spot(3, 4),
    "y=4, x=3": Spot(3, 4),
    "x minus two, y five": Spot(-2, 5),
    "the point 3, 4": Spot(3, 4),
    "position (3 m, 4 m)": Spot(3, 4),
    "(\u22123, \u22124)": Spot(-3, -4),
    "(20, 0)": Spot(20, 0),
    "three and a half, minus 2 and a half": Spot(3.5, -2.5),
    "(999999, 0)": Spot(999999, 0),
}
ALTITUDES = {
    "at 5 m": 5,
    "at altitude 5": 5,
    "five metres high": 5,
    "at an altitude of 7.5 m": 7.5,
    "height: 3": 3,
    "at altitude one zero metres": 10,
    "at five and a half metres": 5.5,
}
NOT_READ = (
    "(3 ft, 4 ft)", "x from 0 to 4 km", "(3, 4, 5)", "1,000", "3", "at 5 m/s", "at 5 ft", "at 5", "at 5 pm",
    "2nd", "1e5, 2", "3.4.5, 2", "5\u00b2, 3", "\u0663, \u0664",
    "3, 4 and 5, 6", "50%, 20%", "one hundred, 4",
    "5 m away", "3 half, 4", "12345678, 4",
)  # fmt: skip


def figures(text: str, lexicon: Lexicon, kind: MentionKind) -> list[SlotValue]:
    return [v for m in read_request(text, lexicon).mentions if m.kind is kind for v in m.values]


@pytest.mark.parametrize(("text", "zone"), ZONES.items())
def test_ranges(text: str, zone: Zone, lexicon: Lexicon) -> None:
    reading = read_request(f"search {text}", lexicon)
    assert [v for m in reading.mentions if m.kind is not MentionKind.ACTION for v in m.values] == [zone]
    assert reading.unread == ()


@pytest.mark.parametrize(("text", "spot"), POINTS.items())
def test_points(text: str, spot: Spot, lexicon: Lexicon) -> None:
    reading = read_request(f"send the rover to {text}", lexicon)
    assert figures(reading.text, lexicon, MentionKind.POINT) == [spot]
    assert reading.unread == ()


@pytest.mark.parametrize(("text", "altitude"), ALTITUDES.items())
def test_altitudes(text: str, altitude: float, lexicon: Lexicon) -> None:
    assert figures(f"search the area {text}", lexicon, MentionKind.ALTITUDE) == [altitude]


@pytest.mark.parametrize("text", NOT_READ)
def test_what_is_no_plain_figure_in_metres_is_unread(text: str, lexicon: Lexicon) -> None:
    reading = read_request(f"send the rover to {text}", lexicon)
    kinds = {m.kind for m in reading.mentions}
    assert not kinds & {MentionKind.POINT, MentionKind.ZONE, MentionKind.ALTITUDE}
    assert reading.unread


def test_a_word_between_two_ranges_is_not_lost(lexicon: Lexicon) -> None:
    reading = read_request("search x from 0 to 4 not y from 1 to 2", lexicon)
    assert [m.positive for m in reading.mentions] == [True, True, False]


def test_travel_between_points_is_no_zone(lexicon: Lexicon) -> None:
    assert figures("drive the rover from (0,0) to (4,4)", lexicon, MentionKind.ZONE) == []


def test_names_are_not_read_as_figures(lexicon: Lexicon) -> None:
    reading = read_request("send tb 3 to base", lexicon)
    assert [m.values for m in reading.mentions if m.kind is MentionKind.ROBOT] == [("tb3",)]
    assert reading.unread == ()

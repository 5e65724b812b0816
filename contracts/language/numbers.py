"""The grammar of points, ranges and altitudes. It reads what is written and never clamps, rounds or completes a figure.

World ENU, metres. A range on one axis alone spans the operational area on the other.
"""

from collections.abc import Callable
from typing import NamedTuple

from crew.contracts.language.figures import figure, is_numeral, norm_at, skip
from crew.contracts.language.mention import MentionKind
from crew.contracts.language.ranges import BRACKETS, OTHER_AXIS, axis_range, labelled, ordered
from crew.contracts.language.tokens import Token
from crew.contracts.language.words import PLACE_NOUNS, ZONE_NOUNS
from crew.contracts.plan import SlotValue, Spot, Zone

_HEIGHT_NOUNS = frozenset(("altitude", "height", "elevation", "alt"))
_HEIGHT_TAILS = (
    ("above", "ground", "level"), ("above", "the", "ground"), ("above", "ground"), ("off", "the", "ground"),
    ("in", "the", "air"), ("in", "height"), ("overhead",), ("flight", "altitude"), ("flight", "height"),
    ("of", "altitude"), ("of", "height"), ("in", "altitude"),
    ("high",), ("altitude",), ("height",), ("up",), ("agl",),
)  # fmt: skip
_NOT_HEIGHT = frozenset(
    (
        "away",
        "from",
        "north",
        "south",
        "east",
        "west",
        "of",
        "per",
        "left",
        "right",
        "before",
        "behind",
        "ahead",
        "radius",
        "wide",
        "long",
        "apart",
        "around",
        "x",
        "y",
    )
)
_COMPASS = ("north", "south", "east", "west")
_BEFORE_HEIGHT = frozenset((*ZONE_NOUNS, *_COMPASS, ","))
_NOT_AROUND = frozenset(("around", "round", "near", "by", "within", "beside", "from", "of", "about", "past", "beyond"))
_FRAMES = frozenset((*ZONE_NOUNS, "rectangle", "box", "square", "strip", "range", "corners"))
_FRAME_LINKS = frozenset(("with", "where", "of", "between", "from", ",", ":", "for", "bounded", "by", "at", "in"))
_JOINTS = (",", ";", "and", "&")


class Figures(NamedTuple):
    """Something said in figures: the tokens `first` up to `after`."""

    first: int
    after: int
    kind: MentionKind
    value: SlotValue
    name: str


def read_figures(tokens: list[Token], area: Zone, takes_zone: Callable[[int], bool]) -> list[Figures]:
    """All points, zones and altitudes in figures. `takes_zone(at)`: whether the action before a token takes a zone."""
    found: list[Figures] = []
    at = 0 if any(is_numeral(tokens, k) for k in range(len(tokens))) else len(tokens)
    while at < len(tokens):
        hit = _zone(tokens, at, area, takes_zone) or _altitude(tokens, at) or _point_mention(tokens, at)
        if hit is not None and hit.kind is MentionKind.ZONE:
            hit = _with_frame(tokens, hit, found[-1].after if found else 0)
        if hit is not None:
            found.append(hit)
        at = at + 1 if hit is None else hit.after
    return found


def show_zone(zone: Zone) -> str:
    return f"x {zone.x_min:g} to {zone.x_max:g}, y {zone.y_min:g} to {zone.y_max:g}"


def _zone(tokens: list[Token], at: int, area: Zone, takes_zone: Callable[[int], bool]) -> Figures | None:
    corners = _corners(tokens, at, takes_zone)
    if corners is not None:
        return corners
    first = axis_range(tokens, at)
    if first is None:
        return None
    spans = dict.fromkeys(first.axes, first.span)
    after = first.after
    if len(first.axes) == 1:
        second = axis_range(tokens, skip(tokens, skip(tokens, after, ",", ";"), "and", "&"))
        if second is not None and second.axes == OTHER_AXIS[first.axes]:
            spans[second.axes] = second.span
            after = second.after
    x, y = spans.get("x", (area.x_min, area.x_max)), spans.get("y", (area.y_min, area.y_max))
    zone = Zone(x[0], x[1], y[0], y[1])
    return Figures(at, after, MentionKind.ZONE, zone, show_zone(zone))


def _corners(tokens: list[Token], at: int, takes_zone: Callable[[int], bool]) -> Figures | None:
    """`from (0, 0) to (4, 4)`, `between (0, 0) and (4, 4)`, `the box (0, 0) to (4, 4)`."""
    opener = norm_at(tokens, at)
    framed = opener == "between" or norm_at(tokens, at - 1) in _FRAMES
    first = _point(tokens, at + 1 if opener in ("from", "between") else at)
    if first is None or norm_at(tokens, first[1]) not in ("to", "and", "-", ","):
        return None
    second = _point(tokens, first[1] + 1)
    if second is None or not (framed or (opener == "from" and takes_zone(at))):
        return None
    (x_min, x_max), (y_min, y_max) = ordered(first[0].x, second[0].x), ordered(first[0].y, second[0].y)
    zone = Zone(x_min, x_max, y_min, y_max)
    return Figures(at, second[1], MentionKind.ZONE, zone, show_zone(zone))


def _with_frame(tokens: list[Token], hit: Figures, floor: int) -> Figures:
    """Take in the noun that announces the figures: `the area x from ...`, `the box between ...`."""
    first = hit.first
    while first - 1 >= floor and norm_at(tokens, first - 1) in _FRAME_LINKS:
        first -= 1
    if first - 1 >= floor and norm_at(tokens, first - 1) in _FRAMES:
        return hit._replace(first=first - 1)
    return hit


def _point_mention(tokens: list[Token], at: int) -> Figures | None:
    start = at
    while norm_at(tokens, at) in PLACE_NOUNS or (at > start and norm_at(tokens, at) in ("of", "at", ":", "=", "to")):
        at += 1
    bare = at > start or norm_at(tokens, at - 1) in ("to", "at", "towards")
    found = _point(tokens, at, spaced=bare)
    if found is None:
        return None
    return Figures(start, found[1], MentionKind.POINT, found[0], f"({found[0].x:g}, {found[0].y:g})")


def _point(tokens: list[Token], at: int, *, spaced: bool = False) -> tuple[Spot, int] | None:
    """`(7.5, 4.0)`, `7.5, 4`, `x = 3 y = 4`, and `7.5 4` if `spaced`."""
    opener = norm_at(tokens, at)
    inner = at + 1 if opener in BRACKETS else at
    first = labelled(tokens, inner)
    pair = (
        _labelled_pair(tokens, inner) if first is not None else _plain_pair(tokens, inner, opener in BRACKETS or spaced)
    )
    if pair is None:
        return None
    spot, after = pair
    if opener in BRACKETS:
        return (spot, after + 1) if norm_at(tokens, after) == BRACKETS[opener] else None
    return spot, after


def _labelled_pair(tokens: list[Token], at: int) -> tuple[Spot, int] | None:
    first = labelled(tokens, at)
    second = None if first is None else labelled(tokens, skip(tokens, first[1].after, *_JOINTS))
    if first is None or second is None or first[0] == second[0]:
        return None
    values = {first[0]: first[1].value, second[0]: second[1].value}
    return Spot(values["x"], values["y"]), second[1].after


def _plain_pair(tokens: list[Token], at: int, spaced: bool) -> tuple[Spot, int] | None:
    first = figure(tokens, at)
    if first is None:
        return None
    comma = norm_at(tokens, first.after) in (",", ";")
    second = figure(tokens, first.after + comma) if comma or spaced else None
    if second is None or _longer_list(tokens, at, second.after) or (comma and _thousands(tokens, first.after)):
        return None
    return Spot(first.value, second.value), second.after


def _longer_list(tokens: list[Token], at: int, after: int) -> bool:
    """Three figures in a row are no point in the plane."""
    if norm_at(tokens, at - 1) in (",", "and") and at > 1 and figure(tokens, at - 2) is not None:
        return True
    return figure(tokens, skip(tokens, after, ",", ";", "and")) is not None


def _thousands(tokens: list[Token], comma: int) -> bool:
    """`1,000` is a thousand or a decimal comma: not a point."""
    tail = tokens[comma + 1]
    glued = tokens[comma - 1].end == tokens[comma].start and tokens[comma].end == tail.start
    return glued and tail.norm.isdigit() and (len(tail.norm) == 3 or (len(tail.norm) > 1 and tail.norm[0] == "0"))


def _altitude(tokens: list[Token], at: int) -> Figures | None:
    start = at
    at = skip(tokens, skip(tokens, at, "at", "from", "to"), "an", "a", "the") if norm_at(tokens, at) != "a" else at
    if norm_at(tokens, at) in _HEIGHT_NOUNS:
        value = figure(tokens, skip(tokens, at + 1, "of", "=", ":", "is", "at"))
        return None if value is None else _height(tokens, start, value.value, value.after)
    value = figure(tokens, at)
    if value is None or not value.metres:
        return None
    tail = next((t for t in _HEIGHT_TAILS if _stands(tokens, value.after, t)), ())
    after = value.after + len(tail)
    bare = at == start and not _ends_a_search(tokens, at, after)
    if not tail and (bare or norm_at(tokens, after) in _NOT_HEIGHT):
        return None
    return _height(tokens, start, value.value, after)


def _ends_a_search(tokens: list[Token], at: int, after: int) -> bool:
    """`search the south half, 5 m`: behind a zone or a comma, at the end, and no distance from a thing."""
    opened = norm_at(tokens, at - 1) in _BEFORE_HEIGHT
    ends = norm_at(tokens, after) in ("", ".", "!", "?", "please")
    return opened and ends and not any(t.norm in _NOT_AROUND for t in tokens[:at])


def _height(tokens: list[Token], start: int, value: float, after: int) -> Figures:
    return Figures(start, after, MentionKind.ALTITUDE, value, f"{value:g} m high")


def _stands(tokens: list[Token], at: int, words: tuple[str, ...]) -> bool:
    return all(norm_at(tokens, at + k) == word for k, word in enumerate(words))

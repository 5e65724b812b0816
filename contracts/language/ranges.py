"""Ranges along an axis: `x from a to b`, `between a and b on both axes`, `x = a to x = b`."""

from typing import NamedTuple

from crew.contracts.language.figures import Figure, figure, norm_at, skip
from crew.contracts.language.tokens import Token

BRACKETS = {"(": ")", "[": "]"}
OTHER_AXIS = {"x": "y", "y": "x"}

Interval = tuple[float, float]


class AxisRange(NamedTuple):
    """One interval for the axes that it holds on, and the token after it."""

    axes: str
    span: Interval
    after: int


def axis_range(tokens: list[Token], at: int) -> AxisRange | None:
    """One range with the axis or axes that it is for, named before or behind it."""
    found = _labelled_span(tokens, at)
    if found is not None:
        return found
    found = _between(tokens, at)
    if found is not None:
        return found
    axes, after = _axes(tokens, skip(tokens, at, "for", "in", "on"))
    if axes:
        span = _span(tokens, skip(tokens, after, ":", "=", "in", "is", "range", "ranges", "axis"), opened=True)
        return None if span is None else AxisRange(axes, span[0], span[1])
    span = _span(tokens, at, opened=False)
    if span is None or norm_at(tokens, span[1]) not in ("in", "on", "along", "for"):
        return None
    axes, after = _axes(tokens, skip(tokens, span[1] + 1, "the"))
    return AxisRange(axes, span[0], skip(tokens, after, "axis", "axes", "direction", "directions")) if axes else None


def _between(tokens: list[Token], at: int) -> AxisRange | None:
    """`between x -2 and 3`, and `y 1 and 6` behind such a one."""
    opened = norm_at(tokens, at) == "between"
    axis, low_at = _axes(tokens, at + opened)
    chained = norm_at(tokens, at - 1) in ("and", ",") and any(t.norm == "between" for t in tokens[:at])
    low = figure(tokens, low_at) if len(axis) == 1 and (opened or chained) else None
    if low is None or norm_at(tokens, low.after) != "and":
        return None
    high = figure(tokens, low.after + 1)
    return None if high is None else AxisRange(axis, ordered(low.value, high.value), high.after)


def _axes(tokens: list[Token], at: int) -> tuple[str, int]:
    """`x`, `y`, `x and y`, `both axes`."""
    word = norm_at(tokens, at)
    if word in ("both", "each"):
        after = skip(tokens, at + 1, "axes", "axis", "directions", "coordinates")
        if after > at + 1:
            return "xy", after
        word, at = norm_at(tokens, at + 1), at + 1
    if word not in OTHER_AXIS:
        return "", at
    joined = norm_at(tokens, at + 1)
    if joined in ("and", ",", "&") and norm_at(tokens, at + 2) == OTHER_AXIS[word]:
        return "xy", at + 3
    return word, skip(tokens, at + 1, "axis", "coordinate", "coordinates")


def _span(tokens: list[Token], at: int, *, opened: bool) -> tuple[Interval, int] | None:
    """`from a to b`, `between a and b`, `[a, b]`; `a to b` only behind an axis (`opened`)."""
    opener = norm_at(tokens, at)
    links: tuple[str, ...]
    if opener in ("from", "between"):
        links = ("and", "to", "-") if opener == "between" else ("to", "until", "till", "through", "-", "up")
    elif opener in BRACKETS and opened:
        links = (",", ";", "to", "-")
    elif opened:
        opener, links, at = "", ("to", "-", "through"), at - 1
    else:
        return None
    low = figure(tokens, at + 1)
    if low is None or norm_at(tokens, low.after) not in links:
        return None
    high = figure(tokens, skip(tokens, low.after + 1, "to") if norm_at(tokens, low.after) == "up" else low.after + 1)
    if high is None:
        return None
    after = high.after
    if opener in BRACKETS:
        if norm_at(tokens, after) != BRACKETS[opener]:
            return None
        after += 1
    return ordered(low.value, high.value), after


def _labelled_span(tokens: list[Token], at: int) -> AxisRange | None:
    """`from x = 0 to x = 4`, `x = 0 to x = 4`."""
    low = labelled(tokens, skip(tokens, at, "from", "between"))
    if low is None or norm_at(tokens, low[1].after) not in ("to", "and"):
        return None
    high = labelled(tokens, low[1].after + 1)
    if high is None or high[0] != low[0]:
        return None
    return AxisRange(low[0], ordered(low[1].value, high[1].value), high[1].after)


def labelled(tokens: list[Token], at: int) -> tuple[str, Figure] | None:
    """`x = 3`, `x minus two`, `x: 3`, `x is 3`."""
    axis = norm_at(tokens, at)
    if axis not in OTHER_AXIS:
        return None
    after = skip(tokens, at + 1, "coordinate")
    value = figure(tokens, skip(tokens, after, "=", ":", "is", "equals", "at", "of"))
    return None if value is None else (axis, value)


def ordered(a: float, b: float) -> Interval:
    return (a, b) if a <= b else (b, a)

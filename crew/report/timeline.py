"""A mission's lanes as an SVG: bars with hover titles, refusals as red marks, one axis of seconds."""

from collections.abc import Iterator

from crew.history.lanes import MISSION, Lanes, Mark, Span
from crew.report.html import Html, join, tag

WIDTH = 1000
GUTTER = 96
LANE = 38
BAR = 24
TOP = 26
RIGHT = 14
CHAR = 6.4
"""About the width of a character of a label, in units of the drawing."""
MAX_TICKS = 11
_STEPS = (0.5, 1, 2, 5, 10, 15, 30, 60, 120, 300, 600, 900, 1800, 3600, 7200, 21600, 86400)
_LEGEND = (
    ("planning", "planning"),
    ("asking", "a person is asked"),
    ("held", "held"),
    ("executing", "executing"),
    ("skill", "a skill"),
    ("safe", "reaching a safe state"),
    ("failed", "failed, cancelled or unknown"),
)


def timeline(lanes: Lanes) -> Html:
    """The drawing with its legend."""
    scale = _Scale(lanes)
    height = TOP + LANE * len(lanes.names) + 8
    parts = [*_axis(scale, height), *_names(lanes)]
    parts += [_bar(span, lanes, scale) for span in lanes.spans if span.lane in lanes.names]
    parts += [_mark(mark, lanes, scale) for mark in lanes.marks if mark.lane in lanes.names]
    label = f"timeline of {len(lanes.names)} lanes over {scale.seconds:.1f} seconds"
    drawing = tag("svg", *parts, viewBox=f"0 0 {WIDTH} {height}", role="img", aria_label=label, class_="timeline")
    kinds = {span.kind for span in lanes.spans}
    keys = [
        _key(kind, words) for kind, words in _LEGEND if kind in kinds or (kind == "failed" and kinds & _ENDED_BADLY)
    ]
    marks = {mark.kind for mark in lanes.marks}
    keys += [
        _key(kind, words) for kind, words in (("refused", "refused"), ("value", "a value published")) if kind in marks
    ]
    return join([tag("div", drawing, class_="scroll"), tag("p", keys, class_="legend")])


_ENDED_BADLY = frozenset({"failed", "cancelled", "unknown"})


class _Scale:
    """Mission time to a place on the axis. Seconds count from the request."""

    def __init__(self, lanes: Lanes) -> None:
        self._start_ns = lanes.start_ns
        self.seconds = max((lanes.end_ns - lanes.start_ns) / 1e9, 0.1)

    def x(self, at_ns: int) -> float:
        return self.at((at_ns - self._start_ns) / 1e9)

    def at(self, seconds: float) -> float:
        share = min(max(seconds / self.seconds, 0.0), 1.0)
        return round(GUTTER + share * (WIDTH - GUTTER - RIGHT), 1)


def _axis(scale: _Scale, height: int) -> Iterator[Html]:
    step = next((s for s in _STEPS if scale.seconds / s <= MAX_TICKS), _STEPS[-1])
    for number in range(int(scale.seconds / step) + 1):
        x = scale.at(number * step)
        yield tag("line", x1=x, x2=x, y1=TOP - 4, y2=height - 6, class_="tick")
        yield tag("text", f"{number * step:g} s", x=x, y=TOP - 10, text_anchor="middle", class_="axis")


def _names(lanes: Lanes) -> Iterator[Html]:
    for row, name in enumerate(lanes.names):
        y = TOP + row * LANE
        yield tag("line", x1=0, x2=WIDTH, y1=y + LANE, y2=y + LANE, class_="rule")
        shown = name if len(name) <= 13 else f"{name[:12]}…"
        text = tag("text", shown, tag("title", name), x=0, y=y + LANE / 2 + 4, class_="lane")
        yield text


def _bar(span: Span, lanes: Lanes, scale: _Scale) -> Html:
    """One span. A label is written where it fits."""
    x, end = scale.x(span.start_ns), scale.x(span.end_ns)
    width = max(end - x, 2.0)
    y = _top(span.lane, lanes) + (LANE - BAR) / 2
    room = int((width - 10) / CHAR)
    label = span.label if len(span.label) <= room else ""
    faded = " open" if span.open else ""
    shape = tag("rect", x=x, y=y, width=width, height=BAR, rx=min(4.0, width / 2), class_=f"bar b-{span.kind}{faded}")
    words = tag("text", label, x=x + 6, y=y + BAR / 2 + 4, class_=f"label l-{span.kind}") if label else None
    return tag("g", tag("title", span.title), shape, words)


def _mark(mark: Mark, lanes: Lanes, scale: _Scale) -> Html:
    x, top = scale.x(mark.at_ns), _top(mark.lane, lanes)
    y = top + LANE / 2
    title = tag("title", mark.title)
    if mark.kind == "refused":
        line = tag("line", x1=x, x2=x, y1=top + 3, y2=top + LANE - 3, class_="m-refused-line")
        cross = tag("path", d=f"M{x - 7} {y} L{x} {y - 7} L{x + 7} {y} L{x} {y + 7} Z", class_="m-refused")
        return tag("g", title, line, cross)
    if mark.kind == "value":
        flag = tag("path", d=f"M{x - 6} {top + 1} L{x + 6} {top + 1} L{x} {top + 11} Z", class_="m-value")
        return tag("g", title, flag)
    if mark.kind == "seen":
        return tag("g", title, tag("circle", cx=x - 5 if x > GUTTER + 8 else x, cy=y, r=2.6, class_="m-seen"))
    return tag("g", title, tag("circle", cx=x, cy=y, r=6, class_=f"m-end m-{mark.kind}"))


def _top(lane: str, lanes: Lanes) -> float:
    return TOP + lanes.names.index(lane) * LANE


def _key(kind: str, words: str) -> Html:
    return tag("span", tag("i", class_=f"k-{kind}"), words)


__all__ = ["MISSION", "timeline"]

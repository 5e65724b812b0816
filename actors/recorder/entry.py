"""What a page shows, as data: the fold of a run's messages gives entries, and only `page` knows how they are drawn."""

import msgspec

from crew.contracts.plan import Zone
from crew.contracts.snapshot import Point


class Stamp(msgspec.Struct, frozen=True):
    """When: mission time, and the wall's since 1970."""

    at_ns: int
    wall_ns: int


class LaneChange(msgspec.Struct, frozen=True):
    """A lane is in another state from now on; an empty state leaves a gap."""

    lane: str
    state: str


class LogLine(msgspec.Struct, frozen=True):
    """One line of the log. `tone` chooses its colour; `level` is shown beside it: a code, or what it is about."""

    text: str
    tone: str
    level: str


class Document(msgspec.Struct, frozen=True):
    """The proposal as it stands now."""

    markdown: str


class Node(msgspec.Struct, frozen=True):
    """One step of a contract."""

    name: str
    label: str
    x: float
    y: float
    tone: str


class Graph(msgspec.Struct, frozen=True):
    """A contract as it stands now."""

    slot: str
    nodes: tuple[Node, ...]
    edges: tuple[tuple[str, str], ...]


class Mark(msgspec.Struct, frozen=True):
    """A place on the ground that matters: where a robot was sent, or a published value. `at` None takes it away."""

    name: str
    tone: str
    at: Point | None
    label: str = ""
    sigma_m: float | None = None


class Area(msgspec.Struct, frozen=True):
    """A rectangle that a robot works on; None takes it away."""

    name: str
    tone: str
    zone: Zone | None


class Measure(msgspec.Struct, frozen=True):
    """One value of a curve, such as `battery/iris`."""

    series: str
    value: float


class Whereabouts(msgspec.Struct, frozen=True):
    """Where a robot says that it is."""

    robot: str
    at: Point


Entry = LaneChange | LogLine | Document | Graph | Mark | Area | Measure | Whereabouts

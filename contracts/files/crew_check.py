"""What a crew file says as a whole: names that mean one thing, ranges the right way round, places inside the area."""

from collections.abc import Iterator

from crew.contracts.files.crew_model import AreaModel, CrewModel, ZoneModel
from crew.contracts.files.source import Loc, Problems, locate

AREA = "operational_area"
"""The zone that is the whole area."""
RESERVED = frozenset(
    {"mission", "planner", "request", "status", "clock", "sim", "gateway", "orchestrator", "router"}
    | {"simulation", "recorder", "operator", "guest"}
)
"""Keys and identities of the crew itself: no robot may bear them."""
_ARTICLES = ("the ", "a ", "an ")


def check(model: CrewModel, problems: Problems) -> None:
    """Every mistake of meaning in one crew file, added to `problems`."""
    _check_ranges(model.area, ("area",), problems)
    _check_robots(model, problems)
    _check_names(model, problems)
    for name, zone in model.zones.items():
        _check_zone(name, zone, model, problems)
    for name, place in model.locations.items():
        _check_inside([place.at], ("locations", name, "at"), model.area, problems)
    for index, (_, _, radius) in enumerate(model.obstacles):
        if radius <= 0:
            facts = {"observed": f"{radius:g}", "allowed": "more than 0 m"}
            problems.at(("obstacles", index, 2), "radius of an obstacle", **facts)
    for index, name in enumerate(model.contracts):
        if name in model.contracts[:index]:
            problems.at(("contracts", index), "contract listed twice", observed=repr(name), fix="remove one")


def _check_robots(model: CrewModel, problems: Problems) -> None:
    for name, robot in model.robots.items():
        loc: Loc = ("robots", name)
        if name in RESERVED:
            allowed = f"any name but {', '.join(sorted(RESERVED))}"
            problems.key(loc, "reserved name", observed=repr(name), allowed=allowed, fix="rename the robot")
        if (robot.sim is None) == (robot.connection is None):
            observed = "neither" if robot.sim is None else "both"
            fix = "`sim` for a simulated robot, `connection` for a real one"
            problems.key(loc, f"robot {name}", observed=observed, allowed="either `sim` or `connection`", fix=fix)
        if robot.sim is not None and model.sim is None:
            fix = "add `sim: {scene: ...}` to the crew, or give the robot a `connection`"
            problems.at((*loc, "sim"), f"robot {name} is simulated, but the crew names no scene", fix=fix)


def _check_ranges(written: AreaModel | ZoneModel, loc: Loc, problems: Problems) -> bool:
    good = True
    for axis, pair in (("x", written.x), ("y", written.y)):
        if pair is not None and not pair[0] < pair[1]:
            fix = "write [lowest, highest]"
            problems.at((*loc, axis), "swapped or empty range", observed=f"[{pair[0]:g}, {pair[1]:g}]", fix=fix)
            good = False
    return good


def _check_zone(name: str, zone: ZoneModel, model: CrewModel, problems: Problems) -> None:
    loc: Loc = ("zones", name)
    if name == AREA:
        for axis in ("x", "y"):
            if getattr(zone, axis) not in (None, getattr(model.area, axis)):
                fix = f"leave {axis} out: {AREA} is the area itself"
                problems.at((*loc, axis), f"{AREA} differs from the area", fix=fix)
        return
    lacking = [axis for axis in ("x", "y") if getattr(zone, axis) is None]
    if lacking:
        problems.key(loc, f"zone {name} lacks {' and '.join(lacking)}", fix=f"write {lacking[0]}: [lowest, highest]")
    elif _check_ranges(zone, loc, problems) and zone.x and zone.y:
        corners = [[x, y] for x, y in zip(zone.x, zone.y, strict=True)]
        _check_inside(corners, loc, model.area, problems)


def _check_inside(points: list[list[float]], loc: Loc, area: AreaModel, problems: Problems) -> None:
    """The first point that is outside is reported, if there is one."""
    for x, y in points:
        if not (area.x[0] <= x <= area.x[1] and area.y[0] <= y <= area.y[1]):
            allowed = f"x from {area.x[0]:g} to {area.x[1]:g}, y from {area.y[0]:g} to {area.y[1]:g} m"
            facts = {"observed": f"({x:g}, {y:g})", "allowed": allowed, "fix": "move it, or widen the area"}
            problems.at(loc, "outside the operational area", **facts)
            return


def _check_names(model: CrewModel, problems: Problems) -> None:
    """A name or alias means one thing in the whole crew, whatever its case, article or underscores."""
    owners: dict[str, tuple[Loc, int]] = {}
    for owner, loc, is_name, words in _spoken(model):
        meaning = plain_words(words)
        place = locate(problems.root, loc, key=is_name)
        first, line = owners.setdefault(meaning, (owner, place.line))
        if first != owner:
            fix = f"line {line} gives it to {_called(first)}; take it from one of the two"
            problems.add(place, f"{words!r} means two things", observed=f"also {_called(owner)}", fix=fix)


def _spoken(model: CrewModel) -> Iterator[tuple[Loc, Loc, bool, str]]:
    """Every name, then every alias: its owner, its place, whether it is the name, and the words."""
    groups = ("robots", "locations", "zones", "objects", "values")
    entities = [((group, name), entity) for group in groups for name, entity in getattr(model, group).items()]
    for owner, _ in entities:
        yield owner, owner, True, owner[1]
    for owner, entity in entities:
        for index, alias in enumerate(entity.aliases):
            yield owner, (*owner, "aliases", index), False, alias


def _called(owner: Loc) -> str:
    return f"{str(owner[0]).removesuffix('s')} {owner[1]}"


def plain_words(words: str) -> str:
    """Words as they are compared: small letters, single spaces, no article in front."""
    plain = " ".join(words.casefold().replace("_", " ").split())
    for article in _ARTICLES:
        plain = plain.removeprefix(article)
    return plain

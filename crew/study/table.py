"""Tables of a study, in Markdown, from its results alone."""

from collections.abc import Iterator, Sequence
from importlib.metadata import version
from statistics import mean, stdev

import msgspec

from crew.study.mission import Measured


class Study(msgspec.Struct, frozen=True, kw_only=True):
    """What was measured, and with which version."""

    version: str
    missions: tuple[Measured, ...] = ()

    @classmethod
    def begun(cls) -> "Study":
        """A study with nothing measured yet."""
        return cls(version=version("robot-crew"))


def page(study: Study) -> str:
    """All tables."""
    parts = (_head(study), _accuracy(study), _faults(study), _sights(study))
    return "\n".join(line for part in parts for line in part)


def _head(study: Study) -> Iterator[str]:
    yield "# The air-ground crew in numbers"
    yield ""
    yield f"Made by `python -m crew.study.air_ground` with version {study.version}, from `air_ground.json` beside this"
    yield "page; every mission is a `crew demo` at full speed, with the noise of `sim/noise.py`. Errors are horizontal,"
    yield "in metres, against the simulation's truth. A mission is repeated by its map, seed and fault; digits may"
    yield "differ slightly, for the order of work in different processes is free."
    yield ""


def _accuracy(study: Study) -> Iterator[str]:
    missions = [m for m in study.missions if m.scenario.name == "accuracy"]
    yield "## From the request to the person"
    yield ""
    yield "The fix error is the drone's; the navigation error is how far the rover stands from the stand-off circle"
    yield "(0.25 m) around the fix; the distance is from the rover to the person, stand-off included. Mean, standard"
    yield "deviation and largest of each. The paper reports a mean distance of 0.465 m."
    yield ""
    yield "| map | missions | completed | fix error | navigation error | distance to the person |"
    yield "|---|---|---|---|---|---|"
    maps = sorted({m.scenario.map for m in missions})
    for map_ in maps:
        yield _accuracy_row(map_, [m for m in missions if m.scenario.map == map_])
    yield _accuracy_row("all", missions)
    yield ""
    worst = max((m.goal_error_m for m in missions if m.goal_error_m is not None), default=0.0)
    within = sum(m.goal_error_m is not None and m.goal_error_m < 0.5 for m in missions)
    yield f"Within 0.5 m of the person: {within} of {len(missions)}; the largest distance is {worst:.3f} m."
    yield ""


def _accuracy_row(name: str, missions: Sequence[Measured]) -> str:
    completed = sum(m.outcome == "completed" for m in missions)
    fields = ("fix_error_m", "navigation_error_m", "goal_error_m")
    return " | ".join((f"| {name}", str(len(missions)), str(completed), *(_spread(missions, f) for f in fields))) + " |"


def _spread(missions: Sequence[Measured], field: str) -> str:
    values = [value for m in missions if (value := getattr(m, field)) is not None]
    if not values:
        return "none"
    spread = stdev(values) if len(values) > 1 else 0.0
    return f"{mean(values):.3f} ± {spread:.3f}, ≤ {max(values):.3f}"


def _faults(study: Study) -> Iterator[str]:
    yield "## What each fault leads to"
    yield ""
    yield "Map A, seed 0, the demo's request. `fault@20` begins 20 s after the simulation, while the drone searches,"
    yield "`fault@75` while the rover drives; the others are there from the start. Positions are the true ones when the"
    yield "mission ended: a drone that is in the air then is being landed by its own failsafe, and left alone."
    yield ""
    yield from _table([m for m in study.missions if m.scenario.name == "fault"], "fault")


def _sights(study: Study) -> Iterator[str]:
    yield "## What a person has to tell"
    yield ""
    yield "Variants of map A: two people, a decoy of another shape, a person outside the zone that was asked for (the"
    yield "north half) and one under a tree."
    yield ""
    missions = [m for m in study.missions if m.scenario.name == "sight"]
    yield from _table(missions, "map")
    for measured in missions:
        if measured.question:
            yield f"- `{measured.scenario.map}` asks: {measured.question}"
    yield ""


def _table(missions: Sequence[Measured], first: str) -> Iterator[str]:
    yield f"| {first} | outcome | code | sent to | ended at |"
    yield "|---|---|---|---|---|"
    for m in missions:
        name = ", ".join(m.scenario.faults) if first == "fault" else m.scenario.map
        sent = "; ".join(f"{robot}: {', '.join(skills)}" for robot, skills in m.dispatched.items()) or "nobody"
        yield f"| {name} | {m.outcome} | {m.code or '-'} | {sent} | {_ends(m)} |"
    yield ""


def _ends(measured: Measured) -> str:
    """Every robot's end; one that has not moved is said to be where it was."""
    return "; ".join(
        f"{robot} ({x:.1f}, {y:.1f}, {z:.1f})" if robot in measured.moved else f"{robot} where it was"
        for robot, (x, y, z) in measured.ends.items()
    )

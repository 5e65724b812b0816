"""Tables of a study, in Markdown, from its results alone."""

from collections import Counter
from collections.abc import Iterator, Sequence
from statistics import mean, stdev

import msgspec

from crew.study.mission import Measured


class Study(msgspec.Struct, frozen=True, kw_only=True):
    """What was measured; each mission says with which version."""

    missions: tuple[Measured, ...] = ()


def page(study: Study) -> str:
    """All tables."""
    parts = (_head(study), _accuracy(study), _faults(study), _sights(study))
    return "\n".join(line for part in parts for line in part)


def _head(study: Study) -> Iterator[str]:
    yield "# The air-ground crew in numbers"
    yield ""
    yield "Made by `python -m crew.study.air_ground` from `air_ground.json` beside this page; every mission is a"
    yield "`crew demo` at full speed, with the noise of `sim/noise.py`. Errors are horizontal, in metres, against the"
    yield "simulation's truth. A mission is repeated by its map, seed and fault; digits may differ slightly, for the"
    yield "order of work in different processes is free."
    yield ""
    yield f"Measured with {_versions(study.missions)}."
    yield ""


def _versions(missions: Sequence[Measured]) -> str:
    """How many missions were measured with which version; one that is measured again replaces what was there."""
    counts = Counter(m.version for m in missions)
    if len(counts) == 1:
        return f"version {next(iter(counts))}"
    told = [f"version {version} ({', '.join(_names(missions, version))})" for version in counts]
    return "; ".join(told) or "no version: nothing was measured yet"


def _names(missions: Sequence[Measured], version: str) -> Iterator[str]:
    """The missions of one version: seeds by map, and how many of another kind."""
    mine = [m.scenario for m in missions if m.version == version]
    for map_ in sorted({s.map for s in mine if s.name == "accuracy"}):
        seeds = sorted(s.seed for s in mine if s.name == "accuracy" and s.map == map_)
        yield f"map {map_} seeds {' '.join(map(str, seeds))}"
    for kind in ("fault", "sight"):
        if count := sum(s.name == kind for s in mine):
            yield f"{count} of the {kind}s"


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

"""The run as a whole on the page: can it be trusted, its missions, its robots at the end, where it is from."""

import time
from collections.abc import Iterator, Mapping
from pathlib import Path

from crew.contracts.gate.guard import age
from crew.contracts.refusal import show
from crew.contracts.snapshot import Point, RobotState, Snapshot
from crew.history.history import History
from crew.report.html import Html, join, tag
from crew.report.mission import outcome_of
from crew.verify import VerifyReport
from crew.visible import one_line

MAX_PROBLEMS = 20
MAX_NOTES = 60
ROUTINE = frozenset({"ready"})
"""Notes that say nothing unusual."""


def head(history: History, report: VerifyReport) -> Html:
    """The title, and when it was."""
    run = history.run
    crew = "a run" if run is None else run.rules.crew.name
    when = time.strftime("%d %B %Y, %H:%M:%S UTC", time.gmtime(history.first_wall_ns / 1e9))
    lasted_s = (history.last_wall_ns - history.first_wall_ns) / 1e9
    return tag(
        "header",
        tag("p", "crew report", class_="over"),
        tag("h1", crew),
        tag(
            "p",
            tag("span", report.run, class_="mono"),
            f" · began {when} · {lasted_s:.0f} s of wall time" if history.first_wall_ns else "",
            class_="soft",
        ),
    )


def verdict(report: VerifyReport, *, running: bool, folder: Path) -> Html:
    """Whether what follows can be believed."""
    command = tag("code", f"crew verify {folder.name}")
    if report.holds:
        decided = sum(report.replayed.get(kind, 0) for kind in ("decision", "validation", "judgement"))
        text = f" Chain and signatures hold; {decided} verdicts were made again and came out the same. Check it: "
        banner = tag("div", tag("b", "✓ This run verifies.", class_="allowed"), text, command, class_="banner good")
    else:
        shown = [tag("li", one_line(p, 500)) for p in report.problems[:MAX_PROBLEMS]]
        more = len(report.problems) - len(shown)
        rest = tag("li", f"and {more} more") if more > 0 else None
        words = tag("strong", "✗ DO NOT RELY ON THIS RUN. It does not verify.")
        banner = tag("div", words, tag("ul", shown, rest), class_="banner bad")
    remarks = [*report.notes, *(["the run still goes on: this is what was written so far"] if running else [])]
    notes = tag("div", [tag("p", f"Note: {note}") for note in remarks], class_="banner note") if remarks else None
    return join([banner, notes])


def overview(history: History) -> Html:
    """One row a mission; a single one tells of itself."""
    missions = list(history.missions.values())
    if history.rules is None:
        return tag("p", "The journal holds no readable record of its run: nothing in it can be followed.")
    if not missions:
        return tag("p", "No mission was asked for in this run.", class_="soft")
    if len(missions) == 1:
        return Html("")
    rows = [
        tag(
            "tr",
            tag("td", str(number), class_="n"),
            tag("td", tag("a", m.id, href=f"#mission-{m.id}"), class_="mono fit"),
            tag("td", one_line(m.state.request, 160)),
            tag("td", m.state.contract, class_="fit"),
            tag("td", tag("b", outcome_of(m), class_=outcome_of(m)), class_="fit"),
            tag("td", f"{((m.ended_ns or m.began_ns) - m.began_ns) / 1e9:.1f} s", class_="n"),
        )
        for number, m in enumerate(missions, start=1)
    ]
    heads = [tag("th", name) for name in ("", "mission", "request", "contract", "outcome", "time")]
    return tag("table", tag("thead", tag("tr", heads)), tag("tbody", rows))


def robots(history: History) -> Html | None:
    """Each robot as it was last known to the gate."""
    if not history.worlds:
        return None
    at_ns, world = max(history.worlds, key=lambda found: found[0])
    kinds = {r.name: r.kind for r in history.rules.crew.robots} if history.rules else {}
    rows = [_robot(state, kinds.get(name, ""), at_ns) for name, state in world.robots.items()]
    title = f"The robots as last judged, {at_ns / 1e9:.1f} s of mission time"
    stopped = tag("p", tag("b", "A stop of the whole crew was in force.", class_="refused")) if world.stopped else None
    heads = [tag("th", name) for name in ("robot", "kind", "state", "what telemetry showed", "oldest")]
    table = tag("table", tag("thead", tag("tr", heads)), tag("tbody", rows))
    return join([tag("h2", title), stopped, table, _values(world, at_ns)])


def _robot(state: RobotState, kind: str, at_ns: int) -> Html:
    condition = state.unavailable or ("stopped" if state.stopped else "available")
    facts = ", ".join(f"{name} {_fluent(s.value)}" for name, s in state.fluents.items())
    oldest_s = max((age(s.source_ns, at_ns) for s in state.fluents.values()), default=None)
    return tag(
        "tr",
        tag("td", tag("b", state.name), class_="fit"),
        tag("td", kind, class_="fit"),
        tag("td", condition, class_="fit " + ("allowed" if condition == "available" else "refused")),
        tag("td", facts or "nothing was heard"),
        tag("td", "" if oldest_s is None else f"{oldest_s:.1f} s", class_="n"),
    )


def _fluent(value: object) -> str:
    if isinstance(value, Point):
        return f"({value.x:.2f}, {value.y:.2f})"
    return f"{value:.3g}" if isinstance(value, float) else show(value)


def _values(world: Snapshot, at_ns: int) -> Html | None:
    found = [
        f"{name}: {v.reading.status}{'' if v.reading.position is None else ' at ' + _fluent(v.reading.position)}, "
        f"by {v.source}, {age(v.reading.stamp_ns, at_ns):.1f} s old"
        for name, v in world.values.items()
    ]
    return tag("p", "Published values: ", "; ".join(found), class_="small") if found else None


def notes(history: History) -> Html | None:
    """Stops, resets, lost robots, refused messages."""
    told = [note for note in history.notes if note.what not in ROUTINE]
    if not told:
        return None
    rows = [
        tag("tr", tag("td", f"{n.at_ns / 1e9:.2f} s", class_="n"), tag("td", n.what, class_="fit"), tag("td", n.text))
        for n in told[:MAX_NOTES]
    ]
    more = tag("p", f"and {len(told) - MAX_NOTES} more", class_="soft") if len(told) > MAX_NOTES else None
    return join([tag("h2", "Stops, losses and other remarks"), tag("table", tag("tbody", rows)), more])


def origin(history: History, report: VerifyReport) -> Html:
    """Versions and digests: what this was decided by."""
    run = history.run
    if run is None:
        return tag("section", tag("h2", "Where it is from"), tag("p", "The journal holds no record of its run."))
    facts: list[tuple[str, str]] = [
        ("run", run.run),
        ("version", run.version),
        ("epoch", str(run.epoch)),
        ("authorizer", run.authorizer),
        ("planner", run.planner),
        ("journal", f"{report.records} records, head {report.head or 'unknown'}"),
        ("rules", run.rules_digest),
        *((f"kind {name}", value) for name, value in run.rules.kinds.items()),
        *((f"contract {name}", contract.digest) for name, contract in run.rules.contracts.items()),
    ]
    return tag("section", tag("h2", "Where it is from"), tag("dl", list(_pairs(dict(facts))), class_="mono"))


def _pairs(facts: Mapping[str, str]) -> Iterator[Html]:
    for name, value in facts.items():
        yield tag("dt", name)
        yield tag("dd", value)

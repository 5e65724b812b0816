"""How things look on a terminal: plain lines, colour only where a person looks."""

import sys
from collections.abc import Iterable, Mapping
from typing import Any

import msgspec

from crew.messages import MissionEvent, PlannedStep

_COLOURS = {"red": "31", "green": "32", "amber": "33", "blue": "34", "dim": "2", "bold": "1"}
_BY_KIND = {"decision": "blue", "value": "green", "question": "amber", "plan": "bold"}


def coloured(text: str, colour: str) -> str:
    """The text in a colour, if standard output is a terminal."""
    return f"\033[{_COLOURS[colour]}m{text}\033[0m" if colour and sys.stdout.isatty() else text


def say(text: str = "") -> None:
    """One line, at once."""
    print(text, flush=True)


def say_json(value: Any) -> None:
    """One JSON object on one line."""
    say(msgspec.json.encode(value).decode())


def say_event(event: MissionEvent, *, with_mission: bool = False) -> None:
    """One line of a mission, and the plan with its sources where there is one."""
    mission = f"{event.mission} " if with_mission else ""
    line = f"{event.at_s:8.2f} s  {mission}{event.what:9} {event.text}"
    say(coloured(line, _colour(event)))
    if event.what == "plan" and event.steps:
        for text in plan_lines(event.steps):
            say(f"            {mission}{text}")


def plan_lines(steps: Iterable[PlannedStep]) -> list[str]:
    """A plan, one line a step and one an argument with where it came from."""
    lines = []
    for number, step in enumerate(steps, start=1):
        lines.append(f"{number}. {step.robot}.{step.skill} ({step.step})")
        lines += [f"     {name} = {shown(value):12} {step.sources.get(name, '')}" for name, value in step.args.items()]
    return lines


def shown(value: object) -> str:
    """An argument without needless decimals."""
    return f"{value:g}" if isinstance(value, float) else str(value)


def table(rows: Iterable[Mapping[str, str]]) -> list[str]:
    """Rows as aligned columns with a header; empty if there are none."""
    found = list(rows)
    if not found:
        return []
    widths = {name: max(len(name), *(len(row[name]) for row in found)) for name in found[0]}
    header = "  ".join(name.ljust(width) for name, width in widths.items()).rstrip()
    return [header, *("  ".join(row[n].ljust(w) for n, w in widths.items()).rstrip() for row in found)]


def _colour(event: MissionEvent) -> str:
    if event.final:
        return "green" if event.outcome == "completed" else "red"
    if event.code:
        return "red"
    return _BY_KIND.get(event.what, "")

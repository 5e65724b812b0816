"""`crew explain`: a run's decisions one by one, each with its check, its words, and what would have been accepted."""

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import msgspec

from crew.cli.output import coloured, say, say_json
from crew.cli.runs import find_run
from crew.cli.session import home
from crew.contracts.language.containment import Finding, check_reading
from crew.contracts.mission_state import ENDS, Phase
from crew.errors import UsageError
from crew.history.explanation import ALLOWED, ASKED, REFUSED, Explainer, Explanation
from crew.history.history import History, MissionHistory, Verdict, read_history
from crew.verify import VerifyReport
from crew.visible import one_line, visible

WIDTH = 15
COLOURS = {ALLOWED: "green", REFUSED: "red", ASKED: "amber"}


class MissionExplanation(msgspec.Struct, frozen=True, kw_only=True):
    """One mission: how it ended, which decision ended it, and every decision explained."""

    mission: str
    request: str
    outcome: str
    message: str
    decisive: int | None
    """The number of the refusal that ended it."""
    unread: str
    """What can be said against the request itself, where no plan was judged."""
    decisions: tuple[Explanation, ...]


def run_explain(run: Path, decision: int | None, runs: Path, key: Path | None, as_json: bool) -> int:
    """0; 1 if the run does not verify, for then nothing that it says can be relied on."""
    folder = find_run(run, runs)
    history, report = read_history(folder, home(), key_file=key)
    verdicts = _chosen(history, decision, folder)
    explainer = Explainer(folder, history) if history.rules is not None else None
    told = [
        _mission(mission, explainer, [v for v in verdicts if v.mission.id == mission.id], decision is not None)
        for mission in history.missions.values()
        if explainer is not None and (decision is None or any(v.mission.id == mission.id for v in verdicts))
    ]
    if as_json:
        say_json({"run": str(folder), "holds": report.holds, "problems": report.problems, "missions": told})
    else:
        _warn(report, goes_on=home().goes_on(folder), version=history.run.version if history.run else "")
        _say(told, folder, in_full=decision is not None)
        if history.rules is None:
            say("the journal holds no readable record of its run: nothing in it can be followed")
    return 0 if report.holds else 1


def _chosen(history: History, decision: int | None, folder: Path) -> list[Verdict]:
    """The verdict with this number, or all. Raises UsageError."""
    if decision is None:
        return history.verdicts
    if not 1 <= decision <= len(history.verdicts):
        known = f"1 to {len(history.verdicts)}" if history.verdicts else "none"
        raise UsageError(
            f"run {folder.name} has no decision {decision} (it has {known}); list them with crew explain {folder}"
        )
    return [history.verdicts[decision - 1]]


def _mission(
    mission: MissionHistory, explainer: Explainer, verdicts: list[Verdict], asked_for: bool
) -> MissionExplanation:
    refused = [v.number for v in mission.verdicts if v.refusal is not None]
    decisive = refused[-1] if refused and mission.state.phase is not Phase.COMPLETED else None
    finding = check_reading(mission.state.reading) if not mission.verdicts else None
    return MissionExplanation(
        mission=mission.id,
        request=mission.state.request,
        outcome=str(mission.state.phase),
        message=mission.state.message,
        decisive=decisive,
        unread=_said_against(finding, mission.state.request),
        decisions=tuple(explainer.explain(v, search=asked_for or v.number == decisive) for v in verdicts),
    )


def _said_against(finding: Finding | None, request: str) -> str:
    if finding is None:
        return ""
    words = "" if finding.span is None else f' (at "{request[slice(*finding.span)]}")'
    return f"{finding.code}: {finding.message}{words}"


# --- on a terminal


def _warn(report: VerifyReport, *, goes_on: bool, version: str) -> None:
    if not report.holds:
        say(coloured("THIS RUN DOES NOT VERIFY: do not rely on what follows", "red"))
        for problem in report.problems[:5]:
            say(coloured(f"  {one_line(problem, 300)}", "red"))
        say(f"  it was made by version {version or 'unknown'}; all that was found: crew verify")
    if goes_on:
        say(coloured("this run still goes on: this is what was written so far", "amber"))


def _say(told: list[MissionExplanation], folder: Path, *, in_full: bool) -> None:
    if not told:
        say(f"nothing was decided in {folder.name}")
    for mission in told:
        ended = mission.outcome if mission.outcome in ENDS else f"not ended ({mission.outcome})"
        say(f'mission {mission.mission}: "{one_line(mission.request, 300)}"')
        say(f"  {ended}: {one_line(mission.message, 600)}" if mission.message else f"  {ended}")
        if mission.unread:
            say(f"  {one_line(mission.unread, 600)}")
        for decision in mission.decisions:
            full = in_full or decision.number == mission.decisive or mission.decisive is None
            if full:
                say()
            for line in lines_of(decision, in_full=full):
                say(line)
        say()


def lines_of(explained: Explanation, *, in_full: bool) -> Iterator[str]:
    """One decision: a head line, and below it why."""
    code = f" {explained.code}" if explained.code else ""
    outcome = coloured(f"{explained.outcome}{code}", COLOURS[explained.outcome])
    unsent = " (never sent: the mission was ending)" if explained.never_sent else ""
    yield f"{explained.number:3}  {explained.at_s:7.2f} s  {outcome}: {one_line(explained.subject, 400)}{unsent}"
    if not in_full:
        return
    if explained.outcome != ALLOWED:
        yield f"       {one_line(explained.sentence, 1000)}"
    for name, value in _facts(explained):
        first, *more = visible(value).splitlines() or [""]
        yield f"       {name:{WIDTH}} {first}"
        yield from (f"       {'':{WIDTH}} {line}" for line in more)


def _facts(explained: Explanation) -> Iterator[tuple[str, str]]:
    if explained.group:
        yield "check", f"{explained.group}{f', at {explained.field}' if explained.field else ''}"
    if explained.observed:
        yield "observed", explained.observed
    if explained.allowed:
        yield "allowed", explained.allowed
    last = ""
    for check in explained.checks:
        yield ("" if check.group == last else str(check.group)), f"{check}{f'  [{check.line}]' if check.line else ''}"
        last = check.group
    if explained.line is not None and explained.outcome != ALLOWED:
        yield "line", f"{explained.line}\n{explained.line.text}" if explained.line.text else str(explained.line)
    if explained.words:
        yield "words", ", ".join(f'"{one_line(w.text, 80)}" {w.why}' for w in explained.words)
    yield from _change(explained)


def _change(explained: Explanation) -> Iterator[tuple[str, str]]:
    if explained.outcome != REFUSED:
        return
    change: Any = explained.change
    if change is None:
        yield "instead", "no small change was found that would have been accepted"
        return
    yield "instead", f"it would have been accepted with: {change}"
    yield "", f"(decided by the gate; {change.tried} cases tried)"
    if change.question:
        yield "", f"a person would still be asked: {change.question}"

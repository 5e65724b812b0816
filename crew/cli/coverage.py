"""`crew contracts coverage`: what runs exercised, and what none of them has."""

from pathlib import Path
from typing import Any

from crew.cli.output import coloured, say, say_json, table
from crew.contracts.codes import GROUP_OF, Code
from crew.contracts.gate.guard import Truth
from crew.coverage import Tally, journals_in
from crew.errors import UsageError
from crew.library import load_rules


def run_coverage(runs: list[Path], crew: str, as_json: bool) -> int:
    """Count, and say what is missing; `crew` adds the contracts of a crew that no run may have used."""
    tally = Tally()
    if crew:
        tally.know(load_rules(crew).contracts)
    for journal in journals_in(runs):
        tally.add(journal)
    if not tally.runs:
        reasons = "; ".join(f"{run}: {why}" for run, why in tally.skipped.items())
        raise UsageError(f"none of the runs could be counted: {reasons}")
    if as_json:
        say_json(as_data(tally))
    else:
        _say(tally)
    return 0


def as_data(tally: Tally) -> dict[str, Any]:
    """The counts for machines; these fields stay."""
    return {
        "runs": tally.runs,
        "skipped": tally.skipped,
        "transitions": [
            {"phase": str(phase), "event": event, "to": str(to), "count": count}
            for (phase, event, to), count in tally.transitions.items()
        ],
        "codes": {str(code): count for code, count in tally.codes.items()},
        "steps": [
            {"contract": contract, "step": name, **counts} for (contract, name), counts in sorted(tally.fates.items())
        ],
        "guards": [
            {"contract": contract, "where": where, "line": line, "guard": words, **_truths(counts)}
            for (contract, where, line, words), counts in sorted(tally.guards.items())
        ],
        "covered": {
            "transitions": _share(tally.transitions.values()),
            "codes": _share(tally.codes.values()),
            "steps": _share(counts["done"] for counts in tally.fates.values()),
            "guards_held": _share(counts[Truth.HOLDS] for counts in tally.guards.values()),
            "guards_refused": _share(_refused(counts) for counts in tally.guards.values()),
        },
    }


def _share(counts: Any) -> list[int]:
    """How many were exercised, of how many."""
    found = list(counts)
    return [sum(1 for count in found if count), len(found)]


def _truths(counts: Any) -> dict[str, int]:
    return {"held": counts[Truth.HOLDS], "failed": counts[Truth.FAILS], "unknown": _unknown(counts)}


def _unknown(counts: Any) -> int:
    return int(counts[Truth.ABSENT] + counts[Truth.STALE])


def _refused(counts: Any) -> int:
    return int(counts[Truth.FAILS]) + _unknown(counts)


def _say(tally: Tally) -> None:
    data = as_data(tally)
    say(f"{len(tally.runs)} runs")
    for run, why in tally.skipped.items():
        say(coloured(f"skipped {run}: {why}", "amber"))
    for what, (some, every) in data["covered"].items():
        say(f"{what.replace('_', ' '):15} {some} of {every}")
    say()
    for line in table({k: str(v) for k, v in row.items()} for row in data["steps"]):
        say(line)
    say()
    for line in table({k: str(v) for k, v in row.items()} for row in data["guards"]):
        say(line)
    say()
    missed = [f"{row['phase']} -{row['event']}-> {row['to']}" for row in data["transitions"] if not row["count"]]
    say(f"transitions never taken ({len(missed)}): {', '.join(missed) or 'none'}")
    never = [f"{code} ({GROUP_OF[code]})" for code in Code if not tally.codes[code]]
    say(f"codes never given ({len(never)}): {', '.join(never) or 'none'}")

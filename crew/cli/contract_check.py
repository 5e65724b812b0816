"""`crew contracts check`: proves contracts, and tells the story of what breaks them."""

import time
from collections.abc import Iterator, Sequence
from pathlib import Path

import msgspec

from crew.cli.output import coloured, say, say_json
from crew.cli.progress import proof_progress
from crew.contracts.odd.look import oddities
from crew.contracts.proof.checker import LIMIT, check
from crew.contracts.proof.report import Fallback, Finding, Report
from crew.contracts.site import Rules
from crew.errors import CrewError, UsageError
from crew.library import crew_names, load_rules, read_text
from crew.proofs import tell

NOT_PROVED = UsageError.exit_code


class Verdict(msgspec.Struct, frozen=True, kw_only=True):
    """One contract in `crew contracts check --json`; these fields stay."""

    contract: str
    crew: str
    source: str
    proved: bool
    bound_reached: bool
    plans: int
    states: int
    transitions: int
    decisions: int
    seconds: float
    counterexample: tuple[str, ...] | None
    findings: tuple[Finding, ...]
    fallbacks: tuple[Fallback, ...]
    warnings: tuple[str, ...] = ()
    """What is legal but odd, with file, line and column; no reason to refuse."""


def run_check(files: Sequence[Path], crew: str, as_json: bool, limit: int = LIMIT) -> int:
    """0 if every contract is proved, 2 if one is not."""
    verdicts = []
    for rules, names in _wanted(files, crew):
        odd = warnings_of(rules)
        for name in names:
            began = time.perf_counter()
            with proof_progress() as progress:
                report = check(rules, name, limit=limit, progress=progress)
            seconds = round(time.perf_counter() - began, 3)
            verdicts.append(_verdict(report, rules, seconds, odd[name]))
            if not as_json:
                say_report(report, rules, seconds)
                for warning in odd[name]:
                    say(coloured(warning, "amber"))
    if as_json:
        say_json({"proved": all(v.proved for v in verdicts), "contracts": verdicts})
    return 0 if verdicts and all(v.proved for v in verdicts) else NOT_PROVED


def say_report(report: Report, rules: Rules, seconds: float) -> None:
    """One line for a proof, the whole story for anything else."""
    counts = f"{report.plans} plans, {report.states} states, {report.transitions} transitions"
    if report.proved:
        say(f"{coloured('proved', 'green')}      {report.contract:22} {counts}, {seconds:.1f} s")
        for line in _fallback_lines(report.fallbacks):
            say(coloured(f"            {line}", "dim"))
        return
    say(f"{coloured('not proved', 'red')}  {report.contract:22} {counts}, {seconds:.1f} s")
    for line in tell(report, rules)[1:]:
        say(line)


def warnings_of(rules: Rules) -> dict[str, tuple[str, ...]]:
    """What is legal but odd, by contract."""
    texts = {name: read_text(Path(contract.source)) for name, contract in rules.contracts.items()}
    found = oddities(rules, texts)
    return {n: tuple(str(o) for o in found if o.source == c.source) for n, c in rules.contracts.items()}


def _wanted(files: Sequence[Path], crew: str) -> Iterator[tuple[Rules, list[str]]]:
    """Rules, and the contracts to check in them: of the files, of a crew, or of every crew that is shipped."""
    if files:
        for path in files:
            rules = load_rules(crew, contracts=[path]) if crew else _rules_for(path)
            yield rules, [name for name, contract in rules.contracts.items() if contract.source == str(path)]
        return
    for name in [crew] if crew else crew_names():
        rules = load_rules(name)
        if not rules.contracts:
            raise UsageError(f"crew {name} has no contracts; name them in {rules.crew.source}")
        yield rules, list(rules.contracts)


def _rules_for(path: Path) -> Rules:
    """The shipped crew that a file is for: the one that names it, or else the first that it can be read with."""
    read_text(path)  # a file that is not there is nobody's
    named = [name for name in crew_names() if path.stem in load_rules(name).crew.contracts]
    others = [name for name in crew_names() if name not in named]
    first: CrewError | None = None
    for name in (*named, *others):
        try:
            return load_rules(name, contracts=[path])
        except CrewError as error:
            first = first or error
    raise UsageError(f"{first}\n(read for crew {(*named, *others)[0]}; name another one with --crew)")


def _verdict(report: Report, rules: Rules, seconds: float, warnings: tuple[str, ...]) -> Verdict:
    return Verdict(
        contract=report.contract,
        crew=rules.crew.name,
        source=rules.contracts[report.contract].source,
        proved=report.proved,
        bound_reached=report.bound_reached,
        plans=report.plans,
        states=report.states,
        transitions=report.transitions,
        decisions=report.decisions,
        seconds=seconds,
        counterexample=report.counterexample or None,
        findings=report.findings,
        fallbacks=report.fallbacks,
        warnings=warnings,
    )


def _fallback_lines(fallbacks: Sequence[Fallback]) -> list[str]:
    """One line for each robot: what it does by itself when it can't be commanded."""
    by_robot: dict[tuple[str, str], dict[str, None]] = {}
    for fallback in fallbacks:
        if fallback.why != "robot_leased":
            by_robot.setdefault((fallback.robot, fallback.role), {})[fallback.behaviour] = None
    return [f"if {robot} ({role}) can't be commanded: {'; '.join(found)}" for (robot, role), found in by_robot.items()]

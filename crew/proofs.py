"""Proofs of contracts, kept in the state folder: what was proved once is not proved again until anything changes.

Kept under a digest of the rules and of the core's own source, so that another checker never trusts an older one.
"""

import hashlib
from functools import cache
from pathlib import Path

import msgspec

from crew.contracts.proof.basis import basis
from crew.contracts.proof.report import Progress, Report
from crew.contracts.site import Rules
from crew.errors import UsageError
from crew.home import Home, replace_file

CORE = Path(__file__).parent / "contracts"
KEPT = 64
"""Files of proofs that are kept; the oldest go first."""


def prove(rules: Rules, home: Home, progress: Progress | None = None) -> dict[str, Report]:
    """The verdict on every contract of the rules. What was proved before with the same rules is read, not made."""
    path = home.proofs / f"{_key(rules)}.json"
    reports = _read(path)
    if missing := [name for name in rules.contracts if name not in reports]:
        from crew.contracts.proof.checker import check

        reports |= {name: check(rules, name, progress=progress) for name in missing}
        _keep(path, {name: report for name, report in reports.items() if report.proved})
    return {name: reports[name] for name in rules.contracts}


def ensure_proved(rules: Rules, home: Home, progress: Progress | None = None) -> None:
    """Raises UsageError with the story of every contract that is not proved."""
    refused = [report for report in prove(rules, home, progress).values() if not report.proved]
    if refused:
        names = ", ".join(report.contract for report in refused)
        told = "\n".join(line for report in refused for line in tell(report, rules))
        remedy = "correct the contract and try again: crew contracts check"
        raise UsageError(f"crew {rules.crew.name} is not started, for {names} is not proved\n{told}\n{remedy}")


def tell(report: Report, rules: Rules) -> list[str]:
    """A verdict that is not a proof, in lines: every finding with its story and its repair."""
    lines = [f"{report.contract}: not proved ({rules.contracts[report.contract].source})"]
    if report.bound_reached:
        lines.append(f"  bound of {report.limit} states reached: what lies beyond was not looked at")
    for finding in report.findings:
        lines.append(f"  {finding.rule}: {finding.message} [{', '.join(finding.where)}]")
        lines += [f"    {sentence}" for sentence in finding.story]
        lines += [f"    repair: {finding.repair}"] if finding.repair else []
    return lines


def _key(rules: Rules) -> str:
    return hashlib.sha256(f"{basis(rules)} {_checker()}".encode()).hexdigest()


@cache
def _checker() -> str:
    """Digest of the core's own source: the checker, the machine and the gate that it explores."""
    found = hashlib.sha256()
    for path in sorted(CORE.rglob("*.py")):
        found.update(str(path.relative_to(CORE)).encode() + b"\0" + path.read_bytes() + b"\0")
    return found.hexdigest()


def _read(path: Path) -> dict[str, Report]:
    """Reports as kept; an unreadable file is as good as none."""
    try:
        kept = msgspec.json.decode(path.read_bytes(), type=dict[str, Report])
    except (OSError, msgspec.MsgspecError):
        return {}
    return {name: report for name, report in kept.items() if report.proved and report.contract == name}


def _keep(path: Path, reports: dict[str, Report]) -> None:
    replace_file(path, msgspec.json.encode(reports), durable=False)
    oldest_first = sorted(path.parent.glob("*.json"), key=lambda p: p.stat().st_mtime_ns)
    for old in oldest_first[:-KEPT]:
        old.unlink(missing_ok=True)

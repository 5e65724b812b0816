"""`crew contracts new`: a first draft of a contract from the skills that it shall use, checked before it is written."""

from collections.abc import Sequence
from pathlib import Path

from msgspec.structs import replace

from crew.cli.output import coloured, say, say_json
from crew.contracts.contract import Contract
from crew.contracts.files.contract_file import load_contract
from crew.contracts.files.source import SourceErrors
from crew.contracts.odd.look import oddities
from crew.contracts.proof.checker import check
from crew.contracts.proof.report import Report
from crew.contracts.scaffold.draft import Draft
from crew.contracts.scaffold.wish import WishError, read_wish
from crew.contracts.site import Rules
from crew.errors import UsageError
from crew.library import crew_path, load_rules


def run_new(name: str, crew: str, do: Sequence[str], to: Path | None, as_json: bool) -> int:
    """Write the draft beside the crew file, or into a folder; nothing is overwritten."""
    rules = load_rules(crew)
    try:
        text = Draft(name, [read_wish(wish) for wish in do], rules).text()
    except WishError as error:
        raise UsageError(str(error)) from error
    path = _path(name, crew, to)
    try:
        contract = load_contract(text, source=str(path), crew=rules.crew, kinds=rules.kinds)
    except SourceErrors as errors:
        raise UsageError(f"the draft can't be read, so it was not written; correct --do:\n{errors}") from errors
    changed = replace(rules, contracts={**rules.contracts, name: contract})
    report = check(changed, name)
    if not report.proved:
        raise UsageError(f"{name} can't be proved as drafted, so it was not written:\n{_found(report)}")
    _write(path, text)
    _tell(path, contract, report, changed, text, as_json)
    return 0


def _path(name: str, crew: str, to: Path | None) -> Path:
    """A folder that was given, the crew file's own, or the current one for a shipped crew."""
    beside = Path() if not Path(crew).suffix and len(Path(crew).parts) == 1 else crew_path(crew).parent
    folder = to or beside
    if not folder.is_dir():
        raise UsageError(f"no folder {folder}; make it first, or name another with --to")
    return folder / f"{name}.yaml"


def _write(path: Path, text: str) -> None:
    try:
        with path.open("x", encoding="utf-8") as file:
            file.write(text)
    except FileExistsError as error:
        raise UsageError(f"{path} is there already; take another name, or move it away") from error
    except OSError as error:
        raise UsageError(f"cannot write {path}: {error.strerror}; name another folder with --to") from error


def _found(report: Report) -> str:
    findings = [f"{f.message}\n" + "\n".join(f"  {line}" for line in f.story) for f in report.findings]
    return "\n".join(findings) or f"more than {report.limit} states; give fewer steps"


def _tell(path: Path, contract: Contract, report: Report, rules: Rules, text: str, as_json: bool) -> None:
    odd = [str(oddity) for oddity in oddities(rules, {contract.name: text})]
    if as_json:
        say_json({"file": str(path), "contract": contract.name, "states": report.states, "warnings": odd})
        return
    say(f"wrote {path}: proved, {report.states} states")
    for warning in odd:
        say(coloured(warning, "amber"))
    say(f"next: write its summary and examples in your own words, and name it under contracts in {rules.crew.source}")

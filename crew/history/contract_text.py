"""The lines of a contract's file as it was when the run was decided; a file that has changed since is not shown."""

from collections.abc import Iterator, Mapping
from pathlib import Path

import msgspec
from msgspec.structs import replace

from crew.contracts.contract import Contract
from crew.contracts.site import Rules
from crew.errors import UsageError
from crew.library import CONTRACTS, read_text

FOLDER = "contracts"
"""Where a run keeps its contracts' files."""
MAX_LINES = 8


class Line(msgspec.Struct, frozen=True, kw_only=True):
    """A line of a contract with what is nested below it. `text` is empty if the file as it was is not to be had."""

    contract: str
    number: int
    text: str = ""

    def __str__(self) -> str:
        return f"{self.contract}:{self.number}"


class ContractTexts:
    """Finds each contract's file: beside the journal, or in the library."""

    def __init__(self, run_folder: Path, rules: Rules) -> None:
        self._folder, self._rules = run_folder, rules
        self._lines: dict[str, list[str]] = {}

    def line(self, reference: str) -> Line | None:
        """`search_only:31` with its text; None for what is no reference."""
        name, _, number = reference.rpartition(":")
        if not name or not number.isdigit():
            return None
        return Line(contract=name, number=int(number), text=_block(self._of(name), int(number)))

    def key(self, contract: str, key: str) -> Line | None:
        """The line of a top-level key."""
        for number, text in enumerate(self._of(contract), start=1):
            if text.startswith(f"{key}:"):
                return Line(contract=contract, number=number, text=_block(self._of(contract), number))
        return None

    def _of(self, name: str) -> list[str]:
        if name not in self._lines:
            self._lines[name] = self._find(name)
        return self._lines[name]

    def _find(self, name: str) -> list[str]:
        contract = self._rules.contracts.get(name)
        for path in () if contract is None else _places(self._folder, contract):
            text = _text(path)
            if contract is not None and text and _same(text, contract, self._rules):
                return text.splitlines()
        return []


def _places(folder: Path, contract: Contract) -> Iterator[Path]:
    yield folder / FOLDER / f"{contract.name}.yaml"
    yield CONTRACTS / f"{contract.name}.yaml"


def _text(path: Path) -> str:
    try:
        return read_text(path)
    except UsageError:
        return ""


def _same(text: str, contract: Contract, rules: Rules) -> bool:
    """Whether this text is the contract that the journal holds."""
    from crew.contracts.files.contract_file import load_contract
    from crew.contracts.files.source import SourceErrors

    try:
        loaded = load_contract(text, source=contract.source, crew=rules.crew, kinds=rules.kinds)
    except SourceErrors:
        return False
    return replace(loaded, source="") == replace(contract, source="")


def _block(lines: list[str], number: int) -> str:
    """A line and what is indented below it, without their common indentation."""
    if not 0 < number <= len(lines):
        return ""
    first = lines[number - 1]
    depth = len(first) - len(first.lstrip())
    block = [first[depth:]]
    for text in lines[number : number + MAX_LINES - 1]:
        if len(text) - len(text.lstrip()) <= depth or not text.strip():
            break
        block.append(text[depth:].rstrip())
    return "\n".join(block)


def keep_contracts(run_folder: Path, contracts: Mapping[str, Contract]) -> None:
    """Copy the files that the run's contracts were read from into its folder."""
    folder = run_folder / FOLDER
    folder.mkdir(exist_ok=True)
    for name, contract in contracts.items():
        if text := _text(Path(contract.source)):
            (folder / f"{name}.yaml").write_text(text, encoding="utf-8")

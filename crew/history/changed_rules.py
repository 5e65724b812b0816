"""The rules of a past run with some of its files changed: what `crew verify --against` decides by."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from msgspec.structs import replace

from crew.contracts.contract import Contract
from crew.contracts.files.contract_file import load_contract
from crew.contracts.files.crew_file import load_crew
from crew.contracts.files.source import SourceErrors, parse
from crew.contracts.site import Crew, Rules
from crew.errors import UsageError
from crew.history.contract_text import FOLDER
from crew.library import CONTRACTS, load_kind, read_text


def changed_rules(recorded: Rules, files: Sequence[Path]) -> Rules:
    """The recorded rules with these contract and crew files in place of what they replace.

    A contract replaces the one of its name, or is added. A crew replaces the crew; its contracts are those that lie
    beside it, then those of the run, then the shipped ones. Raises UsageError with every mistake of the files.
    """
    texts = {path: read_text(path) for path in files}
    crews = [path for path, text in texts.items() if _is_crew(text, path)]
    if len(crews) > 1:
        raise UsageError(f"{len(crews)} crew files in --against ({', '.join(map(str, crews))}); a run has one crew")
    crew = recorded.crew if not crews else _crew(texts[crews[0]], crews[0], recorded.crew)
    kinds = {robot.kind: load_kind(robot.kind) for robot in crew.robots}
    written = {path: text for path, text in texts.items() if path not in crews}
    beside = {path: read_text(path) for found in crews for path in _beside(found, crew)}
    given = _contracts({**beside, **written}, crew, kinds)
    kept = {n: c for n, c in recorded.contracts.items() if not crews or n in crew.contracts}
    shipped = {n for n in crew.contracts if n not in kept and n not in given} if crews else set()
    found = {CONTRACTS / f"{name}.yaml": read_text(CONTRACTS / f"{name}.yaml") for name in sorted(shipped)}
    return Rules(crew=crew, kinds=kinds, contracts={**kept, **_contracts(found, crew, kinds), **given})


def _is_crew(text: str, path: Path) -> bool:
    """Whether a file is a crew's, by its own word."""
    try:
        document = parse(text, file=str(path))
    except SourceErrors as errors:
        raise UsageError(str(errors)) from errors
    if ("crew" in document) == ("contract" in document):
        raise UsageError(f"{path} is neither a contract nor a crew file; its first key is contract: or crew:")
    return "crew" in document


def _crew(text: str, path: Path, recorded: Crew) -> Crew:
    """A crew file, on the site that the run was on."""
    try:
        crew = load_crew(text, source=str(path))
    except SourceErrors as errors:
        raise UsageError(str(errors)) from errors
    return replace(crew, sim=recorded.sim, origin=recorded.origin, obstacles=recorded.obstacles)


def _beside(crew_file: Path, crew: Crew) -> list[Path]:
    """The files of a crew's contracts that lie beside its own."""
    places = [
        folder / f"{name}.yaml" for name in crew.contracts for folder in (crew_file.parent, crew_file.parent / FOLDER)
    ]
    return [place for place in places if place.is_file() and place != crew_file]


def _contracts(texts: Mapping[Path, str], crew: Crew, kinds: Mapping[str, Any]) -> dict[str, Contract]:
    loaded: dict[str, Contract] = {}
    mistakes = []
    for path, text in texts.items():
        try:
            contract = load_contract(text, source=str(path), crew=crew, kinds=kinds)
        except SourceErrors as errors:
            mistakes.append(str(errors))
            continue
        loaded[contract.name] = contract
    if mistakes:
        raise UsageError("\n".join(mistakes))
    return loaded

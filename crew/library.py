"""The one reader of crew and contract files: finds them, reads them, and hands their text to the core.

Importing it stays cheap: the YAML reader and the models are imported when a file is loaded.
"""

from collections.abc import Mapping, Sequence
from functools import cache
from pathlib import Path
from pkgutil import resolve_name
from typing import TYPE_CHECKING

from crew.errors import UsageError, nearest

if TYPE_CHECKING:
    from importlib.metadata import EntryPoint

    from crew.contracts.contract import Contract
    from crew.contracts.site import Crew, Rules
    from crew.contracts.skill import Kind

KINDS_GROUP = "crew.kinds"
SHIPPED_KINDS = {
    "humanoid": "crew.contracts.kinds.humanoid:HUMANOID",
    "quadcopter": "crew.contracts.kinds.quadcopter:QUADCOPTER",
    "quadruped": "crew.contracts.kinds.quadruped:QUADRUPED",
    "rover": "crew.contracts.kinds.rover:ROVER",
}
"""Kinds of this distribution: looked up without reading what is installed, which every process of a crew would do."""
_HERE = Path(__file__).parent
CREWS = _HERE / "crews"
CONTRACTS = _HERE / "contracts" / "library"


def crew_names() -> list[str]:
    """The crews that are shipped."""
    return _stems(CREWS)


def contract_names() -> list[str]:
    """The contracts that are shipped."""
    return _stems(CONTRACTS)


def load_rules(crew: str | Path, *, contracts: Sequence[Path] = ()) -> "Rules":
    """A crew by its name or its file, with its kinds and contracts; `contracts` adds to them, or replaces by name.

    Raises UsageError with every mistake of every file.
    """
    from crew.contracts.site import Rules

    path = crew_path(crew)
    text = read_text(path)
    loaded = _load_crew(text, path)
    found = _find_contracts(loaded, path)
    _check_references(loaded, found, text)
    kinds = {spec.kind: load_kind(spec.kind) for spec in loaded.robots}
    _check_places(loaded, kinds, text)
    paths = [*(place for place in found.values() if place), *contracts]
    return Rules(crew=loaded, kinds=kinds, contracts=_load_contracts(paths, loaded, kinds))


def load_crew_file(crew: str | Path) -> "Crew":
    """A crew by its name or its file, without its kinds and contracts. Raises UsageError."""
    path = crew_path(crew)
    return _load_crew(read_text(path), path)


def demo_request(crew: str | Path) -> str:
    """What a demonstration asks of a crew. Raises UsageError if its file does not say, or can't be read."""
    from crew.contracts.files.crew_file import demo_request as read
    from crew.contracts.files.source import SourceErrors

    path = crew_path(crew)
    try:
        found = read(read_text(path), source=str(path))
    except SourceErrors as errors:
        raise UsageError(str(errors)) from errors
    if not found:
        raise UsageError(f"{path} has no demo: line; say what to ask for")
    return found


def crew_path(crew: str | Path) -> Path:
    """The file of a crew: text that ends in .yaml or .yml or holds a slash is a path, all else a name."""
    path = Path(crew)
    if isinstance(crew, Path) or path.suffix in (".yaml", ".yml") or len(path.parts) > 1:
        return path
    if crew not in crew_names():
        raise UsageError(f"no crew is called {crew!r}{nearest(crew, crew_names())}; or give the path of a crew file")
    return CREWS / f"{crew}.yaml"


def read_text(path: Path) -> str:
    """A file's text, UTF-8. Raises UsageError in plain words."""
    try:
        return path.read_bytes().decode("utf-8")
    except UnicodeDecodeError as error:
        raise UsageError(f"cannot read {path}: byte {error.start} is not UTF-8; save the file as UTF-8") from error
    except FileNotFoundError as error:
        raise UsageError(f"no file {path}; relative paths start at {Path.cwd()}") from error
    except IsADirectoryError as error:
        raise UsageError(f"{path} is a folder, not a file; name the YAML file inside it") from error
    except OSError as error:
        raise UsageError(f"cannot read {path}: {error.strerror}; check its permissions") from error


def kind_names() -> list[str]:
    """The kinds that are installed."""
    return sorted({*SHIPPED_KINDS, *_kind_entries()})


@cache
def load_kind(name: str) -> "Kind":
    """An installed kind by its name. Raises UsageError."""
    from crew.contracts.kind_check import mistakes
    from crew.contracts.skill import Kind

    place = SHIPPED_KINDS.get(name) or _installed_kind(name)
    try:
        kind = resolve_name(place)
    except (ImportError, AttributeError) as error:
        raise UsageError(f"kind {name!r} ({place}) can't be imported: {error}; reinstall its package") from error
    if not isinstance(kind, Kind) or kind.name != name:
        raise UsageError(f"{place} is not a kind called {name!r}; correct the entry point of group {KINDS_GROUP}")
    found = mistakes(kind)
    if found:
        told = "\n".join(f"  {text}" for text in found)
        raise UsageError(f"kind {name!r} ({place}) does not fit together:\n{told}")
    return kind


def _installed_kind(name: str) -> str:
    """Where a kind of another distribution is. Raises UsageError."""
    entry = _kind_entries().get(name)
    if entry is None:
        raise UsageError(f"no kind is called {name!r}{nearest(name, kind_names())}")
    return entry.value


@cache
def _kind_entries() -> "Mapping[str, EntryPoint]":
    from importlib.metadata import entry_points

    return {entry.name: entry for entry in entry_points(group=KINDS_GROUP)}


def _stems(folder: Path) -> list[str]:
    return sorted(path.stem for path in folder.glob("*.yaml"))


def _load_crew(text: str, path: Path) -> "Crew":
    from crew.contracts.files.crew_file import load_crew
    from crew.contracts.files.source import SourceErrors

    try:
        return load_crew(text, source=str(path))
    except SourceErrors as errors:
        raise UsageError(str(errors)) from errors


def _find_contracts(crew: "Crew", path: Path) -> dict[str, Path | None]:
    """Each contract that the crew names: a file beside the crew's own, or else a shipped one, or None."""
    found: dict[str, Path | None] = {}
    for name in crew.contracts:
        places = [path.parent / f"{name}.yaml", path.parent / "contracts" / f"{name}.yaml", CONTRACTS / f"{name}.yaml"]
        found[name] = next((place for place in places if place != path and place.is_file()), None)
    return found


def _check_references(crew: "Crew", contracts: Mapping[str, Path | None], text: str) -> None:
    """Kinds and contracts that the crew names must exist. Raises UsageError that points into its file."""
    kinds = kind_names()
    bad_kinds = [spec for spec in crew.robots if spec.kind not in kinds]
    bad_contracts = [index for index, name in enumerate(crew.contracts) if contracts[name] is None]
    if not bad_kinds and not bad_contracts:
        return
    from crew.contracts.files.source import Problems, SourceErrors, parse

    problems = Problems(crew.source, parse(text, file=crew.source))
    for spec in bad_kinds:
        problems.unknown(("robots", spec.name, "kind"), "unknown kind", spec.kind, kinds)
    for index in bad_contracts:
        fix = "a contract of your own lies beside the crew file"
        problems.unknown(("contracts", index), "no such contract", crew.contracts[index], contract_names(), fix=fix)
    raise UsageError(str(SourceErrors(problems.errors)))


def _check_places(crew: "Crew", kinds: Mapping[str, "Kind"], text: str) -> None:
    """Reach and parts, which a crew and its kinds declare together. Raises UsageError."""
    from crew.contracts.files.crew_place import check_places
    from crew.contracts.files.source import Problems, SourceErrors, parse

    problems = Problems(crew.source, parse(text, file=crew.source))
    check_places(crew, kinds, problems)
    if problems.errors:
        raise UsageError(str(SourceErrors(problems.errors)))


def _load_contracts(paths: Sequence[Path], crew: "Crew", kinds: Mapping[str, "Kind"]) -> dict[str, "Contract"]:
    from crew.contracts.files.contract_file import load_contract
    from crew.contracts.files.source import SourceErrors

    loaded: dict[str, Contract] = {}
    mistakes: list[str] = []
    for path in paths:
        try:
            contract = load_contract(read_text(path), source=str(path), crew=crew, kinds=kinds)
        except SourceErrors as errors:
            mistakes.append(str(errors))
            continue
        if contract.name != path.stem:
            mistakes.append(f"{path}: the contract is called {contract.name!r}; call the file {contract.name}.yaml")
        loaded[contract.name] = contract
    if mistakes:
        raise UsageError("\n".join(mistakes))
    return loaded

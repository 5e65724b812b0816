"""The reader of crew and contract files: what it finds, and what it says when it doesn't."""

import subprocess
import sys
from importlib.metadata import EntryPoint, distribution
from pathlib import Path

import pytest

from crew import library
from crew.actors.robot import fitting
from crew.contracts.files.source import SourceErrors, parse
from crew.contracts.kinds.rover import ROVER
from crew.errors import UsageError
from crew.library import contract_names, crew_names, kind_names, load_crew_file, load_kind, load_rules, read_text

CREW = """\
crew: mine
area: {x: [0, 10], y: [0, 10]}
robots:
  tb3: {kind: rover, adapter: mavlink, connection: "udp:1"}
contracts: [go_home]
"""
CONTRACT = """\
contract: go_home
summary: Drive to a place.
slots: {destination: {type: point}}
roles: {driver: {}}
asks: [go]
steps:
  go: {role: driver, do: {navigate_to: {x: $destination.x, y: $destination.y}}}
"""


@pytest.fixture
def crew_file(tmp_path: Path) -> Path:
    path = tmp_path / "mine.yaml"
    path.write_text(CREW)
    (tmp_path / "go_home.yaml").write_text(CONTRACT)
    return path


def test_a_shipped_crew_loads_by_name() -> None:
    rules = load_rules("air_ground")
    assert list(rules.contracts) == ["search_and_dispatch", "search_only", "dispatch_only", "abort"]
    assert set(rules.kinds) == {"quadcopter", "rover"}
    assert rules.kind_of("tb3") is ROVER


@pytest.mark.parametrize("name", crew_names())
def test_every_shipped_crew_loads(name: str) -> None:
    assert load_rules(name).crew.name == name


def test_what_is_shipped_is_listed() -> None:
    assert "air_ground" in crew_names()
    assert {"search_and_dispatch", "search_only", "dispatch_only", "abort"} <= set(contract_names())
    assert {"quadcopter", "rover"} <= set(kind_names())


def test_a_crew_of_ones_own_finds_contracts_beside_it(crew_file: Path) -> None:
    assert list(load_rules(crew_file).contracts) == ["go_home"]
    assert list(load_rules(str(crew_file)).contracts) == ["go_home"]


def test_a_contract_beside_the_crew_may_lie_in_a_folder(crew_file: Path) -> None:
    folder = crew_file.parent / "contracts"
    folder.mkdir()
    (crew_file.parent / "go_home.yaml").rename(folder / "go_home.yaml")
    assert list(load_rules(crew_file).contracts) == ["go_home"]


def test_a_crew_of_ones_own_may_name_shipped_contracts(crew_file: Path) -> None:
    crew_file.write_text(CREW.replace("[go_home]", "[dispatch_only]") + "values: {victim: {}}\n")
    assert list(load_rules(crew_file).contracts) == ["dispatch_only"]


def test_further_contracts_are_added_or_replace(crew_file: Path, tmp_path: Path) -> None:
    folder = tmp_path / "more"
    folder.mkdir()
    (folder / "go_home.yaml").write_text(CONTRACT.replace("Drive", "Walk"))
    (folder / "go_away.yaml").write_text(CONTRACT.replace("go_home", "go_away"))
    rules = load_rules(crew_file, contracts=[folder / "go_home.yaml", folder / "go_away.yaml"])
    assert {name: c.summary for name, c in rules.contracts.items()} == {
        "go_home": "Walk to a place.",
        "go_away": "Drive to a place.",
    }


def test_a_crew_alone_is_read_without_its_contracts(crew_file: Path) -> None:
    (crew_file.parent / "go_home.yaml").unlink()
    assert load_crew_file(crew_file).contracts == ("go_home",)


def test_an_unknown_crew_names_the_known_and_the_nearest() -> None:
    with pytest.raises(UsageError, match=r"no crew is called 'air_grund'; did you mean 'air_ground'\?.*path of a crew"):
        load_rules("air_grund")


def test_an_unknown_kind_is_reported_at_its_line(crew_file: Path) -> None:
    crew_file.write_text(CREW.replace("kind: rover", "kind: rovr"))
    with pytest.raises(UsageError) as caught:
        load_rules(crew_file)
    assert f"{crew_file}:4:15: unknown kind: found 'rovr', allowed: " in str(caught.value)
    assert "did you mean 'rover'?" in str(caught.value)


def test_an_unknown_contract_is_reported_at_its_line(crew_file: Path) -> None:
    crew_file.write_text(CREW.replace("[go_home]", "[search_onli]"))
    with pytest.raises(UsageError) as caught:
        load_rules(crew_file)
    assert f"{crew_file}:5:13: no such contract: found 'search_onli'" in str(caught.value)
    assert "did you mean 'search_only'?" in str(caught.value)


def test_mistakes_of_all_contracts_are_reported_together(crew_file: Path) -> None:
    crew_file.write_text(CREW.replace("[go_home]", "[go_home, go_away]"))
    bad = CONTRACT.replace("navigate_to", "navigate")
    for name in ("go_home", "go_away"):
        (crew_file.parent / f"{name}.yaml").write_text(bad.replace("go_home", name))
    with pytest.raises(UsageError) as caught:
        load_rules(crew_file)
    assert "go_home.yaml:7:27: unknown skill" in str(caught.value)
    assert "go_away.yaml:7:27: unknown skill" in str(caught.value)


def test_a_mistake_in_a_crew_is_a_usage_error(crew_file: Path) -> None:
    crew_file.write_text("crew: [")
    with pytest.raises(UsageError, match="not YAML"):
        load_rules(crew_file)


def test_a_contract_bears_the_name_of_its_file(crew_file: Path) -> None:
    (crew_file.parent / "go_home.yaml").write_text(CONTRACT.replace("go_home", "go_there"))
    with pytest.raises(UsageError, match=r"the contract is called 'go_there'; call the file go_there\.yaml"):
        load_rules(crew_file)


def test_a_missing_file_is_said_plainly(tmp_path: Path) -> None:
    with pytest.raises(UsageError, match=r"no file .*absent\.yaml; relative paths start at"):
        load_rules(tmp_path / "absent.yaml")


def test_a_folder_is_said_plainly(tmp_path: Path) -> None:
    with pytest.raises(UsageError, match="is a folder, not a file"):
        load_rules(tmp_path)


def test_text_that_is_not_utf_8_is_said_plainly(tmp_path: Path) -> None:
    path = tmp_path / "latin.yaml"
    path.write_bytes("crew: café".encode("latin-1"))
    with pytest.raises(UsageError, match="byte 9 is not UTF-8; save the file as UTF-8"):
        read_text(path)


def test_a_file_that_may_not_be_read_is_said_plainly(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(_: Path) -> bytes:
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr(Path, "read_bytes", refuse)
    with pytest.raises(UsageError, match="Permission denied; check its permissions"):
        read_text(tmp_path / "x.yaml")


@pytest.mark.parametrize(
    ("target", "words"),
    [
        ("no_such_package.kinds:KIND", "can't be imported"),
        ("crew.contracts.kinds.rover:ABSENT", "can't be imported"),
        ("crew.contracts.kinds.rover:ROVER", "is not a kind called 'broken'"),
        ("crew.errors:UsageError", "is not a kind called 'broken'"),
    ],
)
def test_a_broken_kind_is_said_plainly(monkeypatch: pytest.MonkeyPatch, target: str, words: str) -> None:
    entry = EntryPoint("broken", target, library.KINDS_GROUP)
    monkeypatch.setattr(library, "_kind_entries", lambda: {"broken": entry})
    with pytest.raises(UsageError, match=words):
        load_kind("broken")


def test_the_tables_of_what_is_shipped_are_the_distributions_entry_points() -> None:
    shipped = distribution("robot-crew").entry_points
    kinds = {entry.name: entry.value for entry in shipped.select(group=library.KINDS_GROUP)}
    adapters = {entry.name: entry.value for entry in shipped.select(group=fitting.ADAPTERS)}
    assert (kinds, adapters) == (library.SHIPPED_KINDS, fitting.SHIPPED)


def test_nobody_elses_kind_takes_the_name_of_a_shipped_one(monkeypatch: pytest.MonkeyPatch) -> None:
    entry = EntryPoint("rover", "no_such_package.kinds:ROVER", library.KINDS_GROUP)
    monkeypatch.setattr(library, "_kind_entries", lambda: {"rover": entry})
    load_kind.cache_clear()
    assert load_kind("rover").name == "rover"


def test_a_text_is_parsed_once_and_a_mistake_is_told_each_time() -> None:
    assert parse("a: 1", file="x.yaml") is parse("a: 1", file="x.yaml")
    assert parse("a: 1", file="x.yaml") is not parse("a: 1", file="y.yaml")
    for _ in range(2):
        with pytest.raises(SourceErrors, match=r"x\.yaml:1"):
            parse("a: [", file="x.yaml")


def test_an_unknown_kind_names_the_nearest() -> None:
    with pytest.raises(UsageError, match="did you mean 'quadcopter'"):
        load_kind("quadcoptr")


def test_importing_the_library_imports_no_reader() -> None:
    code = "import sys, crew.library; print(sorted({'pydantic', 'ruamel.yaml', 'msgspec'} & set(sys.modules)))"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"

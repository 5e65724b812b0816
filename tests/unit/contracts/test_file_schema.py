"""The published JSON Schemas: an independent validator takes what is shipped and refuses what the loader refuses."""

from pathlib import Path
from typing import Any

import pytest
from jsonschema import Draft202012Validator
from ruamel.yaml import YAML

from crew.contracts.files.contract_model import ContractModel
from crew.contracts.files.file_model import validate
from crew.contracts.files.source import Problems, parse
from crew.contracts.render.schema import contract_file_schema, crew_file_schema
from crew.library import CONTRACTS, CREWS

CONTRACT = Draft202012Validator(contract_file_schema())
CREW = Draft202012Validator(crew_file_schema())


def data(text: str) -> Any:
    return YAML(typ="safe").load(text)


def test_the_schemas_are_schemas() -> None:
    Draft202012Validator.check_schema(contract_file_schema())
    Draft202012Validator.check_schema(crew_file_schema())


@pytest.mark.parametrize("path", sorted(CONTRACTS.glob("*.yaml")), ids=lambda path: path.stem)
def test_every_shipped_contract_is_valid(path: Path) -> None:
    assert [*CONTRACT.iter_errors(data(path.read_text(encoding="utf-8")))] == []


@pytest.mark.parametrize("path", sorted(CREWS.glob("*.yaml")), ids=lambda path: path.stem)
def test_every_shipped_crew_is_valid(path: Path) -> None:
    assert [*CREW.iter_errors(data(path.read_text(encoding="utf-8")))] == []


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("optional: true", "optional: maybe"),
        ("asks: [deliver]\n", ""),
        ("said: from", "said: to"),
        ("    role: loader\n", "    role: loader\n    who: anyone\n"),
        ("deadline_s: 300", "deadline_s: 5 min"),
        ("deadline_s: 300", "deadline_s: -1"),
        ("{by: stop, reach", "{by: stop, within: 3, reach"),
        ("do: {pick_place: {object: $object, location: payload_tray}}", "do: []"),
        ("contract: carry", "contract: Carry It"),
    ],
)
def test_a_mistake_of_shape_is_refused_by_schema_and_loader_alike(old: str, new: str) -> None:
    text = (CONTRACTS / "carry.yaml").read_text(encoding="utf-8")
    assert old in text
    changed = text.replace(old, new, 1)
    assert [*CONTRACT.iter_errors(data(changed))]
    root = parse(changed, file="carry.yaml")
    problems = Problems("carry.yaml", root)
    validate(ContractModel, root, problems)
    assert problems.errors

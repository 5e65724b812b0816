"""The author's guide: its examples load, and its errors are the ones that are printed."""

import re
from pathlib import Path

import pytest

from crew.contracts.files.contract_file import load_contract
from crew.contracts.files.contract_model import ContractModel, NeverModel, SlotModel, StepModel
from crew.contracts.files.source import SourceErrors
from crew.contracts.site import Rules
from crew.library import load_rules

GUIDE = (Path(__file__).parents[3] / "docs" / "contracts.md").read_text(encoding="utf-8")
WHOLE = re.findall(r"```yaml contract\n(.*?)```", GUIDE, re.DOTALL)[0]
FRAGMENTS = re.findall(r"```yaml\n(.*?)```", GUIDE, re.DOTALL)
WRONG = re.findall(r"```yaml wrong\n(.*?)```\n```text\n(.*?)```", GUIDE, re.DOTALL)
TOP_KEY = re.compile(r"^(?=[a-z_]+:)", re.MULTILINE)


@pytest.fixture(scope="module")
def rules() -> Rules:
    return load_rules("air_ground")


def _blocks(text: str) -> dict[str, str]:
    """Top-level key to its lines."""
    return {block.partition(":")[0]: block for block in TOP_KEY.split(text) if block}


def _with(fragment: str) -> str:
    """The fragment, then the rest of the whole contract."""
    own = _blocks(fragment)
    return fragment + "".join(block for key, block in _blocks(WHOLE).items() if key not in own)


def test_the_whole_contract_loads(rules: Rules) -> None:
    contract = load_contract(WHOLE, source="guide", crew=rules.crew, kinds=rules.kinds)
    assert contract.name == "look_then_drive"


@pytest.mark.parametrize("fragment", FRAGMENTS, ids=lambda fragment: "_".join(_blocks(fragment)))
def test_every_example_loads(rules: Rules, fragment: str) -> None:
    load_contract(_with(fragment), source="guide", crew=rules.crew, kinds=rules.kinds)


@pytest.mark.parametrize(("fragment", "printed"), WRONG)
def test_the_errors_are_the_ones_that_are_printed(rules: Rules, fragment: str, printed: str) -> None:
    with pytest.raises(SourceErrors) as caught:
        load_contract(_with(fragment), source="look_then_drive.yaml", crew=rules.crew, kinds=rules.kinds)
    assert str(caught.value) == printed.rstrip()


def test_every_key_has_an_example() -> None:
    shown = WHOLE + "".join(FRAGMENTS)
    for model in (ContractModel, SlotModel, StepModel, NeverModel):
        for name, field in model.model_fields.items():
            assert re.search(rf"\b{field.alias or name}:", shown), f"{name} of {model.called} has no example"

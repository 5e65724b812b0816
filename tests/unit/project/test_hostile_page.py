"""The page of hostile cases names twenty, and each of its tests exists and is marked."""

import re
from pathlib import Path

import crew

ROOT = Path(crew.__file__).parents[1]
PAGE = (ROOT / "docs" / "hostile-cases.md").read_text(encoding="utf-8")


def test_there_are_twenty_cases() -> None:
    assert re.findall(r"^\| (\d+) \|", PAGE, re.MULTILINE) == [str(n) for n in range(1, 21)]


def test_every_named_test_exists_and_is_marked() -> None:
    named = set(re.findall(r"`(tests/[\w/]+\.py)::(test_\w+)`", PAGE))
    assert len(named) > 8
    for file, test in named:
        text = (ROOT / file).read_text(encoding="utf-8")
        whole_file = "pytestmark = pytest.mark.hostile" in text
        assert re.search(rf"^(async )?def {test}\(", text, re.MULTILINE), f"{file}::{test}"
        assert whole_file or re.search(rf"@pytest\.mark\.hostile\n(@.*\n)*(async )?def {test}\(", text), (
            f"unmarked {test}"
        )

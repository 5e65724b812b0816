"""Each broken contract of the zoo is found, with its shortest story and, where one is offered, a checked repair.

After a deliberate change: write `verdict(beast)` over the golden file and read the difference.
"""

from itertools import chain

import pytest

from tests.unit.contracts.proof.zoo import BEASTS, ZOO, golden, mistake, verdict


@pytest.mark.parametrize("beast", BEASTS)
def test_mistake_is_found_and_told(beast: str) -> None:
    told = verdict(beast)
    assert told, f"nothing found, although {mistake(beast)}"
    assert told == golden(beast).read_text(encoding="utf-8")


def test_zoo_has_every_sort_of_mistake() -> None:
    told = [golden(beast).read_text(encoding="utf-8") for beast in BEASTS]
    rules = {line.partition(":")[0] for text in told for line in text.splitlines() if not line.startswith(" ")}
    assert rules >= {
        "never",
        "dead_step",
        "cannot_complete",
        "unsafe_end",
        "unbound_value",
        "contradictory",
        "not read",
    }
    assert len(BEASTS) >= 20


def test_every_golden_file_belongs_to_a_beast() -> None:
    files = chain(ZOO.glob("*/*.txt"), ZOO.glob("*/*.yaml"))
    assert {path.with_suffix("") for path in files} == {golden(beast).with_suffix("") for beast in BEASTS}


def test_stories_end_after_the_fewest_events() -> None:
    """The shortest story: one dispatch less can't break it, since breadth comes first and plans are compared."""
    story = golden("humanoid_quadruped/load_guard_removed").read_text(encoding="utf-8").splitlines()
    sent = [line for line in story if " is sent" in line]
    assert len(sent) == 1, "the load itself breaks it; no approach is needed"

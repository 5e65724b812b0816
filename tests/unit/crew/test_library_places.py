"""Reach and parts: what a crew file says that makes sense only together with the kinds of its robots."""

from pathlib import Path

import pytest

from crew.errors import UsageError
from crew.library import CREWS, load_rules

TEXT = (CREWS / "humanoid_quadruped.yaml").read_text(encoding="utf-8")
REACH = "    reach: [table_a, table_b, payload_tray]\n"


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        (REACH, "", "g1 has no reach, which pick_place of a humanoid needs; write reach: [...]"),
        (REACH, "    reach: [tabel_a, payload_tray]\n", "unknown place: found 'tabel_a'"),
        ("    sim: go2\n", "    sim: go2\n    reach: [table_a]\n", "no skill of a quadruped places anything"),
        ("  room_a: {", "  payload_tray: {at: [0, 0]}\n  room_a: {", "'payload_tray' means the payload_tray of"),
        ("[first room]", "[first room, the tray]", "'the tray' means the payload_tray of go2 already"),
        (REACH, "    reach: [table_a, table_b]\n", "out of reach of g1: found 'payload_tray'"),
    ],
)  # fmt: skip
def test_places_that_do_not_fit_the_kinds_are_named(tmp_path: Path, old: str, new: str, words: str) -> None:
    assert TEXT.count(old) == 1
    path = tmp_path / "humanoid_quadruped.yaml"
    path.write_text(TEXT.replace(old, new), encoding="utf-8")
    with pytest.raises(UsageError) as raised:
        load_rules(path)
    assert words in str(raised.value)
    assert "yaml:" in str(raised.value)


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ("location: payload_tray", "location: room_b", "out of reach of g1: found 'room_b'"),
        ("    do: {navigate: {location: pickup}}", "    do: {navigate: {location: payload_tray}}", "unknown target"),
    ],
)
def test_a_contracts_own_places_must_be_reached_and_walked_to(tmp_path: Path, old: str, new: str, words: str) -> None:
    text = (CREWS.parent / "contracts" / "library" / "carry.yaml").read_text(encoding="utf-8")
    assert text.count(f"{old}}}") >= 1 or text.count(old) == 1
    (tmp_path / "crew.yaml").write_text(TEXT, encoding="utf-8")
    (tmp_path / "carry.yaml").write_text(text.replace(old, new, 1), encoding="utf-8")
    with pytest.raises(UsageError) as raised:
        load_rules(tmp_path / "crew.yaml")
    assert words in str(raised.value)


def test_a_tray_that_two_roles_could_have_is_refused(tmp_path: Path) -> None:
    two = TEXT.replace("locations:\n", "  go3: {kind: quadruped, adapter: unitree, sim: go3}\nlocations:\n", 1)
    text = (CREWS.parent / "contracts" / "library" / "carry.yaml").read_text(encoding="utf-8")
    escort = "steps:\n  escort: {role: guard, optional: true, do: {navigate: {location: room_a}}}\n"
    text = text.replace("asks:", "  guard: {safe: stay}\nasks:", 1).replace("steps:\n", escort, 1)
    (tmp_path / "crew.yaml").write_text(two, encoding="utf-8")
    (tmp_path / "carry.yaml").write_text(text, encoding="utf-8")
    with pytest.raises(UsageError) as raised:
        load_rules(tmp_path / "crew.yaml")
    assert "whose payload_tray is not clear: found roles with a payload_tray: carrier, guard" in str(raised.value)

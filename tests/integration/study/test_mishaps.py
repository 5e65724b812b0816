"""Every mishap of the humanoid and the quadruped in a full crew: how it ends, where the cube truly lies, who stands."""

import tempfile
from collections.abc import Iterator
from pathlib import Path

import pytest

from crew.home import Home
from crew.study.mishaps import MISHAPS, Mishap, carry_out

QUICK = ("object_dropped-near", "go2_falls-far", "g1_unavailable-near", "lease_held-far")
"""The others take a minute together: `make soak`; `tray_slip` is also tested with a process for every actor."""


@pytest.fixture(scope="module")
def home() -> Iterator[Home]:
    with tempfile.TemporaryDirectory() as folder:
        yield Home(Path(folder))


@pytest.mark.parametrize(
    "mishap", [pytest.param(m, id=m.name, marks=() if m.name in QUICK else pytest.mark.soak) for m in MISHAPS]
)
def test_a_mishap_ends_as_declared(mishap: Mishap, home: Home, tmp_path: Path) -> None:
    found = carry_out(mishap, home, tmp_path / "run")
    assert found.as_declared, found

"""Runs every attack against a crew that is up."""

import tempfile
from pathlib import Path

from tests.attack import insiders, strangers
from tests.attack.row import Row
from tests.attack.scene import scene_of
from tests.integration.crew.harness import Desk


def run() -> list[Row]:
    """Bring a crew up, attack it, bring it down; the table's rows."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        desk = Desk(folder)
        with desk.up() as up, scene_of(up.running) as scene:
            return [*strangers.attacks(scene, folder), *insiders.attacks(scene)]

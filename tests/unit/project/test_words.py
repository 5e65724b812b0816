"""What may not stand in a committed file: places on somebody's machine, and hosts of package registries."""

import re

from tests.unit.project.tree import ROOT, committed

PLACE = re.compile(r"/(root|work|home|Users)/\w")
HOSTS = ("pypi" + ".org", "pythonhosted" + ".org", "npmjs" + ".", "crates" + ".io", "deb.debian" + ".org")
TEXT = {".py", ".md", ".toml", ".yaml", ".yml", ".json", ".txt", ".xml", ".mmd", ".sh", ""}


def test_no_place_of_one_machine_and_no_registry() -> None:
    for path in committed():
        if path.suffix in TEXT and (ROOT / path).is_file():
            text = (ROOT / path).read_text(encoding="utf-8")
            place = PLACE.search(text)
            assert place is None, f"{path}: {place[0]}"
            assert [host for host in HOSTS if host in text] == [], path

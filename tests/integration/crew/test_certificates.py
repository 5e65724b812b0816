"""A person's side of the first lock: what is wrong is said, with exit code 2, and nothing starts without it."""

import json
import shutil
from collections.abc import Callable
from pathlib import Path

import pytest

from tests.attack.mint import mint
from tests.integration.crew.harness import NAME, Desk


@pytest.fixture(scope="module")
def sound(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A state folder with a crew's certificates as they should be."""
    desk = Desk(tmp_path_factory.mktemp("sound"))
    made = desk.crew("certs", "init")
    assert made.returncode == 0, made.stderr
    return desk.home.path


@pytest.fixture
def desk(sound: Path, tmp_path: Path) -> Desk:
    shutil.copytree(sound, tmp_path / "home")
    return Desk(tmp_path)


@pytest.fixture
def folder(desk: Desk) -> Path:
    return desk.home.certificates(NAME)


def _copy(folder: Path, source: str, target: str) -> None:
    shutil.copy(folder / source, folder / target)


def _expire(folder: Path) -> None:
    mint(folder, folder / "aside", "planner", expired=True)
    for kind in ("crt", "key"):
        shutil.copy(folder / "aside" / f"planner.{kind}", folder / f"planner.{kind}")


SPOILT: dict[str, tuple[Callable[[Path], object], str]] = {
    "missing": (lambda f: (f / "planner.crt").unlink(), "missing or unreadable certificate"),
    "unreadable": (lambda f: (f / "planner.key").write_text("nothing"), "broken key"),
    "swapped": (lambda f: _copy(f, "orchestrator.crt", "planner.crt"), "planner.crt is orchestrator's, not planner's"),
    "another's key": (lambda f: _copy(f, "orchestrator.key", "planner.key"), "swapped key"),
    "open": (lambda f: (f / "planner.key").chmod(0o644), "open to others"),
    "expired": (_expire, "expired certificate"),
    "no authority": (lambda f: (f / "authority.crt").unlink(), "authority.crt"),
}


@pytest.mark.parametrize("how", SPOILT)
def test_nothing_starts_with_a_bad_certificate(desk: Desk, folder: Path, how: str) -> None:
    spoil, words = SPOILT[how]
    spoil(folder)
    up = desk.crew("up", "--port", "0", timeout_s=20)
    assert up.returncode == 2
    assert words in up.stderr
    assert "crew certs rotate" in up.stderr
    assert "Traceback" not in up.stderr
    assert not desk.runs.exists(), "nothing was begun"
    doctor = desk.crew("doctor", "--json")
    assert doctor.returncode == 2
    (failed,) = [f for f in json.loads(doctor.stdout)["findings"] if f["verdict"] == "FAIL" and "cert" in f["what"]]
    assert words in failed["found"]
    assert failed["remedy"] == f"crew certs rotate {NAME}"


def test_rotation_puts_it_right(desk: Desk, folder: Path) -> None:
    _copy(folder, "orchestrator.crt", "planner.crt")
    assert desk.crew("certs", "show").returncode == 2
    assert desk.crew("certs", "rotate").returncode == 0
    assert desk.crew("certs", "show").returncode == 0


def test_no_key_is_ever_printed_or_logged(desk: Desk, folder: Path) -> None:
    with desk.up() as up:
        keys = {line for key in folder.glob("*.key") for line in key.read_text().splitlines() if "-----" not in line}
        written = [p for p in up.run.rglob("*") if p.is_file()] + [desk.home.path / "running" / f"{NAME}.json"]
        said = [up.said, *(p.read_bytes().decode(errors="replace") for p in written)]
        rotated = desk.crew("certs", "rotate")
        assert rotated.returncode == 2
        assert "end it first" in rotated.stderr
        shown = [desk.crew("certs", "show", "--json").stdout, desk.crew("doctor").stdout]
        tried = desk.crew("doctor", "--authority", timeout_s=60)
    assert keys
    assert not [key for key in keys for text in (*said, *shown) if key in text]
    assert tried.returncode == 0, tried.stdout
    assert "tried on the crew that runs" in tried.stdout
    assert tried.stdout.count("PASS") == 9
    assert "its heartbeat arrives" in tried.stdout
    assert "UNSECURED" not in up.said


def test_the_doctor_tries_the_rules_without_a_crew(desk: Desk) -> None:
    tried = desk.crew("doctor", "--authority", "--json", timeout_s=60)
    assert tried.returncode == 0, tried.stderr
    findings = json.loads(tried.stdout)["findings"]
    assert {f["what"]: f["verdict"] for f in findings} == dict.fromkeys(
        (
            "planner",
            "gateway",
            "simulation",
            "recorder",
            "operator",
            "robot-iris",
            "robot-tb3",
            "guest",
            "orchestrator",
        ),
        "PASS",
    )


@pytest.fixture
def bare(tmp_path: Path) -> Desk:
    return Desk(tmp_path)


def test_the_router_is_named_by_its_hosts_once(bare: Desk) -> None:
    assert bare.crew("certs", "show").returncode == 2
    made = bare.crew("certs", "init", "--host", "10.1.2.3")
    assert made.returncode == 0, made.stderr
    assert "10.1.2.3" in made.stdout
    other = bare.crew("certs", "init", "--host", "10.9.9.9")
    assert other.returncode == 2
    assert "crew certs rotate air_ground --host 10.9.9.9" in other.stderr

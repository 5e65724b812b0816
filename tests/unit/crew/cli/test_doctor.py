import socket
from pathlib import Path

import pytest

from crew.authority import EXPIRES_SOON, VALID, establish
from crew.cli import doctor
from crew.cli.doctor import Verdict, run_doctor, satisfies
from crew.home import Home
from crew.launch.table import roles
from crew.library import load_crew_file

CREW = load_crew_file("air_ground")


@pytest.fixture
def home(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Home:
    monkeypatch.setenv("CREW_HOME", str(tmp_path / "home"))
    return Home(tmp_path / "home")


@pytest.mark.parametrize(
    ("found", "wanted", "fine"),
    [
        ("1.10.2", ">=1.10.2,<1.11", True),
        ("1.10.1", ">=1.10.2,<1.11", False),
        ("1.11", ">=1.10.2,<1.11", False),
        ("1.9.9", ">=1.10,<2", False),
        ("0.41.3", "==0.41.*", True),
        ("0.42.0", "==0.41.*", False),
        ("4.0.0", "==4.0.0", True),
        ("4.0", "==4.0.0", True),
        ("2.0.0rc1", ">=1,<3", True),
        ("5", "", True),
    ],
)
def test_versions_are_compared_as_numbers(found: str, wanted: str, fine: bool) -> None:
    assert satisfies(found, wanted) is fine


def test_an_old_zenoh_fails_because_it_would_not_keep_the_rules(home: Home, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(doctor, "version", lambda name: "1.2.0" if name == "eclipse-zenoh" else "999")
    found = {f.found.split()[0]: f for f in doctor._packages(CREW, home)}
    assert found["eclipse-zenoh"].verdict is Verdict.FAIL
    assert found["eclipse-zenoh"].remedy.startswith("pip install 'eclipse-zenoh")


def test_a_taken_port_fails_with_the_command_that_shows_who_holds_it(home: Home) -> None:
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        assert not doctor._is_free(taken.getsockname()[1])
        taken.listen()
        assert not doctor._is_free(taken.getsockname()[1])


def test_keys_open_to_others_fail(home: Home, capsys: pytest.CaptureFixture[str]) -> None:
    (home.path / "keys").mkdir(parents=True, mode=0o700)
    (home.path / "keys" / "operator.key").write_bytes(b"")
    (home.path / "keys" / "operator.key").chmod(0o644)
    assert run_doctor("air_ground", authority=False, as_json=False) == 2
    assert f"chmod 0600 {home.path}/keys/operator.key" in capsys.readouterr().out


def test_certificates_that_expire_soon_are_a_warning(home: Home) -> None:
    from datetime import UTC, datetime, timedelta

    folder = home.certificates(CREW.name)
    establish(folder, roles(CREW), now=datetime.now(UTC))
    (sound,) = doctor._certificates(CREW, home)
    assert sound.verdict is Verdict.PASS
    assert timedelta() < EXPIRES_SOON < VALID


def test_no_certificates_yet_is_no_fault(home: Home) -> None:
    (found,) = doctor._certificates(CREW, home)
    assert found.verdict is Verdict.SKIP


def test_a_clock_behind_its_own_files_fails(home: Home) -> None:
    import os
    import time

    (home.path / "epochs").mkdir(parents=True)
    ahead = home.path / "epochs" / "demo"
    ahead.write_text("1")
    os.utime(ahead, (time.time_ns() / 1e9 + 3600,) * 2)
    (found,) = doctor._clock(CREW, home)
    assert found.verdict is Verdict.FAIL
    assert "behind what was written" in found.found

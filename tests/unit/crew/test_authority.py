import shutil
from datetime import UTC, datetime, timedelta
from pathlib import Path

import pytest
from cryptography import x509
from cryptography.exceptions import InvalidSignature
from cryptography.x509.oid import ExtendedKeyUsageOID

from crew.authority import BACKDATED, VALID, check, establish, hosts_of, rotate
from crew.errors import UsageError

ROLES = ["router", "orchestrator", "planner"]
NOW = datetime.now(UTC)
HOUR = timedelta(hours=1)


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    folder = tmp_path / "demo"
    establish(folder, ROLES, now=NOW)
    return folder


def certificate(folder: Path, role: str) -> x509.Certificate:
    return x509.load_pem_x509_certificate((folder / f"{role}.crt").read_bytes())


def refused(folder: Path, words: str, *, now: datetime = NOW) -> None:
    """Both the start of a crew and a look at it end with a sentence that names the file and what to do."""
    for attempt in (lambda: check(folder, ROLES, now=now), lambda: establish(folder, ROLES, now=now)):
        with pytest.raises(UsageError, match=words):
            attempt()


def test_everybody_gets_one_of_their_own_and_it_is_kept(folder: Path) -> None:
    first = check(folder, ROLES)
    assert [c.name for c in first] == ROLES
    assert len({c.fingerprint for c in first}) == len(ROLES)
    assert establish(folder, ROLES) == []
    assert check(folder, ROLES) == first


def test_keys_are_private(folder: Path) -> None:
    assert folder.stat().st_mode & 0o777 == 0o700
    keys = list(folder.glob("*.key"))
    assert len(keys) == len(ROLES) + 1
    assert {key.stat().st_mode & 0o777 for key in keys} == {0o600}


def test_only_the_router_can_serve_and_others_can_only_connect(folder: Path) -> None:
    for role in ROLES:
        usage = certificate(folder, role).extensions.get_extension_for_class(x509.ExtendedKeyUsage).value
        wanted = ExtendedKeyUsageOID.SERVER_AUTH if role == "router" else ExtendedKeyUsageOID.CLIENT_AUTH
        assert list(usage) == [wanted]
    assert hosts_of(folder) == ("127.0.0.1", "localhost")


def test_a_role_that_is_new_gets_its_certificate_and_the_rest_stays(folder: Path) -> None:
    before = check(folder, ROLES)
    assert establish(folder, [*ROLES, "robot-iris"]) == ["robot-iris"]
    assert check(folder, ROLES) == before


@pytest.mark.parametrize("skew", [-HOUR, HOUR])
def test_an_hour_of_clock_skew_does_no_harm(folder: Path, skew: timedelta) -> None:
    check(folder, ROLES, now=NOW + skew)
    establish(folder, ROLES, now=NOW + skew)


def test_an_expired_certificate(folder: Path) -> None:
    last = NOW + VALID - timedelta(seconds=1)
    check(folder, ROLES, now=last)
    refused(folder, r"expired certificate: .*router\.crt was valid until .*crew certs rotate", now=last + HOUR)


def test_a_certificate_from_the_future(folder: Path) -> None:
    refused(folder, r"certificate from the future: .*authority\.crt.*set the clock", now=NOW - BACKDATED - HOUR)


@pytest.mark.parametrize("name", ["authority.crt", "planner.crt", "planner.key"])
@pytest.mark.parametrize("how", ["missing", "folder", "empty", "garbage"])
def test_a_file_that_cannot_be_read(folder: Path, name: str, how: str) -> None:
    path = folder / name
    path.unlink()
    if how == "folder":
        path.mkdir()
    elif how != "missing":
        path.write_bytes(b"" if how == "empty" else b"\xff" * 99)
        path.chmod(0o600)
    kind = "certificate" if name.endswith("crt") else "key"
    word = "missing or unreadable" if how in ("missing", "folder") else "broken"
    refused(folder, rf"{word} {kind} .*{name}.*crew certs rotate")


def test_the_authoritys_key_is_needed_only_for_issuing(folder: Path) -> None:
    (folder / "authority.key").unlink()
    check(folder, ROLES)
    assert establish(folder, ROLES) == []
    with pytest.raises(UsageError, match=r"missing or unreadable key .*authority\.key"):
        establish(folder, [*ROLES, "robot-iris"])


def test_swapped_certificates(folder: Path) -> None:
    for kind in ("crt", "key"):
        shutil.copy(folder / f"orchestrator.{kind}", folder / f"planner.{kind}")
    refused(folder, r"swapped certificate: .*planner\.crt is orchestrator's, not planner's")


def test_a_swapped_key(folder: Path) -> None:
    shutil.copy(folder / "orchestrator.key", folder / "planner.key")
    refused(folder, r"swapped key: .*planner\.key does not belong to .*planner\.crt")


def test_another_authoritys_certificate(folder: Path, tmp_path: Path) -> None:
    other = tmp_path / "other"
    establish(other, ROLES)
    for kind in ("crt", "key"):
        shutil.copy(other / f"planner.{kind}", folder / f"planner.{kind}")
    refused(folder, r"foreign certificate: .*planner\.crt was not issued by .*authority\.crt")


@pytest.mark.parametrize("mode", [0o640, 0o604, 0o644, 0o660])
def test_a_key_open_to_others(folder: Path, mode: int) -> None:
    (folder / "planner.key").chmod(mode)
    refused(folder, rf"open to others: .*planner\.key has permissions {mode:04o}, not 0600; chmod 0600")


def test_a_folder_open_to_others(folder: Path) -> None:
    folder.chmod(0o755)
    with pytest.raises(UsageError, match=r"open to others: .*0755, not 0700; chmod 0700"):
        establish(folder, ROLES)


def test_a_linked_key_is_refused(folder: Path, tmp_path: Path) -> None:
    (folder / "planner.key").rename(tmp_path / "elsewhere")
    (folder / "planner.key").symlink_to(tmp_path / "elsewhere")
    refused(folder, r"missing or unreadable key .*planner\.key")


def test_a_folder_that_cannot_be_made(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    with pytest.raises(UsageError, match=r"unusable certificates in .*make the folder your own"):
        establish(tmp_path / "file" / "demo", ROLES)


def test_rotation_makes_all_earlier_ones_worthless(folder: Path, tmp_path: Path) -> None:
    before = certificate(folder, "planner")
    rotate(folder, ROLES, hosts=("10.0.0.5", "robots.example"))
    assert hosts_of(folder) == ("10.0.0.5", "robots.example")
    check(folder, ROLES)
    with pytest.raises((InvalidSignature, ValueError)):
        before.verify_directly_issued_by(certificate(folder, "authority"))
    assert [path.name for path in tmp_path.iterdir()] == ["demo"], "nothing of the old lies about"


def test_two_crews_do_not_trust_each_other(folder: Path, tmp_path: Path) -> None:
    establish(tmp_path / "other", ROLES)
    assert certificate(folder, "authority").public_key() != certificate(tmp_path / "other", "authority").public_key()


def test_a_name_that_is_too_long_for_a_certificate(folder: Path) -> None:
    with pytest.raises(UsageError, match=r"no certificate can be made for 'robot-xxx.*over 64 characters; rename it"):
        establish(folder, [*ROLES, f"robot-{'x' * 70}"])
    check(folder, ROLES)

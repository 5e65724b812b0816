from pathlib import Path

import pytest

from crew.errors import UsageError
from crew.signing import SigningKey, fingerprint, load_or_create_key, load_public_key, verify


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    return tmp_path / "keys"


def test_a_signature_verifies_for_its_key_purpose_and_message_only(folder: Path) -> None:
    key, other = load_or_create_key(folder, "a"), load_or_create_key(folder, "b")
    signature = key.sign("permit", b"go")
    assert verify(key.public, "permit", b"go", signature)
    assert not verify(other.public, "permit", b"go", signature)
    assert not verify(key.public, "journal-head", b"go", signature)
    assert not verify(key.public, "permit", b"gO", signature)
    assert not verify(key.public, "permit", b"go", signature[:-1])
    assert not verify(b"short", "permit", b"go", signature)


def test_a_key_is_made_once_and_private(folder: Path) -> None:
    first = load_or_create_key(folder, "orchestrator")
    assert load_or_create_key(folder, "orchestrator").public == first.public
    assert (folder / "orchestrator.key").stat().st_mode & 0o777 == 0o600
    assert folder.stat().st_mode & 0o777 == 0o700
    assert load_public_key(folder / "orchestrator.pub") == first.public
    assert sorted(path.name for path in folder.iterdir()) == ["orchestrator.key", "orchestrator.pub"]


@pytest.mark.parametrize("mode", [0o640, 0o604, 0o620, 0o601])
def test_a_key_open_to_others_is_refused(folder: Path, mode: int) -> None:
    load_or_create_key(folder, "a")
    (folder / "a.key").chmod(mode)
    with pytest.raises(UsageError, match=f"permissions {mode:04o}, not 0600; chmod 0600"):
        load_or_create_key(folder, "a")


def test_a_folder_open_to_others_is_refused(folder: Path) -> None:
    folder.mkdir(mode=0o755)
    folder.chmod(0o755)
    with pytest.raises(UsageError, match="permissions 0755, not 0700"):
        load_or_create_key(folder, "a")


def test_a_linked_key_is_refused(folder: Path, tmp_path: Path) -> None:
    load_or_create_key(folder, "a")
    (folder / "b.key").symlink_to(folder / "a.key")
    with pytest.raises(UsageError, match="not a link"):
        load_or_create_key(folder, "b")


@pytest.mark.parametrize("content", [b"", b"x" * 31, b"x" * 33])
def test_a_broken_key_is_refused(folder: Path, content: bytes) -> None:
    load_or_create_key(folder, "a")
    (folder / "a.key").write_bytes(content)
    with pytest.raises(UsageError, match="not 32 bytes"):
        load_or_create_key(folder, "a")


@pytest.mark.parametrize("content", ["", "zz", "00" * 31])
def test_a_broken_public_key_is_refused(tmp_path: Path, content: str) -> None:
    (tmp_path / "a.pub").write_text(content)
    with pytest.raises(UsageError, match="no public key"):
        load_public_key(tmp_path / "a.pub")


def test_a_key_shows_its_fingerprint_and_nothing_else() -> None:
    key = SigningKey(bytes(32))
    assert repr(key) == f"SigningKey({fingerprint(key.public)})"
    assert len(fingerprint(key.public)) == 19

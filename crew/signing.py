"""Ed25519 keys: kept in private files, used to sign permits and journal heads."""

import hashlib
import os
import stat
from contextlib import suppress
from functools import lru_cache
from pathlib import Path

from cryptography.exceptions import InvalidSignature
from cryptography.hazmat.primitives.asymmetric.ed25519 import Ed25519PrivateKey, Ed25519PublicKey

from crew.errors import UsageError

KEY_BYTES = 32


class SigningKey:
    """A private key. What is signed is bound to a purpose, so that one signature never serves for another."""

    def __init__(self, seed: bytes) -> None:
        self._key = Ed25519PrivateKey.from_private_bytes(seed)
        self.public = self._key.public_key().public_bytes_raw()
        """The public key's 32 bytes."""

    def __repr__(self) -> str:
        return f"SigningKey({fingerprint(self.public)})"

    def sign(self, purpose: str, message: bytes) -> bytes:
        """The signature's 64 bytes."""
        return self._key.sign(_bound(purpose, message))


def verify(public: bytes, purpose: str, message: bytes, signature: bytes) -> bool:
    """Whether `signature` is the one of `message` for this purpose by the owner of `public`."""
    try:
        _loaded(public).verify(signature, _bound(purpose, message))
    except (InvalidSignature, ValueError):
        return False
    return True


@lru_cache(maxsize=64)
def key_id(public: bytes) -> bytes:
    """Eight bytes that tell a public key from others; `fingerprint` shows the same to people."""
    return hashlib.sha256(public).digest()[:8]


def fingerprint(public: bytes) -> str:
    """A public key as a person compares it: 16 hexadecimal digits in groups of four."""
    digits = key_id(public).hex()
    return "-".join(digits[start : start + 4] for start in range(0, 16, 4))


def load_or_create_key(folder: Path, name: str) -> SigningKey:
    """The key `<folder>/<name>.key`, made if there is none; UsageError if others could read it or it is no key.

    The public half lies beside it as `<name>.pub`, in hexadecimal.
    """
    folder.mkdir(mode=0o700, parents=True, exist_ok=True)
    _refuse_open_to_others(folder, folder.stat().st_mode, "0700")
    path = folder / f"{name}.key"
    if not path.exists():
        _create(path)
    key = SigningKey(_private_bytes(path))
    (folder / f"{name}.pub").write_text(f"{key.public.hex()}\n")
    return key


def load_public_key(path: Path) -> bytes:
    """The 32 bytes in a `.pub` file; UsageError if it holds none."""
    try:
        public = bytes.fromhex(path.read_text())
    except (OSError, ValueError) as error:
        raise UsageError(f"no public key in {path}: {error}; copy the .pub file of the crew that ran") from error
    if len(public) != KEY_BYTES:
        raise UsageError(f"no public key in {path}: {len(public)} bytes, not {KEY_BYTES}; copy the .pub file again")
    return public


@lru_cache(maxsize=64)
def _loaded(public: bytes) -> Ed25519PublicKey:
    """A process verifies with very few keys, again and again."""
    return Ed25519PublicKey.from_public_bytes(public)


def _bound(purpose: str, message: bytes) -> bytes:
    return b"crew/" + purpose.encode() + b"\0" + message


def _create(path: Path) -> None:
    """Write a new key beside, complete, then link it: of two processes at once, one wins and both load its key."""
    fresh = path.with_name(f".{path.name}.{os.getpid()}")
    fd = os.open(fresh, os.O_WRONLY | os.O_CREAT | os.O_TRUNC | os.O_NOFOLLOW, 0o600)
    try:
        with os.fdopen(fd, "wb") as file:
            file.write(Ed25519PrivateKey.generate().private_bytes_raw())
            file.flush()
            os.fsync(file.fileno())
        with suppress(FileExistsError):
            os.link(fresh, path)
    finally:
        fresh.unlink()


def _private_bytes(path: Path) -> bytes:
    try:
        fd = os.open(path, os.O_RDONLY | os.O_NOFOLLOW)
    except OSError as error:
        raise UsageError(f"unreadable key {path}: {error.strerror}; make it your own file, not a link") from error
    with os.fdopen(fd, "rb") as file:
        _refuse_open_to_others(path, os.fstat(file.fileno()).st_mode, "0600")
        seed = file.read(KEY_BYTES + 1)
    if len(seed) != KEY_BYTES:
        raise UsageError(f"broken key {path}: not {KEY_BYTES} bytes; move it away and a new one is made")
    return seed


def _refuse_open_to_others(path: Path, mode: int, wanted: str) -> None:
    permissions = stat.S_IMODE(mode)
    if permissions & 0o077:
        raise UsageError(
            f"private key open to others at {path}: permissions {permissions:04o}, not {wanted}; "
            f"chmod {wanted} {path}, and delete the key if somebody may have read it"
        )

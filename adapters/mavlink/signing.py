"""Signed links: the key, and a parser that verifies a signature before it believes anything in the frame.

The protocol library stores a frame's time before it has verified the frame: one forged frame with a time in the future
would lock the true sender out. Here the signature comes first.
"""

import hashlib
import hmac
import stat
import time
from pathlib import Path
from typing import Any

from pymavlink.dialects.v20 import common as mavlink

from crew.errors import AdapterError

KEY_BYTES = 32
EPOCH_2015_NS = 1_420_070_400_000_000_000
TICK_NS = 10_000
"""Signatures count tens of microseconds since 2015."""


class SigningState:
    """One link's key and times, the same whoever sends: a frame is good once, wherever it comes from.

    `rejected` counts frames that were not signed, or not with this key, or replayed.
    """

    def __init__(self, key: bytes) -> None:
        self.shared: Any = mavlink.MAVLinkSigning()
        self.shared.secret_key = key
        self.shared.timestamp = (time.time_ns() - EPOCH_2015_NS) // TICK_NS
        self.shared.allow_unsigned_callback = self._reject
        self.rejected = 0

    def _reject(self, _: Any, __: int) -> bool:
        self.rejected += 1
        return False

    def sign(self, encoder: Any) -> None:
        """Let an encoder sign what it packs, in its own time."""
        encoder.signing.secret_key = self.shared.secret_key
        encoder.signing.timestamp = self.shared.timestamp
        encoder.signing.sign_outgoing = True


class VerifyingParser(mavlink.MAVLink):  # type: ignore[misc]
    """A parser that takes frames signed with one key only."""

    def __init__(self, state: SigningState) -> None:
        super().__init__(None)
        self.signing = state.shared

    def check_signature(self, msgbuf: bytearray, srcSystem: int, srcComponent: int) -> bool:  # noqa: N803
        """Whether the key made the signature, and then whether its time is newer than all before."""
        made = hashlib.sha256(self.signing.secret_key + bytes(msgbuf[:-6])).digest()[:6]
        if not hmac.compare_digest(made, bytes(msgbuf[-6:])):
            return False
        return bool(super().check_signature(msgbuf, srcSystem, srcComponent))


def read_key(robot: str, path: str) -> bytes:
    """The key in a file of 64 hexadecimal digits. Raises AdapterError `bad_option` in plain words."""
    file = Path(path).expanduser()
    try:
        text, mode = file.read_text(encoding="ascii"), file.stat().st_mode
    except (OSError, UnicodeDecodeError) as error:
        raise _bad(robot, f"cannot read {file}: {error}") from error
    if mode & (stat.S_IRGRP | stat.S_IROTH):
        raise _bad(robot, f"{file} can be read by others: chmod 600 it, and make a new key if others may have read it")
    try:
        key = bytes.fromhex(text.strip())
    except ValueError:
        key = b""
    if len(key) != KEY_BYTES:
        raise _bad(robot, f"{file} does not hold {2 * KEY_BYTES} hexadecimal digits")
    return key


def _bad(robot: str, what: str) -> AdapterError:
    return AdapterError(f"{robot}: signing_key: {what}", code="bad_option")

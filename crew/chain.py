"""The journal's hash chain and its signed head. Pure: no database and no files here."""

import hashlib
import struct
from typing import Protocol

import msgspec

from crew.signing import verify

HEAD_PURPOSE = "journal-head"

_GENESIS = b"crew journal 1\0"
_FIXED = struct.Struct(">QqqI")


class Signer(Protocol):
    """A private key, as `crew.signing.SigningKey` is."""

    @property
    def public(self) -> bytes: ...

    def sign(self, purpose: str, message: bytes) -> bytes: ...


class Head(msgspec.Struct, frozen=True, kw_only=True):
    """Where a journal's chain ended when this was signed. `seq` is 0 for an empty journal."""

    run_id: str
    seq: int
    hash: bytes
    wall_ns: int
    signature: bytes = b""

    def signed_by(self, key: Signer) -> "Head":
        return msgspec.structs.replace(self, signature=key.sign(HEAD_PURPOSE, self._signed_bytes()))

    def is_signed_by(self, public: bytes) -> bool:
        return verify(public, HEAD_PURPOSE, self._signed_bytes(), self.signature)

    def _signed_bytes(self) -> bytes:
        return msgspec.msgpack.encode((self.run_id, self.seq, self.hash, self.wall_ns))


def genesis(run_id: str) -> bytes:
    """The hash before the first record: it binds the chain to its run."""
    return hashlib.sha256(_GENESIS + run_id.encode()).digest()


def chained(previous: bytes, seq: int, kind: bytes, at_ns: int, wall_ns: int, body: bytes) -> bytes:
    """The hash of a record: over the previous hash and every column, unambiguously."""
    digest = hashlib.sha256(previous)
    digest.update(_FIXED.pack(seq, at_ns, wall_ns, len(kind)))
    digest.update(kind)
    digest.update(body)
    return digest.digest()

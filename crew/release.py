"""Resets: the operator's signature over exactly the stops that he has seen, and releases."""

import secrets
from collections.abc import Mapping

from msgspec.structs import replace

from crew.messages import RESET, Reset
from crew.signing import SigningKey

NONCE_BYTES = 16


def signed_reset(crew: str, targets: Mapping[str, str], key: SigningKey, *, by: str, epoch: int) -> Reset:
    """A reset of each named robot's latch, as its state or the crew's status showed it, with a nonce of its own."""
    unsigned = Reset(by=by, epoch=epoch, targets=targets, nonce=secrets.token_hex(NONCE_BYTES), signature=b"")
    return replace(unsigned, signature=key.sign(RESET, unsigned.signed_part(crew)))

"""Permits: the orchestrator's signature on everything that it tells a robot, and how a robot reads one."""

from typing import TypeVar

import msgspec
from msgspec.structs import replace

from crew.messages import CancelSkill, Dispatch, Heartbeat
from crew.signing import SigningKey, key_id, verify

PERMIT = "permit"
"""The purpose that every permit's signature is bound to."""
ID_BYTES = 8

Permitted = TypeVar("Permitted", Dispatch, CancelSkill, Heartbeat)
AnyPermitted = Dispatch | CancelSkill | Heartbeat
_ENCODER = msgspec.msgpack.Encoder(order="deterministic")


class PermitProblem(msgspec.Struct, frozen=True):
    """Why a permit is none of the orchestrator's: `no_permit`, `foreign_permit` or `altered`."""

    code: str
    detail: str


def permit(message: Permitted, crew: str, key: SigningKey) -> Permitted:
    """The message with its permit: the key's id, then the signature over crew, schema and every other field."""
    return replace(message, permit=key_id(key.public) + key.sign(PERMIT, _signed_part(message, crew)))


def permit_problem(message: AnyPermitted, crew: str, public: bytes) -> PermitProblem | None:
    """None if the owner of `public` signed exactly this message for this crew."""
    given = message.permit
    if not given:
        return PermitProblem("no_permit", "it carries no permit; only the orchestrator may command a robot")
    own = key_id(public)
    if given[:ID_BYTES] != own:
        named = given[:ID_BYTES].hex()
        return PermitProblem("foreign_permit", f"its permit names key {named}, the orchestrator's is {own.hex()}")
    if not verify(public, PERMIT, _signed_part(message, crew), given[ID_BYTES:]):
        return PermitProblem("altered", "its permit was not given for these contents: they were altered, or made up")
    return None


def _signed_part(message: AnyPermitted, crew: str) -> bytes:
    """Canonical: the whole message with an empty permit, so that no field can be left out of it."""
    head = f"{crew}\0{message.schema}/{message.version}\0".encode()
    return head + _ENCODER.encode(replace(message, permit=b""))

"""Messages as bytes. The encoding string names media type, schema and version: `application/msgpack;crew.x/1`.

What arrives from outside either becomes a message of the expected type or a `WireRefusal`; nothing else leaves here.
"""

import math
import re
from enum import StrEnum
from functools import cache
from typing import Any, ClassVar, TypeVar

import msgspec

from crew.errors import CrewError

MSGPACK = "application/msgpack"
JSON = "application/json"
DEFAULT_LIMIT_BYTES = 1 << 20

_NON_FINITE = {"nan": math.nan, "inf": math.inf, "-inf": -math.inf}
_FLOAT_TAG = re.compile(r"\$+float")
_UNREADABLE = (msgspec.MsgspecError, RecursionError, MemoryError, ValueError, OverflowError, TypeError)
_SHOWN_CHARS = 80


class Message(msgspec.Struct, frozen=True, kw_only=True):
    """Base of everything that travels on the bus: a subclass declares `schema` and `version`."""

    schema: ClassVar[str]
    version: ClassVar[int]


M = TypeVar("M", bound=Message)


class Refusal(StrEnum):
    """Why a payload was not taken."""

    OVERSIZED = "oversized"
    UNKNOWN_ENCODING = "unknown_encoding"
    UNKNOWN_SCHEMA = "unknown_schema"
    OLDER_VERSION = "older_version"
    NEWER_VERSION = "newer_version"
    TRUNCATED = "truncated"
    MALFORMED = "malformed"
    WRONG_TYPE = "wrong_type"


class WireRefusal(CrewError):  # noqa: N818 - an outcome, by the name the receivers count it under
    """A payload that is not the message expected; receivers count it by `reason` and go on."""

    def __init__(self, reason: Refusal, message: str) -> None:
        super().__init__(message)
        self.reason = reason


def encoding_of(message_type: type[Message], media: str = MSGPACK) -> str:
    """The encoding string of a message type."""
    return f"{media};{message_type.schema}/{message_type.version}"


def encode(message: Message) -> tuple[bytes, str]:
    """The message as msgpack, and its encoding."""
    return msgspec.msgpack.encode(message), _msgpack_encoding(type(message))


def encode_json(message: Message) -> tuple[bytes, str]:
    """The message as JSON that any client can read, and its encoding. Non-finite floats become `{"$float": "nan"}`."""
    plain = _tagged(msgspec.to_builtins(message, str_keys=True))
    return msgspec.json.encode(plain), encoding_of(type(message), JSON)


def decode(message_type: type[M], payload: bytes, encoding: str, *, limit_bytes: int = DEFAULT_LIMIT_BYTES) -> M:
    """The message in `payload`; WireRefusal for anything that is not one of `message_type`."""
    if len(payload) > limit_bytes:
        raise WireRefusal(
            Refusal.OVERSIZED,
            f"oversized {message_type.schema}: {len(payload)} bytes > {limit_bytes} bytes; send less in one message",
        )
    try:
        if encoding == _msgpack_encoding(message_type):
            message: M = _msgpack_decoder(message_type).decode(payload)
            return message
        if encoding == encoding_of(message_type, JSON):
            plain = _untagged(msgspec.json.decode(payload))
            return msgspec.convert(plain, message_type, str_keys=True)
    except _UNREADABLE as error:
        raise _unreadable(message_type, error) from error
    raise _misnamed(message_type, encoding)


@cache
def _msgpack_encoding(message_type: type[Message]) -> str:
    return encoding_of(message_type)


@cache
def _msgpack_decoder(message_type: type[M]) -> msgspec.msgpack.Decoder[M]:
    return msgspec.msgpack.Decoder(message_type)


def _unreadable(message_type: type[Message], error: Exception) -> WireRefusal:
    if isinstance(error, msgspec.ValidationError):
        reason = Refusal.WRONG_TYPE
    elif isinstance(error, msgspec.DecodeError) and "truncated" in str(error):
        reason = Refusal.TRUNCATED
    else:
        reason = Refusal.MALFORMED
    text = str(error) or type(error).__name__
    return WireRefusal(reason, f"{reason} {message_type.schema}/{message_type.version}: {text}; check the sender")


def _misnamed(message_type: type[Message], encoding: str) -> WireRefusal:
    expected = f"{message_type.schema}/{message_type.version}"
    media, _, named = encoding.partition(";")
    schema, _, version = named.rpartition("/")
    shown = encoding[:_SHOWN_CHARS]
    if media not in (MSGPACK, JSON):
        return WireRefusal(
            Refusal.UNKNOWN_ENCODING, f"unknown encoding {shown!r} for {expected}: send {MSGPACK} or {JSON}"
        )
    if schema != message_type.schema or not (version.isascii() and version.isdigit() and len(version) < 10):
        return WireRefusal(Refusal.UNKNOWN_SCHEMA, f"unknown schema {shown!r}: expected {expected}; check the sender")
    if int(version) < message_type.version:
        reason, remedy = Refusal.OLDER_VERSION, "upgrade the sender"
    else:
        reason, remedy = Refusal.NEWER_VERSION, "upgrade this receiver"
    return WireRefusal(reason, f"{reason} {shown!r}: expected {expected}; {remedy}")


def _tagged(value: Any) -> Any:
    """Builtins with each non-finite float tagged; a mapping that looks like a tag gets one more `$`."""
    if isinstance(value, float):
        return value if math.isfinite(value) else {"$float": str(value)}
    if isinstance(value, dict):
        tagged = {key: _tagged(item) for key, item in value.items()}
        return {f"${_only_key(tagged)}": item for item in tagged.values()} if _looks_tagged(tagged) else tagged
    if isinstance(value, list | tuple):
        return [_tagged(item) for item in value]
    return value


def _untagged(value: Any) -> Any:
    """The inverse of `_tagged`; ValueError for a tag that names no float."""
    if isinstance(value, dict):
        if not _looks_tagged(value):
            return {key: _untagged(item) for key, item in value.items()}
        key, item = next(iter(value.items()))
        if key != "$float":
            return {key[1:]: _untagged(item)}
        if item not in _NON_FINITE:
            raise ValueError(f"$float is {item!r}, not one of nan, inf, -inf")
        return _NON_FINITE[item]
    if isinstance(value, list):
        return [_untagged(item) for item in value]
    return value


def _looks_tagged(value: dict[Any, Any]) -> bool:
    return len(value) == 1 and isinstance(key := _only_key(value), str) and _FLOAT_TAG.fullmatch(key) is not None


def _only_key(value: dict[Any, Any]) -> Any:
    return next(iter(value))

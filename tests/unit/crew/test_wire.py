import contextlib
import math
from typing import Any, ClassVar

import msgspec
import pytest
from hypothesis import given
from hypothesis import strategies as st

from crew.wire import JSON, Message, Refusal, WireRefusal, decode, encode, encode_json, encoding_of


class Telemetry(Message, frozen=True):
    schema: ClassVar[str] = "crew.telemetry"
    version: ClassVar[int] = 2

    name: str
    speed_m_s: float
    path: tuple[float, ...] = ()
    extra: dict[str, Any] = msgspec.field(default_factory=dict)
    blob: bytes = b""


ENCODING = "application/msgpack;crew.telemetry/2"

FLOATS = st.floats(allow_nan=True, allow_infinity=True)
TREES = st.recursive(
    st.none() | st.booleans() | st.text(max_size=5) | FLOATS | st.integers(-(2**50), 2**50),
    lambda inner: (
        st.lists(inner, max_size=3)
        | st.dictionaries(st.text(max_size=3) | st.sampled_from(["$float", "$$float", "$"]), inner, max_size=3)
    ),
    max_leaves=10,
)
TELEMETRY = st.builds(
    Telemetry,
    name=st.text(max_size=8),
    speed_m_s=FLOATS,
    path=st.lists(FLOATS, max_size=4).map(tuple),
    extra=st.dictionaries(st.text(max_size=5), TREES, max_size=3),
    blob=st.binary(max_size=8),
)


def refusal_of(payload: bytes, encoding: str, **options: int) -> Refusal:
    with pytest.raises(WireRefusal) as refused:
        decode(Telemetry, payload, encoding, **options)
    assert str(refused.value)
    return refused.value.reason


def test_encoding_names_schema_and_version() -> None:
    assert encode(Telemetry(name="a", speed_m_s=1.0))[1] == ENCODING
    assert encoding_of(Telemetry, JSON) == "application/json;crew.telemetry/2"


@given(TELEMETRY)
def test_msgpack_round_trip_keeps_everything(message: Telemetry) -> None:
    assert repr(decode(Telemetry, *encode(message))) == repr(message)


@given(TELEMETRY)
def test_json_round_trip_keeps_everything_and_is_strict_json(message: Telemetry) -> None:
    payload, encoding = encode_json(message)
    assert repr(decode(Telemetry, payload, encoding)) == repr(message)


@pytest.mark.parametrize(("value", "word"), [(math.nan, "nan"), (math.inf, "inf"), (-math.inf, "-inf")])
def test_non_finite_floats_are_tagged_in_json(value: float, word: str) -> None:
    payload, encoding = encode_json(Telemetry(name="a", speed_m_s=value))
    assert msgspec.json.decode(payload)["speed_m_s"] == {"$float": word}
    read = decode(Telemetry, payload, encoding).speed_m_s
    assert math.isnan(read) if math.isnan(value) else read == value


@given(st.binary(max_size=64), st.sampled_from([ENCODING, encoding_of(Telemetry, JSON), "x", ""]))
def test_arbitrary_bytes_never_raise_anything_but_a_refusal(payload: bytes, encoding: str) -> None:
    with contextlib.suppress(WireRefusal):
        decode(Telemetry, payload, encoding)


@given(st.text(max_size=60))
def test_arbitrary_encodings_are_refused(encoding: str) -> None:
    refusal_of(b"\x80", encoding)


@given(st.data())
def test_a_cut_message_is_truncated(data: st.DataObject) -> None:
    payload, encoding = encode(Telemetry(name="iris", speed_m_s=1.5, path=(1.0, 2.0)))
    cut = data.draw(st.integers(0, len(payload) - 1))
    assert refusal_of(payload[:cut], encoding) is Refusal.TRUNCATED


@pytest.mark.parametrize(
    ("payload", "encoding", "reason"),
    [
        (b"\x80", "application/msgpack;crew.other/2", Refusal.UNKNOWN_SCHEMA),
        (b"\x80", "application/msgpack;crew.telemetry/x", Refusal.UNKNOWN_SCHEMA),
        (b"\x80", "application/msgpack;crew.telemetry/²", Refusal.UNKNOWN_SCHEMA),
        (b"\x80", "application/msgpack;crew.telemetry/" + "9" * 5000, Refusal.UNKNOWN_SCHEMA),
        (b"\x80", "application/msgpack", Refusal.UNKNOWN_SCHEMA),
        (b"\x80", "application/msgpack;crew.telemetry/1", Refusal.OLDER_VERSION),
        (b"\x80", "application/msgpack;crew.telemetry/3", Refusal.NEWER_VERSION),
        (b"\x80", "text/plain;crew.telemetry/2", Refusal.UNKNOWN_ENCODING),
        (b"\x80", ENCODING, Refusal.WRONG_TYPE),
        (b"\x93\x01\x02\x03", ENCODING, Refusal.WRONG_TYPE),
        (b"\xc1", ENCODING, Refusal.MALFORMED),
        (b"\xdd\xff\xff\xff\xff", ENCODING, Refusal.WRONG_TYPE),
        (b"{]", "application/json;crew.telemetry/2", Refusal.MALFORMED),
        (b"[" * 100_000, "application/json;crew.telemetry/2", Refusal.MALFORMED),
        (b'{"name":"a","speed_m_s":{"$float":"big"}}', "application/json;crew.telemetry/2", Refusal.MALFORMED),
        (b'{"name":"a","speed_m_s":{"$float":[]}}', "application/json;crew.telemetry/2", Refusal.MALFORMED),
        (b'{"name":"a","speed_m_s":"fast"}', "application/json;crew.telemetry/2", Refusal.WRONG_TYPE),
    ],
)
def test_refusals_are_typed(payload: bytes, encoding: str, reason: Refusal) -> None:
    assert refusal_of(payload, encoding) is reason


def test_deep_nesting_in_a_free_field_is_refused() -> None:
    bomb = b"\x81\xa5extra\x81\xa1a" + b"\x91" * 500_000
    assert refusal_of(bomb, ENCODING) is Refusal.MALFORMED


def test_size_limit_holds_at_the_byte() -> None:
    payload, encoding = encode(Telemetry(name="iris", speed_m_s=1.0))
    assert decode(Telemetry, payload, encoding, limit_bytes=len(payload)).name == "iris"
    assert refusal_of(payload, encoding, limit_bytes=len(payload) - 1) is Refusal.OVERSIZED

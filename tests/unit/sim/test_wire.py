"""Frames from the wire: whatever arrives, a message or None comes out; commands in one form."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st
from pymavlink.dialects.v20 import common as mavlink

from crew.sim.autopilot.command import INT_UNSET, flag, read_command
from crew.sim.autopilot.link import decode, parse_endpoint

MAV = mavlink.MAVLink(None, srcSystem=255, srcComponent=190)
GOOD = mavlink.MAVLink_heartbeat_message(6, 8, 0, 0, 4, 3).pack(MAV)


@given(st.binary(max_size=300))
def test_any_bytes_give_none_and_no_exception(data: bytes) -> None:
    assert decode(MAV, data) is None


@given(st.integers(0, len(GOOD) - 1), st.integers(1, 255))
def test_one_changed_byte_is_never_another_heartbeat(index: int, change: int) -> None:
    data = bytearray(GOOD)
    data[index] ^= change
    message = decode(MAV, bytes(data))
    assert message is None or index in (2, 3)  # flags: the incompatibility ones are checked by the CRC as well


@pytest.mark.parametrize("data", [GOOD[:-1], GOOD + b"\0", GOOD + GOOD, b"", b"\xfd"])
def test_a_datagram_is_exactly_one_frame(data: bytes) -> None:
    assert decode(MAV, data) is None


@given(st.binary(min_size=23, max_size=23))
def test_a_name_that_is_not_text_does_not_raise(payload: bytes) -> None:
    message = mavlink.MAVLink_param_set_message(1, 1, b"", 0.0, 9)
    crc_extra, ident = mavlink.MAVLink_param_set_message.crc_extra, mavlink.MAVLINK_MSG_ID_PARAM_SET
    frame = message._pack(MAV, crc_extra, payload)
    found = decode(MAV, bytes(frame))
    assert found is None or found.get_msgId() == ident


def test_endpoints() -> None:
    assert parse_endpoint("udp:127.0.0.1:14540") == ("127.0.0.1", 14540)
    for bad in ("tcp:127.0.0.1:1", "udp:127.0.0.1", "udp:127.0.0.1:0", "udp::5", "udp:host:x"):
        with pytest.raises(ValueError, match="is not udp:HOST:PORT"):
            parse_endpoint(bad)


def test_command_int_degrees_and_heights() -> None:
    message = mavlink.MAVLink_command_int_message(1, 1, 6, 192, 0, 0, -1, 1, 0, 0, 473977420, INT_UNSET, 5.0)
    command = read_command(message)
    assert command.x == pytest.approx(47.397742)
    assert math.isnan(command.y)
    assert command.height_m(488.0, 0.0) == 5.0
    assert command._replace(frame=0).height_m(488.0, 0.0) == -483.0
    assert command._replace(frame=1).height_m(488.0, 0.0) is None
    assert command._replace(z=math.nan).height_m(488.0, 2.5) == 2.5


def test_flags_of_odd_numbers_are_zero() -> None:
    assert flag(math.nan) == flag(math.inf) == 0
    assert flag(217.0) == 217

"""Nothing that causes motion leaves after the latch is set, whoever writes and whenever."""

import threading
from typing import Any

import pytest
from pymavlink.dialects.v20 import common as mavlink

from crew.adapter import Permit, StopLatch
from crew.adapters.mavlink.writer import Writer, causes_motion
from crew.errors import AdapterError, Latched
from tests.unit.adapters.fake import Wire, arm, heartbeat


def command(number: int) -> Any:
    return mavlink.MAVLink_command_long_message(1, 1, number, 0, 0, 0, 0, 0, 0, 0, 0)


def setpoint() -> Any:
    return mavlink.MAVLink_set_position_target_global_int_message(0, 1, 1, 6, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0)


STOP = command(mavlink.MAV_CMD_DO_SET_MODE)


def parts() -> tuple[StopLatch, Wire, Writer]:
    latch, wire = StopLatch(), Wire()
    return latch, wire, Writer(latch, wire.transmit)


def test_what_is_not_known_to_be_harmless_causes_motion() -> None:
    assert all(map(causes_motion, (arm(), setpoint(), STOP, command(21), command(22), command(192), command(31000))))
    harmless = mavlink.MAVLink_param_request_read_message(1, 1, b"NAV_DLL_ACT", -1)
    assert not any(map(causes_motion, (heartbeat(), harmless, command(511), command(512))))


def test_motion_needs_a_permit() -> None:
    _, wire, writer = parts()
    with pytest.raises(AdapterError, match="without a permit"):
        writer.send(arm())
    writer.send(arm(), Permit())
    assert wire.names() == ["COMMAND_LONG"]


def test_a_latched_stop_refuses_motion_but_not_the_heartbeat_or_a_safe_permit() -> None:
    latch, wire, writer = parts()
    latch.set()
    with pytest.raises(Latched):
        writer.send(setpoint(), Permit())
    assert wire.messages == []
    writer.send(heartbeat())
    writer.send(command(21), Permit(safe=True))
    writer.send_stop(STOP)
    assert wire.names() == ["HEARTBEAT", "COMMAND_LONG", "COMMAND_LONG"]


def test_a_revoked_permit_stays_revoked_with_its_first_reason_after_the_latch_opens() -> None:
    latch, wire, writer = parts()
    permit = Permit()
    latch.set()
    permit.revoke(Latched("stopped"))
    permit.revoke(AdapterError("later"))
    latch.clear()
    with pytest.raises(Latched, match="stopped"):
        writer.send(setpoint(), permit)
    assert wire.messages == []


def test_sequence_numbers_are_consecutive_over_all_senders() -> None:
    _, wire, writer = parts()
    for _ in range(300):
        writer.send(heartbeat())
    assert [m.get_seq() for m in wire.messages] == [i % 256 for i in range(300)]


def test_no_motion_leaves_after_a_stop_from_racing_threads() -> None:
    latch, wire, writer = parts()
    stopped_at: list[int] = []
    started = threading.Barrier(5)

    def race() -> None:
        permit = Permit()
        started.wait()
        try:
            while True:
                writer.send(setpoint(), permit)
        except Latched:
            return

    threads = [threading.Thread(target=race) for _ in range(4)]
    for thread in threads:
        thread.start()
    started.wait()
    while len(wire.messages) < 50:
        pass
    with latch.lock:
        latch.set()
        writer.send_stop(STOP)
        stopped_at.append(len(wire.messages))
    for thread in threads:
        thread.join(5.0)
        assert not thread.is_alive()
    assert len(wire.messages) == stopped_at[0]
    assert wire.names()[-1] == "COMMAND_LONG"

"""What is received becomes values with ages; numbers that are none and other people's messages do not."""

import math
import struct

import pytest
from pymavlink.dialects.v20 import common as mavlink

from crew.adapters.mavlink.endpoint import parse_endpoint
from crew.adapters.mavlink.flavours.ardupilot_rover import ArduPilotRover
from crew.adapters.mavlink.flavours.px4_quadcopter import Px4Quadcopter
from crew.adapters.mavlink.flavours.registry import choose_flavour
from crew.adapters.mavlink.frame import WorldFrame
from crew.adapters.mavlink.link import parse_datagram
from crew.adapters.mavlink.options import QuadcopterOptions, RoverOptions
from crew.adapters.mavlink.parameter import decode_value
from crew.adapters.mavlink.preflight import bad_sensors
from crew.adapters.mavlink.search import Search
from crew.adapters.mavlink.statustext import StatusLog
from crew.adapters.mavlink.sweep import Zone
from crew.adapters.mavlink.telemetry import Telemetry
from crew.adapters.options import read_options
from crew.clock import SimClock
from crew.errors import AdapterError
from tests.unit.adapters.fake import heartbeat

FRAME = WorldFrame((47.0, 8.0, 500.0))


def position(boot_ms: int, x: float = 1.0, y: float = 2.0) -> mavlink.MAVLink_global_position_int_message:
    lat, lon = FRAME.to_geo(x, y)
    where = (round(lat * 1e7), round(lon * 1e7))
    return mavlink.MAVLink_global_position_int_message(boot_ms, *where, 505_000, 5_000, 30, 40, 0, 0)


def attitude(boot_ms: int, roll: float = 0.0) -> mavlink.MAVLink_attitude_message:
    return mavlink.MAVLink_attitude_message(boot_ms, roll, 0.0, 0.0, 0.0, 0.0, 0.0)


def target(angle_x: float, boot_us: int) -> mavlink.MAVLink_landing_target_message:
    return mavlink.MAVLink_landing_target_message(boot_us, 0, 12, angle_x, 0.0, 0.0, 0.05, 0.05)


def told(clock: SimClock | None = None) -> Telemetry:
    return Telemetry(clock or SimClock(), FRAME)


def test_a_position_is_world_metres_stamped_with_the_time_of_receipt() -> None:
    clock = SimClock(7_000_000_000)
    telemetry = told(clock)
    telemetry.take(position(1000))
    clock.advance(9_000_000_000)
    assert telemetry.motion is not None
    assert telemetry.motion.stamp_ns == 7_000_000_000
    assert telemetry.age_s(telemetry.motion) == 2.0
    motion = telemetry.motion.value
    assert (motion.x_m, motion.y_m, motion.height_m) == pytest.approx((1.0, 2.0, 5.0), abs=0.01)
    assert (motion.north_mps, motion.east_mps, motion.ground_speed_mps) == pytest.approx((0.3, 0.4, 0.5))


def test_what_was_never_heard_is_infinitely_old() -> None:
    assert told().age_s(None) == math.inf


def test_boot_time_going_backwards_is_a_reboot_and_reordering_is_not() -> None:
    telemetry = told()
    for boot_ms in (5000, 4900, 5100):
        telemetry.take(position(boot_ms))
    assert not telemetry.rebooted
    telemetry.take(position(100))
    telemetry.take(position(200))
    assert telemetry.rebooted


def test_an_attitude_that_is_no_number_is_dropped_and_counted() -> None:
    telemetry = told()
    telemetry.take(attitude(100, math.nan))
    telemetry.take(position(100, 0, 0))
    assert telemetry.heading is None
    assert telemetry.dropped == 1


def test_a_damaged_detection_makes_a_reading_without_a_position_even_beside_good_ones() -> None:
    telemetry = told(SimClock(3_000_000_000))
    telemetry.take(position(1000))
    telemetry.take(attitude(1000))
    search = Search(telemetry, 0.3, (0.1, 0.8), Zone(-1000.0, 1000.0, -1000.0, 1000.0))
    assert search.reading(5).status == "absent"
    assert search.reading(5).stamp_ns == 5
    for _ in range(3):
        telemetry.take(target(0.1, 1_000_000))
    good = search.reading(5)
    assert good.status == "ok"
    assert good.position is not None
    assert (good.looks, good.stamp_ns) == (3, 3_000_000_000)
    telemetry.take(target(math.nan, 1_000_000))
    telemetry.take(target(0.1, 1_000_000))
    bad = search.reading(5)
    assert bad.status == "ok"
    assert bad.position is not None
    assert math.isnan(bad.position.x)
    assert math.isnan(bad.position.y)


@pytest.mark.parametrize("value", [0, 1, 3, 300, 100_000, -1, -300])
def test_an_integer_parameter_is_read_whichever_way_it_was_encoded(value: int) -> None:
    (copied,) = struct.unpack("<f", struct.pack("<i", value))
    assert decode_value(copied, mavlink.MAV_PARAM_TYPE_INT32) == value
    assert decode_value(float(value), mavlink.MAV_PARAM_TYPE_INT32) == value


def test_a_real_parameter_is_itself() -> None:
    assert decode_value(0.25, mavlink.MAV_PARAM_TYPE_REAL32) == 0.25


def test_long_texts_are_put_together_and_milder_ones_left_out() -> None:
    log = StatusLog()
    log.add(mavlink.MAVLink_statustext_message(3, b"a" * 50, 9, 0), 10)
    log.add(mavlink.MAVLink_statustext_message(3, b"b", 9, 1), 11)
    log.add(mavlink.MAVLink_statustext_message(6, b"hello"), 12)
    assert log.since(0) == ["a" * 50 + "b"]
    assert log.since(12) == []


def test_prearm_counts_only_while_disarmed() -> None:
    telemetry = told()
    bits = mavlink.MAV_SYS_STATUS_PREARM_CHECK | mavlink.MAV_SYS_STATUS_SENSOR_GPS
    telemetry.take(mavlink.MAVLink_sys_status_message(bits, bits, 0, 0, 0, 0, 80, 0, 0, 0, 0, 0, 0))
    telemetry.take(heartbeat())
    assert bad_sensors(telemetry, Px4Quadcopter()) == ["GPS", "pre-arm check"]
    telemetry.take(heartbeat(armed=True))
    assert bad_sensors(telemetry, Px4Quadcopter()) == ["GPS"]


def test_modes_have_names() -> None:
    assert Px4Quadcopter().mode(4 << 16 | 3 << 24) == "AUTO.LOITER"
    assert Px4Quadcopter().mode(3 << 16) == "POSCTL"
    assert ArduPilotRover().mode(15) == "GUIDED"


def test_takeoff_is_commanded_above_sea_level_and_the_rest_is_unused() -> None:
    arm, climb = Px4Quadcopter().takeoff(5.0, 488.0)
    assert arm.params == (1.0,)
    assert climb.params[6] == 493.0
    assert all(math.isnan(p) for p in climb.params[:6])


def test_a_heartbeat_of_another_kind_of_vehicle_is_refused_with_the_supported_ones() -> None:
    assert isinstance(choose_flavour("rover", 3, 10), ArduPilotRover)
    with pytest.raises(
        AdapterError, match=r"MAV_TYPE_FIXED_WING.*PX4 quadcopter, ArduPilot copter, PX4 rover, Ardu"
    ) as refused:
        choose_flavour("quadcopter", 12, 1)
    assert refused.value.code == "wrong_vehicle"


@pytest.mark.parametrize("bad", ["", "udp:1.2.3.4:5", "udpin:14540", "udpin::14540", "udpout:h:0", "udpin:h:99999"])
def test_a_connection_that_is_not_understood_is_refused(bad: str) -> None:
    with pytest.raises(AdapterError, match="udpin:HOST:PORT"):
        parse_endpoint(bad)


def test_an_unknown_option_names_the_nearest_and_a_bad_value_its_field() -> None:
    with pytest.raises(AdapterError, match=r"did you mean 'fov_x_deg'"):
        read_options("iris", {"fov_x": 80}, QuadcopterOptions)
    with pytest.raises(AdapterError, match=r"\$\.cruise_mps"):
        read_options("tb3", {"cruise_mps": -1}, RoverOptions)


def test_damaged_datagrams_are_none_and_do_not_spoil_the_next() -> None:
    parser = mavlink.MAVLink(None)
    parser.robust_parsing = True
    good = heartbeat().pack(mavlink.MAVLink(None, 1, 1))
    for damaged in (good[:7], b"", b"\x00\x01\x02", good[:-1] + b"\xff", good + b"\x01", b"\xfd" * 30):
        assert parse_datagram(parser, bytes(damaged)) is None
        assert len(parse_datagram(parser, bytes(good)) or []) == 1

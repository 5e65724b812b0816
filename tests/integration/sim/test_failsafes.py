"""What happens by itself: lost ground, low battery, lost position, and the other faults."""

import math
from typing import Any

import pytest
from pymavlink.dialects.v20 import common as mavlink

from tests.integration.sim.ground import IRIS, TB3, Ground

TEMPORARILY_REJECTED = 1
LAND = 4 << 16 | 6 << 24


def test_silent_ground_makes_the_quadcopter_land_after_its_timeout() -> None:
    with Ground() as ground:
        ground.take_off(3.0)
        ground.run(1.0)
        ground.heartbeat = False
        ground.run(3.5)
        assert ground.mode(IRIS) != LAND
        ground.run(3.0)
        assert ground.mode(IRIS) == LAND
        assert "Failsafe: ground link lost" in ground.texts(IRIS)
        assert ground.last(IRIS, "HEARTBEAT").system_status == 5
        assert ground.wait(lambda: not ground.armed(IRIS), 20.0)


def test_silent_ground_makes_the_rover_hold() -> None:
    with Ground() as ground:
        ground.command(TB3, 176, 1, 15)
        ground.command(TB3, 400, 1)
        ground.drive(-4.0, 8.0)
        ground.run(1.0)
        ground.heartbeat = False
        ground.run(7.5)
        assert ground.world.truth().robots["tb3"].speed_mps < 0.01
        assert ground.mode(TB3) == 4
        assert "GCS failsafe: HOLD" in ground.texts(TB3)


def test_a_ground_that_fell_silent_prevents_arming() -> None:
    with Ground() as ground:
        ground.heartbeat = False
        ground.run(6.0)
        assert not ground.last(IRIS, "SYS_STATUS").onboard_control_sensors_health & 0x10000000
        assert ground.command(IRIS, 400, 1) == TEMPORARILY_REJECTED
        assert ground.texts(IRIS) == ["Arming denied: no ground station connected"]


def test_a_ground_that_never_beats_is_lost_soon_after_arming() -> None:
    with Ground(heartbeat=False) as ground:
        ground.take_off(3.0)
        ground.run(4.0)
        assert ground.mode(IRIS) == LAND


def test_px4_counts_any_ground_station_but_no_other_system() -> None:
    def beat(kind: int, system: int) -> bytes:
        return bytes(mavlink.MAVLink_heartbeat_message(kind, 8, 0, 0, 4, 3).pack(mavlink.MAVLink(None, system, 190)))

    with Ground(heartbeat=False) as ground:
        for kind, healthy in ((6, True), (18, False)):
            for _ in range(7):
                ground.send_bytes("iris", beat(kind, 245))
                ground.run(1.0)
            health = ground.last(IRIS, "SYS_STATUS").onboard_control_sensors_health
            assert bool(health & 0x10000000) is healthy


def test_low_battery_lands_and_then_refuses_to_arm() -> None:
    with Ground() as ground:
        ground.take_off(2.0)
        ground.world.set_fault("battery_low", True)
        ground.run(2.0)
        assert ground.last(IRIS, "BATTERY_STATUS").battery_remaining == 12
        assert ground.mode(IRIS) == LAND
        assert ground.wait(lambda: not ground.armed(IRIS), 20.0)
        assert ground.command(IRIS, 400, 1) == TEMPORARILY_REJECTED
        assert ground.texts(IRIS) == ["Arming denied: low battery"]


def test_lost_position_lands_the_quadcopter_and_holds_the_rover() -> None:
    with Ground() as ground:
        ground.command(TB3, 176, 1, 15)
        ground.command(TB3, 400, 1)
        ground.drive(-4.0, 8.0)
        ground.take_off(2.0)
        ground.world.set_fault("gps_loss", True)
        ground.forget()
        ground.run(2.0)
        assert ground.mode(IRIS) == LAND
        assert ground.mode(TB3) == 4
        assert not ground.all(IRIS, "GLOBAL_POSITION_INT")
        assert ground.last(IRIS, "GPS_RAW_INT").fix_type == 1
        assert not ground.last(IRIS, "SYS_STATUS").onboard_control_sensors_health & 0x20
        assert ground.command(TB3, 176, 1, 15) == TEMPORARILY_REJECTED


def test_unavailable_quadcopter_refuses_to_arm() -> None:
    with Ground(faults=("iris_unavailable",)) as ground:
        ground.run(0.6)
        assert not ground.last(IRIS, "SYS_STATUS").onboard_control_sensors_health & 0x10000000
        assert ground.command(IRIS, 400, 1) == TEMPORARILY_REJECTED
        assert ground.texts(IRIS) == ["Arming denied: system fault: vehicle unavailable"]


@pytest.mark.parametrize("fault", ["missed_detection", "nan_transmission"])
def test_faults_of_the_detection(fault: str) -> None:
    with Ground(faults=(fault,)) as ground:
        ground.take_off(5.0)
        ground.go(5.0, 5.0, 5.0)
        ground.run(6.0)
        found = ground.all(IRIS, "LANDING_TARGET")
        if fault == "missed_detection":
            assert not found
        else:
            assert found
            assert all(math.isnan(message.angle_x) and math.isnan(message.angle_y) for message in found)


def test_lost_link_is_deaf_and_dumb_but_counts_what_arrives() -> None:
    with Ground() as ground:
        ground.run(1.0)
        ground.world.set_fault("link_loss", True)
        ground.run(0.5)
        ground.forget()
        before = ground.world.counts()["iris"]
        ground.run(2.0)
        after = ground.world.counts()["iris"]
        assert not ground.messages[IRIS]
        assert (after.sent, after.received) == (before.sent, before.received + 2)


def test_failsafe_parameters_are_read_and_set() -> None:
    with Ground() as ground:
        ground.exchange("tb3", _read(TB3, "FS_GCS_ENABLE"))
        assert ground.last(TB3, "PARAM_VALUE").param_value == 1.0
        ground.exchange("tb3", _set(TB3, "FS_GCS_TIMEOUT", 8.0))
        assert ground.last(TB3, "PARAM_VALUE").param_value == 8.0
        ground.exchange("tb3", _set(TB3, "FS_GCS_TIMEOUT", 1000.0))
        assert ground.last(TB3, "PARAM_VALUE").param_value == 8.0, "out of bounds"
        ground.forget()
        ground.exchange("iris", _list(IRIS))
        values = ground.all(IRIS, "PARAM_VALUE")
        assert len(values) == values[0].param_count
        assert {"NAV_DLL_ACT", "COM_DL_LOSS_T", "COM_LOW_BAT_ACT", "GF_ACTION", "MPC_XY_VEL_MAX"} <= {
            value.param_id for value in values
        }


def _read(system: int, name: str) -> Any:
    return mavlink.MAVLink_param_request_read_message(system, 1, name.encode(), -1)


def _set(system: int, name: str, value: float) -> Any:
    return mavlink.MAVLink_param_set_message(system, 1, name.encode(), value, 9)


def _list(system: int) -> Any:
    return mavlink.MAVLink_param_request_list_message(system, 1)

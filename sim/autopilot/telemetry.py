"""Telemetry: from a vehicle's estimate to MAVLink messages. Must not decide anything or see the truth.

The world is ENU; MAVLink here is NED and FRD. Heights are above home, which stands on the world's z = 0.
"""

import math
from collections.abc import Callable
from typing import Any, Protocol

from pymavlink.dialects.v20 import common as mavlink

from crew.sim.geo import GeoFrame, enu_yaw_to_heading_rad
from crew.sim.vehicle.battery import Battery
from crew.sim.vehicle.state import State

SENSORS = (
    mavlink.MAV_SYS_STATUS_SENSOR_3D_GYRO
    | mavlink.MAV_SYS_STATUS_SENSOR_3D_ACCEL
    | mavlink.MAV_SYS_STATUS_SENSOR_3D_MAG
    | mavlink.MAV_SYS_STATUS_SENSOR_ABSOLUTE_PRESSURE
    | mavlink.MAV_SYS_STATUS_SENSOR_BATTERY
)
GPS = mavlink.MAV_SYS_STATUS_SENSOR_GPS
PREARM = mavlink.MAV_SYS_STATUS_PREARM_CHECK
CELL_UNUSED = 65535
VELOCITY_IGNORED = 0b110111111000
"""Type mask of a position target in which the position alone counts."""


class Source(Protocol):
    """What telemetry reads: an autopilot."""

    time_ns: int
    geo: GeoFrame
    home: tuple[float, float]
    home_alt_m: float

    @property
    def state(self) -> State: ...
    @property
    def battery(self) -> Battery: ...
    @property
    def gps_ok(self) -> bool: ...
    @property
    def landed_state(self) -> int: ...
    @property
    def aim(self) -> tuple[float, float, float] | None: ...
    def problems(self) -> list[str]: ...
    def heartbeat(self) -> Any: ...


def _heartbeat(a: Source) -> Any:
    return a.heartbeat()


def _sys_status(a: Source) -> Any:
    present = SENSORS | GPS | PREARM
    health = SENSORS | (GPS if a.gps_ok else 0) | (0 if a.problems() else PREARM)
    battery = a.battery
    volts, amps = int(battery.voltage_v * 1000), int(battery.current_a * 100)
    return mavlink.MAVLink_sys_status_message(present, present, health, 250, volts, amps, battery.percent, *(0,) * 6)


def _extended_sys_state(a: Source) -> Any:
    return mavlink.MAVLink_extended_sys_state_message(mavlink.MAV_VTOL_STATE_UNDEFINED, a.landed_state)


def _home_position(a: Source) -> Any:
    lat, lon = _lat_lon(a, *a.home)
    alt_mm = round(a.home_alt_m * 1000)
    none = (math.nan,) * 3
    return mavlink.MAVLink_home_position_message(
        lat, lon, alt_mm, 0.0, 0.0, 0.0, (1.0, 0.0, 0.0, 0.0), *none, a.time_ns // 1000
    )


def _global_position_int(a: Source) -> Any | None:
    if not a.gps_ok:
        return None
    s = a.state
    lat, lon = _lat_lon(a, s.x, s.y)
    alt_mm, relative_mm = (
        round((a.geo.origin.alt_m + s.z) * 1000),
        round((a.geo.origin.alt_m + s.z - a.home_alt_m) * 1000),
    )
    north, east, down = round(s.vy * 100), round(s.vx * 100), round(-s.vz * 100)
    return mavlink.MAVLink_global_position_int_message(
        _boot_ms(a), lat, lon, alt_mm, relative_mm, north, east, down, _heading_cdeg(s)
    )


def _local_position_ned(a: Source) -> Any | None:
    if not a.gps_ok:
        return None
    s = a.state
    return mavlink.MAVLink_local_position_ned_message(
        _boot_ms(a), s.y - a.home[1], s.x - a.home[0], -s.z, s.vy, s.vx, -s.vz
    )


def _attitude(a: Source) -> Any:
    s = a.state
    return mavlink.MAVLink_attitude_message(
        _boot_ms(a), s.roll, -s.pitch, enu_yaw_to_heading_rad(s.yaw), s.p, -s.q, -s.r
    )


def _battery_status(a: Source) -> Any:
    battery = a.battery
    cell_mv = round(battery.voltage_v * 1000 / battery.cells)
    cells = [cell_mv] * battery.cells + [CELL_UNUSED] * (10 - battery.cells)
    lipo, unknown = mavlink.MAV_BATTERY_TYPE_LIPO, 32767
    return mavlink.MAVLink_battery_status_message(
        0, mavlink.MAV_BATTERY_FUNCTION_ALL, lipo, unknown, cells, int(battery.current_a * 100), -1, -1, battery.percent
    )


def _gps_raw_int(a: Source) -> Any:
    s = a.state
    fix = mavlink.GPS_FIX_TYPE_3D_FIX if a.gps_ok else mavlink.GPS_FIX_TYPE_NO_FIX
    lat, lon = _lat_lon(a, s.x, s.y) if a.gps_ok else (0, 0)
    alt_mm = round((a.geo.origin.alt_m + s.z) * 1000)
    satellites = 12 if a.gps_ok else 0
    return mavlink.MAVLink_gps_raw_int_message(
        a.time_ns // 1000, fix, lat, lon, alt_mm, 90, 120, round(s.ground_speed * 100), 65535, satellites
    )


def _position_target(a: Source) -> Any | None:
    if a.aim is None:
        return None
    x_m, y_m, height_m = a.aim
    lat, lon = _lat_lon(a, x_m, y_m)
    frame, mask = mavlink.MAV_FRAME_GLOBAL_INT, VELOCITY_IGNORED
    altitude_m = a.home_alt_m + height_m
    return mavlink.MAVLink_position_target_global_int_message(
        _boot_ms(a), frame, mask, lat, lon, altitude_m, *(0.0,) * 8
    )


ENCODERS: dict[int, Callable[[Source], Any | None]] = {
    mavlink.MAVLINK_MSG_ID_HEARTBEAT: _heartbeat,
    mavlink.MAVLINK_MSG_ID_SYS_STATUS: _sys_status,
    mavlink.MAVLINK_MSG_ID_EXTENDED_SYS_STATE: _extended_sys_state,
    mavlink.MAVLINK_MSG_ID_HOME_POSITION: _home_position,
    mavlink.MAVLINK_MSG_ID_GLOBAL_POSITION_INT: _global_position_int,
    mavlink.MAVLINK_MSG_ID_LOCAL_POSITION_NED: _local_position_ned,
    mavlink.MAVLINK_MSG_ID_ATTITUDE: _attitude,
    mavlink.MAVLINK_MSG_ID_BATTERY_STATUS: _battery_status,
    mavlink.MAVLINK_MSG_ID_GPS_RAW_INT: _gps_raw_int,
    mavlink.MAVLINK_MSG_ID_POSITION_TARGET_GLOBAL_INT: _position_target,
}

FULL_RATES_HZ: dict[int, float] = {
    mavlink.MAVLINK_MSG_ID_HEARTBEAT: 1.0,
    mavlink.MAVLINK_MSG_ID_SYS_STATUS: 2.0,
    mavlink.MAVLINK_MSG_ID_EXTENDED_SYS_STATE: 5.0,
    mavlink.MAVLINK_MSG_ID_HOME_POSITION: 1.0,
    mavlink.MAVLINK_MSG_ID_GLOBAL_POSITION_INT: 20.0,
    mavlink.MAVLINK_MSG_ID_LOCAL_POSITION_NED: 10.0,
    mavlink.MAVLINK_MSG_ID_ATTITUDE: 20.0,
    mavlink.MAVLINK_MSG_ID_BATTERY_STATUS: 1.0,
    mavlink.MAVLINK_MSG_ID_GPS_RAW_INT: 1.0,
    mavlink.MAVLINK_MSG_ID_POSITION_TARGET_GLOBAL_INT: 2.0,
}
HEARTBEAT_ONLY_HZ = {message: 1.0 if message == mavlink.MAVLINK_MSG_ID_HEARTBEAT else 0.0 for message in ENCODERS}


def _boot_ms(a: Source) -> int:
    return (a.time_ns // 1_000_000) & 0xFFFFFFFF


def _lat_lon(a: Source, x_m: float, y_m: float) -> tuple[int, int]:
    lat_deg, lon_deg = a.geo.to_geo(x_m, y_m)
    return round(lat_deg * 1e7), round(lon_deg * 1e7)


def _heading_cdeg(s: State) -> int:
    return round(math.degrees(enu_yaw_to_heading_rad(s.yaw)) * 100) % 36000

"""PX4 on a quadcopter."""

from typing import ClassVar

from pymavlink.dialects.v20 import common as mavlink

from crew.adapters.mavlink.command import UNUSED, Command, Position
from crew.adapters.mavlink.flavours import px4
from crew.adapters.mavlink.flavours.flavour import Failsafe, Modes


class Px4Quadcopter:
    """Flies by AUTO modes: TAKEOFF, LOITER (which a reposition moves about), LAND."""

    title = "PX4 quadcopter"
    kind = "quadcopter"
    autopilot = mavlink.MAV_AUTOPILOT_PX4
    vehicle_types = frozenset({mavlink.MAV_TYPE_QUADROTOR})
    sensors: ClassVar[dict[int, str]] = {
        mavlink.MAV_SYS_STATUS_SENSOR_3D_GYRO: "gyro",
        mavlink.MAV_SYS_STATUS_SENSOR_3D_ACCEL: "accelerometer",
        mavlink.MAV_SYS_STATUS_SENSOR_3D_MAG: "magnetometer",
        mavlink.MAV_SYS_STATUS_SENSOR_GPS: "GPS",
        mavlink.MAV_SYS_STATUS_SENSOR_BATTERY: "battery",
    }
    prearm_bit = mavlink.MAV_SYS_STATUS_PREARM_CHECK
    failsafes = (
        Failsafe("NAV_DLL_ACT", lambda v: v > 0, "not 0 (off): what the vehicle does when the ground falls silent"),
        Failsafe("COM_DL_LOSS_T", lambda v: 0 < v <= 60, "above 0 and at most 60 s of silence"),
        Failsafe("COM_LOW_BAT_ACT", lambda v: v > 0, "not 0 (warning only): what it does at low battery"),
    )
    fences = (
        Failsafe("GF_ACTION", lambda v: v > 1, "2 or more (not off, not a warning only): what it does at its geofence"),
        Failsafe("GF_MAX_HOR_DIST", lambda v: 0 < v <= 1000, "above 0 and at most 1000 m from home"),
        Failsafe("GF_MAX_VER_DIST", lambda v: 0 < v <= 120, "above 0 and at most 120 m above home"),
    )
    streams: ClassVar[dict[int, float]] = {}
    stops = px4.STOP
    stop_mode = "AUTO.LOITER"
    travel_modes: Modes = frozenset({"AUTO.LOITER"})
    takeoff_modes: Modes = frozenset({"AUTO.TAKEOFF", "AUTO.LOITER"})
    land_modes: Modes = frozenset({"AUTO.LAND"})
    land = Command(id=mavlink.MAV_CMD_NAV_LAND, fill=UNUSED)
    disarm = px4.DISARM

    def mode(self, custom_mode: int) -> str:
        return px4.mode_name(custom_mode)

    def prepare(self) -> tuple[Command, ...]:
        return ()

    def takeoff(self, height_m: float, home_amsl_m: float) -> tuple[Command, ...]:
        climb = (UNUSED,) * 6 + (home_amsl_m + height_m,)
        return px4.ARM, Command(id=mavlink.MAV_CMD_NAV_TAKEOFF, params=climb)

    def go_to(self, place: Position, speed_mps: float, heading_rad: float | None) -> tuple[Command, ...]:
        return (px4.reposition(place, speed_mps, heading_rad),)

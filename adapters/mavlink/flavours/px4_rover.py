"""PX4 on a rover."""

from typing import ClassVar

from pymavlink.dialects.v20 import common as mavlink

from crew.adapters.mavlink.command import Command, Position
from crew.adapters.mavlink.flavours import px4
from crew.adapters.mavlink.flavours.flavour import Failsafe, Modes


class Px4Rover:
    """Stands in AUTO.LOITER, and drives in it to where it is repositioned."""

    title = "PX4 rover"
    kind = "rover"
    autopilot = mavlink.MAV_AUTOPILOT_PX4
    vehicle_types = frozenset({mavlink.MAV_TYPE_GROUND_ROVER})
    sensors: ClassVar[dict[int, str]] = {
        mavlink.MAV_SYS_STATUS_SENSOR_3D_GYRO: "gyro",
        mavlink.MAV_SYS_STATUS_SENSOR_3D_ACCEL: "accelerometer",
        mavlink.MAV_SYS_STATUS_SENSOR_GPS: "GPS",
        mavlink.MAV_SYS_STATUS_SENSOR_BATTERY: "battery",
    }
    prearm_bit = mavlink.MAV_SYS_STATUS_PREARM_CHECK
    failsafes = (
        Failsafe("NAV_DLL_ACT", lambda v: v > 0, "not 0 (off): what the vehicle does when the ground falls silent"),
        Failsafe("COM_DL_LOSS_T", lambda v: 0 < v <= 60, "above 0 and at most 60 s of silence"),
    )
    fences = (
        Failsafe("GF_ACTION", lambda v: v > 1, "2 or more (not off, not a warning only): what it does at its geofence"),
        Failsafe("GF_MAX_HOR_DIST", lambda v: 0 < v <= 1000, "above 0 and at most 1000 m from home"),
    )
    streams: ClassVar[dict[int, float]] = {}
    stops = px4.STOP
    stop_mode = "AUTO.LOITER"
    travel_modes: Modes = frozenset({"AUTO.LOITER"})

    def mode(self, custom_mode: int) -> str:
        return px4.mode_name(custom_mode)

    def prepare(self) -> tuple[Command, ...]:
        return (*px4.STOP[:1], px4.ARM)

    def go_to(self, place: Position, speed_mps: float, heading_rad: float | None) -> tuple[Command, ...]:
        return (px4.reposition(place, speed_mps, None),)

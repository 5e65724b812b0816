"""PX4 on a quadcopter."""

import math
from typing import ClassVar

from pymavlink.dialects.v20 import common as mavlink

from crew.adapters.mavlink.command import UNUSED, Command, Position
from crew.adapters.mavlink.flavours.flavour import Failsafe, Modes

CUSTOM = float(mavlink.MAV_MODE_FLAG_CUSTOM_MODE_ENABLED)
AUTO = 4
LOITER = 3
MAIN_MODES = {1: "MANUAL", 2: "ALTCTL", 3: "POSCTL", 4: "AUTO", 5: "ACRO", 6: "OFFBOARD", 7: "STABILIZED"}
AUTO_MODES = {1: "READY", 2: "TAKEOFF", 3: "LOITER", 4: "MISSION", 5: "RTL", 6: "LAND", 9: "PRECLAND"}
CHANGE_MODE = float(mavlink.MAV_DO_REPOSITION_FLAGS_CHANGE_MODE)


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
    streams: ClassVar[dict[int, float]] = {}
    stop = Command(id=mavlink.MAV_CMD_DO_SET_MODE, params=(CUSTOM, AUTO, LOITER))
    stop_mode = "AUTO.LOITER"
    travel_modes: Modes = frozenset({"AUTO.LOITER"})
    takeoff_modes: Modes = frozenset({"AUTO.TAKEOFF", "AUTO.LOITER"})
    land_modes: Modes = frozenset({"AUTO.LAND"})
    land = Command(id=mavlink.MAV_CMD_NAV_LAND, fill=UNUSED)
    arm = Command(id=mavlink.MAV_CMD_COMPONENT_ARM_DISARM, params=(1.0,))
    disarm = Command(id=mavlink.MAV_CMD_COMPONENT_ARM_DISARM, params=(0.0,))

    def mode(self, custom_mode: int) -> str:
        main, sub = custom_mode >> 16 & 0xFF, custom_mode >> 24 & 0xFF
        name = MAIN_MODES.get(main, f"main {main}")
        return f"{name}.{AUTO_MODES.get(sub, sub)}" if main == AUTO else name

    def prepare(self) -> tuple[Command, ...]:
        return ()

    def takeoff(self, height_m: float, home_amsl_m: float) -> tuple[Command, ...]:
        climb = (UNUSED,) * 6 + (home_amsl_m + height_m,)
        return self.arm, Command(id=mavlink.MAV_CMD_NAV_TAKEOFF, params=climb)

    def go_to(self, place: Position, speed_mps: float, heading_rad: float | None) -> Command:
        heading = math.nan if heading_rad is None else heading_rad
        params = (speed_mps, CHANGE_MODE, 0.0, heading)
        return Command(id=mavlink.MAV_CMD_DO_REPOSITION, params=params, position=place)

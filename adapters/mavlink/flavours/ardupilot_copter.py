"""ArduPilot on a quadcopter."""

import math
from typing import ClassVar

from pymavlink.dialects.v20 import common as mavlink

from crew.adapters.mavlink.command import Command, Position
from crew.adapters.mavlink.flavours import ardupilot
from crew.adapters.mavlink.flavours.flavour import Failsafe, Modes

MODES = {
    0: "STABILIZE", 1: "ACRO", 2: "ALT_HOLD", 3: "AUTO", 4: "GUIDED", 5: "LOITER", 6: "RTL", 9: "LAND", 16: "POSHOLD",
    17: "BRAKE", 21: "SMART_RTL",
}  # fmt: skip
GUIDED, BRAKE = 4, 17
TURN_DEG_PER_S = 60.0


class ArduPilotCopter:
    """Flies in GUIDED, stops in BRAKE, comes down in LAND."""

    title = "ArduPilot copter"
    kind = "quadcopter"
    autopilot = mavlink.MAV_AUTOPILOT_ARDUPILOTMEGA
    vehicle_types = frozenset({mavlink.MAV_TYPE_QUADROTOR})
    sensors: ClassVar[dict[int, str]] = {
        mavlink.MAV_SYS_STATUS_SENSOR_3D_GYRO: "gyro",
        mavlink.MAV_SYS_STATUS_SENSOR_3D_ACCEL: "accelerometer",
        mavlink.MAV_SYS_STATUS_SENSOR_3D_MAG: "magnetometer",
        mavlink.MAV_SYS_STATUS_SENSOR_GPS: "GPS",
        mavlink.MAV_SYS_STATUS_SENSOR_BATTERY: "battery",
    }
    prearm_bit = 0  # its meaning depends on the mode; a refused arming tells the reasons
    failsafes = (
        Failsafe("FS_GCS_ENABLE", lambda v: v > 0, "not 0 (off): what the vehicle does when the ground falls silent"),
        Failsafe("FS_GCS_TIMEOUT", lambda v: 0 < v <= 60, "above 0 and at most 60 s of silence"),
        Failsafe("BATT_FS_CRT_ACT", lambda v: v > 0, "not 0 (nothing): what it does at a critical battery"),
        Failsafe("FS_EKF_ACTION", lambda v: v > 0, "not 0 (report only): what it does without a position"),
    )
    fences = (
        Failsafe("FENCE_ENABLE", lambda v: v > 0, "not 0 (off)"),
        Failsafe("FENCE_RADIUS", lambda v: 0 < v <= 1000, "above 0 and at most 1000 m from home"),
        Failsafe("FENCE_ALT_MAX", lambda v: 0 < v <= 120, "above 0 and at most 120 m above home"),
    )
    streams: ClassVar[dict[int, float]] = ardupilot.STREAMS
    stops = (ardupilot.set_mode(BRAKE),)
    stop_mode = "BRAKE"
    travel_modes: Modes = frozenset({"GUIDED"})
    takeoff_modes: Modes = frozenset({"GUIDED"})
    land_modes: Modes = frozenset({"LAND"})
    land = Command(id=mavlink.MAV_CMD_NAV_LAND)
    disarm = ardupilot.DISARM

    def mode(self, custom_mode: int) -> str:
        return MODES.get(custom_mode, f"mode {custom_mode}")

    def prepare(self) -> tuple[Command, ...]:
        return ()

    def takeoff(self, height_m: float, home_amsl_m: float) -> tuple[Command, ...]:
        """The altitude of this takeoff counts from home, not from the sea."""
        climb = Command(id=mavlink.MAV_CMD_NAV_TAKEOFF, params=(0.0,) * 6 + (height_m,))
        return ardupilot.set_mode(GUIDED), ardupilot.ARM, climb

    def go_to(self, place: Position, speed_mps: float, heading_rad: float | None) -> tuple[Command, ...]:
        """Speed and heading last until the next target or mode only, so they follow each target."""
        go = (ardupilot.reposition(place, speed_mps), ardupilot.change_speed(speed_mps))
        if heading_rad is None:
            return go
        degrees = math.degrees(heading_rad) % 360.0
        return *go, Command(id=mavlink.MAV_CMD_CONDITION_YAW, params=(degrees, TURN_DEG_PER_S, 0.0, 0.0))

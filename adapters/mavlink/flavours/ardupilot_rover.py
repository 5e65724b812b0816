"""ArduPilot on a rover."""

from typing import ClassVar

from pymavlink.dialects.v20 import common as mavlink

from crew.adapters.mavlink.command import Command, Position
from crew.adapters.mavlink.flavours.flavour import Failsafe, Modes

CUSTOM = float(mavlink.MAV_MODE_FLAG_CUSTOM_MODE_ENABLED)
MODES = {0: "MANUAL", 1: "ACRO", 3: "STEERING", 4: "HOLD", 5: "LOITER", 10: "AUTO", 11: "RTL", 15: "GUIDED"}
HOLD = 4.0
GUIDED = 15.0
CHANGE_MODE = float(mavlink.MAV_DO_REPOSITION_FLAGS_CHANGE_MODE)


class ArduPilotRover:
    """Drives in GUIDED, stands in HOLD."""

    title = "ArduPilot rover"
    kind = "rover"
    autopilot = mavlink.MAV_AUTOPILOT_ARDUPILOTMEGA
    vehicle_types = frozenset({mavlink.MAV_TYPE_GROUND_ROVER})
    sensors: ClassVar[dict[int, str]] = {
        mavlink.MAV_SYS_STATUS_SENSOR_3D_GYRO: "gyro",
        mavlink.MAV_SYS_STATUS_SENSOR_3D_ACCEL: "accelerometer",
        mavlink.MAV_SYS_STATUS_SENSOR_GPS: "GPS",
        mavlink.MAV_SYS_STATUS_SENSOR_BATTERY: "battery",
    }
    prearm_bit = 0  # its meaning depends on the mode; a refused arming tells the reasons
    failsafes = (
        Failsafe("FS_GCS_ENABLE", lambda v: v > 0, "not 0 (off): the vehicle minds a silent ground"),
        Failsafe("FS_GCS_TIMEOUT", lambda v: 0 < v <= 60, "above 0 and at most 60 s of silence"),
        Failsafe("FS_ACTION", lambda v: v > 0, "not 0 (nothing): what it does then"),
    )
    streams: ClassVar[dict[int, float]] = {
        mavlink.MAVLINK_MSG_ID_SYS_STATUS: 2.0,
        mavlink.MAVLINK_MSG_ID_HOME_POSITION: 1.0,
        mavlink.MAVLINK_MSG_ID_GLOBAL_POSITION_INT: 20.0,
        mavlink.MAVLINK_MSG_ID_ATTITUDE: 20.0,
        mavlink.MAVLINK_MSG_ID_EXTENDED_SYS_STATE: 5.0,
        mavlink.MAVLINK_MSG_ID_BATTERY_STATUS: 1.0,
    }
    stop = Command(id=mavlink.MAV_CMD_DO_SET_MODE, params=(CUSTOM, HOLD))
    stop_mode = "HOLD"
    travel_modes: Modes = frozenset({"GUIDED"})
    guided = Command(id=mavlink.MAV_CMD_DO_SET_MODE, params=(CUSTOM, GUIDED))
    arm = Command(id=mavlink.MAV_CMD_COMPONENT_ARM_DISARM, params=(1.0,))

    def mode(self, custom_mode: int) -> str:
        return MODES.get(custom_mode, f"mode {custom_mode}")

    def prepare(self) -> tuple[Command, ...]:
        return self.guided, self.arm

    def go_to(self, place: Position, speed_mps: float, heading_rad: float | None) -> Command:
        params = (speed_mps, CHANGE_MODE, 0.0, 0.0)
        return Command(id=mavlink.MAV_CMD_DO_REPOSITION, params=params, position=place)

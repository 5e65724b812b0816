"""ArduPilot on a rover."""

from typing import ClassVar

from pymavlink.dialects.v20 import common as mavlink

from crew.adapters.mavlink.command import Command, Position
from crew.adapters.mavlink.flavours import ardupilot
from crew.adapters.mavlink.flavours.flavour import Failsafe, Modes

MODES = {0: "MANUAL", 1: "ACRO", 3: "STEERING", 4: "HOLD", 5: "LOITER", 10: "AUTO", 11: "RTL", 15: "GUIDED"}
HOLD, GUIDED = 4, 15


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
    fences = (
        Failsafe("FENCE_ENABLE", lambda v: v > 0, "not 0 (off)"),
        Failsafe("FENCE_RADIUS", lambda v: 0 < v <= 1000, "above 0 and at most 1000 m from home"),
    )
    streams: ClassVar[dict[int, float]] = ardupilot.STREAMS
    stops = (ardupilot.set_mode(HOLD),)
    stop_mode = "HOLD"
    travel_modes: Modes = frozenset({"GUIDED"})

    def mode(self, custom_mode: int) -> str:
        return MODES.get(custom_mode, f"mode {custom_mode}")

    def prepare(self) -> tuple[Command, ...]:
        return ardupilot.set_mode(GUIDED), ardupilot.ARM

    def go_to(self, place: Position, speed_mps: float, heading_rad: float | None) -> tuple[Command, ...]:
        return (ardupilot.reposition(place, speed_mps),)

"""What PX4 is like on every vehicle."""

import math

from pymavlink.dialects.v20 import common as mavlink

from crew.adapters.mavlink.command import UNUSED, Command, Position

CUSTOM = float(mavlink.MAV_MODE_FLAG_CUSTOM_MODE_ENABLED)
CHANGE_MODE = float(mavlink.MAV_DO_REPOSITION_FLAGS_CHANGE_MODE)
AUTO, LOITER = 4, 3
MAIN_MODES = {1: "MANUAL", 2: "ALTCTL", 3: "POSCTL", 4: "AUTO", 5: "ACRO", 6: "OFFBOARD", 7: "STABILIZED"}
AUTO_MODES = {1: "READY", 2: "TAKEOFF", 3: "LOITER", 4: "MISSION", 5: "RTL", 6: "LAND", 9: "PRECLAND"}

ARM = Command(id=mavlink.MAV_CMD_COMPONENT_ARM_DISARM, params=(1.0,))
DISARM = Command(id=mavlink.MAV_CMD_COMPONENT_ARM_DISARM, params=(0.0,))
STOP = (
    Command(id=mavlink.MAV_CMD_DO_SET_MODE, params=(CUSTOM, AUTO, LOITER)),
    Command(id=mavlink.MAV_CMD_DO_REPOSITION, params=(-1.0, CHANGE_MODE, 0.0), fill=UNUSED),
)
"""LOITER takes it out of any other mode; in LOITER it would go on to where it was sent, so it is sent nowhere."""


def mode_name(custom_mode: int) -> str:
    """A custom mode of the heartbeat in words: `POSCTL`, `AUTO.LOITER`."""
    main, sub = custom_mode >> 16 & 0xFF, custom_mode >> 24 & 0xFF
    name = MAIN_MODES.get(main, f"main {main}")
    return f"{name}.{AUTO_MODES.get(sub, sub)}" if main == AUTO else name


def reposition(place: Position, speed_mps: float, heading_rad: float | None) -> Command:
    """Go to a place in LOITER, whatever AUTO mode it is in."""
    params = (speed_mps, CHANGE_MODE, 0.0, math.nan if heading_rad is None else heading_rad)
    return Command(id=mavlink.MAV_CMD_DO_REPOSITION, params=params, position=place)

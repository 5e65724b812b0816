"""What ArduPilot is like on every vehicle."""

from pymavlink.dialects.v20 import common as mavlink

from crew.adapters.mavlink.command import Command, Position

CUSTOM = float(mavlink.MAV_MODE_FLAG_CUSTOM_MODE_ENABLED)
CHANGE_MODE = float(mavlink.MAV_DO_REPOSITION_FLAGS_CHANGE_MODE)
GROUND_SPEED = 1.0

ARM = Command(id=mavlink.MAV_CMD_COMPONENT_ARM_DISARM, params=(1.0,))
DISARM = Command(id=mavlink.MAV_CMD_COMPONENT_ARM_DISARM, params=(0.0,))
STREAMS: dict[int, float] = {
    mavlink.MAVLINK_MSG_ID_SYS_STATUS: 2.0,
    mavlink.MAVLINK_MSG_ID_HOME_POSITION: 1.0,
    mavlink.MAVLINK_MSG_ID_GLOBAL_POSITION_INT: 20.0,
    mavlink.MAVLINK_MSG_ID_ATTITUDE: 20.0,
    mavlink.MAVLINK_MSG_ID_EXTENDED_SYS_STATE: 5.0,
    mavlink.MAVLINK_MSG_ID_BATTERY_STATUS: 1.0,
    mavlink.MAVLINK_MSG_ID_POSITION_TARGET_GLOBAL_INT: 2.0,
}


def set_mode(number: int) -> Command:
    """Change to a mode by its number."""
    return Command(id=mavlink.MAV_CMD_DO_SET_MODE, params=(CUSTOM, float(number)))


def reposition(place: Position, speed_mps: float) -> Command:
    """Go to a place in GUIDED; not every vehicle minds the speed or a heading here."""
    return Command(id=mavlink.MAV_CMD_DO_REPOSITION, params=(speed_mps, CHANGE_MODE, 0.0, 0.0), position=place)


def change_speed(speed_mps: float) -> Command:
    """The ground speed in GUIDED, until the mode changes."""
    return Command(id=mavlink.MAV_CMD_DO_CHANGE_SPEED, params=(GROUND_SPEED, speed_mps, -1.0))

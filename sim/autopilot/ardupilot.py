"""What ArduPilot is like on every vehicle. Pure."""

import math

from pymavlink.dialects.v20 import common as mavlink

from crew.sim.autopilot.autopilot import Autopilot
from crew.sim.autopilot.command import ABSOLUTE, RELATIVE
from crew.sim.autopilot.parameters import Parameters

CAPABILITIES = (
    mavlink.MAV_PROTOCOL_CAPABILITY_COMMAND_INT
    | mavlink.MAV_PROTOCOL_CAPABILITY_PARAM_ENCODE_C_CAST
    | mavlink.MAV_PROTOCOL_CAPABILITY_SET_POSITION_TARGET_GLOBAL_INT
    | mavlink.MAV_PROTOCOL_CAPABILITY_MAVLINK2
)
EKF_STATUS_REPORT = 193  # of ArduPilot's own dialect
GLOBAL = ABSOLUTE | RELATIVE
IGNORE_POSITION = mavlink.POSITION_TARGET_TYPEMASK_X_IGNORE | mavlink.POSITION_TARGET_TYPEMASK_Y_IGNORE


def link_lost(autopilot: Autopilot, parameters: Parameters) -> bool:
    """Whether the ground has fallen silent and that matters; one that was never heard is not lost."""
    on = parameters["FS_GCS_ENABLE"] != 0
    return on and parameters["FS_GCS_TIMEOUT"] < autopilot.ground_silence_s < math.inf

"""What PX4 is like on every vehicle: its mode numbers, whom it takes for a ground station. Pure."""

import math
from typing import Any

from pymavlink.dialects.v20 import common as mavlink

from crew.sim.autopilot.autopilot import GROUND_SYSTEM, NS, Autopilot
from crew.sim.autopilot.parameters import Parameters

AUTO, LOITER = 4, 3
CAPABILITIES = (
    mavlink.MAV_PROTOCOL_CAPABILITY_COMMAND_INT
    | mavlink.MAV_PROTOCOL_CAPABILITY_PARAM_ENCODE_BYTEWISE
    | mavlink.MAV_PROTOCOL_CAPABILITY_MAVLINK2
)


def auto_mode(sub_mode: int) -> int:
    """The heartbeat's custom mode of a sub-mode of AUTO."""
    return AUTO << 16 | sub_mode << 24


def counts_as_ground(heartbeat: Any) -> bool:
    """PX4 counts every ground station, whatever its system id."""
    return bool(heartbeat.get_srcSystem() == GROUND_SYSTEM or heartbeat.type == mavlink.MAV_TYPE_GCS)


def link_lost(autopilot: Autopilot, parameters: Parameters, armed_ns: int) -> bool:
    """Whether the ground has fallen silent and that matters; one never heard is awaited from arming on."""
    silence_s = autopilot.ground_silence_s
    if math.isinf(silence_s):
        silence_s = (autopilot.time_ns - armed_ns) / NS if autopilot.armed else 0.0
    return parameters["NAV_DLL_ACT"] != 0 and silence_s > parameters["COM_DL_LOSS_T"]

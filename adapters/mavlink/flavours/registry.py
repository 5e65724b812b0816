"""The flavours that there are. A new autopilot or vehicle is a file beside this one and a line here."""

from collections.abc import Sequence

from pymavlink.dialects.v20 import common as mavlink

from crew.adapters.mavlink.flavours.ardupilot_copter import ArduPilotCopter
from crew.adapters.mavlink.flavours.ardupilot_rover import ArduPilotRover
from crew.adapters.mavlink.flavours.flavour import Flavour
from crew.adapters.mavlink.flavours.px4_quadcopter import Px4Quadcopter
from crew.adapters.mavlink.flavours.px4_rover import Px4Rover
from crew.errors import AdapterError

FLAVOURS: tuple[Flavour, ...] = (Px4Quadcopter(), ArduPilotCopter(), Px4Rover(), ArduPilotRover())


def find_flavour(kind: str, autopilot: int, vehicle_type: int, known: Sequence[Flavour] = FLAVOURS) -> Flavour | None:
    """The flavour of a heartbeat, or None."""
    for flavour in known:
        if flavour.kind == kind and flavour.autopilot == autopilot and vehicle_type in flavour.vehicle_types:
            return flavour
    return None


def choose_flavour(kind: str, autopilot: int, vehicle_type: int) -> Flavour:
    """The flavour of a heartbeat. Raises AdapterError `wrong_vehicle` listing what is supported."""
    flavour = find_flavour(kind, autopilot, vehicle_type)
    if flavour is None:
        names = ", ".join(f.title for f in FLAVOURS)
        raise AdapterError(
            f"no {kind} here: the heartbeat says {_name('MAV_AUTOPILOT', autopilot)}, "
            f"{_name('MAV_TYPE', vehicle_type)} (supported: {names})",
            code="wrong_vehicle",
        )
    return flavour


def _name(enum: str, value: int) -> str:
    entry = mavlink.enums[enum].get(value)
    return str(entry.name) if entry else f"{enum} {value}"

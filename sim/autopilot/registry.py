"""Which autopilots a vehicle can fly or drive with. A new one is a file beside this one and a line here."""

import difflib
from collections.abc import Mapping
from typing import Any

from crew.sim.autopilot.ardupilot_copter import ArduPilotCopter
from crew.sim.autopilot.ardupilot_rover import ArduPilotRover
from crew.sim.autopilot.px4_quadcopter import Px4Quadcopter
from crew.sim.autopilot.px4_rover import Px4Rover

QUADCOPTERS = {"px4": Px4Quadcopter, "ardupilot": ArduPilotCopter}
ROVERS = {"ardupilot": ArduPilotRover, "px4": Px4Rover}


def choose(vehicle: str, name: str | None, known: Mapping[str, Any]) -> Any:
    """The autopilot of that name; the first for None. Raises ValueError with the valid names and the nearest."""
    if name is None:
        return next(iter(known.values()))
    if name not in known:
        near = difflib.get_close_matches(name, known, n=1, cutoff=0.0)
        raise ValueError(f"{vehicle}: no autopilot {name!r}; valid: {', '.join(known)}; nearest: {near[0]}")
    return known[name]

"""A rover that behaves as PX4 does: its modes, refusals and failsafes. Must not contain control laws."""

import math
from typing import Any, ClassVar

from pymavlink.dialects.v20 import common as mavlink

from crew.sim.autopilot.command import ACCEPTED, Command, Outcome, denied, flag, rejected
from crew.sim.autopilot.driving import Driving
from crew.sim.autopilot.link import Link
from crew.sim.autopilot.parameters import Parameters, Spec
from crew.sim.autopilot.px4 import AUTO, CAPABILITIES, LOITER, auto_mode, counts_as_ground, link_lost
from crew.sim.autopilot.target import Target, inside_fence, resolve
from crew.sim.autopilot.telemetry import FULL_RATES_HZ
from crew.sim.faults import Faults
from crew.sim.geo import GeoFrame
from crew.sim.vehicle.rover import Rover

MANUAL = 1  # a main mode

PARAMETERS = (
    Spec("NAV_DLL_ACT", 1, 0, 3),  # ground link lost: 0 nothing, else hold
    Spec("COM_DL_LOSS_T", 5, 5, 300),  # s
    Spec("COM_LOW_BAT_ACT", 1, 0, 3),
    Spec("BAT_CRIT_THR", 0.07, 0.05, 0.5),
    Spec("RO_SPEED_LIM", 0.6, 0.05, 0.7),  # m/s
    Spec("GF_ACTION", 2, 0, 3),
    Spec("GF_MAX_HOR_DIST", 100.0, 0.0, 10000.0),  # m from home; 0 is no fence
)


class Px4Rover(Driving):
    """AUTO.LOITER stands, or drives to where it was repositioned; MANUAL waits for a pilot."""

    capabilities: ClassVar[int] = CAPABILITIES

    def __init__(self, vehicle: Rover, link: Link, geo: GeoFrame, home: tuple[float, float], faults: Faults) -> None:
        parameters = Parameters(PARAMETERS, bytewise=True)
        super().__init__(vehicle, link, geo, home, faults, parameters, FULL_RATES_HZ)
        self.manual = False
        self._armed_ns = 0
        self._commands |= {
            mavlink.MAV_CMD_DO_SET_MODE: self._set_mode,
            mavlink.MAV_CMD_DO_REPOSITION: self._reposition,
        }

    def heartbeat(self) -> Any:
        mode = MANUAL << 16 if self.manual else auto_mode(LOITER)
        return self.base_heartbeat(mavlink.MAV_AUTOPILOT_PX4, not self.manual, mode)

    def problems(self) -> list[str]:
        found = super().problems()
        if link_lost(self, self.parameters, self._armed_ns):
            found.append("no ground station connected")
        return found

    def is_ground(self, heartbeat: Any) -> bool:
        return counts_as_ground(heartbeat)

    # Commands.

    def arm(self) -> Outcome:
        problems = [] if self._armed else self.problems()
        if problems:
            return rejected(f"Arming denied: {problems[0]}")
        self._armed, self._armed_ns = True, self.time_ns
        return ACCEPTED

    def disarm(self, *, force: bool) -> Outcome:
        self._armed = False
        self.vehicle.halt()
        return ACCEPTED

    def _set_mode(self, command: Command) -> Outcome:
        """A mode that it is in already changes nothing: in LOITER it stays on its way to where it was sent."""
        if not flag(command.p1) & mavlink.MAV_MODE_FLAG_CUSTOM_MODE_ENABLED:
            return denied("Mode change denied: no custom mode given")
        main, sub = flag(command.p2), flag(command.p3)
        if (main, sub) != (AUTO, LOITER) and main != MANUAL:
            return denied(f"Mode {main}/{sub} is not available")
        if self.manual is not (main == MANUAL):
            self.manual = main == MANUAL
            self.vehicle.halt()
        return ACCEPTED

    def _reposition(self, command: Command) -> Outcome:
        if not flag(command.p2) & mavlink.MAV_DO_REPOSITION_FLAGS_CHANGE_MODE:
            return denied("Reposition denied: mode change flag not set")
        if command.is_pause:
            self.manual = False
            self.vehicle.halt()
            return ACCEPTED
        target = resolve(command, self.geo, Target(self.state.x, self.state.y, 0.0), self.home_alt_m)
        if target is None or math.isnan(command.x) or math.isnan(command.y):
            return denied("Reposition denied: frame or position")
        if not self.gps_ok:
            return rejected("Reposition denied: no valid position")
        if not inside_fence(target, self.home, self.parameters["GF_MAX_HOR_DIST"], 0.0):
            return denied("Reposition denied: outside geofence")
        self.manual = False
        limit_mps = self.parameters["RO_SPEED_LIM"]
        self.drive_to(command.x, command.y, min(command.p1, limit_mps) if command.p1 > 0.0 else limit_mps)
        return ACCEPTED

    # Supervision.

    def supervise(self) -> None:
        if not self._armed:
            self.failures.clear()
            return
        self._hold_if(self.faulty, "Failsafe: system fault")
        self._hold_if(link_lost(self, self.parameters, self._armed_ns), "Failsafe: ground link lost")
        self._hold_if(not self.gps_ok, "Failsafe: position lost")

    def _hold_if(self, failing: bool, what: str) -> None:
        """Act when a failure begins: stand, in LOITER; the heartbeat says CRITICAL."""
        if self.failures.begins(what, failing):
            self.say(mavlink.MAV_SEVERITY_CRITICAL, what)
            self.manual = False
            self.vehicle.halt()

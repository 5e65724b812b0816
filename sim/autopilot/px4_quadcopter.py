"""A quadcopter that behaves as PX4 does: its modes, refusals and failsafes. Must not contain control laws."""

import math
from typing import Any, ClassVar

from pymavlink.dialects.v20 import common as mavlink

from crew.sim.autopilot.command import ACCEPTED, Command, Outcome, denied, flag, rejected
from crew.sim.autopilot.copter import Copter
from crew.sim.autopilot.flight import AIRBORNE, Event, Phase
from crew.sim.autopilot.link import Link
from crew.sim.autopilot.parameters import Parameters, Spec
from crew.sim.autopilot.px4 import AUTO, CAPABILITIES, LOITER, auto_mode, counts_as_ground, link_lost
from crew.sim.autopilot.target import Target, inside_fence, resolve
from crew.sim.autopilot.telemetry import FULL_RATES_HZ
from crew.sim.faults import Faults
from crew.sim.geo import GeoFrame, enu_yaw_to_heading_rad
from crew.sim.vehicle.quadcopter import Quadcopter

TAKEOFF, RTL, LAND = 2, 5, 6  # sub-modes of AUTO
SUB_MODE = {Phase.TAKEOFF: TAKEOFF, Phase.RETURN: RTL, Phase.LAND: LAND, Phase.LANDED: LAND}
MODE_EVENT = {LOITER: Event.HOLD, RTL: Event.RETURN, LAND: Event.LAND}
LINK_LOST_EVENT = {1: Event.HOLD, 2: Event.RETURN, 3: Event.LAND}  # by NAV_DLL_ACT
LOW_BATTERY_EVENT = {1: Event.RETURN, 2: Event.LAND, 3: Event.RETURN}  # by COM_LOW_BAT_ACT

PARAMETERS = (
    Spec("NAV_DLL_ACT", 3, 0, 3),  # ground link lost: 0 nothing, 1 hold, 2 return, 3 land
    Spec("COM_DL_LOSS_T", 5, 5, 300),  # s
    Spec("COM_LOW_BAT_ACT", 2, 0, 3),  # battery critical: 0 warn, 1 return, 2 land, 3 return, land when worse
    Spec("BAT_LOW_THR", 0.25, 0.12, 0.5),
    Spec("BAT_CRIT_THR", 0.15, 0.05, 0.5),
    Spec("COM_DISARM_LAND", 2.0, 0.0, 20.0),  # s after touchdown
    Spec("COM_DISARM_PRFLT", 10.0, 0.0, 120.0),  # s armed without a takeoff
    Spec("MIS_TAKEOFF_ALT", 2.5, 0.5, 80.0),  # m above home
    Spec("RTL_RETURN_ALT", 5.0, 0.0, 120.0),  # m above home
    Spec("MPC_XY_VEL_MAX", 3.0, 0.5, 5.0),  # m/s
    Spec("GF_ACTION", 2, 0, 3),
    Spec("GF_MAX_HOR_DIST", 100.0, 0.0, 10000.0),  # m from home; 0 is no fence
    Spec("GF_MAX_VER_DIST", 30.0, 0.0, 10000.0),
)


class Px4Quadcopter(Copter):
    """Commands become events of the flight table."""

    capabilities: ClassVar[int] = CAPABILITIES
    landed_text: ClassVar[str] = "Landing detected"

    def __init__(
        self, vehicle: Quadcopter, link: Link, geo: GeoFrame, home: tuple[float, float], faults: Faults
    ) -> None:
        self.parameters = Parameters(PARAMETERS, bytewise=True)
        super().__init__(vehicle, link, geo, home, faults, self.parameters, FULL_RATES_HZ)
        self._commands |= {
            mavlink.MAV_CMD_NAV_TAKEOFF: self._takeoff,
            mavlink.MAV_CMD_NAV_LAND: lambda _: self.change(Event.LAND),
            mavlink.MAV_CMD_NAV_RETURN_TO_LAUNCH: lambda _: self.change(Event.RETURN),
            mavlink.MAV_CMD_DO_SET_MODE: self._set_mode,
            mavlink.MAV_CMD_DO_REPOSITION: self._reposition,
            mavlink.MAV_CMD_DO_CHANGE_SPEED: self._change_speed,
        }

    @property
    def speed_max_mps(self) -> float:
        return self.parameters["MPC_XY_VEL_MAX"]

    @property
    def return_height_m(self) -> float:
        return self.parameters["RTL_RETURN_ALT"]

    def idle_limit_s(self) -> float:
        return self.parameters["COM_DISARM_LAND" if self.phase is Phase.LANDED else "COM_DISARM_PRFLT"]

    def heartbeat(self) -> Any:
        flags = mavlink.MAV_MODE_FLAG_GUIDED_ENABLED | mavlink.MAV_MODE_FLAG_AUTO_ENABLED
        return self.base_heartbeat(mavlink.MAV_AUTOPILOT_PX4, flags, auto_mode(SUB_MODE.get(self.phase, LOITER)))

    def problems(self) -> list[str]:
        found = super().problems()
        if self._battery_critical():
            found.append("low battery")
        if self._link_lost():
            found.append("no ground station connected")
        return found

    def is_ground(self, heartbeat: Any) -> bool:
        return counts_as_ground(heartbeat)

    # Commands.

    def arm(self) -> Outcome:
        if not self.armed:
            problems = self.problems()
            if problems:
                return rejected(f"Arming denied: {problems[0]}")
        return self.change(Event.ARM)

    def disarm(self, *, force: bool) -> Outcome:
        if force:
            return self.change(Event.KILL)
        if self.phase in AIRBORNE:
            return rejected("Disarming denied: not landed")
        return self.change(Event.DISARM)

    def _takeoff(self, command: Command) -> Outcome:
        height = command.height_m(self.home_alt_m, self.parameters["MIS_TAKEOFF_ALT"])
        if height is None or height < 0.3:
            return denied("Takeoff denied: altitude is not above home")
        if self.phase is Phase.DISARMED:
            return rejected("Takeoff denied: disarmed")
        outcome = self.climb(height)
        if outcome is ACCEPTED:
            self.say(mavlink.MAV_SEVERITY_INFO, "Takeoff detected")
        return outcome

    def _set_mode(self, command: Command) -> Outcome:
        """A mode that it is in already changes nothing: in LOITER it stays on its way to where it was sent."""
        if not flag(command.p1) & mavlink.MAV_MODE_FLAG_CUSTOM_MODE_ENABLED:
            return denied("Mode change denied: no custom mode given")
        event = MODE_EVENT.get(flag(command.p3)) if flag(command.p2) == AUTO else None
        if event is None:
            return denied(f"Mode {flag(command.p2)}/{flag(command.p3)} is not available")
        return self.change(event)

    def _reposition(self, command: Command) -> Outcome:
        if not flag(command.p2) & mavlink.MAV_DO_REPOSITION_FLAGS_CHANGE_MODE:
            return denied("Reposition denied: mode change flag not set")
        if self.phase not in AIRBORNE:
            return rejected("Reposition denied: not in the air")
        if command.is_pause:
            self.change(Event.REPOSITION)
            self.vehicle.brake(self.speed_mps)
            return ACCEPTED
        target = resolve(command, self.geo, Target(self.state.x, self.state.y, self.state.z), self.home_alt_m)
        if target is None:
            return denied("Reposition denied: frame or position")
        if not inside_fence(target, self.home, self.parameters["GF_MAX_HOR_DIST"], self.parameters["GF_MAX_VER_DIST"]):
            return denied("Reposition denied: outside geofence")
        self.change(Event.REPOSITION)
        speed = command.p1 if command.p1 > 0.0 else self.speed_mps
        yaw = None if math.isnan(command.p4) else enu_yaw_to_heading_rad(command.p4)
        self.vehicle.fly_to(*target, min(speed, self.speed_max_mps), yaw)
        return ACCEPTED

    def _change_speed(self, command: Command) -> Outcome:
        if not command.p2 > 0.0:
            return denied("Speed change denied: no speed given")
        self.speed_mps = min(command.p2, self.speed_max_mps)
        return ACCEPTED

    # Supervision.

    def failsafes(self) -> None:
        battery, link = int(self.parameters["COM_LOW_BAT_ACT"]), int(self.parameters["NAV_DLL_ACT"])
        self.fail_if(self.faulty, "Failsafe: system fault", Event.LAND)
        self.fail_if(not self.gps_ok, "Failsafe: position lost", Event.LAND)
        self.fail_if(self._battery_critical(), "Failsafe: battery critical", LOW_BATTERY_EVENT.get(battery))
        self.fail_if(self._link_lost(), "Failsafe: ground link lost", LINK_LOST_EVENT.get(link))

    def _battery_critical(self) -> bool:
        return self.battery.fraction < self.parameters["BAT_CRIT_THR"]

    def _link_lost(self) -> bool:
        return link_lost(self, self.parameters, self.armed_ns)

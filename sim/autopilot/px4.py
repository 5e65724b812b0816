"""A quadcopter that behaves as PX4 does: its modes, refusals and failsafes. Must not contain control laws."""

import math
from typing import Any, ClassVar

from pymavlink.dialects.v20 import common as mavlink

from crew.sim.autopilot.autopilot import NS, Autopilot
from crew.sim.autopilot.command import ACCEPTED, Command, Outcome, denied, flag, rejected
from crew.sim.autopilot.failure import Failures
from crew.sim.autopilot.flight import AIRBORNE, Event, Phase, follow
from crew.sim.autopilot.link import Link
from crew.sim.autopilot.parameters import Parameters, Spec
from crew.sim.autopilot.target import Target, inside_fence, resolve
from crew.sim.autopilot.telemetry import FULL_RATES_HZ
from crew.sim.camera import Detection
from crew.sim.faults import Faults
from crew.sim.geo import GeoFrame, enu_yaw_to_heading_rad
from crew.sim.vehicle.battery import Battery
from crew.sim.vehicle.quadcopter import Quadcopter
from crew.sim.vehicle.state import State

AUTO = 4
TAKEOFF, LOITER, RTL, LAND = 2, 3, 5, 6  # sub-modes of AUTO
SUB_MODE = {Phase.TAKEOFF: TAKEOFF, Phase.RETURN: RTL, Phase.LAND: LAND, Phase.LANDED: LAND}
MODE_EVENT = {LOITER: Event.HOLD, RTL: Event.RETURN, LAND: Event.LAND}
LINK_LOST_EVENT = {1: Event.HOLD, 2: Event.RETURN, 3: Event.LAND}  # by NAV_DLL_ACT
LOW_BATTERY_EVENT = {1: Event.RETURN, 2: Event.LAND, 3: Event.RETURN}  # by COM_LOW_BAT_ACT
REACHED_M = 0.4

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
    Spec("GF_MAX_HOR_DIST", 0.0, 0.0, 10000.0),  # m from home; 0 is no fence
    Spec("GF_MAX_VER_DIST", 0.0, 0.0, 10000.0),
)


class Px4Quadcopter(Autopilot):
    """Commands become events of the flight table; entering a phase gives the inner loops their target."""

    system: ClassVar[int] = 1
    capabilities: ClassVar[int] = (
        mavlink.MAV_PROTOCOL_CAPABILITY_COMMAND_INT
        | mavlink.MAV_PROTOCOL_CAPABILITY_PARAM_ENCODE_BYTEWISE
        | mavlink.MAV_PROTOCOL_CAPABILITY_MAVLINK2
    )

    def __init__(
        self, vehicle: Quadcopter, link: Link, geo: GeoFrame, home: tuple[float, float], faults: Faults
    ) -> None:
        parameters = Parameters(PARAMETERS, bytewise=True)
        super().__init__(vehicle.name, link, geo, home, faults, parameters, FULL_RATES_HZ)
        self.vehicle = vehicle
        self.phase = Phase.DISARMED
        self._since_ns = self._armed_ns = 0
        self._speed = self.parameters["MPC_XY_VEL_MAX"]
        self._failures = Failures()
        self._commands |= {
            mavlink.MAV_CMD_NAV_TAKEOFF: self._takeoff,
            mavlink.MAV_CMD_NAV_LAND: lambda _: self._change(Event.LAND),
            mavlink.MAV_CMD_NAV_RETURN_TO_LAUNCH: lambda _: self._change(Event.RETURN),
            mavlink.MAV_CMD_DO_SET_MODE: self._set_mode,
            mavlink.MAV_CMD_DO_REPOSITION: self._reposition,
            mavlink.MAV_CMD_DO_CHANGE_SPEED: self._change_speed,
        }

    @property
    def state(self) -> State:
        return self.vehicle.state

    @property
    def battery(self) -> Battery:
        return self.vehicle.battery

    @property
    def armed(self) -> bool:
        return self.phase is not Phase.DISARMED

    @property
    def landed_state(self) -> int:
        states = {
            Phase.TAKEOFF: mavlink.MAV_LANDED_STATE_TAKEOFF,
            Phase.HOLD: mavlink.MAV_LANDED_STATE_IN_AIR,
            Phase.RETURN: mavlink.MAV_LANDED_STATE_IN_AIR,
            Phase.LAND: mavlink.MAV_LANDED_STATE_LANDING,
        }
        return int(states.get(self.phase, mavlink.MAV_LANDED_STATE_ON_GROUND))

    def heartbeat(self) -> Any:
        base = mavlink.MAV_MODE_FLAG_CUSTOM_MODE_ENABLED | mavlink.MAV_MODE_FLAG_STABILIZE_ENABLED
        base |= mavlink.MAV_MODE_FLAG_GUIDED_ENABLED | mavlink.MAV_MODE_FLAG_AUTO_ENABLED
        base |= mavlink.MAV_MODE_FLAG_SAFETY_ARMED if self.armed else 0
        status = mavlink.MAV_STATE_ACTIVE if self.armed else mavlink.MAV_STATE_STANDBY
        if (self._failures and self.armed) or self.faulty:
            status = mavlink.MAV_STATE_CRITICAL
        mode = AUTO << 16 | SUB_MODE.get(self.phase, LOITER) << 24
        return mavlink.MAVLink_heartbeat_message(
            mavlink.MAV_TYPE_QUADROTOR, mavlink.MAV_AUTOPILOT_PX4, base, mode, status, 3
        )

    def problems(self) -> list[str]:
        found = super().problems()
        if self._battery_critical():
            found.append("low battery")
        if self._link_lost():
            found.append("no ground station connected")
        return found

    def report_target(self, detection: Detection) -> None:
        """Pass what the camera has found on to the ground, as the vision system on board does."""
        angles = (detection.angle_x_rad, detection.angle_y_rad)
        if self.faults.is_on("nan_transmission"):
            angles = (math.nan, math.nan)
        self.link.send(
            mavlink.MAVLink_landing_target_message(
                self.time_ns // 1000,
                0,
                mavlink.MAV_FRAME_BODY_FRD,
                *angles,
                0.0,
                detection.size_x_rad,
                detection.size_y_rad,
                type=mavlink.LANDING_TARGET_TYPE_VISION_OTHER,
            )
        )

    def is_ground(self, heartbeat: Any) -> bool:
        """PX4 counts every ground station, whatever its system id."""
        return super().is_ground(heartbeat) or bool(heartbeat.type == mavlink.MAV_TYPE_GCS)

    # Commands.

    def arm(self) -> Outcome:
        if not self.armed:
            problems = self.problems()
            if problems:
                return rejected(f"Arming denied: {problems[0]}")
        return self._change(Event.ARM)

    def disarm(self, *, force: bool) -> Outcome:
        if force:
            return self._change(Event.KILL)
        if self.phase in AIRBORNE:
            return rejected("Disarming denied: not landed")
        return self._change(Event.DISARM)

    def _takeoff(self, command: Command) -> Outcome:
        default = self.parameters["MIS_TAKEOFF_ALT"]
        height = command.height_m(self.geo.origin.alt_m, default)
        if height is None or height < 0.3:
            return denied("Takeoff denied: altitude is not above home")
        if self.phase is Phase.DISARMED:
            return rejected("Takeoff denied: disarmed")
        outcome = self._change(Event.TAKEOFF)
        if outcome is ACCEPTED:
            s = self.state
            self.vehicle.fly_to(s.x, s.y, height, self._speed, s.yaw)
            self.say(mavlink.MAV_SEVERITY_INFO, "Takeoff detected")
        return outcome

    def _set_mode(self, command: Command) -> Outcome:
        if not flag(command.p1) & mavlink.MAV_MODE_FLAG_CUSTOM_MODE_ENABLED:
            return denied("Mode change denied: no custom mode given")
        event = MODE_EVENT.get(flag(command.p3)) if flag(command.p2) == AUTO else None
        if event is None:
            return denied(f"Mode {flag(command.p2)}/{flag(command.p3)} is not available")
        return self._change(event)

    def _reposition(self, command: Command) -> Outcome:
        if not flag(command.p2) & mavlink.MAV_DO_REPOSITION_FLAGS_CHANGE_MODE:
            return denied("Reposition denied: mode change flag not set")
        if self.phase not in AIRBORNE:
            return rejected("Reposition denied: not in the air")
        here = Target(self.state.x, self.state.y, self.state.z)
        target = resolve(command, self.geo, here)
        if target is None:
            return denied("Reposition denied: frame or position")
        if not inside_fence(target, self.home, self.parameters["GF_MAX_HOR_DIST"], self.parameters["GF_MAX_VER_DIST"]):
            return denied("Reposition denied: outside geofence")
        self._change(Event.REPOSITION)
        speed = command.p1 if command.p1 > 0.0 else self._speed
        yaw = None if math.isnan(command.p4) else enu_yaw_to_heading_rad(command.p4)
        self.vehicle.fly_to(*target, min(speed, self.parameters["MPC_XY_VEL_MAX"]), yaw)
        return ACCEPTED

    def _change_speed(self, command: Command) -> Outcome:
        if not command.p2 > 0.0:
            return denied("Speed change denied: no speed given")
        self._speed = min(command.p2, self.parameters["MPC_XY_VEL_MAX"])
        return ACCEPTED

    # Phases.

    def _change(self, event: Event) -> Outcome:
        after = follow(self.phase, event)
        if after is None:
            return rejected(f"{event.capitalize()} denied: {self.phase}")
        before, self.phase = self.phase, after
        if after is not before:
            self._since_ns = self.time_ns
        self._enter(before, after, event)
        return ACCEPTED

    def _enter(self, before: Phase, after: Phase, event: Event) -> None:
        """Give the inner loops what the phase needs; targets of a takeoff or a reposition come with the command."""
        vehicle = self.vehicle
        if event is Event.HOLD and after is Phase.HOLD:
            vehicle.brake(self._speed)
        if after is before:
            return
        match after:
            case Phase.DISARMED:
                vehicle.spin_down()
                self._failures.clear()
                self._speed = self.parameters["MPC_XY_VEL_MAX"]
                self.say(mavlink.MAV_SEVERITY_INFO, "Disarmed")
            case Phase.ARMED if before is Phase.DISARMED:
                vehicle.spin_up()
                self._armed_ns = self.time_ns
            case Phase.RETURN:
                height = max(self.state.z, self.parameters["RTL_RETURN_ALT"])
                vehicle.fly_to(*self.home, height, self._speed)
            case Phase.LAND:
                vehicle.descend(self._speed)
            case Phase.LANDED:
                vehicle.settle()
                self.say(mavlink.MAV_SEVERITY_INFO, "Landing detected")

    # Supervision.

    def supervise(self) -> None:
        if self.phase is Phase.DISARMED:
            return
        if self.phase in AIRBORNE:
            self._failsafes()
        idle_s = (self.time_ns - self._since_ns) / NS
        match self.phase:
            case Phase.TAKEOFF | Phase.RETURN if self.vehicle.distance_to_target() < REACHED_M:
                self._change(Event.REACHED)
            case Phase.LAND if self.vehicle.touched_down:
                self._change(Event.TOUCHDOWN)
            case Phase.LANDED if idle_s >= self.parameters["COM_DISARM_LAND"]:
                self._change(Event.IDLE)
            case Phase.ARMED if idle_s >= self.parameters["COM_DISARM_PRFLT"]:
                self._change(Event.IDLE)

    def _failsafes(self) -> None:
        link, battery = int(self.parameters["NAV_DLL_ACT"]), int(self.parameters["COM_LOW_BAT_ACT"])
        self._fail_if(not self.gps_ok, "position lost", Event.LAND)
        self._fail_if(self._battery_critical(), "battery critical", LOW_BATTERY_EVENT.get(battery))
        self._fail_if(self._link_lost(), "ground link lost", LINK_LOST_EVENT.get(link))

    def _battery_critical(self) -> bool:
        return self.battery.fraction < self.parameters["BAT_CRIT_THR"]

    def _link_lost(self) -> bool:
        """Whether the ground has fallen silent and that matters; one never heard is awaited from arming on."""
        silence_s = self.ground_silence_s
        if math.isinf(silence_s):
            silence_s = (self.time_ns - self._armed_ns) / NS if self.armed else 0.0
        return self.parameters["NAV_DLL_ACT"] != 0 and silence_s > self.parameters["COM_DL_LOSS_T"]

    def _fail_if(self, failing: bool, what: str, action: Event | None) -> None:
        if self._failures.begins(what, failing):
            self.say(mavlink.MAV_SEVERITY_CRITICAL, f"Failsafe: {what}")
            if action is not None and self.phase is not Phase.LAND:
                self._change(action)

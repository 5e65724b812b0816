"""A quadcopter that behaves as ArduPilot Copter does: its modes, refusals, failsafes. Must not contain control laws."""

import math
from typing import Any, ClassVar

from pymavlink.dialects.v20 import common as mavlink

from crew.sim.autopilot.ardupilot import CAPABILITIES, EKF_STATUS_REPORT, GLOBAL, IGNORE_POSITION, link_lost
from crew.sim.autopilot.command import ACCEPTED, RELATIVE, Command, Outcome, denied, flag
from crew.sim.autopilot.copter import Copter
from crew.sim.autopilot.flight import AIRBORNE, Event, Phase
from crew.sim.autopilot.link import Link
from crew.sim.autopilot.parameters import Parameters, Spec
from crew.sim.autopilot.target import Target, inside_fence, on_earth, resolve
from crew.sim.autopilot.telemetry import HEARTBEAT_ONLY_HZ
from crew.sim.faults import Faults
from crew.sim.geo import GeoFrame, enu_yaw_to_heading_rad
from crew.sim.vehicle.quadcopter import Quadcopter

STABILIZE, GUIDED, LOITER, RTL, LAND, BRAKE = 0, 4, 5, 6, 9, 17
NAMES = {STABILIZE: "STABILIZE", GUIDED: "GUIDED", LOITER: "LOITER", RTL: "RTL", LAND: "LAND", BRAKE: "BRAKE"}
MODE_EVENT = {GUIDED: Event.HOLD, LOITER: Event.HOLD, BRAKE: Event.HOLD, RTL: Event.RETURN, LAND: Event.LAND}
ARMABLE = frozenset({STABILIZE, GUIDED, LOITER})
FAILSAFE_MODE = {1: RTL, 2: RTL, 3: RTL, 4: RTL, 5: LAND}  # by FS_GCS_ENABLE
BATTERY_MODE = {1: LAND, 2: RTL}  # by BATT_FS_CRT_ACT
BATTERY_CRITICAL = 0.15
FACING_M = 2.0  # it turns towards a target further away than this
FAILED = mavlink.MAV_RESULT_FAILED

PARAMETERS = (
    Spec("FS_GCS_ENABLE", 5, 0, 5),  # ground lost: 0 nothing, 1 to 4 return, 5 land
    Spec("FS_GCS_TIMEOUT", 5.0, 2.0, 120.0),  # s
    Spec("FS_EKF_ACTION", 1, 0, 3),  # position lost: 0 nothing, else land
    Spec("BATT_FS_CRT_ACT", 1, 0, 2),  # 0 nothing, 1 land, 2 return
    Spec("DISARM_DELAY", 10, 0, 127),  # s on the ground
    Spec("RTL_ALT", 500, 30, 300000),  # cm above home
    Spec("WPNAV_SPEED", 300.0, 10.0, 500.0),  # cm/s
    Spec("WP_YAW_BEHAVIOR", 2, 0, 3),  # 0 keeps the heading, else it faces the next target
    Spec("FENCE_ENABLE", 1, 0, 1),
    Spec("FENCE_RADIUS", 100.0, 30.0, 10000.0),  # m from home
    Spec("FENCE_ALT_MAX", 30.0, 10.0, 1000.0),  # m above home
)


class ArduPilotCopter(Copter):
    """Its mode is a number of its own; what it does in the air follows the flight table."""

    capabilities: ClassVar[int] = CAPABILITIES
    unsent: ClassVar[frozenset[int]] = frozenset({EKF_STATUS_REPORT})

    def __init__(
        self, vehicle: Quadcopter, link: Link, geo: GeoFrame, home: tuple[float, float], faults: Faults
    ) -> None:
        self.parameters = Parameters(PARAMETERS, bytewise=False)
        super().__init__(vehicle, link, geo, home, faults, self.parameters, HEARTBEAT_ONLY_HZ)
        self.mode = STABILIZE
        self._commands |= {
            mavlink.MAV_CMD_NAV_TAKEOFF: self._takeoff,
            mavlink.MAV_CMD_NAV_LAND: lambda _: self._enter_mode(LAND),
            mavlink.MAV_CMD_NAV_RETURN_TO_LAUNCH: lambda _: self._enter_mode(RTL),
            mavlink.MAV_CMD_DO_SET_MODE: self._set_mode,
            mavlink.MAV_CMD_DO_REPOSITION: self._reposition,
            mavlink.MAV_CMD_DO_CHANGE_SPEED: self._change_speed,
            mavlink.MAV_CMD_CONDITION_YAW: self._turn,
        }
        self._handlers["SET_POSITION_TARGET_GLOBAL_INT"] = self._on_position_target

    @property
    def speed_max_mps(self) -> float:
        return self.parameters["WPNAV_SPEED"] / 100.0

    @property
    def return_height_m(self) -> float:
        return self.parameters["RTL_ALT"] / 100.0

    def idle_limit_s(self) -> float:
        """A landing ends in a disarm at once; otherwise it waits."""
        return 1.0 if self.phase is Phase.LANDED else self.parameters["DISARM_DELAY"] or math.inf

    def heartbeat(self) -> Any:
        flags = mavlink.MAV_MODE_FLAG_GUIDED_ENABLED if self.mode == GUIDED else 0
        return self.base_heartbeat(mavlink.MAV_AUTOPILOT_ARDUPILOTMEGA, flags, self.mode)

    def problems(self) -> list[str]:
        found = super().problems()
        if self.battery.fraction < BATTERY_CRITICAL:
            found.append("Battery 1 below minimum arming capacity")
        return found

    # Commands.

    def arm(self) -> Outcome:
        if not self.armed:
            if self.mode not in ARMABLE:
                return Outcome(FAILED, f"Arm: {NAMES[self.mode]} mode not armable")
            if problems := self.problems():
                return Outcome(FAILED, f"PreArm: {problems[0]}")
        return self.change(Event.ARM)

    def disarm(self, *, force: bool) -> Outcome:
        if force:
            return self.change(Event.KILL)
        if self.phase in AIRBORNE:
            return Outcome(FAILED, "Disarm: not landed")
        return self.change(Event.DISARM)

    def _takeoff(self, command: Command) -> Outcome:
        """The altitude of a COMMAND_LONG is above home here."""
        height_m = command.z if command.frame is None or command.frame in RELATIVE else math.nan
        if self.mode != GUIDED or not self.armed:
            return Outcome(FAILED, f"Takeoff: {'not armed' if self.mode == GUIDED else 'not in GUIDED'}")
        if not height_m >= 0.3:
            return Outcome(FAILED, "Takeoff: altitude is not above home")
        if self.phase in AIRBORNE:
            return Outcome(FAILED, "Takeoff: already in the air")
        return self.climb(height_m)

    def _set_mode(self, command: Command) -> Outcome:
        if not flag(command.p1) & mavlink.MAV_MODE_FLAG_CUSTOM_MODE_ENABLED:
            return denied("Mode change failed: no custom mode given")
        return self._enter_mode(flag(command.p2))

    def _enter_mode(self, mode: int) -> Outcome:
        if mode not in NAMES:
            return Outcome(FAILED, f"Mode change failed: no mode {mode}")
        if mode not in (STABILIZE, LAND) and not self.gps_ok:
            return Outcome(FAILED, f"Mode change to {NAMES[mode]} failed: requires position")
        if mode == STABILIZE and self.phase in AIRBORNE:
            return Outcome(FAILED, "Mode change to STABILIZE failed: no pilot input")
        if mode == self.mode:
            return ACCEPTED
        event = MODE_EVENT.get(mode)
        if self.phase in AIRBORNE and event is not None:
            if self.phase is Phase.HOLD and event is Event.HOLD:
                self.vehicle.brake(self.speed_mps)
            self.change(event)
        self.mode = mode
        self.speed_mps = self.speed_max_mps
        return ACCEPTED

    def _reposition(self, command: Command) -> Outcome:
        if command.frame is None:
            return Outcome(mavlink.MAV_RESULT_COMMAND_INT_ONLY, "Reposition: COMMAND_INT only")
        target = resolve(command, self.geo, Target(self.state.x, self.state.y, self.state.z), self.home_alt_m)
        if target is None or math.isnan(command.x) or math.isnan(command.y):
            return denied("Reposition denied: frame or position")
        change = flag(command.p2) & mavlink.MAV_DO_REPOSITION_FLAGS_CHANGE_MODE
        if self.mode != GUIDED and not change:
            return denied("Reposition denied: not in GUIDED")
        if self.phase not in AIRBORNE:
            return Outcome(FAILED, "Reposition denied: not in the air")
        if not self._inside_fence(target):
            return Outcome(FAILED, "Reposition denied: outside fence")
        if self.mode != GUIDED:
            outcome = self._enter_mode(GUIDED)
            if outcome is not ACCEPTED:
                return outcome
        return self._go(target)

    def _go(self, target: Target) -> Outcome:
        self.change(Event.REPOSITION)
        self.vehicle.fly_to(*target, self.speed_mps, self._facing(target))
        return ACCEPTED

    def _facing(self, target: Target) -> float | None:
        dx, dy = target.x_m - self.state.x, target.y_m - self.state.y
        turns = self.parameters["WP_YAW_BEHAVIOR"] != 0 and math.hypot(dx, dy) > FACING_M
        return math.atan2(dy, dx) if turns else None

    def _inside_fence(self, target: Target) -> bool:
        if not self.parameters["FENCE_ENABLE"]:
            return True
        return inside_fence(target, self.home, self.parameters["FENCE_RADIUS"], self.parameters["FENCE_ALT_MAX"])

    def _turn(self, command: Command) -> Outcome:
        if self.mode != GUIDED or self.phase not in AIRBORNE:
            return Outcome(FAILED, "Yaw: not in GUIDED")
        heading_rad = math.radians(command.p1)
        if command.p4 == 1.0:
            heading_rad = enu_yaw_to_heading_rad(self.state.yaw) + heading_rad * (command.p3 or 1.0)
        self.vehicle.turn_to(enu_yaw_to_heading_rad(heading_rad))
        return ACCEPTED

    def _change_speed(self, command: Command) -> Outcome:
        if not command.p2 > 0.0 or self.mode != GUIDED:
            return Outcome(FAILED, "Speed change: needs GUIDED and a speed")
        self.speed_mps = min(command.p2, self.speed_max_mps)
        self.vehicle.limit_speed(self.speed_mps)
        return ACCEPTED

    def _on_position_target(self, message: Any) -> None:
        """Taken in GUIDED and in the air only, and never acknowledged."""
        position = not message.type_mask & IGNORE_POSITION
        if not self.for_me(message) or self.mode != GUIDED or self.phase not in AIRBORNE or not position:
            return
        lat_deg, lon_deg = message.lat_int * 1e-7, message.lon_int * 1e-7
        if message.coordinate_frame not in GLOBAL or not on_earth(lat_deg, lon_deg):
            return
        above_m = 0.0 if message.coordinate_frame in RELATIVE else self.home_alt_m
        target = Target(*self.geo.to_world(lat_deg, lon_deg), message.alt - above_m)
        if self._inside_fence(target):
            self._go(target)

    # Supervision.

    def failsafes(self) -> None:
        link, battery = int(self.parameters["FS_GCS_ENABLE"]), int(self.parameters["BATT_FS_CRT_ACT"])
        critical = self.battery.fraction < BATTERY_CRITICAL
        self._fall_back(self.faulty, "Failsafe: system fault", LAND)
        self._fall_back(not self.gps_ok, "EKF Failsafe", LAND if self.parameters["FS_EKF_ACTION"] else None)
        self._fall_back(critical, "Battery Failsafe", BATTERY_MODE.get(battery))
        self._fall_back(link_lost(self, self.parameters), "GCS Failsafe", FAILSAFE_MODE.get(link))

    def _fall_back(self, failing: bool, what: str, mode: int | None) -> None:
        if self.fail_if(failing, what, None if mode is None else MODE_EVENT[mode]) and mode is not None:
            self.mode = mode

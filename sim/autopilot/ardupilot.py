"""A rover that behaves as ArduPilot Rover does: its modes, refusals and failsafes. Must not contain control laws."""

import math
from typing import Any, ClassVar

from pymavlink.dialects.v20 import common as mavlink

from crew.sim.autopilot.autopilot import Autopilot
from crew.sim.autopilot.command import ABSOLUTE, ACCEPTED, RELATIVE, Command, Outcome, denied, flag, rejected
from crew.sim.autopilot.failure import Failures
from crew.sim.autopilot.link import Link
from crew.sim.autopilot.parameters import Parameters, Spec
from crew.sim.autopilot.target import on_earth
from crew.sim.autopilot.telemetry import HEARTBEAT_ONLY_HZ
from crew.sim.faults import Faults
from crew.sim.geo import GeoFrame
from crew.sim.vehicle.battery import Battery
from crew.sim.vehicle.rover import Rover
from crew.sim.vehicle.state import State

HOLD, GUIDED = 4, 15
MODES = frozenset({HOLD, GUIDED})
IGNORE_POSITION = mavlink.POSITION_TARGET_TYPEMASK_X_IGNORE | mavlink.POSITION_TARGET_TYPEMASK_Y_IGNORE

PARAMETERS = (
    Spec("FS_GCS_ENABLE", 1, 0, 1),
    Spec("FS_GCS_TIMEOUT", 5.0, 2.0, 120.0),  # s
    Spec("FS_ACTION", 2, 0, 2),  # 0 nothing, 1 and 2 hold (this rover knows no way home)
    Spec("FS_EKF_ACTION", 1, 0, 1),  # position lost: 0 nothing, 1 hold
    Spec("BATT_CRT_MAH", 0.0, 0.0, 100000.0),
    Spec("WP_SPEED", 0.6, 0.05, 0.7),  # m/s
)


class ArduPilotRover(Autopilot):
    """Two modes: HOLD stands still, GUIDED drives to the last position target; armed or not."""

    system: ClassVar[int] = 2
    capabilities: ClassVar[int] = (
        mavlink.MAV_PROTOCOL_CAPABILITY_COMMAND_INT
        | mavlink.MAV_PROTOCOL_CAPABILITY_PARAM_ENCODE_C_CAST
        | mavlink.MAV_PROTOCOL_CAPABILITY_SET_POSITION_TARGET_GLOBAL_INT
        | mavlink.MAV_PROTOCOL_CAPABILITY_MAVLINK2
    )

    def __init__(self, vehicle: Rover, link: Link, geo: GeoFrame, home: tuple[float, float], faults: Faults) -> None:
        parameters = Parameters(PARAMETERS, bytewise=False)
        super().__init__(vehicle.name, link, geo, home, faults, parameters, HEARTBEAT_ONLY_HZ)
        self.vehicle = vehicle
        self.mode = HOLD
        self._armed = False
        self._speed: float | None = None
        self._failures = Failures()
        self._commands |= {
            mavlink.MAV_CMD_DO_SET_MODE: self._set_mode,
            mavlink.MAV_CMD_DO_REPOSITION: self._reposition,
            mavlink.MAV_CMD_DO_CHANGE_SPEED: self._change_speed,
        }
        self._handlers["SET_POSITION_TARGET_GLOBAL_INT"] = self._on_position_target

    @property
    def state(self) -> State:
        return self.vehicle.state

    @property
    def battery(self) -> Battery:
        return self.vehicle.battery

    @property
    def armed(self) -> bool:
        return self._armed

    @property
    def landed_state(self) -> int:
        return int(mavlink.MAV_LANDED_STATE_ON_GROUND)

    def heartbeat(self) -> Any:
        base = mavlink.MAV_MODE_FLAG_CUSTOM_MODE_ENABLED
        base |= mavlink.MAV_MODE_FLAG_GUIDED_ENABLED if self.mode == GUIDED else 0
        base |= mavlink.MAV_MODE_FLAG_SAFETY_ARMED if self._armed else 0
        status = mavlink.MAV_STATE_ACTIVE if self._armed else mavlink.MAV_STATE_STANDBY
        if self._failures or self.faulty:
            status = mavlink.MAV_STATE_CRITICAL
        return mavlink.MAVLink_heartbeat_message(
            mavlink.MAV_TYPE_GROUND_ROVER, mavlink.MAV_AUTOPILOT_ARDUPILOTMEGA, base, self.mode, status, 3
        )

    # Commands.

    def arm(self) -> Outcome:
        problems = [] if self._armed else self.problems()
        if problems:
            return rejected(f"PreArm: {problems[0]}")
        self._armed = True
        return ACCEPTED

    def disarm(self, *, force: bool) -> Outcome:
        self._armed = False
        self.vehicle.halt()
        return ACCEPTED

    def _set_mode(self, command: Command) -> Outcome:
        if not flag(command.p1) & mavlink.MAV_MODE_FLAG_CUSTOM_MODE_ENABLED:
            return denied("Mode change failed: no custom mode given")
        mode = flag(command.p2)
        if mode not in MODES:
            return denied(f"Mode change failed: no mode {mode}")
        if mode == GUIDED and not self.gps_ok:
            return rejected("Mode change to GUIDED failed: requires position")
        self._enter(mode)
        return ACCEPTED

    def _reposition(self, command: Command) -> Outcome:
        if command.frame is None:
            return Outcome(mavlink.MAV_RESULT_COMMAND_INT_ONLY, "Reposition: COMMAND_INT only")
        if command.frame not in ABSOLUTE | RELATIVE or not on_earth(command.x, command.y):
            return denied("Reposition denied: frame or position")
        if self.mode != GUIDED:
            if not flag(command.p2) & mavlink.MAV_DO_REPOSITION_FLAGS_CHANGE_MODE:
                return rejected("Reposition denied: not in GUIDED")
            if not self.gps_ok:
                return rejected("Mode change to GUIDED failed: requires position")
            self._enter(GUIDED)
        self._speed = command.p1 if command.p1 > 0.0 else None
        self._drive_to(command.x, command.y)
        return ACCEPTED

    def _change_speed(self, command: Command) -> Outcome:
        if self.mode != GUIDED or not command.p2 > 0.0:
            return rejected("Speed change denied: needs GUIDED and a speed")
        self._speed = command.p2
        return ACCEPTED

    def _on_position_target(self, message: Any) -> None:
        """Taken in GUIDED only, and never acknowledged, as by the real one."""
        position = not message.type_mask & IGNORE_POSITION
        known = message.coordinate_frame in ABSOLUTE | RELATIVE
        if self.for_me(message) and self.mode == GUIDED and known and position:
            lat_deg, lon_deg = message.lat_int * 1e-7, message.lon_int * 1e-7
            if on_earth(lat_deg, lon_deg):
                self._drive_to(lat_deg, lon_deg)

    def _drive_to(self, lat_deg: float, lon_deg: float) -> None:
        if self._armed:
            limit = self.parameters["WP_SPEED"]
            self.vehicle.drive_to(*self.geo.to_world(lat_deg, lon_deg), self._speed or limit)

    def _enter(self, mode: int) -> None:
        if mode != self.mode:
            self.vehicle.halt()
            self._speed = None
        self.mode = mode

    # Supervision.

    def supervise(self) -> None:
        if not self._armed:
            self._failures.clear()
            return
        self._fail_if(self._link_lost(), "GCS failsafe", self.parameters["FS_ACTION"] != 0)
        self._fail_if(not self.gps_ok, "EKF failsafe: no position", self.parameters["FS_EKF_ACTION"] != 0)

    def _link_lost(self) -> bool:
        """Whether the ground has fallen silent and that matters; one that was never heard is not lost."""
        on = self.parameters["FS_GCS_ENABLE"] != 0
        return on and self.parameters["FS_GCS_TIMEOUT"] < self.ground_silence_s < math.inf

    def _fail_if(self, failing: bool, what: str, hold: bool) -> None:
        """Act when a failure begins. The mode stays as the failsafe left it when the failure ends."""
        if self._failures.begins(what, failing):
            self.say(mavlink.MAV_SEVERITY_CRITICAL, f"{what}{': HOLD' if hold else ''}")
            if hold:
                self._enter(HOLD)

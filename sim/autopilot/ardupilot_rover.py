"""A rover that behaves as ArduPilot Rover does: its modes, refusals and failsafes. Must not contain control laws."""

from typing import Any, ClassVar

from pymavlink.dialects.v20 import common as mavlink

from crew.sim.autopilot.ardupilot import CAPABILITIES, EKF_STATUS_REPORT, GLOBAL, IGNORE_POSITION, link_lost
from crew.sim.autopilot.command import ACCEPTED, Command, Outcome, denied, flag, rejected
from crew.sim.autopilot.driving import Driving
from crew.sim.autopilot.link import Link
from crew.sim.autopilot.parameters import Parameters, Spec
from crew.sim.autopilot.target import on_earth
from crew.sim.autopilot.telemetry import HEARTBEAT_ONLY_HZ
from crew.sim.faults import Faults
from crew.sim.geo import GeoFrame
from crew.sim.vehicle.rover import Rover

MANUAL, HOLD, GUIDED = 0, 4, 15
MODES = frozenset({MANUAL, HOLD, GUIDED})

PARAMETERS = (
    Spec("FS_GCS_ENABLE", 1, 0, 1),
    Spec("FS_GCS_TIMEOUT", 5.0, 2.0, 120.0),  # s
    Spec("FS_ACTION", 2, 0, 2),  # 0 nothing, 1 and 2 hold (this rover knows no way home)
    Spec("FS_EKF_ACTION", 1, 0, 1),  # position lost: 0 nothing, 1 hold
    Spec("BATT_CRT_MAH", 0.0, 0.0, 100000.0),
    Spec("WP_SPEED", 0.6, 0.05, 0.7),  # m/s
    Spec("FENCE_ENABLE", 1, 0, 1),
    Spec("FENCE_RADIUS", 100.0, 30.0, 10000.0),  # m from home
)


class ArduPilotRover(Driving):
    """HOLD stands still, GUIDED drives to the last position target, MANUAL waits for a pilot; armed or not."""

    capabilities: ClassVar[int] = CAPABILITIES
    unsent: ClassVar[frozenset[int]] = frozenset({EKF_STATUS_REPORT})

    def __init__(self, vehicle: Rover, link: Link, geo: GeoFrame, home: tuple[float, float], faults: Faults) -> None:
        parameters = Parameters(PARAMETERS, bytewise=False)
        super().__init__(vehicle, link, geo, home, faults, parameters, HEARTBEAT_ONLY_HZ)
        self.mode = HOLD
        self._speed: float | None = None
        self._commands |= {
            mavlink.MAV_CMD_DO_SET_MODE: self._set_mode,
            mavlink.MAV_CMD_DO_REPOSITION: self._reposition,
            mavlink.MAV_CMD_DO_CHANGE_SPEED: self._change_speed,
        }
        self._handlers["SET_POSITION_TARGET_GLOBAL_INT"] = self._on_position_target

    def heartbeat(self) -> Any:
        return self.base_heartbeat(mavlink.MAV_AUTOPILOT_ARDUPILOTMEGA, self.mode == GUIDED, self.mode)

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
        if command.frame not in GLOBAL or not on_earth(command.x, command.y):
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
        known = message.coordinate_frame in GLOBAL
        if self.for_me(message) and self.mode == GUIDED and known and position:
            lat_deg, lon_deg = message.lat_int * 1e-7, message.lon_int * 1e-7
            if on_earth(lat_deg, lon_deg):
                self._drive_to(lat_deg, lon_deg)

    def _drive_to(self, lat_deg: float, lon_deg: float) -> None:
        self.drive_to(lat_deg, lon_deg, self._speed or self.parameters["WP_SPEED"])

    def _enter(self, mode: int) -> None:
        if mode != self.mode:
            self.vehicle.halt()
            self._speed = None
        self.mode = mode

    # Supervision.

    def supervise(self) -> None:
        if not self._armed:
            self.failures.clear()
            return
        self._fail_if(self.faulty, "System fault", True)
        self._fail_if(link_lost(self, self.parameters), "GCS failsafe", self.parameters["FS_ACTION"] != 0)
        self._fail_if(not self.gps_ok, "EKF failsafe: no position", self.parameters["FS_EKF_ACTION"] != 0)

    def _fail_if(self, failing: bool, what: str, hold: bool) -> None:
        """Act when a failure begins. The mode stays as the failsafe left it when the failure ends."""
        if self.failures.begins(what, failing):
            self.say(mavlink.MAV_SEVERITY_CRITICAL, f"{what}{': HOLD' if hold else ''}")
            if hold:
                self._enter(HOLD)

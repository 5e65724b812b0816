"""What every flavour of a flying autopilot shares: the phases of a flight, and the camera's reports.

A flavour decides which command makes which event and what its failsafes are. Must not contain control laws.
"""

import math
from abc import abstractmethod
from typing import Any, ClassVar

from pymavlink.dialects.v20 import common as mavlink

from crew.sim.autopilot.autopilot import NS, Autopilot
from crew.sim.autopilot.command import ACCEPTED, Outcome, rejected
from crew.sim.autopilot.failure import Failures
from crew.sim.autopilot.flight import AIRBORNE, Event, Phase, follow
from crew.sim.camera import Detection
from crew.sim.vehicle.battery import Battery
from crew.sim.vehicle.quadcopter import Quadcopter
from crew.sim.vehicle.state import State

REACHED_M = 0.4
LANDED_STATE = {
    Phase.TAKEOFF: mavlink.MAV_LANDED_STATE_TAKEOFF,
    Phase.HOLD: mavlink.MAV_LANDED_STATE_IN_AIR,
    Phase.RETURN: mavlink.MAV_LANDED_STATE_IN_AIR,
    Phase.LAND: mavlink.MAV_LANDED_STATE_LANDING,
}


class Copter(Autopilot):
    """Events of the flight table; entering a phase gives the inner loops their target."""

    vehicle: Quadcopter
    landed_text: ClassVar[str] = ""

    def __init__(self, vehicle: Quadcopter, *made_of: Any) -> None:
        super().__init__(vehicle.name, *made_of)
        self.vehicle = vehicle
        self.phase = Phase.DISARMED
        self.since_ns = self.armed_ns = 0
        self.speed_mps = self.speed_max_mps
        self.failures = Failures()

    # What a flavour says.

    @property
    @abstractmethod
    def speed_max_mps(self) -> float: ...

    @property
    @abstractmethod
    def return_height_m(self) -> float: ...

    @abstractmethod
    def failsafes(self) -> None:
        """What to do about failures in the air: calls of `fail_if`, once each tick."""

    @abstractmethod
    def idle_limit_s(self) -> float:
        """How long the present phase on the ground may last before it disarms by itself."""

    # What telemetry reads.

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
        return int(LANDED_STATE.get(self.phase, mavlink.MAV_LANDED_STATE_ON_GROUND))

    @property
    def aim(self) -> tuple[float, float, float] | None:
        return self.vehicle.target if self.phase in AIRBORNE else None

    def base_heartbeat(self, autopilot: int, extra_flags: int, mode: int) -> Any:
        """The heartbeat of a quadcopter in a custom mode."""
        base = mavlink.MAV_MODE_FLAG_CUSTOM_MODE_ENABLED | mavlink.MAV_MODE_FLAG_STABILIZE_ENABLED | extra_flags
        base |= mavlink.MAV_MODE_FLAG_SAFETY_ARMED if self.armed else 0
        status = mavlink.MAV_STATE_ACTIVE if self.armed else mavlink.MAV_STATE_STANDBY
        if (self.failures and self.armed) or self.faulty:
            status = mavlink.MAV_STATE_CRITICAL
        return mavlink.MAVLink_heartbeat_message(mavlink.MAV_TYPE_QUADROTOR, autopilot, base, mode, status, 3)

    def report_targets(self, detections: list[Detection]) -> None:
        """Pass what the camera has found on to the ground, as the vision system on board does."""
        for number, detection in enumerate(detections):
            angles = (detection.angle_x_rad, detection.angle_y_rad)
            if self.faults.is_on("nan_transmission"):
                angles = (math.nan, math.nan)
            self.link.send(
                mavlink.MAVLink_landing_target_message(
                    self.time_ns // 1000,
                    number,
                    mavlink.MAV_FRAME_BODY_FRD,
                    *angles,
                    0.0,
                    detection.size_x_rad,
                    detection.size_y_rad,
                    type=mavlink.LANDING_TARGET_TYPE_VISION_OTHER,
                )
            )

    # Phases.

    def climb(self, height_m: float) -> Outcome:
        """Begin a takeoff to a height above home."""
        outcome = self.change(Event.TAKEOFF)
        if outcome is ACCEPTED:
            s = self.state
            self.vehicle.fly_to(s.x, s.y, height_m, self.speed_mps, s.yaw)
        return outcome

    def change(self, event: Event) -> Outcome:
        """Follow the table, or refuse what the phase does not take."""
        after = follow(self.phase, event)
        if after is None:
            return rejected(f"{event.capitalize()} denied: {self.phase}")
        before, self.phase = self.phase, after
        if after is not before:
            self.since_ns = self.time_ns
        self._enter(before, after, event)
        return ACCEPTED

    def _enter(self, before: Phase, after: Phase, event: Event) -> None:
        """Give the inner loops what the phase needs; targets of a takeoff or a reposition come with the command."""
        if after is before:
            return
        vehicle = self.vehicle
        match after:
            case Phase.DISARMED:
                vehicle.spin_down()
                self.failures.clear()
                self.speed_mps = self.speed_max_mps
                self.say(mavlink.MAV_SEVERITY_INFO, "Disarmed")
            case Phase.ARMED if before is Phase.DISARMED:
                vehicle.spin_up()
                self.armed_ns = self.time_ns
            case Phase.HOLD if event is Event.HOLD:
                vehicle.brake(self.speed_mps)
            case Phase.RETURN:
                vehicle.fly_to(*self.home, max(self.state.z, self.return_height_m), self.speed_mps)
            case Phase.LAND:
                vehicle.descend(self.speed_mps)
            case Phase.LANDED:
                vehicle.settle()
                if self.landed_text:
                    self.say(mavlink.MAV_SEVERITY_INFO, self.landed_text)

    # Supervision.

    def supervise(self) -> None:
        if self.phase is Phase.DISARMED:
            return
        if self.phase in AIRBORNE:
            self.failsafes()
        match self.phase:
            case Phase.TAKEOFF | Phase.RETURN if self.vehicle.distance_to_target() < REACHED_M:
                self.change(Event.REACHED)
            case Phase.LAND if self.vehicle.touched_down:
                self.change(Event.TOUCHDOWN)
            case Phase.LANDED | Phase.ARMED if (self.time_ns - self.since_ns) / NS >= self.idle_limit_s():
                self.change(Event.IDLE)

    def fail_if(self, failing: bool, what: str, action: Event | None) -> bool:
        """Act when a failure begins, unless it is landing already; whether it acted."""
        if not self.failures.begins(what, failing):
            return False
        self.say(mavlink.MAV_SEVERITY_CRITICAL, what)
        if action is None or self.phase is Phase.LAND:
            return False
        self.change(action)
        return True

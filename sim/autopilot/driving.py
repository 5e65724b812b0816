"""What every flavour of a rover's autopilot shares. A flavour decides what a command means. Plans no path."""

import math
from typing import Any

from pymavlink.dialects.v20 import common as mavlink

from crew.sim.autopilot.autopilot import Autopilot
from crew.sim.autopilot.failure import Failures
from crew.sim.lidar import FURTHEST_M, NEAREST_M, STEP_DEG
from crew.sim.vehicle.battery import Battery
from crew.sim.vehicle.rover import Rover
from crew.sim.vehicle.state import State

NEAREST_CM, FURTHEST_CM = round(NEAREST_M * 100), round(FURTHEST_M * 100)
UNSEEN_CM = FURTHEST_CM + 1


class Driving(Autopilot):
    """A rover stands, or drives to the last position that it was given."""

    vehicle: Rover

    def __init__(self, vehicle: Rover, *made_of: Any) -> None:
        super().__init__(vehicle.name, *made_of)
        self.vehicle = vehicle
        self.failures = Failures()
        self._armed = False

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

    @property
    def aim(self) -> tuple[float, float, float] | None:
        target = self.vehicle.target
        return None if target is None else (*target, 0.0)

    def base_heartbeat(self, autopilot: int, guided: bool, mode: int) -> Any:
        """The heartbeat of a rover in a custom mode."""
        base = mavlink.MAV_MODE_FLAG_CUSTOM_MODE_ENABLED
        base |= mavlink.MAV_MODE_FLAG_GUIDED_ENABLED if guided else 0
        base |= mavlink.MAV_MODE_FLAG_SAFETY_ARMED if self._armed else 0
        status = mavlink.MAV_STATE_ACTIVE if self._armed else mavlink.MAV_STATE_STANDBY
        if self.failures or self.faulty:
            status = mavlink.MAV_STATE_CRITICAL
        return mavlink.MAVLink_heartbeat_message(mavlink.MAV_TYPE_GROUND_ROVER, autopilot, base, mode, status, 3)

    def report_scan(self, ranges_m: list[float]) -> None:
        """Pass the scanner's distances on to the ground, as the computer on board does."""
        distances = [min(round(r * 100), UNSEEN_CM) if math.isfinite(r) else UNSEEN_CM for r in ranges_m]
        sensor, frame = mavlink.MAV_DISTANCE_SENSOR_LASER, mavlink.MAV_FRAME_BODY_FRD
        self.link.send(
            mavlink.MAVLink_obstacle_distance_message(
                self.time_ns // 1000,
                sensor,
                distances,
                STEP_DEG,
                round(NEAREST_M * 100),
                FURTHEST_CM,
                STEP_DEG,
                0.0,
                frame,
            )
        )

    def drive_to(self, lat_deg: float, lon_deg: float, speed_mps: float) -> None:
        """Drive to a place; a disarmed rover stays where it is."""
        if self._armed:
            self.vehicle.drive_to(*self.geo.to_world(lat_deg, lon_deg), speed_mps)

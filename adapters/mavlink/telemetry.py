"""What the vehicle last said, every value with mission time of its receipt. Numbers that are none are dropped, counted.

Frames: positions are world ENU, metres; heights are above home.
"""

import math
from collections.abc import Callable
from typing import Any, Generic, TypeVar

import msgspec
from pymavlink.dialects.v20 import common as mavlink

from crew.adapters.mavlink.frame import WorldFrame
from crew.adapters.mavlink.statustext import StatusLog
from crew.adapters.mavlink.surroundings import Scan
from crew.adapters.mavlink.track import PoseTrack
from crew.clock import SECOND_NS, Clock

T = TypeVar("T")

SIGHTINGS_MAX = 20_000
"""Detections kept: an hour of one person at 5 Hz; the older half goes first."""

REBOOT_STEP_MS = 1000
"""Boot time further back than reordered datagrams explain."""
HOME_JUMP_M = 2.0
"""A home that moves further than this in flight is not a correction: heights and fences count from it."""


class Sample(msgspec.Struct, Generic[T], frozen=True):
    """A value and mission time of its receipt."""

    value: T
    stamp_ns: int


class Heartbeat(msgspec.Struct, frozen=True):
    custom_mode: int
    armed: bool
    critical: bool
    """The vehicle says that it is in a failsafe, an emergency, or going down."""


class Motion(msgspec.Struct, frozen=True):
    """World east and north, height above home, metres; velocity east, north, up, m/s."""

    x_m: float
    y_m: float
    height_m: float
    east_mps: float
    north_mps: float
    up_mps: float

    @property
    def ground_speed_mps(self) -> float:
        return math.hypot(self.east_mps, self.north_mps)

    @property
    def speed_mps(self) -> float:
        return math.hypot(self.ground_speed_mps, self.up_mps)


class Home(msgspec.Struct, frozen=True):
    """World east and north, and height above mean sea level, metres."""

    x_m: float
    y_m: float
    amsl_m: float


class Sighting(msgspec.Struct, frozen=True):
    """A detection: angles from the downward optical axis towards body x (forward) and y (right), radians.

    Detections with one `boot_s` are of one frame, and of different things.
    """

    forward_rad: float
    right_rad: float
    boot_s: float
    stamp_ns: int
    size_rad: tuple[float, float] = (0.0, 0.0)
    """Extents in the image, fore-aft and across."""

    @property
    def finite(self) -> bool:
        return math.isfinite(self.forward_rad) and math.isfinite(self.right_rad)

    @property
    def extent_rad(self) -> float:
        """The larger of its two extents in the image; NaN if the detector does not tell."""
        return max(self.size_rad) if min(self.size_rad) > 0 else math.nan


class Telemetry:
    """The vehicle's state as received. An attribute that was never heard is None."""

    def __init__(self, clock: Clock, frame: WorldFrame) -> None:
        self._clock = clock
        self._frame = frame
        self._boot_ms = 0
        self.heartbeat: Sample[Heartbeat] | None = None
        self.motion: Sample[Motion] | None = None
        self.heading: Sample[float] | None = None
        """Radians clockwise from north."""
        self.home: Sample[Home] | None = None
        self.home_jump = ""
        """Why heights mean nothing any more: home moved while the vehicle was in the air."""
        self.aim: Sample[tuple[float, float]] | None = None
        """Where the vehicle says that it is going, world ENU."""
        self.scan: Sample[Scan] | None = None
        self.landed_state: Sample[int] | None = None
        self.sensors_bad: Sample[int] | None = None
        """MAV_SYS_STATUS_SENSOR bits that are present and unhealthy."""
        self.battery_percent: Sample[float] | None = None
        self.rebooted = False
        self.dropped = 0
        """Messages left out because a number in them was none."""
        self.positions = 0
        """Positions that were received."""
        self.texts = StatusLog()
        self.track = PoseTrack()
        self.sightings: list[Sighting] = []
        self._takers: dict[str, Callable[[Any], None]] = {
            "HEARTBEAT": self._take_heartbeat,
            "SYS_STATUS": self._take_sys_status,
            "BATTERY_STATUS": self._take_battery,
            "EXTENDED_SYS_STATE": self._take_landed_state,
            "HOME_POSITION": self._take_home,
            "GLOBAL_POSITION_INT": self._take_position,
            "ATTITUDE": self._take_attitude,
            "LANDING_TARGET": self._take_sighting,
            "POSITION_TARGET_GLOBAL_INT": self._take_aim,
            "OBSTACLE_DISTANCE": self._take_scan,
        }

    def take(self, message: Any) -> None:
        """Fold one message of the vehicle in; other kinds of message are left alone."""
        kind = message.get_type()
        if kind == "STATUSTEXT":
            self.texts.add(message, self._clock.now_ns())
            return
        taker = self._takers.get(kind)
        if taker is None:
            return
        boot_ms = getattr(message, "time_boot_ms", None)
        if boot_ms is not None:
            self._watch_boot(int(boot_ms))
        taker(message)

    def age_s(self, sample: Sample[Any] | None) -> float:
        """Seconds of mission time since receipt; infinite for what was never heard."""
        return math.inf if sample is None else (self._clock.now_ns() - sample.stamp_ns) / SECOND_NS

    @property
    def airborne(self) -> Sample[bool] | None:
        """Off the ground by the landed-state report; None while it says undefined."""
        state = self.landed_state
        if state is None or state.value == mavlink.MAV_LANDED_STATE_UNDEFINED:
            return None
        return Sample(state.value != mavlink.MAV_LANDED_STATE_ON_GROUND, state.stamp_ns)

    @property
    def armed(self) -> bool:
        return self.heartbeat is not None and self.heartbeat.value.armed

    def _sample(self, value: T) -> Sample[T]:
        return Sample(value, self._clock.now_ns())

    def _watch_boot(self, boot_ms: int) -> None:
        if boot_ms < self._boot_ms - REBOOT_STEP_MS:
            self.rebooted = True
        self._boot_ms = max(self._boot_ms, boot_ms)

    def _take_heartbeat(self, message: Any) -> None:
        armed = bool(message.base_mode & mavlink.MAV_MODE_FLAG_SAFETY_ARMED)
        critical = message.system_status >= mavlink.MAV_STATE_CRITICAL
        self.heartbeat = self._sample(Heartbeat(int(message.custom_mode), armed, critical))

    def _take_sys_status(self, message: Any) -> None:
        present, healthy = message.onboard_control_sensors_present, message.onboard_control_sensors_health
        self.sensors_bad = self._sample(int(present & ~healthy))
        self._take_battery(message)

    def _take_battery(self, message: Any) -> None:
        if 0 <= message.battery_remaining <= 100:
            self.battery_percent = self._sample(float(message.battery_remaining))

    def _take_landed_state(self, message: Any) -> None:
        self.landed_state = self._sample(int(message.landed_state))

    def _take_home(self, message: Any) -> None:
        x_m, y_m = self._frame.to_world(message.latitude / 1e7, message.longitude / 1e7)
        home = Home(x_m, y_m, message.altitude / 1e3)
        if self.home is not None and self.airborne is not None and self.airborne.value:
            self._watch_home(self.home.value, home)
        self.home = self._sample(home)

    def _watch_home(self, old: Home, new: Home) -> None:
        moved_m = math.dist((old.x_m, old.y_m, old.amsl_m), (new.x_m, new.y_m, new.amsl_m))
        if moved_m > HOME_JUMP_M:
            self.home_jump = f"home jumped by {moved_m:.1f} m in flight: heights mean nothing; land and reconnect"

    def _take_scan(self, message: Any) -> None:
        """The far limit itself, one more and 65535 all say that nothing was met."""
        step_deg = message.increment_f or float(message.increment)
        if not (0.0 < abs(step_deg) <= 180.0 and math.isfinite(message.angle_offset)):
            self.dropped += 1
            return
        far_cm = message.max_distance
        ranges_m = tuple(cm / 100.0 if cm <= far_cm else math.inf for cm in message.distances)
        self.scan = self._sample(Scan(ranges_m, math.radians(message.angle_offset), math.radians(step_deg)))

    def _take_aim(self, message: Any) -> None:
        if message.lat_int or message.lon_int:
            self.aim = self._sample(self._frame.to_world(message.lat_int / 1e7, message.lon_int / 1e7))

    def _take_position(self, message: Any) -> None:
        if (message.lat == 0 and message.lon == 0) or abs(message.lat) > 900_000_000:
            self.dropped += 1
            return
        x_m, y_m = self._frame.to_world(message.lat / 1e7, message.lon / 1e7)
        height_m = message.relative_alt / 1e3
        self.motion = self._sample(
            Motion(x_m, y_m, height_m, message.vy / 100.0, message.vx / 100.0, -message.vz / 100.0)
        )
        self.positions += 1
        self.track.add_position(message.time_boot_ms / 1e3, x_m, y_m, height_m)

    def _take_attitude(self, message: Any) -> None:
        angles = (message.roll, message.pitch, message.yaw)
        if not all(map(math.isfinite, angles)):
            self.dropped += 1
            return
        self.heading = self._sample(float(message.yaw))
        self.track.add_attitude(message.time_boot_ms / 1e3, *angles)

    def _take_sighting(self, message: Any) -> None:
        now = self._boot_ms / 1e3
        told = message.time_usec / 1e6
        boot_s = told if abs(told - now) < 10.0 else now
        if len(self.sightings) >= SIGHTINGS_MAX:
            del self.sightings[: SIGHTINGS_MAX // 2]
        angles, size = (float(message.angle_x), float(message.angle_y)), (float(message.size_x), float(message.size_y))
        self.sightings.append(Sighting(*angles, boot_s, self._clock.now_ns(), size))

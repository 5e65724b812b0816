"""A simulated Go2: its sport service over the gait, its telemetry, and what it senses. Plans no way anywhere.

Sport mode's semantics: StandUp locks the joints, BalanceStand unlocks them; Move is heeded only then, not in the
first moments, and for one second; a fall ends in damping.
"""

import math
from collections.abc import Callable, Mapping
from typing import Any

import mujoco
import numpy as np

from crew.sim.noise import GaussMarkov, stream
from crew.sim.unitree.build import OWN, Build
from crew.sim.unitree.gait import Gait, Posture, Sensed
from crew.sim.unitree.link import Link
from crew.sim.unitree.rpc import Service, Switchboard, number_of

WATCHDOG_S = 1.0
"""A Move is heeded for so long."""
DEAF_S = 2.0
"""After BalanceStand, a Move is answered and ignored for so long: the gait settles."""
FALLEN_RAD = 0.9
LIMITS = (1.0, 0.5, 1.5)
POSITION_SIGMA_M, HEADING_SIGMA_RAD = 0.02, math.radians(0.6)
POSITION_TAU_S, HEADING_TAU_S = 8.0, 8.0
VELOCITY_SIGMA_MPS = 0.02
ATTITUDE_SIGMA_RAD = math.radians(0.3)
BATTERY_WH = 230.0
MOTORS = tuple(f"{leg}_{part}" for leg in ("FR", "FL", "RR", "RL") for part in ("hip", "thigh", "calf"))
"""In the SDK's order; a model may have them in another."""
STANDING = (0.0, 0.773, -1.546)
"""Joint angles of one leg that stands."""
FIT, UNFIT = 0, 1001
MODE_IDLE, MODE_BALANCED, MODE_WALKING, MODE_DOWN, MODE_LOCKED, MODE_DAMPED = 0, 1, 3, 5, 6, 7
RANGE_M = 3.0
SEEN_GROUPS = [1, 1, 0, 0, 0, 0]
"""Groups of geoms that the range finder sees: not those of robots' shells."""


class Go2:
    """One robot of the world. `control` at each control step, `tick` at the telemetry's rate."""

    def __init__(
        self,
        model: Any,
        data: Any,
        name: str,
        *,
        link: Link,
        seed: int,
        noise: bool,
        step_s: float,
        tick_s: float,
        build: Build = OWN,
    ) -> None:
        self.link = link
        self.unfit = False
        """A fault of the robot's own that it reports in its telemetry."""
        self.ignores_moves = False
        """Move is answered, and nothing happens."""
        self.tray: Callable[[], tuple[str, float]] = lambda: ("", 0.0)
        """What the tray's sensor reads: the tag of what lies in it, and its weight in newtons."""
        self._model, self._data, self._name = model, data, name
        self._trunk = int(model.body(f"{name}/trunk").id)
        joint = model.body(f"{name}/trunk").jntadr[0]
        start, speed = int(model.jnt_qposadr[joint]), int(model.jnt_dofadr[joint])
        self._pose, self._twist = data.qpos[start : start + 7], data.qvel[speed : speed + 6]
        joints = [model.joint(f"{name}/{motor}") for motor in MOTORS]
        self._joints = np.array([int(joint.qposadr[0]) for joint in joints])
        self._rates = np.array([int(joint.dofadr[0]) for joint in joints])
        self._motors = np.array([int(model.actuator(f"{name}/{motor}").id) for motor in MOTORS])
        data.qpos[self._joints] = STANDING * 4
        self._gait = Gait(step_s, build)
        self._gait.take(Posture.RISING)
        self._gait.stand_at_once()
        self._sensed = Sensed()
        self._random = stream(seed, f"{name}/imu")
        scale = 1.0 if noise else 0.0
        self._drift = [
            GaussMarkov(stream(seed, f"{name}/{axis}"), scale * sigma, tau_s, tick_s)
            for axis, sigma, tau_s in (
                ("x", POSITION_SIGMA_M, POSITION_TAU_S),
                ("y", POSITION_SIGMA_M, POSITION_TAU_S),
                ("yaw", HEADING_SIGMA_RAD, HEADING_TAU_S),
            )
        ]
        self._jitter = scale
        self._yaw = 0.0
        self._locked = False
        self._fallen = False
        self._now_ns = self._heeds_ns = 0
        self._expires_ns = 0
        self._charge_wh = BATTERY_WH * 0.93
        self._tick_s = tick_s
        self.sport = self._service()
        self._switchboard = Switchboard([self.sport])
        self._read()

    @property
    def walking(self) -> bool:
        return self._gait.posture is Posture.WALKING

    @property
    def true_pose(self) -> tuple[float, float, float, float]:
        """x, y, z of the trunk and its heading: the world's, without noise."""
        x, y, z = self._pose[:3].tolist()
        return x, y, z, self._yaw

    def shove(self, impulse_ns: float, direction_rad: float, height_m: float = 0.0) -> None:
        """Push the trunk sideways, as a kick or a collision does: newton-seconds, relative to its heading."""
        mass = float(self._model.body_subtreemass[self._trunk])
        angle = self._yaw + direction_rad
        change = impulse_ns / mass
        self._twist[0] += change * math.cos(angle)
        self._twist[1] += change * math.sin(angle)
        self._twist[3] += height_m * impulse_ns * -math.sin(direction_rad)

    def control(self) -> None:
        """One step of the inner loop."""
        self._read()
        if not self._fallen and max(abs(self._sensed.roll), abs(self._sensed.pitch)) > FALLEN_RAD:
            self._fallen = True
            self._gait.take(Posture.DAMPED)
        data = self._data
        joints, rates = data.qpos[self._joints].tolist(), data.qvel[self._rates].tolist()
        data.ctrl[self._motors] = self._gait.step(joints, rates, self._sensed)

    def poll(self, now_ns: int) -> int:
        """Answer the calls that wait; how many."""
        self._now_ns = now_ns
        count = 0
        for topic, body in self.link.messages():
            count += 1
            answer = self._switchboard.take(topic, body, now_ns)
            if answer is not None:
                self.link.publish(*answer)
        return count

    def tick(self, now_ns: int) -> None:
        """Take calls, mind the watchdog, tell."""
        self.poll(now_ns)
        if now_ns > self._expires_ns:
            self._gait.want(0.0, 0.0, 0.0)
        watts = 120.0 if self.walking else 60.0
        self._charge_wh = max(0.0, self._charge_wh - watts * self._tick_s / 3600.0)
        for drift in self._drift:
            drift.step()
        self.link.publish("rt/sportmodestate", self._sport_state())
        self.link.publish("rt/lowstate", self._low_state())
        tag, weight_n = self.tray()
        self.link.publish("rt/crew/tray", {"object": tag, "weight_n": round(weight_n, 2)})

    # The sport service.

    def _service(self) -> Service:
        sport = Service("sport", "1.0.0.1")
        sport.offer(1001, self._damp, leased=False)
        sport.offer(1002, self._balance_stand)
        sport.offer(1003, self._stop_move, leased=False)
        sport.offer(1004, self._stand_up)
        sport.offer(1005, self._stand_down)
        sport.offer(1006, self._recovery_stand)
        sport.offer(1007, lambda _: (0, None))
        sport.offer(1008, self._move)
        return sport

    def _damp(self, _: Mapping[str, Any]) -> tuple[int, Any]:
        self._gait.take(Posture.DAMPED)
        return 0, None

    def _balance_stand(self, _: Mapping[str, Any]) -> tuple[int, Any]:
        if self._locked and self._gait.at_height:
            self._locked = False
            self._heeds_ns = self._now_ns + round(DEAF_S * 1e9)
        return 0, None

    def _stop_move(self, _: Mapping[str, Any]) -> tuple[int, Any]:
        self._expires_ns = 0
        self._gait.want(0.0, 0.0, 0.0)
        return 0, None

    def _stand_up(self, _: Mapping[str, Any]) -> tuple[int, Any]:
        if not self._fallen and self._gait.posture in (Posture.DAMPED, Posture.LOWERING):
            self._gait.take(Posture.RISING)
            self._locked = True
        return 0, None

    def _stand_down(self, _: Mapping[str, Any]) -> tuple[int, Any]:
        if not self._fallen and self._gait.posture is not Posture.DAMPED:
            self._gait.take(Posture.LOWERING)
        return 0, None

    def _recovery_stand(self, _: Mapping[str, Any]) -> tuple[int, Any]:
        """It gets up from lying, not from its back: the call is answered all the same, as the real one is."""
        return self._stand_up({})

    def _move(self, parameters: Mapping[str, Any]) -> tuple[int, Any]:
        wanted = [number_of(parameters, axis) for axis in "xyz"]
        heeds = not (self._locked or self._fallen or self.ignores_moves) and self._now_ns >= self._heeds_ns
        if heeds and self._gait.posture in (Posture.STANDING, Posture.WALKING):
            bounded = [max(-limit, min(limit, value)) for value, limit in zip(wanted, LIMITS, strict=True)]
            self._gait.want(*bounded)
            self._expires_ns = self._now_ns + round(WATCHDOG_S * 1e9)
        return 0, None

    # What it senses and tells.

    def _read(self) -> None:
        w, i, j, k = self._pose[3:7].tolist()
        vx, vy, vz, p, q, r = self._twist.tolist()
        self._yaw = math.atan2(2.0 * (w * k + i * j), 1.0 - 2.0 * (j * j + k * k))
        gauss, scale = self._random.gauss, self._jitter
        sensed = self._sensed
        sensed.roll = math.atan2(2.0 * (w * i + j * k), 1.0 - 2.0 * (i * i + j * j))
        sensed.pitch = math.asin(max(-1.0, min(1.0, 2.0 * (w * j - k * i))))
        c, s = math.cos(self._yaw), math.sin(self._yaw)
        ahead, left = c * vx + s * vy, -s * vx + c * vy
        if scale:
            sensed.roll += gauss(0.0, ATTITUDE_SIGMA_RAD)
            sensed.pitch += gauss(0.0, ATTITUDE_SIGMA_RAD)
            ahead, left = ahead + gauss(0.0, VELOCITY_SIGMA_MPS), left + gauss(0.0, VELOCITY_SIGMA_MPS)
        sensed.rates = (p, q, r)
        sensed.velocity = (ahead, left, vz)

    def _mode(self) -> int:
        match self._gait.posture:
            case Posture.WALKING:
                return MODE_WALKING
            case Posture.LOWERING:
                return MODE_DOWN
            case Posture.DAMPED:
                return MODE_DAMPED
        return MODE_LOCKED if self._locked else MODE_BALANCED

    def _sport_state(self) -> dict[str, Any]:
        x, y, z = self._pose[:3].tolist()
        yaw = self._yaw + self._drift[2].value
        s = self._sensed
        vx, vy = self._twist[:2].tolist()
        return {
            "stamp": {"sec": self._now_ns // 10**9, "nanosec": self._now_ns % 10**9},
            "error_code": UNFIT if self.unfit else FIT,
            "imu_state": {"rpy": [s.roll, s.pitch, yaw], "gyroscope": list(s.rates)},
            "mode": self._mode(),
            "position": [x + self._drift[0].value, y + self._drift[1].value, z],
            "body_height": z,
            "velocity": [vx, vy, s.velocity[2]],
            "yaw_speed": s.rates[2],
            "range_obstacle": [self._range(), RANGE_M, RANGE_M, RANGE_M],
        }

    def _low_state(self) -> dict[str, Any]:
        q, dq = self._data.qpos[self._joints].tolist(), self._data.qvel[self._rates].tolist()
        return {
            "motor_state": [{"q": a, "dq": b} for a, b in zip(q, dq, strict=True)],
            "bms_state": {"soc": round(100.0 * self._charge_wh / BATTERY_WH)},
            "imu_state": {"rpy": [self._sensed.roll, self._sensed.pitch, self._yaw + self._drift[2].value]},
        }

    def _range(self) -> float:
        """Distance from the nose to what stands ahead at trunk height, as the front's range finder tells it."""
        x, y, z = self._pose[:3].tolist()
        c, s = math.cos(self._yaw), math.sin(self._yaw)
        nose = [x + 0.32 * c, y + 0.32 * s, z]
        found = mujoco.mj_ray(self._model, self._data, nose, [c, s, 0.0], SEEN_GROUPS, 1, self._trunk, None, None)
        return min(RANGE_M, found) if found >= 0.0 else RANGE_M

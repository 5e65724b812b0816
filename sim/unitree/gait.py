"""The quadruped's inner loop: a trot after Raibert, forces by least squares, and the four postures. Knows no calls.

Frames: "level" is the trunk's frame turned upright: x ahead along its heading, z up. Metres, seconds, newtons.
"""

import math
from enum import StrEnum

from crew.sim.unitree.build import OWN, Build
from crew.sim.unitree.leg import Leg, Vector, torques, velocity
from crew.sim.unitree.stance import stance_forces

GRAVITY = 9.81
LEGS = (
    Leg(0.1934, -0.0465, -0.0955),
    Leg(0.1934, 0.0465, 0.0955),
    Leg(-0.1934, -0.0465, -0.0955),
    Leg(-0.1934, 0.0465, 0.0955),
)
"""Front right, front left, rear right, rear left."""
PHASES = (0.0, 0.5, 0.5, 0.0)
PERIOD_S = 0.28
DUTY = 0.6
"""Share of the period that a foot stands."""
LIFT_M = 0.06
HEIGHT_M = 0.31
LYING_M = 0.12
RISE_MPS = 0.15
STEP_MAX_M = 0.16
SPEED_FEEDBACK_S = 0.06
"""How far a foot lands further out for each m/s that the trunk is too fast."""
REST_STEPS = 3
"""Steps on the spot at the end of a walk, which bring the feet below the hips."""
DAMP_GAIN = 3.0


class Posture(StrEnum):
    """What the robot does with its legs."""

    DAMPED = "damped"
    RISING = "rising"
    STANDING = "standing"
    WALKING = "walking"
    LOWERING = "lowering"


class Sensed:
    """What the loop reads at each step: attitude, rates in the trunk's frame, velocity in the level one."""

    __slots__ = ("pitch", "rates", "roll", "velocity")

    def __init__(self) -> None:
        self.roll = self.pitch = 0.0
        self.rates: Vector = (0.0, 0.0, 0.0)
        self.velocity: Vector = (0.0, 0.0, 0.0)


class Gait:
    """Turns a wanted velocity into twelve torques, for one build of body. `step` at a fixed period."""

    def __init__(self, step_s: float, build: Build = OWN) -> None:
        self.posture = Posture.DAMPED
        self.payload_kg = 0.0
        self._step_s, self._build = step_s, build
        self._phase = 0.0
        self._height_m = LYING_M
        self._wanted: Vector = (0.0, 0.0, 0.0)
        self._eased: Vector = (0.0, 0.0, 0.0)
        self._lifted: list[Vector | None] = [None] * 4
        self._rest = 0

    def stand_at_once(self) -> None:
        """Begin on its feet, as a robot that was switched on a while ago."""
        self.posture, self._height_m = Posture.STANDING, HEIGHT_M

    @property
    def at_height(self) -> bool:
        """Whether a rise or a lowering has come to its end."""
        return self._height_m in (HEIGHT_M, LYING_M)

    def want(self, forward_mps: float, left_mps: float, turn_rps: float) -> None:
        """The velocity to walk with, in the level frame. Heeded while standing or walking."""
        self._wanted = (forward_mps, left_mps, turn_rps)

    def take(self, posture: Posture) -> None:
        """Change what the legs do."""
        if posture is Posture.RISING and self.posture is Posture.DAMPED:
            self._height_m = LYING_M
        if posture in (Posture.DAMPED, Posture.RISING, Posture.LOWERING):
            self._wanted = self._eased = (0.0, 0.0, 0.0)
        self.posture = posture

    def step(self, joints: list[float], rates: list[float], sensed: Sensed) -> list[float]:
        """Torques, in the joints' order, for joint angles and rates in the same order."""
        if self.posture is Posture.DAMPED:
            return [-DAMP_GAIN * rate for rate in rates]
        self._plan()
        frames = [LEGS[i].foot(joints[3 * i], joints[3 * i + 1], joints[3 * i + 2]) for i in range(4)]
        tilt = _Tilt(sensed.roll, sensed.pitch)
        feet = [tilt.level(frame[0]) for frame in frames]
        swings = [self._swing(i) for i in range(4)]
        standing = [i for i in range(4) if swings[i] is None]
        for i in standing:
            self._lifted[i] = None
        pushes = self._pushes(feet, standing, sensed)
        found: list[float] = []
        for i in range(4):
            columns = frames[i][1]
            if i in pushes:
                fx, fy, fz = pushes[i]
                force = tilt.trunk((-fx, -fy, -fz))
            else:
                speed = tilt.level(velocity(columns, (rates[3 * i], rates[3 * i + 1], rates[3 * i + 2])))
                force = tilt.trunk(self._reach(i, swings[i] or 0.0, feet[i], speed, sensed))
            found.extend(torques(columns, force))
        return self._overcome(found, rates)

    def _overcome(self, pushes: list[float], rates: list[float]) -> list[float]:
        """Torques with what the joints' bearings take from them while the legs swing."""
        damping = self._build.damping_nms
        if not damping or self.posture is not Posture.WALKING:
            return pushes
        return [push + damping * rate for push, rate in zip(pushes, rates, strict=True)]

    # What is wanted now.

    def _plan(self) -> None:
        self._ease()
        self._raise()
        self._choose()

    def _ease(self) -> None:
        """Follow the wanted velocity at a bounded acceleration."""
        limit = 1.0 * self._step_s
        turn_limit = 3.0 * self._step_s
        x, y, w = self._eased
        wx, wy, ww = self._wanted if self.posture is Posture.WALKING else (0.0, 0.0, 0.0)
        self._eased = (_towards(x, wx, limit), _towards(y, wy, limit), _towards(w, ww, turn_limit))

    def _raise(self) -> None:
        goal = LYING_M if self.posture is Posture.LOWERING else HEIGHT_M
        self._height_m = _towards(self._height_m, goal, RISE_MPS * self._step_s)

    def _choose(self) -> None:
        """Between standing and walking; a walk ends at the end of a step, once it has come to rest."""
        if self.posture is Posture.RISING and self.at_height:
            self.posture = Posture.STANDING
        moving = max(map(abs, self._wanted)) > 0.01 or max(map(abs, self._eased)) > 0.01
        if self.posture is Posture.STANDING and moving:
            self.posture, self._phase = Posture.WALKING, 0.0
        if self.posture is not Posture.WALKING:
            return
        before = self._phase
        self._phase = (self._phase + self._step_s / PERIOD_S) % 1.0
        if not moving and (self._phase < before or before < 0.5 <= self._phase):
            self._rest += 1
            if self._rest > REST_STEPS:
                self.posture = Posture.STANDING
        elif moving:
            self._rest = 0

    def _swing(self, leg: int) -> float | None:
        """How far a foot's swing has come, 0 to 1; None while it stands."""
        if self.posture is not Posture.WALKING:
            return None
        phase = (self._phase + PHASES[leg]) % 1.0
        return None if phase < DUTY else (phase - DUTY) / (1.0 - DUTY)

    # The standing feet.

    def _pushes(self, feet: list[Vector], standing: list[int], sensed: Sensed) -> dict[int, Vector]:
        n = len(standing)
        vx, vy, vz = sensed.velocity
        wx, wy, ww = self._eased
        mass = self._build.mass_kg + self.payload_kg
        height = -sum(feet[i][2] for i in standing) / n
        ax, ay = 5.0 * (wx - vx), 5.0 * (wy - vy)
        if self.posture is not Posture.WALKING:
            ax += 20.0 * (sum(feet[i][0] for i in standing) / n)
            ay += 20.0 * (sum(feet[i][1] for i in standing) / n)
        force = (
            mass * ax,
            mass * ay,
            mass * (GRAVITY + 90.0 * (self._height_m - height) - 14.0 * vz),
        )
        p, q, r = sensed.rates
        twist = 0.0 if self.posture is Posture.WALKING else 60.0 * _twist(feet)
        moment = (-150.0 * sensed.roll - 12.0 * p, -220.0 * sensed.pitch - 16.0 * q, 8.0 * (ww - r) + twist)
        found = stance_forces([(x, y, z) for x, y, z in (feet[i] for i in standing)], force, moment)
        return dict(zip(standing, found, strict=True))

    # The swinging feet.

    def _reach(self, leg: int, along: float, foot: Vector, speed: Vector, sensed: Sensed) -> Vector:
        """The force that draws a foot along its swing, in the level frame."""
        start = self._lifted[leg]
        if start is None:
            start = self._lifted[leg] = foot
        goal = self._landing(leg, sensed)
        share = along * along * (3.0 - 2.0 * along)
        rise = math.sin(math.pi * along)
        x = start[0] + (goal[0] - start[0]) * share
        y = start[1] + (goal[1] - start[1]) * share
        ground = -self._height_m
        z = start[2] + (ground - 0.005 - start[2]) * share + LIFT_M * rise
        vx, vy, vz = speed
        return 600.0 * (x - foot[0]) - 12.0 * vx, 600.0 * (y - foot[1]) - 12.0 * vy, 600.0 * (z - foot[2]) - 12.0 * vz

    def _landing(self, leg: int, sensed: Sensed) -> Vector:
        """Raibert's neutral point and the correction of the speed's error."""
        half_s = DUTY * PERIOD_S / 2.0
        vx, vy, _ = sensed.velocity
        wx, wy, turn = self._eased
        hip_x, hip_y = LEGS[leg].hip_x_m, LEGS[leg].home_y_m
        dx = vx * half_s + SPEED_FEEDBACK_S * (vx - wx) - turn * hip_y * half_s
        dy = vy * half_s + SPEED_FEEDBACK_S * (vy - wy) + turn * hip_x * half_s
        dx = max(-STEP_MAX_M, min(STEP_MAX_M, dx))
        dy = max(-STEP_MAX_M, min(STEP_MAX_M, dy))
        return hip_x + dx, hip_y + dy, -self._height_m


class _Tilt:
    """Between the trunk's frame and the level one: a turn by pitch and roll."""

    def __init__(self, roll: float, pitch: float) -> None:
        self._cr, self._sr = math.cos(roll), math.sin(roll)
        self._cp, self._sp = math.cos(pitch), math.sin(pitch)

    def level(self, v: Vector) -> Vector:
        x, y, z = v
        a = self._sr * y + self._cr * z
        return self._cp * x + self._sp * a, self._cr * y - self._sr * z, -self._sp * x + self._cp * a

    def trunk(self, v: Vector) -> Vector:
        x, y, z = v
        a = self._sp * x + self._cp * z
        return self._cp * x - self._sp * z, self._cr * y + self._sr * a, -self._sr * y + self._cr * a


def _twist(feet: list[Vector]) -> float:
    """How far the trunk is turned against its four standing feet, radians."""
    total = 0.0
    for leg, (x, y, _) in zip(LEGS, feet, strict=True):
        total += (leg.hip_x_m * y - leg.home_y_m * x) / (leg.hip_x_m**2 + leg.home_y_m**2)
    return total / 4.0


def _towards(value: float, goal: float, limit: float) -> float:
    return min(goal, value + limit) if value < goal else max(goal, value - limit)

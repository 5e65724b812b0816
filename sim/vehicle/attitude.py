"""The quadcopter's fast loop: from a wanted acceleration and yaw to four thrusts. Pure; scalar for speed."""

import math

from crew.sim.geo import wrap_rad
from crew.sim.vehicle.profile import clamp
from crew.sim.vehicle.state import State

MASS_KG = 1.5
GRAVITY = 9.81
ARM_M = 0.18  # of each rotor along x and along y
DRAG_M = 0.06  # torque per newton of thrust, about z
INERTIA_XY, INERTIA_Z = 0.018, 0.032  # kg m^2
THRUST_MAX_N = 8.0

TILT_GAIN, YAW_GAIN = 7.0, 2.0  # 1/s: angle to rate
RATE_GAIN_XY, RATE_GAIN_Z = 20.0, 8.0  # 1/s: rate to angular acceleration
RATE_MAX, YAW_RATE_MAX = 3.5, 1.2  # rad/s

Thrusts = tuple[float, float, float, float]
STILL: Thrusts = (0.0, 0.0, 0.0, 0.0)


def attitude_step(s: State, ax: float, ay: float, az: float, yaw_rad: float) -> Thrusts:
    """Thrusts (N; front left, front right, back left, back right) that turn the body's z towards a + g.

    s: the estimate. (ax, ay, az): wanted acceleration, world frame, m/s^2. yaw_rad: wanted yaw.
    """
    fx, fy, fz = ax, ay, az + GRAVITY
    cr, sr = math.cos(s.roll), math.sin(s.roll)
    cp, sp = math.cos(s.pitch), math.sin(s.pitch)
    cy, sy = math.cos(s.yaw), math.sin(s.yaw)
    # The wanted force in body axes: forward, left, up.
    forward = fx * cy + fy * sy
    left = fy * cy - fx * sy
    bx = forward * cp - fz * sp
    level = forward * sp + fz * cp
    by = left * cr + level * sr
    bz = level * cr - left * sr
    norm = math.sqrt(bx * bx + by * by + bz * bz) or 1.0
    roll_rate = clamp(-TILT_GAIN * by / norm, -RATE_MAX, RATE_MAX)
    pitch_rate = clamp(TILT_GAIN * bx / norm, -RATE_MAX, RATE_MAX)
    yaw_rate = clamp(YAW_GAIN * wrap_rad(yaw_rad - s.yaw), -YAW_RATE_MAX, YAW_RATE_MAX)
    return mix(
        MASS_KG * max(0.0, bz),
        INERTIA_XY * RATE_GAIN_XY * (roll_rate - s.p),
        INERTIA_XY * RATE_GAIN_XY * (pitch_rate - s.q),
        INERTIA_Z * RATE_GAIN_Z * (yaw_rate - s.r),
    )


def mix(thrust: float, torque_x: float, torque_y: float, torque_z: float) -> Thrusts:
    """Share a total thrust (N) and body torques (N m) among the rotors, each within what it can give."""
    lift = thrust / 4.0
    x = torque_x / (4.0 * ARM_M)
    y = torque_y / (4.0 * ARM_M)
    z = clamp(torque_z / (4.0 * DRAG_M), -0.5, 0.5)  # yaw may not use up what holds the craft level
    return (
        clamp(lift + x - y - z, 0.0, THRUST_MAX_N),
        clamp(lift - x - y + z, 0.0, THRUST_MAX_N),
        clamp(lift + x + y + z, 0.0, THRUST_MAX_N),
        clamp(lift - x + y - z, 0.0, THRUST_MAX_N),
    )

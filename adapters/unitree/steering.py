"""From a pose and a point to a velocity: forward along the way, or sideways with a held heading. Pure. World ENU."""

import math

Spot = tuple[float, float]
Velocity = tuple[float, float, float]
"""Ahead and left in m/s, counter-clockwise in rad/s."""

TURN_GAIN, TURN_MAX_RPS = 1.8, 0.9
AHEAD_RAD = 0.5
"""Walking begins once the heading is within this of the way."""
SLOW_M = 0.5
"""Over the last stretch the speed falls with the distance."""
CREEP_GAIN, CREEP_MAX_MPS = 1.0, 0.22


def wrap_rad(angle: float) -> float:
    return math.remainder(angle, math.tau)


def along(here: Spot, yaw_rad: float, goal: Spot, cruise_mps: float, left_m: float) -> Velocity:
    """Turn towards a point and walk to it; `left_m` is what is left to the end of the whole way."""
    away = wrap_rad(math.atan2(goal[1] - here[1], goal[0] - here[0]) - yaw_rad)
    turn = _bounded(TURN_GAIN * away, TURN_MAX_RPS)
    if abs(away) > AHEAD_RAD:
        return 0.0, 0.0, turn
    speed = cruise_mps * min(1.0, max(0.3, left_m / SLOW_M)) * math.cos(away)
    return speed, 0.0, turn


def sideways(here: Spot, yaw_rad: float, goal: Spot, heading_rad: float) -> Velocity:
    """Creep to a point in any direction while holding a heading."""
    east, north = goal[0] - here[0], goal[1] - here[1]
    c, s = math.cos(yaw_rad), math.sin(yaw_rad)
    ahead, left = CREEP_GAIN * (c * east + s * north), CREEP_GAIN * (-s * east + c * north)
    scale = min(1.0, CREEP_MAX_MPS / max(1e-9, math.hypot(ahead, left)))
    return ahead * scale, left * scale, _bounded(TURN_GAIN * wrap_rad(heading_rad - yaw_rad), TURN_MAX_RPS)


def _bounded(value: float, limit: float) -> float:
    return max(-limit, min(limit, value))

"""The speed at which to approach a target so that braking stays within a limit. Pure."""

import math


def approach_speed(distance: float, gain: float, brake: float, limit: float) -> float:
    """Speed towards a target `distance` away: proportional (gain, 1/s) close by, constant braking (m/s^2) further out.

    The two parts meet with the same value and slope, and the result never exceeds `limit`.
    """
    knee = brake / (gain * gain)
    if distance <= knee:
        return min(limit, gain * distance)
    return min(limit, math.sqrt(2.0 * brake * (distance - knee / 2.0)))


def approach_rate(error: float, gain: float, brake: float, limit_up: float, limit_down: float) -> float:
    """The same along one axis, with the sign of `error` and a limit for each direction."""
    if error >= 0.0:
        return approach_speed(error, gain, brake, limit_up)
    return -approach_speed(-error, gain, brake, limit_down)


def clamp(value: float, low: float, high: float) -> float:
    return low if value < low else high if value > high else value

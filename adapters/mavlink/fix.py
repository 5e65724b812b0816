"""One position from many looks. Pure. World ENU, metres.

Looks close in time share the vehicle's pose error, which drifts over seconds, so a second of looks at 5 Hz is worth
little more than one of them: each is weighted by how few others are near it in time.
"""

import math
from collections.abc import Sequence
from statistics import median

import msgspec

from crew.adapters.mavlink.camera import Look

POSE_SIGMA_M = 0.15
POSE_TAU_S = 4.0
ATTITUDE_SIGMA_RAD = math.radians(1.5)
ATTITUDE_TAU_S = 1.0
CLUSTER_M = 1.2
"""Looks at one thing lie within this of their median: over four sigma of a single look from 5 m."""


class Fix(msgspec.Struct, frozen=True):
    """Where one thing is. covariance_m2: xx, xy, yy. extent_m: the median of what was told, NaN if nothing was."""

    x_m: float
    y_m: float
    covariance_m2: tuple[float, float, float]
    looks: int
    last_s: float
    extent_m: float

    @property
    def sigma_m(self) -> float:
        """One sigma along an axis, the mean of both."""
        return math.sqrt((self.covariance_m2[0] + self.covariance_m2[2]) / 2)


def combine(looks: Sequence[Look]) -> Fix | None:
    """The position that most looks agree on; None without any."""
    return None if not looks else locate(cluster(looks))


def locate(looks: Sequence[Look]) -> Fix:
    """The weighted mean of looks at one thing, at least one."""
    weights = [1.0 / sum(covariance_m2(a, b) for b in looks) for a in looks]
    total = sum(weights)
    x_m = sum(w * look.x_m for w, look in zip(weights, looks, strict=True)) / total
    y_m = sum(w * look.y_m for w, look in zip(weights, looks, strict=True)) / total
    extents = [look.extent_m for look in looks if math.isfinite(look.extent_m)]
    return Fix(
        x_m=x_m,
        y_m=y_m,
        covariance_m2=_covariance(looks, weights, x_m, y_m),
        looks=len(looks),
        last_s=max(look.time_s for look in looks),
        extent_m=median(extents) if extents else math.nan,
    )


def _covariance(looks: Sequence[Look], weights: Sequence[float], x_m: float, y_m: float) -> tuple[float, float, float]:
    """Of the mean: what the error model expects, or what the looks' own scatter says where that is more."""
    pairs = list(zip(weights, looks, strict=True))
    total = sum(weights)
    expected_m2 = sum(wa * wb * covariance_m2(a, b) for wa, a in pairs for wb, b in pairs) / total**2
    single_m2 = sum(w * covariance_m2(a, a) for w, a in pairs) / total
    share = expected_m2 / single_m2 / total
    xx = share * sum(w * (look.x_m - x_m) ** 2 for w, look in pairs)
    xy = share * sum(w * (look.x_m - x_m) * (look.y_m - y_m) for w, look in pairs)
    yy = share * sum(w * (look.y_m - y_m) ** 2 for w, look in pairs)
    return max(expected_m2, xx), xy, max(expected_m2, yy)


def cluster(looks: Sequence[Look]) -> list[Look]:
    """The looks around the median of the densest neighbourhood."""
    crowds = ([b for b in looks if near(a.x_m, a.y_m, b)] for a in looks)
    crowd = max(crowds, key=len)
    x_m, y_m = median(look.x_m for look in crowd), median(look.y_m for look in crowd)
    return [look for look in looks if near(x_m, y_m, look)] or crowd


def covariance_m2(a: Look, b: Look) -> float:
    """Covariance of two looks along one axis, under the error model above."""
    apart_s = abs(a.time_s - b.time_s)
    pose = POSE_SIGMA_M**2 * math.exp(-apart_s / POSE_TAU_S)
    return pose + a.range_m * b.range_m * ATTITUDE_SIGMA_RAD**2 * math.exp(-apart_s / ATTITUDE_TAU_S)


def near(x_m: float, y_m: float, look: Look) -> bool:
    """Whether a look may be at what is at a point."""
    return math.hypot(look.x_m - x_m, look.y_m - y_m) <= CLUSTER_M

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
"""Looks at one person lie within this of their median: over four sigma of a single look from 5 m."""
APART_M = 2.0
OTHER_LOOKS = 5
"""This many looks together, at least `APART_M` away, are somebody else."""


class Fix(msgspec.Struct, frozen=True):
    """`ambiguous` says that somebody else was seen as well."""

    x_m: float
    y_m: float
    sigma_m: float
    looks: int
    last_s: float
    ambiguous: bool


def combine(looks: Sequence[Look]) -> Fix | None:
    """The position that most looks agree on; None without any."""
    if not looks:
        return None
    inliers = cluster(looks)
    chosen = set(map(id, inliers))
    rest = [look for look in looks if id(look) not in chosen]
    weights = [1.0 / sum(covariance_m2(a, b) for b in inliers) for a in inliers]
    total = sum(weights)
    x_m = sum(w * look.x_m for w, look in zip(weights, inliers, strict=True)) / total
    y_m = sum(w * look.y_m for w, look in zip(weights, inliers, strict=True)) / total
    variance_m2 = sum(
        wa * wb * covariance_m2(a, b)
        for wa, a in zip(weights, inliers, strict=True)
        for wb, b in zip(weights, inliers, strict=True)
    )
    far = [look for look in rest if math.hypot(look.x_m - x_m, look.y_m - y_m) > APART_M]
    return Fix(
        x_m=x_m,
        y_m=y_m,
        sigma_m=math.sqrt(variance_m2) / total,
        looks=len(inliers),
        last_s=max(look.time_s for look in inliers),
        ambiguous=bool(far) and len(cluster(far)) >= OTHER_LOOKS,
    )


def cluster(looks: Sequence[Look]) -> list[Look]:
    """The looks around the median of the densest neighbourhood."""
    crowds = ([b for b in looks if _near(a.x_m, a.y_m, b)] for a in looks)
    crowd = max(crowds, key=len)
    x_m, y_m = median(look.x_m for look in crowd), median(look.y_m for look in crowd)
    return [look for look in looks if _near(x_m, y_m, look)] or crowd


def covariance_m2(a: Look, b: Look) -> float:
    """Covariance of two looks along one axis, under the error model above."""
    apart_s = abs(a.time_s - b.time_s)
    pose = POSE_SIGMA_M**2 * math.exp(-apart_s / POSE_TAU_S)
    return pose + a.range_m * b.range_m * ATTITUDE_SIGMA_RAD**2 * math.exp(-apart_s / ATTITUDE_TAU_S)


def _near(x_m: float, y_m: float, look: Look) -> bool:
    return math.hypot(look.x_m - x_m, look.y_m - y_m) <= CLUSTER_M
